//! While an answer goes to disk.

use eframe::egui::Ui;

use super::Page;

/// Draws the sentence.
pub fn show(ui: &mut Ui, page: Page<'_>) {
    page.show(ui, |ui| ui.label(&*page.words.saving));
}
