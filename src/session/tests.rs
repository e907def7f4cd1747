//! Every path of the no-reference session, and random events on top.

use std::path::Path;

use proptest::prelude::*;
use time::macros::datetime;

use super::{Effect, Event, PairHashes, Screen, Session, SessionInfo, SessionTime};
use crate::protocol::{Condition, Position, Protocol, SessionPlan};
use crate::record::{InputDevice, OnsetMethod, TrialRow};

const GREY_NS: u64 = 2_000_000_000;

fn protocol() -> Protocol {
    let text = include_str!("../../protocols/thesis-2010.toml");
    Protocol::parse(Path::new("p.toml"), text).unwrap()
}

fn conditions() -> Vec<Condition> {
    ["a", "b", "c"]
        .map(|id| Condition {
            id: id.to_owned(),
            scene: "atrium".to_owned(),
            first_technique: format!("{id}-base"),
            second_technique: format!("{id}-other"),
        })
        .into()
}

fn info(answered: usize) -> SessionInfo {
    SessionInfo {
        participant_id: "P01".to_owned(),
        session: 1,
        segment: 1,
        station_id: "lab".to_owned(),
        pilot: false,
        started_utc: datetime!(2026-03-01 10:00 UTC),
        onset_method: OnsetMethod::PresentCall,
        onset_uncertainty_ms: Some(16.7),
        input_device: InputDevice::Keyboard,
        images: ["a", "b", "c"]
            .map(|id| PairHashes {
                first: format!("{id}-base-hash"),
                second: format!("{id}-other-hash"),
            })
            .into(),
        answered,
        interrupted_utc: None,
    }
}

fn session_with(slot: u32, info: SessionInfo) -> Session {
    let plan = SessionPlan::new(&protocol(), &conditions(), slot).unwrap();
    Session::new(plan, &protocol(), info)
}

fn session() -> Session {
    session_with(0, info(0))
}

fn at(ns: u64) -> SessionTime {
    SessionTime { ns }
}

/// Feeds events, none of which may have an effect.
fn feed(session: &mut Session, events: &[(u64, Event)]) {
    for (ns, event) in events {
        assert_eq!(session.handle(event.clone(), at(*ns)), [], "{event:?}");
    }
}

fn image(trial: usize, position: Position) -> Screen {
    Screen::Image { trial, position }
}

/// Brings a new session to the question of its first trial, shown at 10 s.
fn to_question() -> Session {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (1_000_000_000, Event::Shown),
            (4_000_000_000, Event::Continue),
            (4_100_000_000, Event::Shown),
            (6_100_000_000, Event::Tick),
            (6_200_000_000, Event::Shown),
            (9_900_000_000, Event::Continue),
            (10_000_000_000, Event::Shown),
        ],
    );
    assert_eq!(session.screen(), &Screen::Question { trial: 0 });
    session
}

fn answer(session: &mut Session, choice: Position, ns: u64) -> TrialRow {
    let effects = session.handle(Event::Answer(choice), at(ns));
    let [Effect::StoreRow(row)] = &effects[..] else {
        panic!("{effects:?}");
    };
    (**row).clone()
}

#[test]
fn one_trial_goes_through_its_screens_in_order() {
    let mut session = session();
    assert_eq!(session.screen(), &Screen::Instructions);
    feed(&mut session, &[(0, Event::Begin)]);
    assert_eq!(session.screen(), &Screen::PairMenu { next: 0, total: 3 });
    feed(&mut session, &[(0, Event::StartPair(0))]);
    assert_eq!(session.screen(), &image(0, Position::First));
    feed(&mut session, &[(0, Event::Shown), (5, Event::Continue)]);
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 });
    feed(&mut session, &[(10, Event::Shown)]);
    assert_eq!(session.wake_at(), Some(at(GREY_NS + 10)));
    feed(&mut session, &[(GREY_NS + 10, Event::Tick)]);
    assert_eq!(session.screen(), &image(0, Position::Second));
    assert_eq!(session.wake_at(), None);
    feed(
        &mut session,
        &[
            (GREY_NS + 20, Event::Shown),
            (GREY_NS + 30, Event::Continue),
        ],
    );
    assert_eq!(session.screen(), &Screen::Question { trial: 0 });
    feed(&mut session, &[(GREY_NS + 40, Event::Shown)]);
    answer(&mut session, Position::Second, GREY_NS + 50);
    assert_eq!(session.screen(), &Screen::Saving { trial: 0 });
    feed(&mut session, &[(GREY_NS + 60, Event::RowStored)]);
    assert_eq!(session.screen(), &Screen::PairMenu { next: 1, total: 3 });
}

