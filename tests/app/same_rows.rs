//! The row a person's keys write and the row a scripted observer writes are one row.

use crate::desk::{Desk, SIZE_PX};
use crate::recorded;
use crate::support::Tiny;
use eframe::egui::Key;
use greyfield::protocol::Position;
use greyfield::record::TrialRow;
use greyfield::session::Answer;
use greyfield::session::observer::Question;

/// Presses the keys of a scripted observer at its times.
fn by_keys(study: Tiny, name: &str) -> Vec<TrialRow> {
    let mut desk = Desk::of(study);
    let protocol = desk.study.protocol();
    let plan = desk.study.plan(0);
    let scripted = recorded::observer(&desk.study, &protocol, name);
    desk.click("Begin");
    for trial in &plan.trials {
        let question = Question::new(&protocol, &plan, trial);
        let behaviour = scripted.observer.behave(&question);
        desk.click(&format!("Pair {}", trial.index + 1));
        desk.pass_time(behaviour.looks_ns[0]);
        desk.press(Key::Space);
        desk.pass_time(protocol.grey.duration_ns());
        desk.frame();
        desk.frame();
        desk.pass_time(behaviour.looks_ns[1]);
        desk.press(Key::Space);
        desk.pass_time(behaviour.decision_ns);
        desk.press(match behaviour.answer {
            Answer::Choice(Position::First) => Key::Num1,
            Answer::Choice(Position::Second) => Key::Num2,
            other => panic!("{other:?}"),
        });
    }
    desk.rows.take()
}

/// Even the times: the clock of the desk is moved by hand. What differs is what must: who it
/// was, what was pressed, and how the onsets are known.
#[test]
fn keys_write_the_rows_that_a_scripted_observer_writes() {
    for name in ["random:1", "first"] {
        let scripted = recorded::rows(&Tiny::new(3, SIZE_PX), name);
        let pressed = by_keys(Tiny::new(3, SIZE_PX), name);
        assert_eq!(scripted.len(), 3);
        assert_eq!(pressed.len(), 3);
        for (scripted, pressed) in scripted.into_iter().zip(pressed) {
            assert_ne!(pressed.input_device, scripted.input_device);
            let row_id = scripted.row_id.strip_prefix(&scripted.participant_id);
            assert_eq!(pressed.row_id.strip_prefix("P01"), row_id);
            let expected = TrialRow {
                row_id: scripted.row_id.clone(),
                participant_id: scripted.participant_id.clone(),
                input_device: scripted.input_device,
                onset_method: scripted.onset_method,
                onset_uncertainty_ms: scripted.onset_uncertainty_ms,
                ..pressed
            };
            assert_eq!(scripted, expected);
        }
    }
}
