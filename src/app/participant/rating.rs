//! The scales, one row of points each; digits rate the first scale that has no answer.

use eframe::egui::{Align, InputState, Key as EguiKey, Layout, Ui, Vec2, vec2};

use super::{Given, Page, button, device, pressed};
use crate::app::theme;
use crate::protocol::Key;
use crate::protocol::options::Scale;
use crate::record::InputDevice;
use crate::session::{Answer, Event};

const POINT: Vec2 = vec2(64.0, 52.0);

/// Points given so far, a scale each.
#[derive(Debug, Clone, Default)]
pub struct Draft(Vec<Option<u32>>);

impl Draft {
    /// Points as they are on record.
    #[must_use]
    pub fn of(points: Vec<Option<u32>>) -> Self {
        Self(points)
    }

    fn whole(&self) -> Option<Event> {
        let ratings: Option<Vec<u32>> = self.0.iter().copied().collect();
        Some(Event::Answer(Answer::Ratings(ratings?)))
    }
}

/// Digits rate, Backspace takes the last rating back, Enter or the key that leads on ends.
pub fn input(input: &InputState, go_on: Key, scales: &[Scale], draft: &mut Draft) -> Option<Given> {
    draft.0.resize(scales.len(), None);
    if let Some(open) = draft.0.iter().position(Option::is_none) {
        let points = scales[open].points.get();
        let digit = (1..=points).find(|&point| {
            char::from_digit(point, 10).is_some_and(|digit| pressed(input, Key::Symbol(digit)))
        });
        draft.0[open] = digit;
    }
    if input.key_pressed(EguiKey::Backspace)
        && let Some(last) = draft.0.iter().rposition(Option::is_some)
    {
        draft.0[last] = None;
    }
    let ends = pressed(input, Key::Enter) || pressed(input, go_on);
    draft
        .whole()
        .filter(|_| ends)
        .map(|event| (event, InputDevice::Keyboard))
}

/// Draws the scales.
pub fn show(ui: &mut Ui, page: Page<'_>, scales: &[Scale], draft: &mut Draft) -> Option<Given> {
    draft.0.resize(scales.len(), None);
    page.show(ui, |ui| {
        ui.heading(&*page.words.question);
        ui.add_space(12.0);
        for (scale, rating) in scales.iter().zip(&mut draft.0) {
            row(ui, page, scale, rating);
            ui.add_space(12.0);
        }
        let whole = draft.whole();
        let next = ui
            .add_enabled_ui(whole.is_some(), |ui| {
                button(ui, &page.words.next, vec2(200.0, 52.0))
            })
            .inner;
        whole
            .filter(|_| next.clicked())
            .map(|event| (event, device(&next)))
    })
}

fn row(ui: &mut Ui, page: Page<'_>, scale: &Scale, rating: &mut Option<u32>) {
    let Some(words) = page.words.scales.get(&*scale.id) else {
        return;
    };
    ui.label(&*words.question);
    // As high as its buttons from the start, so that the words stand in their middle.
    let size = vec2(ui.available_width(), POINT.y * page.look.text_scale);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.label(&*words.low);
        for point in 1..=scale.points.get() {
            let is_given = *rating == Some(point);
            let text = point.to_string();
            let pressed = theme::point_button(ui, &text, is_given, POINT * page.look.text_scale);
            if pressed.clicked() {
                *rating = Some(point);
            }
        }
        ui.label(&*words.high);
    });
}
