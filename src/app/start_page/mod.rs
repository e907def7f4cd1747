//! The experimenter's page: what study this is, whether everything is ready, and
//! who comes next.

mod enrolment;
mod facts;
mod overview;
mod screens;

use eframe::egui::{Color32, Frame, Margin, Rect, RichText, ScrollArea, Ui, UiBuilder, vec2};

pub use enrolment::{Enrolling, OnRecord};
pub use facts::Facts;
pub use overview::lines as participants;
pub use screens::Screens;

use super::{stimulus_view, theme};
use crate::record::ParticipantId;

/// Widest the page gets, points.
const WIDTH: f32 = 860.0;

/// What the experimenter asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Request {
    /// A session of a new participant.
    Begin(ParticipantId),
    /// The rest of an interrupted session; the experimenter has confirmed it.
    Resume(ParticipantId),
}

/// Where to go from this page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Next {
    /// Into a session.
    Session(Request),
    /// To the stimuli, before anybody takes part.
    Stimuli,
    /// To the participants and their data.
    Study,
    /// To the same in a window of its own, which stays during sessions.
    Watch,
}

/// Draws the page.
pub fn show(ui: &mut Ui, facts: &Facts<'_>, enrolling: &mut Enrolling) -> Option<Next> {
    let screen = ui.ctx().viewport_rect();
    stimulus_view::paint_grey(ui.ctx(), theme::PAGE);
    let width = WIDTH.min(screen.width() - 48.0).max(1.0);
    let column = Rect::from_center_size(
        screen.center() + vec2(0.0, 16.0),
        vec2(width, (screen.height() - 56.0).max(1.0)),
    );
    ui.scope_builder(UiBuilder::new().max_rect(column), |ui| {
        ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| {
                heading(ui, facts);
                let request = enrolment::show(ui, facts, enrolling);
                let elsewhere = ways_on(ui);
                facts::show(ui, facts);
                elsewhere.or(request.map(Next::Session))
            })
            .inner
    })
    .inner
}

/// The buttons to the other pages.
fn ways_on(ui: &mut Ui) -> Option<Next> {
    ui.add_space(10.0);
    ui.horizontal_wrapped(|ui| {
        [
            ("Participants and data", Next::Study),
            ("Watch in another window", Next::Watch),
            ("Look at the stimuli", Next::Stimuli),
        ]
        .map(|(text, next)| ui.button(text).clicked().then_some(next))
    })
    .inner
    .into_iter()
    .flatten()
    .next()
}

fn heading(ui: &mut Ui, facts: &Facts<'_>) {
    ui.horizontal(|ui| {
        ui.heading(&*facts.protocol.study_id);
        if facts.pilot {
            ui.add_space(8.0);
            Frame::new()
                .fill(Color32::from_gray(45))
                .corner_radius(4)
                .inner_margin(Margin::symmetric(10, 3))
                .show(ui, |ui| {
                    ui.label(
                        RichText::new("Pilot: rows are marked as such")
                            .color(Color32::from_gray(250)),
                    );
                });
        }
    });
    ui.label(theme::quiet(format!(
        "{} trials: {}.",
        facts.trials, facts.protocol.procedure.summary
    )));
    ui.add_space(14.0);
}
