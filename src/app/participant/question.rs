//! Which of the two looked more realistic: two buttons, two keys.

use eframe::egui::{InputState, RichText, TextStyle, Ui, vec2};

use super::{Given, button, device, page, pressed};
use crate::protocol::config::{Keys, Texts};
use crate::protocol::{Key, Position};
use crate::record::InputDevice;
use crate::session::Event;

const BUTTON: [f32; 2] = [260.0, 72.0];

/// The keys that answer. Both at once are no answer.
pub fn input(input: &InputState, keys: &Keys) -> Option<Given> {
    let choice = match (
        pressed(input, keys.answer_first),
        pressed(input, keys.answer_second),
    ) {
        (true, false) => Position::First,
        (false, true) => Position::Second,
        _ => return None,
    };
    Some((Event::Answer(choice), InputDevice::Keyboard))
}

/// Draws the question.
pub fn show(ui: &mut Ui, level: u8, texts: &Texts, keys: &Keys) -> Option<Given> {
    page(ui, level, |ui| {
        ui.add_space(40.0);
        ui.vertical_centered(|ui| {
            ui.heading(&*texts.question);
            ui.add_space(36.0);
            // Two equal columns round the middle: neither answer stands out.
            let gap = ui.spacing().item_spacing.x;
            let margin = (ui.available_width() - 2.0 * BUTTON[0] - gap).max(0.0) / 2.0;
            ui.horizontal(|ui| {
                ui.add_space(margin);
                let first = answer(ui, &texts.answer_first, keys.answer_first, Position::First);
                let second = answer(
                    ui,
                    &texts.answer_second,
                    keys.answer_second,
                    Position::Second,
                );
                first.or(second)
            })
            .inner
        })
        .inner
    })
}

fn answer(ui: &mut Ui, text: &str, key: Key, choice: Position) -> Option<Given> {
    ui.vertical(|ui| {
        ui.set_max_width(BUTTON[0]);
        let pressed = button(ui, text, vec2(BUTTON[0], BUTTON[1]));
        ui.vertical_centered(|ui| {
            ui.label(RichText::new(key.to_string()).text_style(TextStyle::Body));
        });
        pressed
            .clicked()
            .then(|| (Event::Answer(choice), device(&pressed)))
    })
    .inner
}
