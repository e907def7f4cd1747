//! Zoom and pan: which point of the image stands where on the stage. Pure arithmetic, in
//! physical pixels of the screen and pixels of the image.

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};

/// Largest magnification, screen pixels an image pixel.
const LARGEST_ZOOM: f32 = 64.0;
/// Smallest.
const SMALLEST_ZOOM: f32 = 1.0 / 16.0;

/// Which part of an image is seen, and how large; both images of a pair share it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Screen pixels an image pixel.
    pub zoom: f32,
    /// The point of the image in the middle of the stage, image pixels.
    pub centre_px: Pos2,
    /// Whether the image is kept as large as the stage allows.
    pub fits: bool,
}

impl View {
    /// The whole image, as large as the stage allows; never magnified beyond its own pixels.
    #[must_use]
    pub fn fit(image_px: Vec2, stage_px: Vec2) -> Self {
        let ratio = stage_px / image_px.max(Vec2::splat(1.0));
        Self {
            zoom: ratio.min_elem().clamp(SMALLEST_ZOOM, 1.0),
            centre_px: (image_px / 2.0).to_pos2(),
            fits: true,
        }
    }

    /// One image pixel on one screen pixel, about the same middle.
    #[must_use]
    pub fn one_to_one(self) -> Self {
        Self {
            zoom: 1.0,
            fits: false,
            ..self
        }
    }

    /// Magnified by `factor`; the image point under `at_px` (from the stage's middle) stays.
    #[must_use]
    pub fn zoomed(self, factor: f32, at_px: Vec2) -> Self {
        let zoom = (self.zoom * factor).clamp(SMALLEST_ZOOM, LARGEST_ZOOM);
        Self {
            zoom,
            centre_px: self.centre_px + at_px / self.zoom - at_px / zoom,
            fits: false,
        }
    }

    /// Moved by so many screen pixels; some of the image stays in the middle.
    #[must_use]
    pub fn panned(self, by_px: Vec2, image_px: Vec2) -> Self {
        let moved = self.centre_px - by_px / self.zoom;
        Self {
            centre_px: moved.clamp(Pos2::ZERO, image_px.to_pos2()),
            fits: false,
            ..self
        }
    }

    /// Moved by under a pixel, so that the image's corner stands on a whole pixel of the screen.
    #[must_use]
    pub fn on_whole_pixels(self, stage_px: Rect) -> Self {
        let corner = stage_px.center() - self.centre_px.to_vec2() * self.zoom;
        Self {
            centre_px: self.centre_px + (corner - corner.round()) / self.zoom,
            ..self
        }
    }

    /// Where the image stands on a stage, in screen pixels; its corner on a whole one, so that
    /// at whole magnifications every image pixel covers whole screen pixels.
    #[must_use]
    pub fn place_px(self, image_px: Vec2, stage_px: Rect) -> Rect {
        let corner = stage_px.center() - self.centre_px.to_vec2() * self.zoom;
        Rect::from_min_size(
            pos2(corner.x.round(), corner.y.round()),
            image_px * self.zoom,
        )
    }

    /// Column and row of the image pixel under a point of the screen; `None` beside the image.
    #[must_use]
    pub fn pixel_at(self, at_px: Pos2, image_px: Vec2, stage_px: Rect) -> Option<(u32, u32)> {
        let place = self.place_px(image_px, stage_px);
        let within = (at_px - place.min) / self.zoom;
        let inside =
            within.x >= 0.0 && within.y >= 0.0 && within.x < image_px.x && within.y < image_px.y;
        inside.then_some((within.x as u32, within.y as u32))
    }
}

/// A vector of whole numbers as egui has them.
#[must_use]
pub fn size(width_px: u32, height_px: u32) -> Vec2 {
    vec2(width_px as f32, height_px as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const STAGE: Rect = Rect {
        min: Pos2::new(100.0, 50.0),
        max: Pos2::new(900.0, 650.0),
    };

    #[test]
    fn fitting_shows_all_of_it_and_magnifies_nothing() {
        let wide = View::fit(size(1600, 600), STAGE.size());
        assert!((wide.zoom - 0.5).abs() < 1e-6);
        assert!(STAGE.contains_rect(wide.place_px(size(1600, 600), STAGE)));
        assert!((View::fit(size(10, 10), STAGE.size()).zoom - 1.0).abs() < 1e-6);
    }

    #[test]
    fn one_to_one_stands_on_whole_pixels_and_finds_them() {
        let image = size(101, 77);
        let view = View::fit(image, STAGE.size()).one_to_one();
        let place = view.place_px(image, STAGE);
        assert_eq!((place.min.x.fract(), place.min.y.fract()), (0.0, 0.0));
        let at = place.min + vec2(7.5, 3.5);
        assert_eq!(view.pixel_at(at, image, STAGE), Some((7, 3)));
        assert_eq!(
            view.pixel_at(place.max + vec2(0.5, 0.0), image, STAGE),
            None
        );
    }

    proptest! {
        #[test]
        fn what_is_under_the_cursor_stays_there(
            x in -400.0_f32..400.0, y in -300.0_f32..300.0, factor in 0.3_f32..3.0,
        ) {
            let view = View { zoom: 2.0, centre_px: pos2(300.0, 200.0), fits: false };
            let at = vec2(x, y);
            let under = |view: View| view.centre_px + at / view.zoom;
            prop_assert!(under(view).distance(under(view.zoomed(factor, at))) < 1e-2);
        }
    }
}
