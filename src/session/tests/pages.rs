//! Consent, questions about the participant, practice and rests.

use super::*;
use crate::protocol::Pause;
use crate::record::AboutAnswer;

const EXTRAS: &str = r#"
[[metadata]]
id = "age"
choices = ["young", "old"]

[practice]
conditions = ["a"]

[breaks]
every_trials = 1

"#;

/// The thesis protocol with a consent, a form, practice and rests.
fn elaborate() -> Protocol {
    let text = include_str!("../../../protocols/thesis-2010.toml").replace(
        "[texts]\n",
        &format!("{EXTRAS}[texts]\nconsent = \"May we?\"\n"),
    );
    Protocol::parse(Path::new("p.toml"), &text).unwrap()
}

fn session_of(protocol: &Protocol, info: SessionInfo) -> Session {
    let plan = SessionPlan::new(protocol, &conditions(), 0).unwrap();
    Session::new(plan, protocol, info)
}

fn told() -> Vec<AboutAnswer> {
    vec![AboutAnswer {
        id: "age".to_owned(),
        answer: "old".to_owned(),
    }]
}

#[test]
fn consent_and_answers_are_on_disk_before_the_instructions() {
    let protocol = elaborate();
    let mut session = session_of(&protocol, info(0));
    assert_eq!(session.screen(), &Screen::Consent);
    feed(&mut session, &[(1, Event::Told(told())), (1, Event::Begin)]);
    assert_eq!(session.screen(), &Screen::Consent, "nothing leads round it");
    feed(&mut session, &[(2_000_000_000, Event::Agree)]);
    assert_eq!(session.screen(), &Screen::Form);
    let effects = session.handle(Event::Told(told()), at(9_000_000_000));
    let [Effect::StoreAbout(about)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(about.answers, told());
    assert_eq!(about.consented_utc.as_deref(), Some("2026-03-01T10:00:02Z"));
    assert_eq!(
        about.consent_sha256.as_deref(),
        Some(crate::digest::sha256_hex(b"May we?").as_str())
    );
    assert_eq!(session.screen(), &Screen::Saving);
    feed(&mut session, &[(9_000_000_001, Event::RowStored)]);
    assert_eq!(session.screen(), &Screen::Instructions);
    assert_eq!(session.stored(), 0, "it was no trial");
}

#[test]
fn whoever_declines_sees_no_more() {
    let protocol = elaborate();
    let mut session = session_of(&protocol, info(0));
    feed(&mut session, &[(1, Event::Decline), (2, Event::Agree)]);
    assert_eq!(session.screen(), &Screen::Declined);
    assert!(session.is_over());
}

#[test]
fn a_full_disk_keeps_the_consent_waiting() {
    let protocol = elaborate();
    let mut session = session_of(&protocol, info(0));
    feed(&mut session, &[(1, Event::Agree)]);
    let effects = session.handle(Event::Told(Vec::new()), at(2));
    feed(&mut session, &[(3, Event::StoreFailed("full".to_owned()))]);
    assert!(matches!(session.screen(), Screen::StorageTrouble { .. }));
    assert_eq!(session.handle(Event::RetryStore, at(4)), effects);
    feed(&mut session, &[(5, Event::RowStored)]);
    assert_eq!(session.screen(), &Screen::Instructions);
}

#[test]
fn who_has_told_is_not_asked_again() {
    let protocol = elaborate();
    let resumed = SessionInfo {
        has_told: true,
        segment: 2,
        ..info(1)
    };
    let session = session_of(&protocol, resumed);
    assert_eq!(session.screen(), &Screen::Instructions);
}

#[test]
fn the_practice_ends_with_a_page_and_rests_stand_between_trials() {
    let protocol = elaborate();
    let started = SessionInfo {
        has_told: true,
        ..info(0)
    };
    let mut session = session_of(&protocol, started);
    let mut pages = Vec::new();
    let mut rows = Vec::new();
    let mut now = 0;
    while !session.is_over() {
        session.handle(Event::Shown, at(now));
        let event = match session.screen() {
            Screen::Instructions => Event::Begin,
            Screen::Pause(pause) => {
                pages.push((session.stored(), *pause));
                Event::Begin
            }
            Screen::PairMenu { next, .. } => Event::StartPair(*next),
            Screen::Image { .. } => Event::Continue,
            Screen::Question { .. } => chosen(Position::First),
            Screen::Saving => Event::RowStored,
            _ => Event::Tick,
        };
        now = session.wake_at().map_or(now + 1, |wake| wake.ns);
        for effect in session.handle(event, at(now)) {
            if let Effect::StoreRow(row) = effect {
                rows.push((row.row_id.clone(), row.condition.clone()));
            }
        }
    }
    assert_eq!(pages, [(1, Pause::PracticeOver), (2, Pause::Break)]);
    assert_eq!(rows[0], ("P01:1:practice:0".to_owned(), "a".to_owned()));
    assert_eq!(rows[1].0, "P01:1:main:1");
    assert_eq!(rows.len(), 3);
}

/// Straight after the instructions nobody needs a rest; but that the practice is over must
/// be said.
#[test]
fn a_resumed_session_skips_the_rest_but_not_the_end_of_practice() {
    let protocol = elaborate();
    let resumed = |answered| SessionInfo {
        has_told: true,
        segment: 2,
        ..info(answered)
    };
    let mut session = session_of(&protocol, resumed(2));
    feed(&mut session, &[(0, Event::Begin)]);
    assert_eq!(session.screen(), &Screen::PairMenu { next: 2, total: 3 });
    let mut session = session_of(&protocol, resumed(1));
    feed(&mut session, &[(0, Event::Begin)]);
    assert_eq!(session.screen(), &Screen::Pause(Pause::PracticeOver));
}

#[test]
fn cannot_tell_is_an_answer_only_where_the_protocol_says_so() {
    let mut session = to_question();
    feed(
        &mut session,
        &[(11_000_000_000, Event::Answer(Answer::CannotTell))],
    );
    assert_eq!(session.screen(), &Screen::Question { trial: 0 });

    let text = include_str!("../../../protocols/thesis-2010.toml")
        .replace("seed = 2010", "seed = 2010\ncannot_tell = true");
    let protocol = Protocol::parse(Path::new("p.toml"), &text).unwrap();
    let mut session = session_of(&protocol, info(0));
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (0, Event::Shown),
            (1, Event::Continue),
            (2, Event::Shown),
            (GREY_NS + 2, Event::Tick),
            (GREY_NS + 3, Event::Shown),
            (GREY_NS + 4, Event::Continue),
            (GREY_NS + 5, Event::Shown),
        ],
    );
    let effects = session.handle(Event::Answer(Answer::CannotTell), at(GREY_NS + 6));
    let [Effect::StoreRow(row)] = &effects[..] else {
        panic!("{effects:?}");
    };
    assert_eq!(row.response, Some(crate::record::Response::CannotTell));
    assert_eq!(row.chosen_technique, None);
}
