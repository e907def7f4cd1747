//! The participant's screens: one file a screen, each a thin view of
//! [`Session::screen`](crate::session::Session::screen). A view draws, and gives
//! back the event of the button that was pressed; it decides nothing.
//!
//! Every text comes from the protocol. None may say what realism is.

pub mod closing;
pub mod grey;
pub mod image;
pub mod instructions;
pub mod pair_menu;
pub mod question;
pub mod saving;
pub mod trouble;

use eframe::egui::{
    self, Color32, FontFamily, FontId, Frame, InputState, Margin, Rect, Response, ScrollArea,
    TextStyle, Ui, UiBuilder, pos2,
};

use super::{stimulus_view, theme};
use crate::protocol::Key;
use crate::record::InputDevice;
use crate::session::Event;

/// Width of the card, points; a line holds about 80 characters.
const COLUMN: f32 = 848.0;

/// A page of text: a quiet card on the protocol's grey. That grey is the one
/// between the images, so that the eye stays adapted to it.
fn page<R>(ui: &mut Ui, level: u8, add: impl FnOnce(&mut Ui) -> R) -> R {
    stimulus_view::paint_grey(ui.ctx(), level);
    let screen = ui.ctx().viewport_rect();
    let width = COLUMN.min(screen.width() - 24.0).max(1.0);
    let column = Rect::from_min_max(
        pos2(
            screen.center().x - width / 2.0,
            screen.top() + screen.height() * 0.1,
        ),
        pos2(screen.center().x + width / 2.0, screen.bottom() - 12.0),
    );
    ui.scope_builder(UiBuilder::new().max_rect(column), |ui| {
        large_type(ui, level);
        ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| {
                Frame::new()
                    .fill(Color32::from_gray(theme::card_on(level)))
                    .corner_radius(6)
                    .inner_margin(Margin::symmetric(44, 36))
                    .show(ui, |ui| {
                        ui.set_min_width(ui.available_width());
                        add(ui)
                    })
                    .inner
            })
            .inner
    })
    .inner
}

fn large_type(ui: &mut Ui, level: u8) {
    let style = ui.style_mut();
    style.visuals.override_text_color = Some(theme::ink_on(level));
    style.spacing.item_spacing = egui::vec2(16.0, 14.0);
    for (role, size) in [
        (TextStyle::Heading, 32.0),
        (TextStyle::Body, 21.0),
        (TextStyle::Button, 21.0),
    ] {
        style
            .text_styles
            .insert(role, FontId::new(size, FontFamily::Proportional));
    }
}

/// A button as every screen has it.
fn button(ui: &mut Ui, text: &str, size: egui::Vec2) -> Response {
    ui.add(theme::primary_button(text, size))
}

/// What a pressed button was pressed with.
fn device(response: &Response) -> InputDevice {
    if response.clicked_by(egui::PointerButton::Primary) {
        InputDevice::Mouse
    } else {
        InputDevice::Keyboard
    }
}

/// Whether a key went down in this pass. Auto-repeat does not count, nor does the
/// key together with Ctrl, Alt or the command key.
pub fn pressed(input: &InputState, key: Key) -> bool {
    let wanted = egui_key(key);
    input.events.iter().any(|event| {
        matches!(event, egui::Event::Key { key, pressed: true, repeat: false, modifiers, .. }
            if Some(*key) == wanted
                && !modifiers.ctrl && !modifiers.alt && !modifiers.command && !modifiers.mac_cmd)
    })
}

/// egui's name of a protocol's key.
#[must_use]
pub fn egui_key(key: Key) -> Option<egui::Key> {
    egui::Key::from_name(&key.to_string())
}

/// An event, and what it was given with.
pub type Given = (Event, InputDevice);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_a_protocol_can_name_is_on_the_keyboard() {
        let symbols = ('A'..='Z').chain('0'..='9').map(Key::Symbol);
        let named = [
            Key::Space,
            Key::Enter,
            Key::Left,
            Key::Right,
            Key::Up,
            Key::Down,
        ];
        let keys: Vec<_> = symbols.chain(named).map(egui_key).collect();
        assert!(keys.iter().all(Option::is_some), "{keys:?}");
        let different: std::collections::HashSet<_> = keys.iter().collect();
        assert_eq!(different.len(), keys.len());
    }
}
