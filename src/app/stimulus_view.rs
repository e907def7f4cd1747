//! The picture on the screen: its own pixels, bit for bit, and nothing else.
//!
//! One image pixel covers one physical pixel of the surface: the texture is
//! drawn at `size / pixels_per_point` points from a corner on a whole pixel,
//! sampled nearest, opaque, with dithering off (see `NativeOptions` in
//! [`super::window`]). Grey is a mesh and not a rectangle shape, because egui
//! feathers the edges of shapes over half a pixel.

use eframe::egui::{
    self, Color32, ColorImage, Context, Mesh, Painter, Pos2, Rect, TextureHandle, TextureOptions,
};

use crate::stimulus::manifest::Picture;

/// Columns and rows, in pixels.
pub type SizePx = [u32; 2];

/// The surface is smaller than the picture; nothing was drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the picture is {}×{} pixels and the window only {}×{}: enlarge the window or use a larger monitor",
    picture_px[0], picture_px[1], surface_px[0], surface_px[1]
)]
pub struct TooSmall {
    /// Size of the surface.
    pub surface_px: SizePx,
    /// Size of the picture.
    pub picture_px: SizePx,
}

/// Makes a texture that shows the picture's bytes unchanged.
pub fn upload(ctx: &Context, name: &str, picture: &Picture) -> TextureHandle {
    let size = [picture.width_px as usize, picture.height_px as usize];
    let image = ColorImage::from_rgba_unmultiplied(size, &picture.rgba8);
    ctx.load_texture(name, image, TextureOptions::NEAREST)
}

/// Size of the surface in physical pixels.
#[must_use]
pub fn surface_px(ctx: &Context) -> SizePx {
    let size = ctx.viewport_rect().size() * ctx.pixels_per_point();
    // A surface has whole pixels; points times scale only miss them by rounding.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    [size.x.round() as u32, size.y.round() as u32]
}

/// Upper left pixel of a picture in the middle of the surface, on whole pixels;
/// an odd pixel left over goes to the right and bottom.
///
/// # Errors
/// [`TooSmall`] if the picture does not fit.
pub fn centred_px(surface_px: SizePx, picture_px: SizePx) -> Result<SizePx, TooSmall> {
    if picture_px[0] > surface_px[0] || picture_px[1] > surface_px[1] {
        return Err(TooSmall {
            surface_px,
            picture_px,
        });
    }
    Ok([0, 1].map(|axis| (surface_px[axis] - picture_px[axis]) / 2))
}

/// Covers the whole surface with one grey level (8-bit sRGB).
pub fn paint_grey(ctx: &Context, level: u8) {
    let mut mesh = Mesh::default();
    mesh.add_colored_rect(ctx.viewport_rect(), Color32::from_gray(level));
    background(ctx).add(mesh);
}

/// Covers the place of a picture of `picture_px` with one grey level, and the
/// rest of the surface with another.
///
/// # Errors
/// [`TooSmall`] if the place is larger than the surface; then only the
/// surrounding was drawn.
pub fn paint_field(
    ctx: &Context,
    picture_px: SizePx,
    level: u8,
    surround: u8,
) -> Result<(), TooSmall> {
    paint_grey(ctx, surround);
    let mut mesh = Mesh::default();
    mesh.add_colored_rect(place(ctx, picture_px)?, Color32::from_gray(level));
    background(ctx).add(mesh);
    Ok(())
}

/// Shows the picture in the middle of the surface, one grey level round it.
///
/// # Errors
/// [`TooSmall`] if it does not fit; then only the surrounding was drawn. It is
/// never scaled down.
pub fn paint_picture(ctx: &Context, texture: &TextureHandle, surround: u8) -> Result<(), TooSmall> {
    paint_grey(ctx, surround);
    let mut mesh = Mesh::with_texture(texture.id());
    mesh.add_rect_with_uv(
        place(ctx, size_px(texture))?,
        Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0)),
        Color32::WHITE,
    );
    background(ctx).add(mesh);
    Ok(())
}

/// Shows pictures with their upper left pixels at `corners`, one grey level round them.
pub fn paint_pictures(ctx: &Context, pictures: &[(&TextureHandle, SizePx)], surround: u8) {
    paint_grey(ctx, surround);
    for (texture, corner_px) in pictures {
        let mut mesh = Mesh::with_texture(texture.id());
        mesh.add_rect_with_uv(
            rect_at(ctx, *corner_px, size_px(texture)),
            Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0)),
            Color32::WHITE,
        );
        background(ctx).add(mesh);
    }
}

/// A rectangle of whole pixels, in points.
#[must_use]
pub fn rect_at(ctx: &Context, corner_px: SizePx, size_px: SizePx) -> Rect {
    let far_px = [corner_px[0] + size_px[0], corner_px[1] + size_px[1]];
    // f32 holds points to better than 1/1000 pixel, and nearest sampling at pixel
    // centres forgives half of one.
    let scale = ctx.pixels_per_point();
    let point = |px: SizePx| Pos2::new(px[0] as f32 / scale, px[1] as f32 / scale);
    Rect::from_min_max(point(corner_px), point(far_px))
}

/// Size of a texture, pixels.
#[must_use]
pub fn size_px(texture: &TextureHandle) -> SizePx {
    texture
        .size()
        .map(|count| u32::try_from(count).unwrap_or(u32::MAX))
}

/// The middle `picture_px` of the surface, in points.
fn place(ctx: &Context, picture_px: SizePx) -> Result<Rect, TooSmall> {
    let corner_px = centred_px(surface_px(ctx), picture_px)?;
    Ok(rect_at(ctx, corner_px, picture_px))
}

fn background(ctx: &Context) -> Painter {
    ctx.layer_painter(egui::LayerId::background())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn margins_differ_by_at_most_the_odd_pixel(
            picture in (1_u32..4000, 1_u32..4000),
            extra in (0_u32..2000, 0_u32..2000),
        ) {
            let picture_px = [picture.0, picture.1];
            let surface_px = [picture.0 + extra.0, picture.1 + extra.1];
            let corner = centred_px(surface_px, picture_px).unwrap();
            for axis in [0, 1] {
                let after = surface_px[axis] - picture_px[axis] - corner[axis];
                prop_assert!(after == corner[axis] || after == corner[axis] + 1);
            }
        }

        #[test]
        fn a_picture_too_large_is_refused(
            surface in (1_u32..4000, 1_u32..4000),
            over in 1_u32..100,
            wide in any::<bool>(),
        ) {
            let surface_px = [surface.0, surface.1];
            let mut picture_px = surface_px;
            picture_px[usize::from(wide)] += over;
            prop_assert_eq!(
                centred_px(surface_px, picture_px),
                Err(TooSmall { surface_px, picture_px })
            );
        }
    }
}
