//! The grey between two images. It takes no input and ends by itself.

use eframe::egui::{self, Context};

use crate::app::stimulus_view::{self, SizePx, TooSmall};
use crate::protocol::config::{Grey, GreyArea};

/// Draws the grey over the place of the images, and what stands round them.
///
/// # Errors
/// [`TooSmall`] if that place is larger than the window.
pub fn show(ctx: &Context, image_px: SizePx, level: u8, surround: u8) -> Result<(), TooSmall> {
    ctx.set_cursor_icon(egui::CursorIcon::None);
    stimulus_view::paint_field(ctx, image_px, level, surround)
}

/// Grey level (8-bit sRGB) round images and the grey.
#[must_use]
pub fn surround(grey: &Grey) -> u8 {
    match grey.area {
        GreyArea::Screen => grey.level_srgb.get(),
        // Black, as a display is where it shows nothing.
        GreyArea::Image => 0,
    }
}
