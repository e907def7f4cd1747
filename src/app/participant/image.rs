//! One stimulus and nothing else: no text, no pointer.

use eframe::egui::{self, Context, InputState, TextureHandle};

use super::{Given, pressed};
use crate::app::stimulus_view::{self, TooSmall};
use crate::protocol::config::Keys;
use crate::record::InputDevice;
use crate::session::Event;

/// The key that ends the image.
pub fn input(input: &InputState, keys: &Keys) -> Option<Given> {
    pressed(input, keys.go_on).then_some((Event::Continue, InputDevice::Keyboard))
}

/// Draws the stimulus.
///
/// # Errors
/// [`TooSmall`] if it does not fit; nothing but the surrounding is drawn then.
pub fn show(ctx: &Context, texture: &TextureHandle, surround: u8) -> Result<(), TooSmall> {
    ctx.set_cursor_icon(egui::CursorIcon::None);
    stimulus_view::paint_picture(ctx, texture, surround)
}
