//! While an answer goes to disk.

use eframe::egui::Ui;

use super::page;
use crate::protocol::config::Texts;

/// Draws the sentence.
pub fn show(ui: &mut Ui, level: u8, texts: &Texts) {
    page(ui, level, |ui| ui.label(&*texts.saving));
}
