//! What a row says.

use super::*;
use crate::record::Response;

#[test]
fn the_row_says_what_was_shown_when_and_what_was_chosen() {
    let mut session = to_question();
    let plan = session.plan().clone();
    let condition = &plan.conditions[plan.trials[0].condition];
    let row = answer(&mut session, Position::Second, 11_234_500_000);
    assert_eq!(row.row_id, "P01:1:main:0");
    assert_eq!(row.condition, condition.id);
    assert_eq!(row.technique_first, condition.techniques[0]);
    assert_eq!(row.technique_second, condition.techniques[1]);
    assert_eq!(
        row.first_image_sha256,
        format!("{}-base-hash", condition.id)
    );
    assert_eq!(row.response, Some(Response::Second));
    assert_eq!(row.chosen_technique, Some(condition.techniques[1].clone()));
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
