//! What the experimenter decides about a participant, and exports.

use std::path::{Path, PathBuf};

use eframe::egui::{ComboBox, TextEdit, Ui};
use time::OffsetDateTime;

use super::Person;
use crate::app::theme;
use crate::record::export::{FORMATS, Selection, export};
use crate::record::{ParticipantId, RecordError, Study};

/// The forms as they stand, and what came of the last one sent.
#[derive(Debug)]
pub struct Actions {
    reason: String,
    format: usize,
    folder: String,
    /// Whether the folder is the one proposed.
    is_proposed: bool,
    outcome: Option<String>,
}

/// A decision about one participant.
#[derive(Debug, Clone, Copy)]
enum Decision {
    Release,
    Reject,
    Reinstate,
}

impl Actions {
    pub fn new(results: &Path) -> Self {
        Self {
            reason: String::new(),
            format: 0,
            folder: proposed(results, 0),
            is_proposed: true,
            outcome: None,
        }
    }

    /// Draws the forms; true if something was decided.
    pub fn show(&mut self, ui: &mut Ui, results: &Path, person: Option<&Person>) -> bool {
        let decided = match person {
            Some(person) => self.decide(ui, results, person),
            None => {
                ui.label(theme::quiet(
                    "Select a participant to give up a slot, or to reject or reinstate somebody.",
                ));
                false
            }
        };
        ui.separator();
        self.export(ui, results);
        if let Some(outcome) = &self.outcome {
            ui.label(outcome);
        }
        decided
    }

    fn decide(&mut self, ui: &mut Ui, results: &Path, person: &Person) -> bool {
        let id = &person.standing.participant;
        let mut wanted = None;
        ui.horizontal_wrapped(|ui| {
            let label = ui.label(format!("{id}: reason"));
            ui.add(TextEdit::singleline(&mut self.reason).desired_width(300.0))
                .labelled_by(label.id);
            let has_reason = !self.reason.trim().is_empty();
            let standing = &person.standing;
            for (text, decision, can) in [
                (
                    "Give up the slot",
                    Decision::Release,
                    standing.released.is_none() && has_reason,
                ),
                (
                    "Reject",
                    Decision::Reject,
                    standing.rejected.is_none() && has_reason,
                ),
                (
                    "Reinstate",
                    Decision::Reinstate,
                    standing.rejected.is_some() || standing.released.is_some(),
                ),
            ] {
                if ui
                    .add_enabled(can, eframe::egui::Button::new(text))
                    .clicked()
                {
                    wanted = Some(decision);
                }
            }
        });
        ui.label(theme::quiet(
            "Nothing is deleted. A slot that was given up goes to the next new participant; who is rejected stays out of the analysis.",
        ));
        let Some(decision) = wanted else {
            return false;
        };
        self.outcome = Some(match decided(results, id, decision, self.reason.trim()) {
            Ok(said) => {
                self.reason.clear();
                said
            }
            Err(error) => error.to_string(),
        });
        true
    }

    fn export(&mut self, ui: &mut Ui, results: &Path) {
        let mut pressed = false;
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("Export as");
            let before = self.format;
            ComboBox::from_id_salt("format")
                .selected_text(FORMATS[self.format].name)
                .show_ui(ui, |ui| {
                    for (index, format) in FORMATS.iter().enumerate() {
                        ui.selectable_value(&mut self.format, index, format.name)
                            .on_hover_text(format.summary);
                    }
                })
                .response
                .labelled_by(label.id);
            if self.format != before && self.is_proposed {
                self.folder = proposed(results, self.format);
            }
            let label = ui.label("to");
            let field = ui
                .add(TextEdit::singleline(&mut self.folder).desired_width(420.0))
                .labelled_by(label.id);
            self.is_proposed &= !field.changed();
            pressed = ui.button("Export").clicked();
        });
        if !pressed {
            return;
        }
        let out = PathBuf::from(self.folder.trim());
        let done = export(results, FORMATS[self.format], Selection::default(), &out);
        self.outcome = Some(match done {
            Ok(done) => {
                let mut said = format!("{} rows exported to {}.", done.rows, out.display());
                for note in done.notes {
                    said = format!("{said} {note}");
                }
                said
            }
            Err(error) => error.to_string(),
        });
    }
}

/// Beside the results folder, named like it.
fn proposed(results: &Path, format: usize) -> String {
    let name = results.file_name().unwrap_or_default().to_string_lossy();
    let name = format!("{name}-{}", FORMATS[format].name);
    results.with_file_name(name).display().to_string()
}

fn decided(
    results: &Path,
    id: &str,
    decision: Decision,
    reason: &str,
) -> Result<String, RecordError> {
    let study = Study::open_existing(results)?;
    let participant = ParticipantId::new(id)?;
    let now = OffsetDateTime::now_utc();
    Ok(match decision {
        Decision::Release => {
            let slot = study.release(&participant, reason, now)?;
            format!("{id} has given up slot {slot}; the next new participant takes it.")
        }
        Decision::Reject => {
            study.reject(&participant, reason, now)?;
            format!("{id} is rejected and stays out of the analysis.")
        }
        Decision::Reinstate => {
            let done = study.reinstate(&participant, reason, now)?;
            format!("{id} is reinstated in slot {}.", done.slot)
        }
    })
}
