//! The grey between two images. It takes no input and ends by itself.

use eframe::egui::{self, Context};

use crate::app::stimulus_view::{self, SizePx, TooSmall};

/// Draws the grey over the place of the images, and what stands round them.
///
/// # Errors
/// [`TooSmall`] if that place is larger than the window.
pub fn show(ctx: &Context, image_px: SizePx, level: u8, surround: u8) -> Result<(), TooSmall> {
    ctx.set_cursor_icon(egui::CursorIcon::None);
    stimulus_view::paint_field(ctx, image_px, level, surround)
}
