//! Timed screens by frames, onsets that become known later, input from before a screen.

use super::*;

/// 60 Hz.
const PERIOD_NS: u64 = 16_666_667;
/// 2000 ms are 120 of them.
const GREY_FRAMES: u64 = 120;

fn counting() -> Session {
    session_with(
        0,
        SessionInfo {
            refresh_period_ns: Some(PERIOD_NS),
            ..info(0)
        },
    )
}

/// To the grey's first frame, handed over at `onset_ns`.
fn to_grey(session: &mut Session, onset_ns: u64) {
    feed(
        session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (10, Event::Shown),
            (20, Event::Continue),
            (onset_ns, Event::Shown),
        ],
    );
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 });
}

/// One pass and its frame: the event before drawing, one at its end, the report.
fn frame(session: &mut Session, now: u64, period_ns: u64) {
    let expected = at(now + period_ns);
    feed(session, &[(now, Event::NextFrame { expected })]);
    feed(session, &[(now, Event::Tick)]);
    feed(session, &[(now + period_ns, Event::Shown)]);
}

#[test]
fn the_next_image_is_in_the_frame_after_the_last_one_of_the_grey() {
    let mut session = counting();
    to_grey(&mut session, PERIOD_NS);
    for shown in 1..GREY_FRAMES {
        frame(&mut session, shown * PERIOD_NS, PERIOD_NS);
        assert_eq!(session.screen(), &Screen::Grey { trial: 0 }, "{shown}");
    }
    frame(&mut session, GREY_FRAMES * PERIOD_NS, PERIOD_NS);
    assert_eq!(session.screen(), &image(0, Position::Second));
    assert!(session.is_shown(), "that very frame");
}

#[test]
fn a_late_frame_makes_the_grey_longer_and_never_shorter() {
    let mut session = counting();
    to_grey(&mut session, PERIOD_NS);
    // Ten frames of ten periods each: the clock is far ahead of the frames.
    let mut now = PERIOD_NS;
    for _ in 0..10 {
        frame(&mut session, now, 10 * PERIOD_NS);
        now += 10 * PERIOD_NS;
    }
    for shown in 11..GREY_FRAMES {
        frame(&mut session, now, PERIOD_NS);
        assert_eq!(session.screen(), &Screen::Grey { trial: 0 }, "{shown}");
        now += PERIOD_NS;
    }
    frame(&mut session, now, PERIOD_NS);
    assert_eq!(session.screen(), &image(0, Position::Second));
}

#[test]
fn the_time_of_a_frame_to_come_is_not_the_time_now() {
    let mut session = counting();
    to_grey(&mut session, PERIOD_NS);
    for shown in 1..=GREY_FRAMES {
        frame(&mut session, shown * PERIOD_NS, PERIOD_NS);
    }
    let onset = (GREY_FRAMES + 1) * PERIOD_NS;
    // Pressed between two frames, after a pass that expects the next one much later.
    let far = at(onset + 1_000_000_000);
    feed(
        &mut session,
        &[
            (onset + 5, Event::NextFrame { expected: far }),
            (onset + 6, Event::Continue),
            (onset + 8, Event::Shown),
        ],
    );
    let row = answer(&mut session, Position::First, onset + 9);
    assert_eq!(row.second_offset_ns, Some(onset + 8));
    assert_eq!(row.response_ns, Some(onset + 9));
}

#[test]
fn without_a_known_period_the_clock_ends_the_grey_not_the_frame_to_come() {
    let mut session = session();
    to_grey(&mut session, 100);
    let expected = at(GREY_NS + 200);
    feed(
        &mut session,
        &[(GREY_NS + 99, Event::NextFrame { expected })],
    );
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 });
    feed(
        &mut session,
        &[(GREY_NS + 100, Event::NextFrame { expected })],
    );
    assert_eq!(session.screen(), &image(0, Position::Second));
}

#[test]
fn input_from_before_the_first_frame_is_no_answer_to_it() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (1000, Event::Shown),
            (999, Event::Continue),
        ],
    );
    assert_eq!(session.screen(), &image(0, Position::First));
    let mut session = to_question();
    feed(&mut session, &[(9_999_999_999, chosen(Position::First))]);
    assert_eq!(session.screen(), &Screen::Question { trial: 0 });
    // At the very time of the frame it may be one; a scripted observer is that quick.
    answer(&mut session, Position::First, 10_000_000_000);
}

