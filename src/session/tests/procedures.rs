//! Every procedure, through the protocol that is shipped for it.

use super::*;
use crate::protocol::exhibit::Exhibits;
use crate::protocol::procedure::{Ask, PROCEDURES, Step};
use crate::record::Response;

const TIMED: &str = include_str!("../../../protocols/sundstedt-2007.toml");
const RATING: &str = include_str!("../../../protocols/kozlowski-kautz-2007.toml");
const REFERENCE: &str = include_str!("../../../protocols/yu-2009-reference.toml");
const RANKING: &str = include_str!("../../../protocols/yu-2009-ranking.toml");

/// A session of `conditions` images of `techniques` each, past its preliminaries.
fn session_of(text: &str, techniques: &[&str], reference: Option<&str>) -> Session {
    // The conditions of these tests are not those that the files name.
    let text: String = text
        .replace("[practice]\nconditions = [\"shapes-none-gtao18\"]", "")
        .replace("[practice]\nconditions = [\"shapes-white\"]", "");
    let text = without_catch(&text);
    let protocol = Protocol::parse(Path::new("p.toml"), &text).unwrap();
    let conditions: Vec<Condition> = ["a", "b", "c"]
        .map(|id| Condition {
            id: id.to_owned(),
            scene: "atrium".to_owned(),
            techniques: techniques.iter().map(|&it| it.to_owned()).collect(),
            reference: reference.map(str::to_owned),
            hypothesis: String::new(),
        })
        .into();
    let images = conditions
        .iter()
        .map(|condition| ImageHashes {
            images: techniques
                .iter()
                .map(|it| format!("{}-{it}-hash", condition.id))
                .collect(),
            reference: reference.map(|it| format!("{}-{it}-hash", condition.id)),
        })
        .collect();
    let plan = SessionPlan::new(&protocol, &conditions, 0).unwrap();
    let info = SessionInfo {
        has_told: true,
        images,
        ..info(0)
    };
    let mut session = Session::new(plan, &protocol, info);
    feed(&mut session, &[(0, Event::Begin)]);
    session
}

fn without_catch(text: &str) -> String {
    match (text.find("[catch]"), text.find("[texts]")) {
        (Some(from), Some(to)) => format!("{}{}", &text[..from], &text[to..]),
        _ => text.to_owned(),
    }
}

fn row_of(effects: &[Effect]) -> TrialRow {
    let [Effect::StoreRow(row)] = effects else {
        panic!("{effects:?}");
    };
    (**row).clone()
}

#[test]
fn every_procedure_ends_its_trial_with_its_only_question() {
    for (procedure, text) in PROCEDURES.iter().zip([
        include_str!("../../../protocols/thesis-2010.toml"),
        TIMED,
        RATING,
        REFERENCE,
        RANKING,
    ]) {
        let protocol = Protocol::parse(Path::new("p.toml"), text).unwrap();
        assert_eq!(protocol.procedure, *procedure);
        let steps = (procedure.steps)(&protocol);
        let asks = steps.iter().filter(|step| matches!(step, Step::Ask(_)));
        assert_eq!(asks.count(), 1, "{}", procedure.name);
        assert!(
            matches!(steps.last(), Some(Step::Ask(_))),
            "{}",
            procedure.name
        );
        assert!(!procedure.source.is_empty());
    }
}

#[test]
fn timed_images_stand_their_time_and_no_key_ends_them() {
    let mut session = session_of(TIMED, &["none", "gtao"], None);
    assert_eq!(session.screen(), &Screen::Ready { next: 0, total: 3 });
    feed(
        &mut session,
        &[
            (0, Event::StartPair(0)),
            (0, Event::Shown),
            (1, Event::Continue),
            (3_999_999_999, Event::Tick),
        ],
    );
    assert_eq!(session.screen(), &image(0, Position::First));
    feed(&mut session, &[(4_000_000_000, Event::Tick)]);
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 });
    feed(
        &mut session,
        &[
            (4_000_000_000, Event::Shown),
            (6_000_000_000, Event::Tick),
            (6_000_000_000, Event::Shown),
            (9_999_999_999, Event::Continue),
        ],
    );
    assert_eq!(session.screen(), &image(0, Position::Second));
    feed(
        &mut session,
        &[
            (10_000_000_000, Event::Tick),
            (10_000_000_000, Event::Shown),
        ],
    );
    let row = row_of(&session.handle(chosen(Position::Second), at(11_000_000_000)));
    assert_eq!(row.procedure, "no-reference-timed");
    let stood = row.first_offset_ns.unwrap() - row.first_onset_ns.unwrap();
    assert_eq!(stood, 4_000_000_000);
}

#[test]
fn a_rating_is_one_row_an_image_with_every_scale() {
    let mut session = session_of(RATING, &["gtao"], None);
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 }, "no menu");
    feed(
        &mut session,
        &[
            (0, Event::Shown),
            (500_000_000, Event::Tick),
            (500_000_000, Event::Shown),
            (3_000_000_000, Event::Continue),
            (3_000_000_000, Event::Shown),
        ],
    );
    assert_eq!(session.screen(), &Screen::Rating { trial: 0 });
    for wrong in [vec![], vec![4], vec![0, 4], vec![4, 8], vec![4, 4, 4]] {
        feed(
            &mut session,
            &[(4_000_000_000, Event::Answer(Answer::Ratings(wrong)))],
        );
    }
    feed(&mut session, &[(4_000_000_000, chosen(Position::First))]);
    assert_eq!(session.screen(), &Screen::Rating { trial: 0 });
    let answer = Event::Answer(Answer::Ratings(vec![7, 1]));
    let row = row_of(&session.handle(answer, at(5_000_000_000)));
    assert_eq!(row.ratings, "realism=7;pleasing=1");
    assert_eq!(
        (row.technique_first.as_str(), row.technique_second.as_str()),
        ("gtao", "")
    );
    assert_eq!((row.response, row.chosen_technique), (None, None));
    assert_eq!(row.second_onset_ns, None);
    feed(&mut session, &[(5_000_000_000, Event::RowStored)]);
    assert_eq!(session.screen(), &Screen::Grey { trial: 1 }, "straight on");
}

