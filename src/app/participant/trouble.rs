//! Something needs the experimenter: a calm sentence for the participant, the
//! precise one folded away under it.

use eframe::egui::{CollapsingHeader, CursorIcon, Ui, vec2};

use super::{Page, button};

/// Draws both; true if the experimenter asks to try again.
pub fn show(ui: &mut Ui, page: Page<'_>, detail: &str) -> bool {
    // An image may have hidden the pointer.
    ui.ctx().set_cursor_icon(CursorIcon::Default);
    page.show(ui, |ui| {
        ui.label(&*page.words.trouble);
        ui.add_space(48.0);
        CollapsingHeader::new(&*page.words.for_experimenter)
            .id_salt("trouble")
            .show(ui, |ui| {
                ui.label(detail);
                ui.add_space(8.0);
                button(ui, &page.words.try_again, vec2(160.0, 44.0)).clicked()
            })
            .body_returned
            .unwrap_or(false)
    })
}
