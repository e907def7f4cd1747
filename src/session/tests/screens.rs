//! Which screen follows which, and what is ignored.

use super::*;

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
    assert_eq!(session.screen(), &Screen::Saving);
    feed(&mut session, &[(GREY_NS + 60, Event::RowStored)]);
    assert_eq!(session.screen(), &Screen::PairMenu { next: 1, total: 3 });
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
            (now + GREY_NS + 1, chosen(Position::First)),
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
        detail: "disk full".to_owned(),
    };
    assert_eq!(session.screen(), &trouble);
    feed(
        &mut session,
        &[
            (12_000_000_000, Event::Continue),
            (12_000_000_000, chosen(Position::Second)),
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
    assert_eq!(session.screen(), &Screen::Saving);
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
    feed(&mut session, &[(12_000_000_000, chosen(Position::First))]);
    assert_eq!(session.screen(), &Screen::Aborted);
}

#[test]
fn a_session_with_nothing_left_says_thanks() {
    let mut session = session_with(0, info(3));
    feed(&mut session, &[(0, Event::Begin)]);
    assert_eq!(session.screen(), &Screen::Closing);
}

#[test]
fn a_frame_reported_late_counts_from_its_own_time() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (0, Event::Shown),
            (100, Event::Continue),
            (130, Event::FocusLost),
            (116, Event::Shown),
        ],
    );
    assert_eq!(session.wake_at(), Some(at(GREY_NS + 116)));
}

#[test]
fn a_frame_from_before_a_screen_is_not_its_onset() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (0, Event::Shown),
            (100, Event::Continue),
            (90, Event::Shown),
        ],
    );
    assert_eq!(session.wake_at(), Some(at(GREY_NS + 100)));
}
