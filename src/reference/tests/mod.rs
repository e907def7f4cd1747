//! Exact cases, honesty of the error, and what the answer must not depend on.

mod exact;
mod independence;
mod inter_reflection;
mod real_files;
mod screen;
mod shapes;

use super::{Estimates, OcclusionSettings, RayTraced, SceneBvh, SurfacePoint, Weighting, estimate};
use crate::scene::Geometry;

/// Settings for exact cases: 1e-3 is at least four standard errors.
fn precise(weighting: Weighting) -> OcclusionSettings {
    OcclusionSettings {
        weighting,
        error: 2.5e-4,
        max_rays: 1 << 18,
        ..OcclusionSettings::new(7)
    }
}

/// Estimates at points of a geometry.
fn at_points(
    geometry: &Geometry,
    points: Vec<SurfacePoint>,
    settings: &OcclusionSettings,
) -> Estimates {
    let bvh = SceneBvh::new(geometry);
    let points = points.into_iter().map(Some).collect();
    estimate(&RayTraced::new(&bvh, points), settings, &|_| {}).unwrap()
}

fn assert_near(found: f32, exact: f64, tolerance: f64, what: &str) {
    assert!(
        (f64::from(found) - exact).abs() <= tolerance,
        "{what}: {found}, exactly {exact}"
    );
}