#[test]
fn a_comparison_shows_all_three_at_once_and_names_the_reference() {
    let mut session = session_of(REFERENCE, &["none", "gtao"], Some("traced"));
    feed(
        &mut session,
        &[
            (0, Event::Shown),
            (500_000_000, Event::Tick),
            (600_000_000, Event::Shown),
            (700_000_000, Event::Continue),
        ],
    );
    assert_eq!(session.screen(), &Screen::Comparison { trial: 0 });
    let row = row_of(&session.handle(chosen(Position::First), at(900_000_000)));
    assert_eq!(row.response, Some(Response::First));
    assert_eq!(row.technique_reference, "traced");
    assert!(
        row.reference_image_sha256.ends_with("-traced-hash"),
        "{row:?}"
    );
    for onset in [
        row.first_onset_ns,
        row.second_onset_ns,
        row.question_onset_ns,
    ] {
        assert_eq!(onset, Some(600_000_000));
    }
    assert_eq!(row.response_time_ms, Some(300.0));
}

#[test]
fn a_ranking_is_a_permutation_written_as_techniques() {
    let techniques = ["none", "crytek", "gtao", "traced"];
    let mut session = session_of(RANKING, &techniques, None);
    feed(
        &mut session,
        &[
            (0, Event::Shown),
            (500_000_000, Event::Tick),
            (600_000_000, Event::Shown),
        ],
    );
    assert_eq!(session.screen(), &Screen::Ranking { trial: 0 });
    for wrong in [
        vec![],
        vec![0, 1, 2],
        vec![0, 1, 2, 2],
        vec![0, 1, 2, 4],
        vec![0, 1, 2, 3, 4],
    ] {
        feed(
            &mut session,
            &[(700_000_000, Event::Answer(Answer::Ranking(wrong)))],
        );
    }
    let trial = session.plan().trials[0].clone();
    let answer = Event::Answer(Answer::Ranking(vec![3, 0, 2, 1]));
    let row = row_of(&session.handle(answer, at(900_000_000)));
    let by_place: Vec<&str> = trial
        .places
        .iter()
        .map(|&image| techniques[image])
        .collect();
    assert_eq!(row.techniques_shown, by_place.join(";"));
    let best_first = [3, 0, 2, 1].map(|place| by_place[place]);
    assert_eq!(row.ranking, best_first.join(";"));
    assert_eq!(row.images_sha256.split(';').count(), 4);
}

#[test]
fn versions_stand_in_other_places_for_other_participants() {
    let text = without_catch(RANKING).replace("[practice]\nconditions = [\"shapes-white\"]", "");
    let protocol = Protocol::parse(Path::new("p.toml"), &text).unwrap();
    assert_eq!(protocol.procedure.exhibits, Exhibits::Versions);
    let condition = Condition {
        id: "a".to_owned(),
        scene: "atrium".to_owned(),
        techniques: ["w", "x", "y", "z"].map(str::to_owned).into(),
        reference: None,
        hypothesis: String::new(),
    };
    let places: std::collections::HashSet<Vec<usize>> = (0..30)
        .map(|slot| {
            let plan = SessionPlan::new(&protocol, std::slice::from_ref(&condition), slot);
            plan.unwrap().trials[0].places.clone()
        })
        .collect();
    assert!(places.len() > 10, "{places:?}");
}

#[test]
fn a_catch_trial_says_whether_it_was_passed() {
    let text = include_str!("../../../protocols/thesis-2010.toml").to_owned()
        + "\n[catch]\nminimum_correct = 1\n[[catch.trials]]\ncondition = \"c\"\ncorrect = \"c-other\"\n";
    let protocol = Protocol::parse(Path::new("p.toml"), &text).unwrap();
    let plan = SessionPlan::new(&protocol, &conditions(), 0).unwrap();
    let catch = plan
        .trials
        .iter()
        .find(|trial| trial.condition == 2)
        .unwrap()
        .clone();
    for (choice, reversed) in [(Position::First, true), (Position::Second, false)] {
        let mut plan = plan.clone();
        plan.trials[catch.index].reversed = reversed;
        plan.trials[catch.index].places = if reversed { vec![1, 0] } else { vec![0, 1] };
        for (given, passed) in [(choice, true), (opposite(choice), false)] {
            let mut session = Session::new(plan.clone(), &protocol, info(catch.index));
            feed(
                &mut session,
                &[
                    (0, Event::Begin),
                    (0, Event::StartPair(catch.index)),
                    (0, Event::Shown),
                    (1, Event::Continue),
                    (2, Event::Shown),
                    (GREY_NS + 2, Event::Tick),
                    (GREY_NS + 3, Event::Shown),
                    (GREY_NS + 4, Event::Continue),
                    (GREY_NS + 5, Event::Shown),
                ],
            );
            let row = answer(&mut session, given, GREY_NS + 6);
            assert_eq!(row.correct, Some(passed));
            assert_eq!(row.row_id, format!("P01:1:catch:{}", catch.index));
        }
    }
    assert_eq!(Ask::Choice, to_question().ask().unwrap());
    assert_eq!(
        answer(&mut to_question(), Position::First, 11_000_000_000).correct,
        None
    );
}

fn opposite(position: Position) -> Position {
    match position {
        Position::First => Position::Second,
        Position::Second => Position::First,
    }
}
