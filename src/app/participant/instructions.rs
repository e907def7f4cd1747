//! The first screen: what will happen, and one button.

use eframe::egui::{Ui, vec2};

use super::{Given, button, device, page};
use crate::protocol::config::Texts;
use crate::session::Event;

/// Draws the instructions.
pub fn show(ui: &mut Ui, level: u8, texts: &Texts) -> Option<Given> {
    page(ui, level, |ui| {
        ui.heading(&*texts.title);
        ui.add_space(12.0);
        for paragraph in texts.instructions.split("\n\n") {
            // Line breaks inside a paragraph are those of the file's editor.
            ui.label(paragraph.split_whitespace().collect::<Vec<_>>().join(" "));
            ui.add_space(4.0);
        }
        ui.add_space(20.0);
        let begin = button(ui, &texts.begin, vec2(200.0, 52.0));
        begin.clicked().then(|| (Event::Begin, device(&begin)))
    })
}