/// A trial of the clock, with the serials of its four screens.
fn trial_with_feedback(known: impl Fn(&mut Session, usize, u64, u64)) -> (TrialRow, [u64; 4]) {
    let mut session = session();
    feed(&mut session, &[(0, Event::Begin), (0, Event::StartPair(0))]);
    let onsets = [1_000, 2_000, GREY_NS + 3_000, GREY_NS + 4_000];
    for (step, onset) in onsets.into_iter().enumerate() {
        let serial = session.screen_serial();
        feed(&mut session, &[(onset, Event::Shown)]);
        known(&mut session, step, serial, onset);
        match step {
            1 => feed(&mut session, &[(GREY_NS + 2_900, Event::Tick)]),
            3 => {}
            _ => feed(&mut session, &[(onset + 500, Event::Continue)]),
        }
    }
    (
        answer(&mut session, Position::First, GREY_NS + 9_000),
        onsets,
    )
}

fn onset_known(session: &mut Session, serial: u64, ns: u64, uncertainty_ns: u64) {
    let event = Event::OnsetKnown {
        screen_serial: serial,
        at: at(ns),
        uncertainty_ns,
    };
    feed(session, &[(ns + 100, event)]);
}

#[test]
fn measured_onsets_replace_the_estimates_and_the_offsets_before_them() {
    let (row, onsets) = trial_with_feedback(|session, step, serial, onset| {
        onset_known(session, serial, onset + 17, 8_000 + step as u64);
    });
    let [first, grey, second, question] = onsets.map(|onset| Some(onset + 17));
    assert_eq!((row.first_onset_ns, row.first_offset_ns), (first, grey));
    assert_eq!((row.grey_onset_ns, row.grey_offset_ns), (grey, second));
    assert_eq!(
        (row.second_onset_ns, row.second_offset_ns),
        (second, question)
    );
    assert_eq!(row.question_onset_ns, question);
    assert_eq!(row.response_time_ms, Some((5_000.0 - 17.0) / 1e6));
    assert_eq!(row.onset_method, OnsetMethod::PresentFeedback);
    assert_eq!(row.onset_uncertainty_ms, Some(8_003.0 / 1e6), "the worst");
}

#[test]
fn one_onset_not_measured_makes_the_row_an_estimate() {
    for missing in 0..4 {
        let (row, _) = trial_with_feedback(|session, step, serial, onset| {
            if step != missing {
                onset_known(session, serial, onset + 17, 8_000);
            }
        });
        assert_eq!(row.onset_method, OnsetMethod::PresentCall, "{missing}");
        assert_eq!(row.onset_uncertainty_ms, Some(16.7));
    }
}

#[test]
fn feedback_that_comes_a_screen_late_still_counts() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (1_000, Event::Shown),
        ],
    );
    let image_serial = session.screen_serial();
    feed(
        &mut session,
        &[(1_500, Event::Continue), (2_000, Event::Shown)],
    );
    onset_known(&mut session, image_serial, 1_017, 0);
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 });
    assert_eq!(session.wake_at(), Some(at(2_000 + GREY_NS)));
    let rest = [
        (2_000 + GREY_NS, Event::Tick),
        (2_001 + GREY_NS, Event::Shown),
        (2_002 + GREY_NS, Event::Continue),
        (2_003 + GREY_NS, Event::Shown),
    ];
    feed(&mut session, &rest);
    let row = answer(&mut session, Position::First, GREY_NS + 9_000);
    assert_eq!(row.first_onset_ns, Some(1_017));
    assert_eq!(row.first_offset_ns, Some(2_000));
}

#[test]
fn feedback_that_cannot_be_true_changes_nothing() {
    let (row, onsets) = trial_with_feedback(|session, step, serial, onset| {
        // Of no screen of this trial; and before the step before.
        onset_known(session, 0, onset + 17, 1);
        if step > 0 {
            onset_known(session, serial, 500, 1);
        }
    });
    assert_eq!(row.first_onset_ns, Some(onsets[0]));
    assert_eq!(row.grey_onset_ns, Some(onsets[1]));
    assert_eq!(row.question_onset_ns, Some(onsets[3]));
    assert_eq!(row.onset_method, OnsetMethod::PresentCall);
}

#[test]
fn a_key_between_the_estimate_and_the_measured_onset_is_ignored() {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (1_000, Event::Shown),
        ],
    );
    let serial = session.screen_serial();
    onset_known(&mut session, serial, 1_017, 0);
    feed(&mut session, &[(1_010, Event::Continue)]);
    assert_eq!(session.screen(), &image(0, Position::First));
    feed(&mut session, &[(1_017, Event::Continue)]);
    assert_eq!(session.screen(), &Screen::Grey { trial: 0 });
}
