//! Random events at random times.

use proptest::prelude::*;

use super::*;

fn any_event() -> impl Strategy<Value = Event> {
    prop_oneof![
        1 => Just(Event::Begin),
        3 => (0_usize..4).prop_map(Event::StartPair),
        6 => Just(Event::Continue),
        8 => Just(Event::Shown),
        4 => Just(Event::Tick),
        6 => prop_oneof![Just(Position::First), Just(Position::Second)].prop_map(chosen),
        4 => Just(Event::RowStored),
        1 => Just(Event::StoreFailed("full".to_owned())),
        2 => Just(Event::RetryStore),
        1 => Just(Event::FocusLost),
        1 => Just(Event::FocusGained),
        1 => (0_u32..3).prop_map(Event::MissedFrames),
        2 => (0_u64..4_000_000_000).prop_map(|ns| Event::NextFrame { expected: at(ns) }),
        2 => (0_u64..20, 0_u64..20_000_000_000).prop_map(|(screen_serial, ns)| Event::OnsetKnown {
            screen_serial,
            at: at(ns),
            uncertainty_ns: 1,
        }),
    ]
}

/// Mixed in, so that the session gets somewhere.
fn the_event_that_leads_on(session: &Session) -> Event {
    if !session.is_shown() {
        return Event::Shown;
    }
    match session.screen() {
        Screen::Instructions => Event::Begin,
        Screen::PairMenu { next, .. } => Event::StartPair(*next),
        Screen::Image { .. } => Event::Continue,
        Screen::Question { .. } => chosen(Position::Second),
        Screen::Saving => Event::RowStored,
        Screen::StorageTrouble { .. } => Event::RetryStore,
        _ => Event::Tick,
    }
}

/// The screens that may follow a screen.
fn may_follow(before: &Screen, after: &Screen) -> bool {
    use Screen::{Closing, Grey, Image, Instructions, PairMenu, Question, Saving, StorageTrouble};
    match (before, after) {
        (Instructions, PairMenu { next, .. }) => *next == 0,
        (PairMenu { next, .. }, after) => *after == image(*next, Position::First),
        (Image { trial, place: 0 }, Grey { trial: t })
        | (Image { trial, place: 1 }, Question { trial: t }) => trial == t,
        (Grey { trial }, after) => *after == image(*trial, Position::Second),
        (Question { .. } | StorageTrouble { .. }, Saving)
        | (Saving, StorageTrouble { .. } | PairMenu { .. } | Closing) => true,
        _ => false,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    /// Random events at random times: no panic, no screen skipped, the grey never
    /// short, and at the end exactly one acknowledged row a trial, in order.
    #[test]
    fn whatever_happens_the_order_holds(
        events in prop::collection::vec(
            (prop::option::weighted(0.6, any_event()), 0_u64..1_500_000_000),
            0..120,
        )
    ) {
        let mut session = session();
        let mut now = 0;
        let mut pending: Option<TrialRow> = None;
        let mut acknowledged = Vec::new();
        let mut corrected = false;
        for (event, wait) in events {
            now += wait;
            let event = event.unwrap_or_else(|| the_event_that_leads_on(&session));
            corrected |= matches!(event, Event::OnsetKnown { .. });
            let before = session.screen().clone();
            let deadline = session.wake_at();
            let effects = session.handle(event.clone(), at(now));
            let after = session.screen().clone();
            prop_assert!(before == after || may_follow(&before, &after), "{before:?} -> {after:?}");
            if matches!(before, Screen::Grey { .. }) && before != after {
                prop_assert!(deadline.is_some_and(|deadline| at(now) >= deadline));
            }
            if let Screen::Saving = before && event == Event::RowStored {
                acknowledged.extend(pending.take());
            }
            for effect in effects {
                let Effect::StoreRow(row) = effect else { panic!() };
                prop_assert!(pending.as_ref().is_none_or(|waiting| *waiting == *row));
                pending = Some(*row);
            }
        }
        let order: Vec<u32> = acknowledged.iter().map(|row| row.trial_index).collect();
        let stored = u32::try_from(session.stored()).unwrap();
        prop_assert_eq!(order, (0..stored).collect::<Vec<_>>());
        for row in acknowledged {
            let onsets = [
                row.first_onset_ns,
                row.grey_onset_ns,
                row.second_onset_ns,
                row.question_onset_ns,
            ];
            prop_assert!(onsets.is_sorted(), "{onsets:?}");
            let grey = row.grey_offset_ns.unwrap() - row.grey_onset_ns.unwrap();
            // Feedback out of thin air may move either end.
            prop_assert!(corrected || grey >= GREY_NS);
            prop_assert!(row.response_ns >= row.question_onset_ns);
        }
    }
}
