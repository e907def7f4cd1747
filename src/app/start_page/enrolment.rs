//! Who comes next: the participant's id, checked while it is typed, and the
//! button that starts or resumes.

use eframe::egui::{Key, Margin, TextEdit, Ui, vec2};

use super::screens::{self, Screens};
use super::{Facts, Request};
use crate::app::theme;
use crate::record::ParticipantId;

/// What is on record of an id.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OnRecord {
    /// Nothing: a new participant.
    New,
    /// So many trials.
    Trials(usize),
    /// It could not be read.
    Unreadable(String),
}

/// The form as it stands.
#[derive(Debug, Default)]
pub struct Enrolling {
    /// What is typed.
    pub text: String,
    /// What that is, kept so that the disk is read once for each change.
    known: Option<Known>,
    /// The experimenter has asked to resume and is asked whether that is meant.
    confirming: bool,
    /// Why the last attempt failed.
    pub failure: Option<String>,
    /// How the participant's pages are to look.
    pub screens: Screens,
}

#[derive(Debug)]
struct Known {
    text: String,
    id: Result<(ParticipantId, OnRecord), String>,
}

impl Enrolling {
    /// Checks what is typed, reading the record only if it has changed.
    fn check(&mut self, facts: &Facts<'_>) {
        if self
            .known
            .as_ref()
            .is_some_and(|known| known.text == self.text)
        {
            return;
        }
        self.confirming = false;
        let id = ParticipantId::new(self.text.trim()).map_err(|error| error.to_string());
        self.known = Some(Known {
            text: self.text.clone(),
            id: id.map(|id| {
                let on_record = (facts.on_record)(&id);
                (id, on_record)
            }),
        });
    }
}

/// Draws the form.
pub fn show(ui: &mut Ui, facts: &Facts<'_>, form: &mut Enrolling) -> Option<Request> {
    theme::card()
        .show(ui, |ui| {
            ui.set_min_width(ui.available_width());
            let entered = entry(ui, form);
            screens::show(ui, facts, &mut form.screens);
            form.check(facts);
            let blocker = facts.blocker();
            let request = match form.known.as_ref().map(|known| &known.id) {
                _ if form.text.trim().is_empty() => {
                    start_button(ui, "Start session", false);
                    note(ui, "Enter the participant's id to start.");
                    None
                }
                Some(Err(message)) => {
                    start_button(ui, "Start session", false);
                    note(ui, message);
                    None
                }
                Some(Ok((id, OnRecord::Unreadable(detail)))) => {
                    start_button(ui, "Start session", false);
                    note(ui, &format!("The record of {id} cannot be read: {detail}"));
                    None
                }
                Some(Ok((id, OnRecord::New))) => {
                    let id = id.clone();
                    let pressed = start_button(ui, "Start session", blocker.is_none());
                    let asked = pressed || (entered && blocker.is_none());
                    asked.then_some(Request::Begin(id))
                }
                Some(Ok((id, OnRecord::Trials(done)))) => {
                    let (id, done) = (id.clone(), *done);
                    resume(ui, facts, form, &id, done).then_some(Request::Resume(id))
                }
                None => None,
            };
            if let Some(blocker) = blocker {
                note(ui, &blocker);
            }
            if let Some(failure) = &form.failure {
                note(ui, failure);
            }
            request
        })
        .inner
}

/// The field; true if Enter was pressed in it.
fn entry(ui: &mut Ui, form: &mut Enrolling) -> bool {
    let label = ui.label("Participant id");
    let field = ui.add(
        TextEdit::singleline(&mut form.text)
            .hint_text("for example P01")
            .char_limit(64)
            .margin(Margin::symmetric(10, 7))
            .desired_width(320.0),
    );
    let field = field.labelled_by(label.id);
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let idle = form.text.is_empty() && ui.memory(|memory| memory.focused().is_none());
    if entered || idle {
        field.request_focus();
    }
    if field.changed() {
        form.failure = None;
    }
    entered
}

/// Offers to go on with an interrupted session; true once that is confirmed.
fn resume(
    ui: &mut Ui,
    facts: &Facts<'_>,
    form: &mut Enrolling,
    id: &ParticipantId,
    done: usize,
) -> bool {
    let total = facts.trials;
    if done >= total {
        start_button(ui, "Start session", false);
        note(
            ui,
            &format!("{id} has finished this study ({done} of {total} trials). Give another id."),
        );
        return false;
    }
    note(
        ui,
        &format!(
            "{id} has an unfinished session: {done} of {total} trials are on record. It can go on with number {}.",
            done + 1
        ),
    );
    if !form.confirming {
        form.confirming = start_button(ui, "Resume session …", facts.blocker().is_none());
        return false;
    }
    note(
        ui,
        &format!(
            "Is this the same person? The interruption goes on record with trial {}.",
            done + 1
        ),
    );
    ui.horizontal(|ui| {
        let confirmed = start_button(ui, "Yes, resume", facts.blocker().is_none());
        if ui.button("No").clicked() {
            form.confirming = false;
        }
        confirmed
    })
    .inner
}

fn start_button(ui: &mut Ui, text: &str, enabled: bool) -> bool {
    ui.add_enabled(enabled, theme::primary_button(text, vec2(170.0, 44.0)))
        .clicked()
}

fn note(ui: &mut Ui, text: &str) {
    ui.label(theme::quiet(text));
}