#[test]
fn the_row_says_what_was_shown_when_and_what_was_chosen() {
    let mut session = to_question();
    let plan = session.plan().clone();
    let condition = &plan.conditions[plan.trials[0].condition];
    let row = answer(&mut session, Position::Second, 11_234_500_000);
    assert_eq!(row.row_id, "P01:1:main:0");
    assert_eq!(row.condition, condition.id);
    assert_eq!(row.technique_first, condition.first_technique);
    assert_eq!(row.technique_second, condition.second_technique);
    assert_eq!(
        row.first_image_sha256,
        format!("{}-base-hash", condition.id)
    );
    assert_eq!(row.response, Some(Position::Second));
    assert_eq!(
        row.chosen_technique,
        Some(condition.second_technique.clone())
    );
    assert_eq!(row.first_onset_ns, Some(1_000_000_000));
    assert_eq!(row.first_offset_ns, Some(4_100_000_000));
    assert_eq!(row.grey_onset_ns, Some(4_100_000_000));
    assert_eq!(row.grey_offset_ns, Some(6_200_000_000));
    assert_eq!(row.second_onset_ns, Some(6_200_000_000));
    assert_eq!(row.second_offset_ns, Some(10_000_000_000));
    assert_eq!(row.question_onset_ns, Some(10_000_000_000));
    assert_eq!(row.response_ns, Some(11_234_500_000));
    assert_eq!(row.response_time_ms, Some(1234.5));
    assert_eq!(row.answered_utc, "2026-03-01T10:00:11.2345Z");
    assert_eq!(row.resume_gap_ms, None);
}

#[test]
fn a_reversed_pair_is_on_record_in_the_order_shown() {
    // Three conditions: slots 3 to 5 are reversed.
    let mut session = session_with(3, info(0));
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
    let row = answer(&mut session, Position::First, GREY_NS + 6);
    assert!(row.technique_first.ends_with("-other"), "{row:?}");
    assert!(row.technique_second.ends_with("-base"), "{row:?}");
    assert!(row.first_image_sha256.ends_with("-other-hash"), "{row:?}");
    assert_eq!(row.chosen_technique.as_ref(), Some(&row.technique_first));
}

#[test]
fn only_the_next_pair_can_be_started() {
    let mut session = session();
    feed(&mut session, &[(0, Event::Begin)]);
    for wrong in [1, 2, 3, usize::MAX] {
        feed(&mut session, &[(0, Event::StartPair(wrong))]);
        assert_eq!(session.screen(), &Screen::PairMenu { next: 0, total: 3 });
    }
}

#[test]
fn a_key_held_over_from_the_screen_before_does_not_count() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (1, Event::Continue),
        ],
    );
    assert_eq!(
        session.screen(),
        &image(0, Position::First),
        "not shown yet"
    );
    let mut session = to_question();
    answer(&mut session, Position::First, 11_000_000_000);
    let now = 11_000_000_000;
    feed(
        &mut session,
        &[
            (now, Event::RowStored),
            (now, Event::StartPair(1)),
            (now, Event::Shown),
            (now, Event::Continue),
            (now, Event::Shown),
            (now + GREY_NS, Event::Tick),
            (now + GREY_NS, Event::Shown),
            (now + GREY_NS, Event::Continue),
            (now + GREY_NS + 1, Event::Answer(Position::First)),
        ],
    );
    let question = Screen::Question { trial: 1 };
    assert_eq!(session.screen(), &question, "asked but not shown yet");
}

#[test]
fn the_grey_cannot_be_skipped_nor_cut_short() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (0, Event::Shown),
            (1, Event::Continue),
            // Long before its first frame: the clock of the grey has not started.
            (GREY_NS * 2, Event::Tick),
            (GREY_NS * 3, Event::Shown),
            (GREY_NS * 3 + 1, Event::Continue),
            (GREY_NS * 4 - 1, Event::Continue),
            (GREY_NS * 4 - 1, Event::Tick),
            (GREY_NS * 4 - 1, Event::Shown),
        ],
    );
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 });
    feed(&mut session, &[(GREY_NS * 4, Event::Tick)]);
    assert_eq!(session.screen(), &image(0, Position::Second));
}

/// Whatever comes at or after the end of the grey ends it, and counts for nothing else.
#[test]
fn the_event_that_ends_the_grey_belongs_to_the_grey() {
    for last in [Event::Tick, Event::Shown, Event::Continue] {
        let mut session = session();
        feed(
            &mut session,
            &[
                (0, Event::Begin),
                (0, Event::StartPair(0)),
                (0, Event::Shown),
                (1, Event::Continue),
                (2, Event::Shown),
                (GREY_NS + 2, last),
                (GREY_NS + 3, Event::Continue),
            ],
        );
        assert_eq!(
            session.screen(),
            &image(0, Position::Second),
            "not shown yet"
        );
    }
}

