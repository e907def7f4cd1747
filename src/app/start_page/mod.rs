//! The experimenter's page: what study this is, whether everything is ready, and
//! who comes next.

mod enrolment;
mod facts;

use eframe::egui::{CentralPanel, Frame, Margin, RichText, ScrollArea, Ui};

pub use enrolment::{Enrolling, OnRecord};
pub use facts::Facts;

use super::theme;
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

/// Draws the page.
pub fn show(ui: &mut Ui, facts: &Facts<'_>, enrolling: &mut Enrolling) -> Option<Request> {
    let side = ((ui.ctx().viewport_rect().width() - WIDTH) / 2.0).max(24.0);
    #[allow(clippy::cast_possible_truncation)] // a margin of a window, under i8::MAX or capped
    let margin = Margin::symmetric(side.min(f32::from(i8::MAX)) as i8, 28);
    let frame = Frame::central_panel(ui.style()).inner_margin(margin);
    CentralPanel::default()
        .frame(frame)
        .show(ui, |ui| {
            ScrollArea::vertical()
                .auto_shrink(false)
                .show(ui, |ui| {
                    ui.set_max_width(WIDTH);
                    heading(ui, facts);
                    let request = enrolment::show(ui, facts, enrolling);
                    facts::show(ui, facts);
                    request
                })
                .inner
        })
        .inner
}

fn heading(ui: &mut Ui, facts: &Facts<'_>) {
    ui.horizontal(|ui| {
        ui.heading(&*facts.protocol.study_id);
        if facts.pilot {
            ui.add_space(8.0);
            Frame::new()
                .fill(eframe::egui::Color32::from_gray(45))
                .corner_radius(4)
                .inner_margin(Margin::symmetric(10, 3))
                .show(ui, |ui| {
                    ui.label(
                        RichText::new("Pilot: rows are marked as such")
                            .color(eframe::egui::Color32::from_gray(250)),
                    );
                });
        }
    });
    ui.label(theme::quiet(format!(
        "{} pairs: {}.",
        facts.pairs, facts.protocol.procedure.summary
    )));
    ui.add_space(14.0);
}
