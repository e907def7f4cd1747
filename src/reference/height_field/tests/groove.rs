//! V-grooves side by side: what a wall sees is known exactly, and so is how fast rays come to it.

use std::f64::consts::{FRAC_PI_2, PI};

use super::*;

/// Texels from ridge to ridge.
const PERIOD: usize = 64;
/// Height over length of a wall.
const SLOPE: f32 = 1.5;

/// Grooves along the rows, as many rows as it takes.
fn grooves() -> HeightField {
    let half = PERIOD as f32 / 2.0;
    field(PERIOD, Border::Tiled, |x, _| SLOPE * (x - half).abs())
}

/// A wall point of the left wall at a column, in the groove's cross-section: place, and unit normal.
fn wall(column: f64) -> ([f64; 2], [f64; 2]) {
    let (half, slope) = (PERIOD as f64 / 2.0, f64::from(SLOPE));
    let length = slope.hypot(1.0);
    (
        [column, slope * (half - column)],
        [slope / length, 1.0 / length],
    )
}

/// The angle from a left wall point's normal down to the opposite ridge; towards its own ridge
/// the sky begins along the wall itself.
fn angle_to_ridge(column: f64) -> f64 {
    let (at, normal) = wall(column);
    let ridge = [PERIOD as f64, f64::from(SLOPE) * PERIOD as f64 / 2.0];
    let to = [ridge[0] - at[0], ridge[1] - at[1]];
    // Turned clockwise from the normal: below it.
    let (across, along) = (
        normal[1] * to[0] - normal[0] * to[1],
        normal[0] * to[0] + normal[1] * to[1],
    );
    across.atan2(along)
}

/// Left wall columns, away from the ridge and the bottom, where normals are of neither wall.
fn columns() -> impl Iterator<Item = usize> {
    2..PERIOD / 2 - 1
}

/// Between two half-planes through a line: α is their angle over π, and k_A = (sin β₁ + sin β₂)/2.
fn exact(column: usize) -> (f64, f64) {
    let below = angle_to_ridge(column as f64);
    ((FRAC_PI_2 + below) / PI, 0.5 * (1.0 + below.sin()))
}

/// Root of the mean squared error of α and of k_A on the left walls.
fn errors(rays: usize) -> (f64, f64) {
    let field = grooves();
    let links = Links::cast(&field, &LinkSettings { rays, seed: 5 }, &|_| {});
    let (mut alpha, mut direct, mut count) = (0.0, 0.0, 0.0);
    for row in 0..PERIOD {
        for column in columns() {
            let (found, irradiance) = links.sky(row * PERIOD + column);
            let (openness, share) = exact(column);
            alpha += (f64::from(found) - openness).powi(2);
            direct += (f64::from(irradiance) / PI - share).powi(2);
            count += 1.0;
        }
    }
    ((alpha / count).sqrt(), (direct / count).sqrt())
}

/// The error of a sum over well-spread points falls faster than 1/√N: 16 times the rays leave less than
/// a quarter of it.
#[test]
fn a_groove_is_exact_and_rays_converge_to_it() {
    let few = errors(64);
    let many = errors(1024);
    assert!(many.0 < 4e-3 && many.1 < 3e-3, "{many:?}");
    assert!(
        many.0 < few.0 / 4.0 && many.1 < few.1 / 4.0,
        "{few:?} {many:?}"
    );
}

/// The first bounce against the exact kernel of two walls, cosθ cosθ′ / (2r) in the cross-section,
/// by quadrature.
#[test]
fn the_first_bounce_of_a_groove_is_that_of_its_walls() {
    let field = grooves();
    let links = Links::cast(
        &field,
        &LinkSettings {
            rays: 1024,
            seed: 5,
        },
        &|_| {},
    );
    let settings = TransportSettings {
        bounces: 1,
        least: 0.0,
    };
    let bounces = Bounces::follow(&links, &white(field.len()), &settings);
    for column in [6, 12, 18, 24] {
        let ([x, z], normal) = wall(column as f64);
        let steps = 4000;
        let half = PERIOD as f64 / 2.0;
        let mut expected = 0.0;
        for step in 0..steps {
            // A point of the right wall is the mirror of one of the left.
            let mirrored = half * (f64::from(step) + 0.5) / f64::from(steps);
            let ([left, height], facing) = wall(mirrored);
            let to = [PERIOD as f64 - left - x, height - z];
            let r = to[0].hypot(to[1]);
            let here = (normal[0] * to[0] + normal[1] * to[1]) / r;
            let there = -(-facing[0] * to[0] + facing[1] * to[1]) / r;
            let below = angle_to_ridge(mirrored);
            let length = half / f64::from(steps) * f64::from(SLOPE).hypot(1.0);
            expected += 0.5 * (1.0 + below.sin()) * here * there / (2.0 * r) * length;
        }
        let rows = (0..PERIOD).map(|row| bounces.irradiance[1][row * PERIOD + column]);
        let found = rows.map(f64::from).sum::<f64>() / PERIOD as f64 / PI;
        // What a link meets is a whole texel, a sixteenth of the light's fall along a wall at most.
        assert!(
            (found / expected - 1.0).abs() < 0.02,
            "{column}: {found} {expected}"
        );
    }
}
