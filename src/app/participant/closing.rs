//! The end, reached or called: thanks, and a small way back for the experimenter.

use eframe::egui::{Button, RichText, TextStyle, Ui};

use super::page;

/// Draws the last sentence; true if the experimenter goes back to the start page.
pub fn show(ui: &mut Ui, level: u8, text: &str) -> bool {
    page(ui, level, |ui| {
        ui.label(text);
        ui.add_space(160.0);
        let back = RichText::new("Back to the start page").text_style(TextStyle::Small);
        ui.add(Button::new(back).frame(false)).clicked()
    })
}
