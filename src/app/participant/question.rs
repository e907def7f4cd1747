//! Which of the two looked more realistic: two buttons, two keys; a third where the
//! protocol lets people say that they cannot tell.

use eframe::egui::{InputState, RichText, TextStyle, Ui, vec2};

use super::{Given, Page, button, device, pressed};
use crate::protocol::config::Keys;
use crate::protocol::{Key, Position};
use crate::record::InputDevice;
use crate::session::{Answer, Event};

const BUTTON: [f32; 2] = [260.0, 72.0];

/// The keys that answer. Two at once are no answer.
pub fn input(input: &InputState, keys: &Keys, cannot_tell: bool) -> Option<Given> {
    let answers = [
        (keys.answer_first, Answer::Choice(Position::First)),
        (keys.answer_second, Answer::Choice(Position::Second)),
        (keys.cannot_tell, Answer::CannotTell),
    ];
    let offered = if cannot_tell { 3 } else { 2 };
    let mut down = answers
        .into_iter()
        .take(offered)
        .filter(|(key, _)| pressed(input, *key));
    match (down.next(), down.next()) {
        (Some((_, answer)), None) => Some((Event::Answer(answer), InputDevice::Keyboard)),
        _ => None,
    }
}

/// Draws the question.
pub fn show(ui: &mut Ui, page: Page<'_>, keys: &Keys, cannot_tell: bool) -> Option<Given> {
    let words = page.words;
    page.show(ui, |ui| {
        ui.add_space(40.0);
        ui.vertical_centered(|ui| {
            ui.heading(&*words.question);
            ui.add_space(36.0);
            // Two equal columns round the middle: neither answer stands out.
            let gap = ui.spacing().item_spacing.x;
            let width = BUTTON[0] * page.look.text_scale.max(1.0);
            let margin = (ui.available_width() - 2.0 * width - gap).max(0.0) / 2.0;
            let choice = |ui: &mut Ui, text: &str, key, position| {
                answer(ui, width, text, key, Answer::Choice(position))
            };
            let chosen = ui
                .horizontal(|ui| {
                    ui.add_space(margin);
                    let first = choice(ui, &words.answer_first, keys.answer_first, Position::First);
                    let second = choice(
                        ui,
                        &words.answer_second,
                        keys.answer_second,
                        Position::Second,
                    );
                    first.or(second)
                })
                .inner;
            if !cannot_tell {
                return chosen;
            }
            ui.add_space(12.0);
            let margin = (ui.available_width() - width).max(0.0) / 2.0;
            let neither = ui
                .horizontal(|ui| {
                    ui.add_space(margin);
                    answer(
                        ui,
                        width,
                        &words.cannot_tell,
                        keys.cannot_tell,
                        Answer::CannotTell,
                    )
                })
                .inner;
            chosen.or(neither)
        })
        .inner
    })
}

/// One button with its key under it.
pub(super) fn answer(
    ui: &mut Ui,
    width: f32,
    text: &str,
    key: Key,
    answer: Answer,
) -> Option<Given> {
    ui.vertical(|ui| {
        ui.set_max_width(width);
        let pressed = button(ui, text, vec2(width, BUTTON[1]));
        ui.vertical_centered(|ui| {
            ui.label(RichText::new(key.to_string()).text_style(TextStyle::Body));
        });
        pressed
            .clicked()
            .then(|| (Event::Answer(answer), device(&pressed)))
    })
    .inner
}
