//! The table of participants.

use eframe::egui::{Grid, ProgressBar, Ui};

use super::{Person, Snapshot};
use crate::app::theme;

/// Draws the table; a click on an id selects that participant.
pub fn show(ui: &mut Ui, snapshot: &Snapshot, selected: &mut Option<String>) {
    if snapshot.people.is_empty() {
        ui.label("Nobody yet");
        return;
    }
    Grid::new("people")
        .num_columns(8)
        .striped(true)
        .spacing([22.0, 4.0])
        .show(ui, |ui| {
            for name in [
                "Slot",
                "Participant",
                "Trials",
                "State",
                "Last answer (UTC)",
                "Late frames",
                "Focus lost",
                "Catch trials",
            ] {
                ui.label(theme::quiet(name));
            }
            ui.end_row();
            for person in &snapshot.people {
                row(ui, person, snapshot.trials, selected);
                ui.end_row();
            }
        });
}

fn row(ui: &mut Ui, person: &Person, trials: usize, selected: &mut Option<String>) {
    let standing = &person.standing;
    let series = if standing.pilot { "pilot " } else { "" };
    ui.label(format!("{series}{}", standing.slot));
    let is_selected = selected.as_ref() == Some(&standing.participant);
    if ui
        .selectable_label(is_selected, &standing.participant)
        .clicked()
    {
        *selected = (!is_selected).then(|| standing.participant.clone());
    }
    let share = standing.answered as f32 / trials.max(1) as f32;
    let text = format!("{} of {trials}", standing.answered);
    ui.add(ProgressBar::new(share).desired_width(110.0).text(text));
    ui.label(state(person, trials));
    // To the second, and without the letters of the format.
    let time = person.last_answer_utc.get(..19).unwrap_or("–");
    ui.label(time.replace('T', " "));
    ui.label(
        person
            .missed_frames
            .map_or_else(|| "–".to_owned(), |count| count.to_string()),
    );
    ui.label(person.focus_lost.to_string());
    let (right, all) = person.catch;
    ui.label(if all == 0 {
        "–".to_owned()
    } else {
        format!("{right} of {all}")
    });
}

/// What became of a participant, the plainest word first.
pub fn state(person: &Person, trials: usize) -> String {
    let standing = &person.standing;
    let mut words = vec![if standing.answered >= trials {
        "finished"
    } else {
        "unfinished"
    }];
    if standing.released.is_some() {
        words.push("slot given up");
    }
    if standing.rejected.is_some() {
        words.push("rejected");
    }
    words.join(", ")
}
