//! The page with the pairs: one button each, only the next one's enabled.

use eframe::egui::{Color32, Role, Ui, WidgetInfo, vec2};

use super::{Given, Page, button, device};
use crate::app::theme;
use crate::session::Event;

/// Size of a pair's button, points.
const BUTTON: [f32; 2] = [176.0, 52.0];
/// Buttons in a row; more would be wider than the column of text.
const ROW: usize = 4;

/// Draws the buttons of `total` pairs, of which those before `next` are done.
pub fn show(ui: &mut Ui, page: Page<'_>, next: usize, total: usize) -> Option<Given> {
    page.show(ui, |ui| {
        ui.label(&*page.words.menu);
        ui.add_space(16.0);
        let mut given = None;
        for first in (0..total).step_by(ROW) {
            ui.horizontal(|ui| {
                for index in first..total.min(first + ROW) {
                    given = pair(ui, page, index, next).or(given.take());
                }
            });
        }
        given
    })
}

fn pair(ui: &mut Ui, page: Page<'_>, index: usize, next: usize) -> Option<Given> {
    let caption = page.words.pair_caption(index);
    let done = index < next;
    ui.add_enabled_ui(index == next, |ui| {
        let pressed = button(ui, &caption, vec2(BUTTON[0], BUTTON[1]));
        if done {
            let centre = pressed.rect.left_center() + vec2(26.0, 0.0);
            theme::paint_tick(ui.painter(), centre, 18.0, Color32::from_gray(250));
        }
        pressed.widget_info(|| {
            WidgetInfo::selected(Role::Button, index == next, done, caption.as_str())
        });
        pressed
            .clicked()
            .then(|| (Event::StartPair(index), device(&pressed)))
    })
    .inner
}
