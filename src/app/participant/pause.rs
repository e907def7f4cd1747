//! A page between two trials: a rest, the end of the practice, or the next trial's button.

use eframe::egui::{Ui, vec2};

use super::{Given, Page, button, device};
use crate::session::Event;

/// Draws a sentence and the button that sends `event`.
pub fn show(ui: &mut Ui, page: Page<'_>, text: &str, event: Event) -> Option<Given> {
    page.show(ui, |ui| {
        ui.add_space(40.0);
        ui.label(text);
        ui.add_space(24.0);
        let next = button(ui, &page.words.next, vec2(200.0, 52.0));
        next.clicked().then(|| (event, device(&next)))
    })
}
