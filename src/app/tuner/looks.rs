//! The row over the stage: what is looked at, and whose.

use eframe::egui::{Button, Ui};

use super::result::{Look, Slot};
use super::{Side, Tuner};

/// Draws the row and does what it asks.
pub(super) fn show(tuner: &mut Tuner, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        for (index, (look, name)) in Look::ALL.into_iter().enumerate() {
            ui.selectable_value(&mut tuner.look, look, name)
                .on_hover_text(format!("Key {}", index + 1));
        }
        ui.separator();
        for (side, name, key) in [
            (Side::Of(Slot::Now), "Now", "N: what the sliders say"),
            (Side::Of(Slot::A), "A", "A: what is pinned as A"),
            (Side::Of(Slot::B), "B", "B: what is pinned as B"),
            (Side::Split, "Split A | B", "S: drag the divider"),
        ] {
            let button = Button::selectable(tuner.side == side, name);
            let can_show = tuner.can_show(side);
            let response = ui
                .add_enabled(can_show, button)
                .on_hover_text(format!("Key {key}"))
                .on_disabled_hover_text("Pin something first");
            if response.clicked() {
                tuner.side = side;
            }
        }
        ui.separator();
        if ui.button("Fit").on_hover_text("Key 0").clicked() {
            tuner.stage.fit();
        }
        if ui.button("1:1").clicked() {
            tuner.stage.one_to_one();
        }
    });
}
