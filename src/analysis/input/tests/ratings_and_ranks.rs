//! Tables and results folders of ratings and of rankings.

use super::*;
use crate::analysis::dataset::{Rank, Rating};

const RANKS: &str = "participant,condition,technique,rank\n";
const RATINGS: &str = "participant,condition,technique,scale,rating\n";

fn ranks(data: &Dataset) -> Vec<(&str, &str, &str, f32)> {
    let of = |rank: &Rank| {
        (
            data.participants[rank.participant as usize].as_str(),
            data.rankings.conditions[rank.condition as usize].as_str(),
            data.rankings.techniques[rank.technique as usize].as_str(),
            rank.rank,
        )
    };
    data.rankings.answers.iter().map(of).collect()
}

fn ratings(data: &Dataset) -> Vec<(&str, &str, &str, &str, f32)> {
    let of = |rating: &Rating| {
        (
            data.participants[rating.participant as usize].as_str(),
            data.ratings.conditions[rating.condition as usize].as_str(),
            data.ratings.techniques[rating.technique as usize].as_str(),
            data.ratings.scales[rating.scale as usize].as_str(),
            rating.value,
        )
    };
    data.ratings.answers.iter().map(of).collect()
}

#[test]
fn a_rank_table_is_read_whatever_the_order_of_its_rows() {
    let data = read_texts(&[&format!(
        "{RANKS}P1,z,gtao,2\nP1,a,none,1\nP1,z,none,1\nP1,a,gtao,2\n"
    )])
    .unwrap();
    assert_eq!(
        ranks(&data),
        [
            ("P1", "a", "gtao", 2.0),
            ("P1", "a", "none", 1.0),
            ("P1", "z", "gtao", 2.0),
            ("P1", "z", "none", 1.0),
        ]
    );
    assert_eq!(data.sources[0].kind, "rank table");
    assert!(!data.has_answers() && data.conditions.is_empty());
}

/// Places 1, 1, 2, and 1, 1, 3, and 1.5, 1.5, 3: three ways to write the same.
#[test]
fn ties_have_the_mean_of_their_places_however_they_are_written() {
    for (first, last) in [("1", "2"), ("1", "3"), ("1.5", "3")] {
        let text = format!("{RANKS}P,c,x,{first}\nP,c,y,{last}\nP,c,z,{first}\n");
        let data = read_texts(&[&text]).unwrap();
        let found: Vec<f32> = data.rankings.answers.iter().map(|it| it.rank).collect();
        assert_eq!(found, [1.5, 3.0, 1.5]);
    }
}

#[test]
fn a_rating_table_is_read() {
    let data = read_texts(&[&format!(
        "{RATINGS}P1,c,none,realism,3\nP1,c,gtao,realism,6.5\nP1,c,none,pleasing,-2\n"
    )])
    .unwrap();
    assert_eq!(
        ratings(&data),
        [
            ("P1", "c", "none", "realism", 3.0),
            ("P1", "c", "gtao", "realism", 6.5),
            ("P1", "c", "none", "pleasing", -2.0),
        ]
    );
}

