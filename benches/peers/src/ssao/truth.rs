//! The ray-traced truth at the points that both renderers show, and the distance from it.

use greyfield::reference::{
    Estimates, OcclusionSettings, RayTraced, SceneBvh, Surroundings, estimate,
};
use greyfield::scene::{Geometry, VisibleSurfaces};
use indicatif::ProgressBar;

use crate::Failure;
use crate::scene::RADIUS_M;

/// Occlusion by rays, by the cosine to the normal, of what lies within the radius.
pub struct Truth {
    /// For people.
    pub name: &'static str,
    /// What it is, in a word for a table.
    pub key: &'static str,
    pub found: Estimates,
}

/// Both: whatever is met within the radius hides all, or the less the farther it is.
pub fn both(
    geometry: &Geometry,
    surfaces: &VisibleSurfaces,
    error: f64,
    progress: &ProgressBar,
) -> Result<[Truth; 2], Failure> {
    let bvh = SceneBvh::new(geometry);
    let points = RayTraced::of_visible(&bvh, surfaces);
    let settings = OcclusionSettings {
        error,
        ..OcclusionSettings::new(1)
    };
    let tell = |pixels: u64| progress.inc(pixels);
    progress.set_message("rays, hard reach");
    let hard = estimate(&WithinReach(&points), &settings, &tell)?;
    progress.set_message("rays, linear obscurance");
    let linear = OcclusionSettings {
        d_max_m: Some(RADIUS_M),
        ..settings
    };
    let linear = estimate(&points, &linear, &tell)?;
    let truth = |name, key, found| Truth { name, key, found };
    Ok([
        truth("hard reach: met within the radius hides all", "hard", hard),
        truth("obscurance: met at t hides 1 - t/radius", "linear", linear),
    ])
}

/// Surroundings of which nothing counts that is farther than the radius.
struct WithinReach<'a>(&'a RayTraced<'a>);

impl<'a> Surroundings for WithinReach<'a> {
    type Start = <RayTraced<'a> as Surroundings>::Start;

    fn len(&self) -> usize {
        self.0.len()
    }

    fn start(&self, point: usize) -> Option<(Self::Start, glam::Vec3)> {
        self.0.start(point)
    }

    fn is_blocked(&self, start: &Self::Start, direction: glam::Vec3, reach_m: f32) -> bool {
        (self.0).is_blocked(start, direction, reach_m.min(RADIUS_M))
    }

    fn nearest_m(&self, start: &Self::Start, direction: glam::Vec3, reach_m: f32) -> Option<f32> {
        (self.0).nearest_m(start, direction, reach_m.min(RADIUS_M))
    }
}

/// How far an image is from the truth.
#[derive(Debug, Clone, Copy)]
pub struct Distance {
    pub rmse: f64,
    pub mae: f64,
    /// Mean of image less truth: above 0 is too bright.
    pub bias: f64,
}

impl Distance {
    /// Over the pixels that count. The truth's own error is not taken off.
    pub fn new(image: &[f32], truth: &[f32], counts: &[bool]) -> Self {
        let differences: Vec<f64> = image
            .iter()
            .zip(truth)
            .zip(counts)
            .filter(|&(_, &counts)| counts)
            .map(|((&image, &truth), _)| f64::from(image) - f64::from(truth))
            .collect();
        let mean = |of: fn(f64) -> f64| {
            let sum: f64 = differences.iter().map(|&difference| of(difference)).sum();
            sum / (differences.len() as f64).max(1.0)
        };
        Self {
            rmse: mean(|difference| difference * difference).sqrt(),
            mae: mean(f64::abs),
            bias: mean(|difference| difference),
        }
    }
}