#[test]
fn a_failed_store_waits_and_stores_the_same_row_again() {
    let mut session = to_question();
    let row = answer(&mut session, Position::First, 11_000_000_000);
    feed(
        &mut session,
        &[(11_000_000_000, Event::StoreFailed("disk full".to_owned()))],
    );
    let trouble = Screen::StorageTrouble {
        trial: 0,
        detail: "disk full".to_owned(),
    };
    assert_eq!(session.screen(), &trouble);
    feed(
        &mut session,
        &[
            (12_000_000_000, Event::Continue),
            (12_000_000_000, Event::Answer(Position::Second)),
            (12_000_000_000, Event::StartPair(1)),
            (12_000_000_000, Event::RowStored),
        ],
    );
    assert_eq!(session.screen(), &trouble, "nothing but a retry leads on");
    let again = session.handle(Event::RetryStore, at(60_000_000_000));
    assert_eq!(again, [Effect::StoreRow(Box::new(row))]);
    feed(&mut session, &[(60_000_000_000, Event::RowStored)]);
    assert_eq!(session.screen(), &Screen::PairMenu { next: 1, total: 3 });
}

#[test]
fn an_abort_while_saving_waits_for_the_row() {
    let mut session = to_question();
    answer(&mut session, Position::First, 11_000_000_000);
    feed(&mut session, &[(11_000_000_000, Event::Abort)]);
    assert_eq!(session.screen(), &Screen::Saving { trial: 0 });
    feed(&mut session, &[(11_000_000_000, Event::RowStored)]);
    assert_eq!(session.screen(), &Screen::Aborted);
    assert_eq!(session.stored(), 1);
    assert!(session.is_over());
}

#[test]
fn an_abort_ends_any_screen() {
    let mut session = to_question();
    feed(&mut session, &[(11_000_000_000, Event::Abort)]);
    assert_eq!(session.screen(), &Screen::Aborted);
    feed(
        &mut session,
        &[(12_000_000_000, Event::Answer(Position::First))],
    );
    assert_eq!(session.screen(), &Screen::Aborted);
}

#[test]
fn mishaps_are_on_record_for_their_trial() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::MissedFrames(5)),
            (0, Event::FocusLost),
            (0, Event::StartPair(0)),
            (0, Event::Shown),
            (0, Event::FocusGained),
            (0, Event::FocusLost),
            (0, Event::FocusGained),
            (0, Event::MissedFrames(2)),
            (1, Event::Continue),
            (2, Event::Shown),
            (GREY_NS + 2, Event::MissedFrames(1)),
            (GREY_NS + 3, Event::Shown),
            (GREY_NS + 4, Event::Continue),
            (GREY_NS + 5, Event::Shown),
            (GREY_NS + 5, Event::UsedDevice(InputDevice::Mouse)),
        ],
    );
    let row = answer(&mut session, Position::First, GREY_NS + 6);
    assert_eq!(row.missed_frames, Some(3), "those of the menu do not count");
    assert_eq!(
        row.focus_lost, 2,
        "it began without the focus and lost it once"
    );
    assert_eq!(row.input_device, InputDevice::Mouse);
}

#[test]
fn a_resumed_session_goes_on_with_the_rest_and_tells_the_gap_once() {
    let mut resumed = session_with(
        0,
        SessionInfo {
            segment: 2,
            interrupted_utc: Some(datetime!(2026-03-01 09:59:30 UTC)),
            ..info(1)
        },
    );
    let rows = run_to_end(&mut resumed);
    let whole = run_to_end(&mut session());
    let shown = |rows: &[TrialRow]| -> Vec<(u32, String, String, String)> {
        rows.iter()
            .map(|row| {
                (
                    row.trial_index,
                    row.condition.clone(),
                    row.first_image_sha256.clone(),
                    row.second_image_sha256.clone(),
                )
            })
            .collect()
    };
    assert_eq!(shown(&rows), shown(&whole)[1..]);
    let gaps: Vec<Option<u64>> = rows.iter().map(|row| row.resume_gap_ms).collect();
    // 30 s until the clock started, and the answer came 2 s and 5 ns later.
    assert_eq!(gaps, [Some(32_000), None]);
}