#[test]
fn bad_ranks_and_ratings_are_named_with_their_place() {
    let k = |rows: &str| format!("{RANKS}{rows}");
    let r = |rows: &str| format!("{RATINGS}{rows}");
    for (texts, parts) in [
        (
            vec![k("P,c,x,0\n")],
            vec![":2: column `rank`", "`0`", "from 1"],
        ),
        (vec![k("P,c,x,inf\n")], vec![":2: column `rank`", "`inf`"]),
        (vec![k("P,c,x,best\n")], vec![":2: column `rank`", "`best`"]),
        (vec![k("P,c,x,\n")], vec![":2: column `rank`", "``"]),
        (vec![k("P,c,,1\n")], vec![":2:", "technique is empty"]),
        (
            vec![k("P,c,x,1\nP,c,y,2\nP,c,x,3\n")],
            vec![
                ":4:",
                "participant P ranks x of condition c a second time",
                "0.csv:2",
            ],
        ),
        (
            vec![r("P,c,x,s,NaN\n")],
            vec![":2: column `rating`", "`NaN`", "finite"],
        ),
        (
            vec![r("P,c,x,s,1e99\n")],
            vec![":2: column `rating`", "`1e99`"],
        ),
        (
            vec![r("P,c,x,,5\n")],
            vec![":2: column `scale`", "is empty"],
        ),
        (
            vec![r("P,c,x,s,1\nP,c,x,t,1\n"), r("P,c,x,t,2\n")],
            vec![
                "1.csv:2:",
                "rates x of condition c on t a second time",
                "0.csv:3",
            ],
        ),
        (
            vec!["participant,condition,technique,rating\nP,c,x,1\n".into()],
            vec![
                ":1:",
                "lacks `scale`",
                "needed participant,condition,technique,scale,rating",
            ],
        ),
        (
            vec![k("P,c,x,1\n"), r("P,c,x,s,1\n")],
            vec!["1.csv", "ratings and rankings cannot be analysed together"],
        ),
        (
            vec![format!("{TRIALS}P,c,x,y,first,\n"), k("P,c,x,1\n")],
            vec![
                "1.csv",
                "single choices and rankings cannot be analysed together",
            ],
        ),
    ] {
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let message = error_of(&texts);
        for part in parts {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }
}

/// A single image is a condition of its own there; versions of one view are to be compared.
#[test]
fn rated_images_of_one_view_are_one_condition() {
    let rated = |participant, index, technique: &str, ratings: &str| TrialRow {
        procedure: "rating".into(),
        condition: format!("atrium-moderate-{technique}"),
        technique_first: technique.into(),
        technique_second: String::new(),
        response: None,
        chosen_technique: None,
        ratings: ratings.into(),
        ..row(participant, index, "")
    };
    let study = r#"[{"id":"atrium-moderate-none","scene":"atrium","techniques":["none"]},
        {"id":"atrium-moderate-ray-march30","scene":"atrium","techniques":["ray-march30"]}]"#;
    let rows = [
        rated("P1", 0, "ray-march30", "realism=6;pleasing=4"),
        rated("P1", 1, "none", "realism=2;pleasing=5"),
    ];
    let dir = results_folder(&rows, Some(study));
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert_eq!(
        ratings(&data),
        [
            ("P1", "atrium-moderate", "none", "realism", 2.0),
            ("P1", "atrium-moderate", "ray-march30", "realism", 6.0),
            ("P1", "atrium-moderate", "none", "pleasing", 5.0),
            ("P1", "atrium-moderate", "ray-march30", "pleasing", 4.0),
        ]
    );
    assert_eq!(data.sources[0].rows_used, 2);
    let dir = results_folder(&[rated("P1", 0, "none", "realism")], Some(study));
    let message = read(&[dir.path().to_owned()], Options::default())
        .unwrap_err()
        .to_string();
    for part in ["_data.csv:2:", "`ratings`", "`realism`", "scale=points"] {
        assert!(message.contains(part), "{part:?} not in {message:?}");
    }
}

#[test]
fn a_ranking_is_ranks_from_the_best() {
    let ranked = |participant, ranking: &str| TrialRow {
        procedure: "rank-order".into(),
        technique_second: String::new(),
        techniques_shown: "none;gtao;traced".into(),
        response: None,
        chosen_technique: None,
        ranking: ranking.into(),
        ..row(participant, 0, "shapes-white")
    };
    let study = r#"[{"id":"shapes-white","scene":"shapes","techniques":["none","gtao","traced"]}]"#;
    let dir = results_folder(
        &[
            ranked("P1", "traced;gtao;none"),
            ranked("P2", "gtao;traced;none"),
        ],
        Some(study),
    );
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert_eq!(data.rankings.techniques, ["none", "gtao", "traced"]);
    assert_eq!(
        ranks(&data)[..4],
        [
            ("P1", "shapes-white", "none", 3.0),
            ("P1", "shapes-white", "gtao", 2.0),
            ("P1", "shapes-white", "traced", 1.0),
            ("P2", "shapes-white", "none", 3.0),
        ]
    );
}

/// With no choice at all every report is written, and says what was ranked or rated.
#[test]
fn a_report_without_choices_is_whole() {
    use crate::report::{Format, render};
    for (text, said) in [
        (
            format!("{RANKS}P,c,x,1\nP,c,y,2\nQ,c,x,1\nQ,c,y,2\n"),
            "2 participants ranked 2 techniques in 1 condition: 2 rankings.",
        ),
        (
            format!("{RATINGS}P,c,x,s,1\nP,c,y,s,2\n"),
            "1 participant rated 2 techniques in 1 condition on 1 scale: 2 ratings.",
        ),
    ] {
        let data = read_texts(&[&text]).unwrap();
        let analysis = crate::analysis::analyse(data, crate::analysis::Settings::default());
        for format in [Format::Text, Format::Html, Format::Json] {
            let report = render(&analysis, format).unwrap();
            assert!(report.contains(said), "{report}");
            assert!(!report.contains("NaN") && !report.contains("even split at alpha"));
        }
        assert!(render(&analysis, Format::Csv).is_ok());
    }
}
