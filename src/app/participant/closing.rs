//! The end, reached or called: thanks, and a small way back for the experimenter.

use eframe::egui::{Button, RichText, TextStyle, Ui};

use super::Page;

/// Draws the last sentence; true if the experimenter goes back to the start page.
pub fn show(ui: &mut Ui, page: Page<'_>, text: &str) -> bool {
    page.show(ui, |ui| {
        ui.label(text);
        ui.add_space(160.0);
        let back = RichText::new(&*page.words.back).text_style(TextStyle::Small);
        ui.add(Button::new(back).frame(false)).clicked()
    })
}
