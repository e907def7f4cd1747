//! The first screen: what will happen, and one button.

use eframe::egui::{Ui, vec2};

use super::{Given, Page, button, device, paragraphs};
use crate::session::Event;

/// Draws the instructions.
pub fn show(ui: &mut Ui, page: Page<'_>) -> Option<Given> {
    page.show(ui, |ui| {
        ui.heading(&*page.words.title);
        ui.add_space(12.0);
        paragraphs(ui, &page.words.instructions);
        ui.add_space(20.0);
        let begin = button(ui, &page.words.begin, vec2(200.0, 52.0));
        begin.clicked().then(|| (Event::Begin, device(&begin)))
    })
}
