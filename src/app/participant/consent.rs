//! What the participant is asked to agree to, before anything else.

use eframe::egui::{Ui, vec2};

use super::{Given, Page, button, device, paragraphs};
use crate::session::Event;

/// Draws the text and both answers.
pub fn show(ui: &mut Ui, page: Page<'_>) -> Option<Given> {
    page.show(ui, |ui| {
        ui.heading(&*page.words.consent_title);
        ui.add_space(12.0);
        paragraphs(ui, page.words.consent.as_deref().unwrap_or_default());
        ui.add_space(20.0);
        ui.horizontal_wrapped(|ui| {
            let agree = button(ui, &page.words.agree, vec2(260.0, 52.0));
            let decline = button(ui, &page.words.decline, vec2(260.0, 52.0));
            let agreed = agree.clicked().then(|| (Event::Agree, device(&agree)));
            agreed.or_else(|| {
                decline
                    .clicked()
                    .then(|| (Event::Decline, device(&decline)))
            })
        })
        .inner
    })
}
