//! Every figure on data of every kind: nothing that is no number, and something to be seen.

use std::fmt::Write as _;

use proptest::prelude::*;

use super::*;
use crate::analysis::input::{self, Options};
use crate::analysis::{Settings, analyse};
use crate::report::{Format, raster, render};

/// The analysis of a file with this text.
fn analysis_of(text: &str) -> Analysis {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("data.csv");
    std::fs::write(&path, text).unwrap();
    let data = input::read(&[path], Options::default()).unwrap();
    let settings = Settings {
        bootstrap: 20,
        ..Settings::default()
    };
    analyse(data, settings)
}

fn drawn(analysis: &Analysis) -> Vec<(&'static str, String)> {
    FIGURES
        .iter()
        .filter_map(|figure| Some((figure.id, (figure.draw)(analysis)?.alone())))
        .collect()
}

fn ids(analysis: &Analysis) -> Vec<&'static str> {
    drawn(analysis).into_iter().map(|(id, _)| id).collect()
}

const TRIALS: &str = "participant,condition,first_technique,second_technique,chosen,rt_ms\n";

#[test]
fn choices_have_their_figures_and_each_shows_something() {
    let mut text = TRIALS.to_owned();
    for (participant, chosen) in ["first", "second", "first", "second", "second"]
        .into_iter()
        .enumerate()
    {
        let pairs = match participant % 2 {
            0 => ["none,crytek24", "crytek24,blizzard24"],
            _ => ["crytek24,none", "blizzard24,crytek24"],
        };
        for (condition, pair) in ["one", "two"].into_iter().zip(pairs) {
            let rt_ms = 900 + 130 * participant;
            let _ = writeln!(text, "p{participant},{condition},{pair},{chosen},{rt_ms}");
        }
    }
    let analysis = analysis_of(&text);
    let expected = [
        "votes",
        "forest",
        "position-bias",
        "orders",
        "anytime",
        "response-times",
        "jod",
    ];
    assert_eq!(ids(&analysis), expected);
    for (id, svg) in drawn(&analysis) {
        let picture = raster::pixels(&svg, 1.0).unwrap();
        let blue = |pixel: &&image::Rgba<u8>| {
            let [r, g, b, _] = pixel.0;
            b > 140 && b > r.saturating_add(60) && b > g.saturating_add(30)
        };
        let count = picture.pixels().filter(blue).count();
        assert!(count > 20, "{id}: {count} blue pixels");
    }
}

#[test]
fn ratings_and_rankings_have_theirs() {
    let mut ratings = "participant,condition,technique,scale,rating\n".to_owned();
    let mut ranks = "participant,condition,technique,rank\n".to_owned();
    for participant in 0..6 {
        for (at, technique) in ["none", "crytek24", "blizzard24"].into_iter().enumerate() {
            let rating = 2 + at + (participant + at) % 2;
            let _ = writeln!(
                ratings,
                "p{participant},atrium,{technique},realism,{rating}"
            );
            let rank = 1 + (at + participant % 2) % 3;
            let _ = writeln!(ranks, "p{participant},atrium,{technique},{rank}");
        }
    }
    assert_eq!(ids(&analysis_of(&ratings)), ["ratings"]);
    assert_eq!(ids(&analysis_of(&ranks)), ["ranks"]);
}

#[test]
fn names_cannot_leave_a_figure() {
    let text = format!("{TRIALS}<p>,\"</svg><script>\",\"a\"\"&\",b,first,\n");
    let analysis = analysis_of(&text);
    for (id, svg) in drawn(&analysis) {
        assert!(!svg.contains("<script>"), "{id}");
        raster::pixels(&svg, 0.5).unwrap_or_else(|error| panic!("{id}: {error}"));
    }
}

/// One trial: participant, condition, order, what was chosen, and how long it took.
type Trial = (u8, u8, bool, Option<bool>, Option<u16>);

fn table(trials: &[Trial]) -> String {
    let mut text = TRIALS.to_owned();
    let mut seen = std::collections::BTreeSet::new();
    let pairs = ["a,b", "b,c", "a,c", "d,e"];
    for (participant, condition, turned, chosen, rt_ms) in trials {
        if !seen.insert((participant, condition)) {
            continue;
        }
        let pair = pairs[usize::from(*condition) % pairs.len()];
        let (first, second) = pair.split_once(',').unwrap();
        let (first, second) = match turned {
            true => (second, first),
            false => (first, second),
        };
        let chosen = chosen.map_or("", |is_first| if is_first { "first" } else { "second" });
        let rt_ms = rt_ms.map_or_else(String::new, |ms| ms.to_string());
        let _ = writeln!(
            text,
            "p{participant},c{condition},{first},{second},{chosen},{rt_ms}"
        );
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Few trials, missing answers, one side alone, times of nought: nothing anywhere is NaN or
    /// infinite, in no figure and no format, and every figure can be drawn.
    #[test]
    fn nothing_is_ever_not_a_number(
        trials in prop::collection::vec(
            (0..9_u8, 0..6_u8, any::<bool>(), prop::option::of(any::<bool>()), prop::option::of(0..9000_u16)),
            1..40,
        ),
    ) {
        let analysis = analysis_of(&table(&trials));
        let mut texts: Vec<(String, String)> = drawn(&analysis)
            .into_iter()
            .map(|(id, svg)| (id.to_owned(), svg))
            .collect();
        for (id, svg) in &texts {
            prop_assert!(raster::pixels(svg, 0.25).is_ok(), "{id}");
        }
        for format in [Format::Text, Format::Json, Format::Csv, Format::Html] {
            texts.push((format!("{format:?}"), render(&analysis, format).unwrap()));
        }
        for (id, text) in texts {
            for word in ["NaN", "nan,", "inf ", "inf,", "Infinity", "\"inf", "\"-inf"] {
                prop_assert!(!text.contains(word), "{word} in {id}");
            }
        }
    }
}
