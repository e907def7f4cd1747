//! Whether both renderers show the same points: to compare others would be worthless.

use greyfield::scene::VisibleSurfaces;

use crate::Failure;
use crate::read::Drawn;

/// Share of the depth by which the depths of one point may differ. Greyfield puts corners on a
/// grid of 1/16 pixel, Bevy does not.
const DEPTH_WITHIN: f32 = 0.005;

/// Angle by which the normals of one point may differ, degrees: Bevy has 10 bits a component, and on
/// bevels of a few pixels the grid of corners shows.
const NORMAL_WITHIN_DEG: f32 = 2.0;

/// Share of pixels that must agree in depth.
const ENOUGH: f64 = 0.99;

/// Where two drawings agree.
pub struct Agreement {
    /// Pixels with a surface in both drawings at the same depth: those that errors are of.
    pub counts: Vec<bool>,
    /// Share of pixels that agree in depth, those without a surface in both among them.
    pub depth: f64,
    /// Share of the pixels that count whose normals agree.
    pub normal: f64,
}

impl Agreement {
    pub fn new(ours: &VisibleSurfaces, theirs: &Drawn) -> Self {
        let mut agreeing = 0;
        let mut normals = 0;
        let mut counts = vec![false; ours.len()];
        for (pixel, counts) in counts.iter_mut().enumerate() {
            let (our_m, their_m) = (ours.depth_m[pixel], theirs.depth_m[pixel]);
            if !ours.has_surface(pixel) {
                agreeing += usize::from(their_m >= ours.camera.far_m);
                continue;
            }
            *counts = (our_m - their_m).abs() <= DEPTH_WITHIN * our_m;
            agreeing += usize::from(*counts);
            // The chord of two unit vectors, which is exact where their product is not.
            let chord = ours.normals[pixel].distance(theirs.normals[pixel]);
            let is_near = 2.0 * (0.5 * chord).min(1.0).asin() <= NORMAL_WITHIN_DEG.to_radians();
            normals += usize::from(*counts && is_near);
        }
        let counted = counts.iter().filter(|&&counts| counts).count();
        Self {
            counts,
            depth: agreeing as f64 / (ours.len() as f64).max(1.0),
            normal: normals as f64 / (counted as f64).max(1.0),
        }
    }

    /// Refuses drawings of different points.
    pub fn check(&self) -> Result<(), Failure> {
        if self.depth >= ENOUGH {
            return Ok(());
        }
        Err(format!(
            "only {:.2} % of pixels have the same depth in both renderers within {} %: they do not draw the same points",
            100.0 * self.depth,
            100.0 * DEPTH_WITHIN,
        )
        .into())
    }

    /// One line for people.
    pub fn line(&self) -> String {
        let counted = self.counts.iter().filter(|&&counts| counts).count();
        format!(
            "same points: depth within {} % at {:.3} % of pixels, normal within {NORMAL_WITHIN_DEG} degrees at {:.3} %; errors are over {counted} pixels",
            100.0 * DEPTH_WITHIN,
            100.0 * self.depth,
            100.0 * self.normal,
        )
    }
}