#[test]
fn a_session_with_nothing_left_says_thanks() {
    let mut session = session_with(0, info(3));
    feed(&mut session, &[(0, Event::Begin)]);
    assert_eq!(session.screen(), &Screen::Closing);
}

/// A participant in a hurry.
fn run_to_end(session: &mut Session) -> Vec<TrialRow> {
    let mut rows = Vec::new();
    let mut now = 0;
    while !session.is_over() {
        session.handle(Event::Shown, at(now));
        let event = match session.screen() {
            Screen::Instructions => Event::Begin,
            Screen::PairMenu { next, .. } => Event::StartPair(*next),
            Screen::Image { .. } => Event::Continue,
            Screen::Grey { .. } => Event::Tick,
            Screen::Question { .. } => Event::Answer(Position::First),
            Screen::Saving { .. } => Event::RowStored,
            other => panic!("{other:?}"),
        };
        now = session.wake_at().map_or(now + 1, |wake| wake.ns);
        for effect in session.handle(event, at(now)) {
            let Effect::StoreRow(row) = effect;
            rows.push(*row);
        }
    }
    assert_eq!(session.screen(), &Screen::Closing);
    rows
}

fn any_event() -> impl Strategy<Value = Event> {
    prop_oneof![
        1 => Just(Event::Begin),
        3 => (0_usize..4).prop_map(Event::StartPair),
        6 => Just(Event::Continue),
        8 => Just(Event::Shown),
        4 => Just(Event::Tick),
        6 => prop_oneof![Just(Position::First), Just(Position::Second)].prop_map(Event::Answer),
        4 => Just(Event::RowStored),
        1 => Just(Event::StoreFailed("full".to_owned())),
        2 => Just(Event::RetryStore),
        1 => Just(Event::FocusLost),
        1 => Just(Event::FocusGained),
        1 => (0_u32..3).prop_map(Event::MissedFrames),
    ]
}

/// The screens that may follow a screen.
fn may_follow(before: &Screen, after: &Screen) -> bool {
    use Screen::{Closing, Grey, Image, Instructions, PairMenu, Question, Saving, StorageTrouble};
    match (before, after) {
        (Instructions, PairMenu { next, .. }) => *next == 0,
        (PairMenu { next, .. }, after) => *after == image(*next, Position::First),
        (
            Image {
                trial,
                position: Position::First,
            },
            Grey { trial: t },
        )
        | (
            Image {
                trial,
                position: Position::Second,
            },
            Question { trial: t },
        )
        | (Question { trial }, Saving { trial: t })
        | (Saving { trial }, StorageTrouble { trial: t, .. })
        | (StorageTrouble { trial, .. }, Saving { trial: t }) => trial == t,
        (Grey { trial }, after) => *after == image(*trial, Position::Second),
        (Saving { trial }, PairMenu { next, .. }) => *next == trial + 1,
        (Saving { trial }, Closing) => *trial == 2,
        _ => false,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    /// Random events at random times: no panic, no screen skipped, the grey never
    /// short, and at the end exactly one acknowledged row a trial, in order.
    #[test]
    fn whatever_happens_the_order_holds(
        events in prop::collection::vec((any_event(), 0_u64..3_000_000_000), 0..400)
    ) {
        let mut session = session();
        let mut now = 0;
        let mut pending: Option<TrialRow> = None;
        let mut acknowledged = Vec::new();
        for (event, wait) in events {
            now += wait;
            let before = session.screen().clone();
            let deadline = session.wake_at();
            let effects = session.handle(event.clone(), at(now));
            let after = session.screen().clone();
            prop_assert!(before == after || may_follow(&before, &after), "{before:?} -> {after:?}");
            if matches!(before, Screen::Grey { .. }) && before != after {
                prop_assert!(deadline.is_some_and(|deadline| at(now) >= deadline));
            }
            if let Screen::Saving { .. } = before && event == Event::RowStored {
                acknowledged.extend(pending.take());
            }
            for effect in effects {
                let Effect::StoreRow(row) = effect;
                prop_assert!(pending.as_ref().is_none_or(|waiting| *waiting == *row));
                pending = Some(*row);
            }
        }
        let order: Vec<u32> = acknowledged.iter().map(|row| row.trial_index).collect();
        let stored = u32::try_from(session.stored()).unwrap();
        prop_assert_eq!(order, (0..stored).collect::<Vec<_>>());
        for row in acknowledged {
            let grey = row.grey_offset_ns.unwrap() - row.grey_onset_ns.unwrap();
            prop_assert!(grey >= GREY_NS);
            prop_assert!(row.response_ns >= row.question_onset_ns);
        }
    }
}
