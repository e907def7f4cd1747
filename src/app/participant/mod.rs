//! The participant's screens: one file a screen, each a thin view of
//! [`Session::screen`](crate::session::Session::screen). A view draws, and gives
//! back the event of the button that was pressed; it decides nothing.
//!
//! Every text comes from the protocol. None may say what realism is.

pub mod closing;
pub mod comparison;
pub mod consent;
pub mod form;
pub mod grey;
pub mod image;
pub mod instructions;
pub mod pair_menu;
pub mod pause;
pub mod question;
pub mod ranking;
pub mod rating;
pub mod saving;
pub mod trouble;

use eframe::egui::{
    self, Color32, FontFamily, FontId, Frame, InputState, Margin, Rect, Response, ScrollArea,
    Stroke, TextStyle, Ui, UiBuilder, pos2,
};

use super::{stimulus_view, theme};
use crate::protocol::{Key, Words};
use crate::record::InputDevice;
use crate::session::Event;

/// Width of the card, points; a line holds about 80 characters.
const COLUMN: f32 = 848.0;

/// How pages of text look. Images and the grey are never touched by it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Grey level round the card (8-bit sRGB): the protocol's, so that the eye stays
    /// adapted to the grey between the images.
    pub level: u8,
    /// Size of type, 1 for the usual.
    pub text_scale: f32,
    /// Black on white with strong edges.
    pub high_contrast: bool,
}

impl Look {
    fn ink(self) -> Color32 {
        if self.high_contrast {
            Color32::BLACK
        } else {
            theme::ink_on(self.level)
        }
    }

    fn card(self) -> Frame {
        let frame = Frame::new()
            .corner_radius(6)
            .inner_margin(Margin::symmetric(44, 36));
        if self.high_contrast {
            frame
                .fill(Color32::WHITE)
                .stroke(Stroke::new(4.0, Color32::BLACK))
        } else {
            frame.fill(Color32::from_gray(theme::card_on(self.level)))
        }
    }
}

/// What every page of text is made of: its look, and every sentence.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// How it looks.
    pub look: Look,
    /// What it says.
    pub words: &'a Words,
}

impl Page<'_> {
    /// A quiet card on the protocol's grey.
    fn show<R>(&self, ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
        stimulus_view::paint_grey(ui.ctx(), self.look.level);
        let screen = ui.ctx().viewport_rect();
        let widest = COLUMN * self.look.text_scale.max(1.0);
        let width = widest.min(screen.width() - 24.0).max(1.0);
        let column = Rect::from_min_max(
            pos2(
                screen.center().x - width / 2.0,
                screen.top() + screen.height() * 0.1,
            ),
            pos2(screen.center().x + width / 2.0, screen.bottom() - 12.0),
        );
        ui.scope_builder(UiBuilder::new().max_rect(column), |ui| {
            self.large_type(ui);
            ScrollArea::vertical()
                .auto_shrink(false)
                .show(ui, |ui| {
                    self.look
                        .card()
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

    fn large_type(&self, ui: &mut Ui) {
        let style = ui.style_mut();
        style.visuals.override_text_color = Some(self.look.ink());
        style.spacing.item_spacing = egui::vec2(16.0, 14.0);
        for (role, size) in [
            (TextStyle::Heading, 32.0),
            (TextStyle::Body, 21.0),
            (TextStyle::Button, 21.0),
            (TextStyle::Small, 15.0),
        ] {
            let size = size * self.look.text_scale;
            style
                .text_styles
                .insert(role, FontId::new(size, FontFamily::Proportional));
        }
    }
}

/// Paragraphs of a text, parted by blank lines; line breaks inside one are those of the
/// file's editor.
fn paragraphs(ui: &mut Ui, text: &str) {
    for paragraph in text.split("\n\n") {
        ui.label(paragraph.split_whitespace().collect::<Vec<_>>().join(" "));
        ui.add_space(4.0);
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
