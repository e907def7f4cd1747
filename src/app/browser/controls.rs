//! The row of controls over the stage.

use eframe::egui::{Ui, vec2};

use super::pair::GAINS;
use super::{Browser, Look};
use crate::render::Buffer;

/// Draws the controls and does what they ask.
pub(super) fn show(browser: &mut Browser, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        if browser.can_leave {
            browser.is_left |= ui.button("Back").on_hover_text("Escape").clicked();
            ui.separator();
        }
        let labels = browser
            .record()
            .map(|record| [&record.first, &record.second].map(|image| image.technique.clone()));
        let Some(labels) = labels else {
            ui.label("Stimuli");
            return;
        };
        images(browser, ui, &labels);
        ui.separator();
        looks(browser, ui);
        ui.separator();
        if ui.button("Fit").on_hover_text("Key 0").clicked() {
            browser.stage.fit();
        }
        if ui.button("1:1").on_hover_text("Key 1").clicked() {
            browser.stage.one_to_one();
        }
        ui.separator();
        for buffer in Buffer::ALL {
            let look = Look::Buffer(buffer);
            ui.selectable_value(&mut browser.look, look, title_case(buffer.name()));
        }
    });
}

fn images(browser: &mut Browser, ui: &mut Ui, labels: &[String; 2]) {
    for (index, (letter, label)) in ["A", "B"].into_iter().zip(labels).enumerate() {
        let second = index == 1;
        let shown =
            browser.shows_second == second && matches!(browser.look, Look::Flip | Look::Buffer(_));
        // As wide for both, so that nothing moves at a flip.
        let text = format!("{letter}  {label}");
        let button = eframe::egui::Button::selectable(shown, text).min_size(vec2(130.0, 0.0));
        if ui
            .add(button)
            .on_hover_text(format!("Key {letter}"))
            .clicked()
        {
            browser.shows_second = second;
            if matches!(browser.look, Look::Split | Look::Difference) {
                browser.look = Look::Flip;
            }
        }
    }
    if ui.button("Flip").on_hover_text("Space").clicked() {
        browser.flip();
    }
}

fn looks(browser: &mut Browser, ui: &mut Ui) {
    for (look, name, key) in [
        (Look::Split, "Split", "Key S"),
        (Look::Difference, "Difference", "Key D"),
    ] {
        ui.selectable_value(&mut browser.look, look, name)
            .on_hover_text(key);
    }
    // Always there, so that nothing moves when the difference is chosen.
    ui.add_enabled_ui(browser.look == Look::Difference, |ui| {
        for gain in GAINS {
            ui.selectable_value(&mut browser.gain, gain, format!("×{gain}"));
        }
    });
}

/// A name as it stands on a button.
fn title_case(name: &str) -> String {
    let mut letters = name.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}
