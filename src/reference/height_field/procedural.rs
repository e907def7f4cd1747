//! Height maps that need no file: each one function of a seed, and one line in [`MAPS`].

use glam::Vec2;
use rand_chacha::rand_core::Rng;

use crate::seed::{self, unit_f32};

/// A height map that is made.
#[derive(Debug)]
pub struct Map {
    /// Name on the command line.
    pub name: &'static str,
    /// What it shows, one line.
    pub summary: &'static str,
    /// Heights of 0 to 1 of `size` × `size` texels, rows from the top; it tiles.
    pub heights: fn(size: usize, seed: u64) -> Vec<f32>,
}

/// Every map there is.
pub const MAPS: &[Map] = &[
    Map {
        name: "bricks",
        summary: "a weathered wall in running bond",
        heights: bricks,
    },
    Map {
        name: "pebbles",
        summary: "round stones of many sizes, close together",
        heights: pebbles,
    },
    Map {
        name: "concrete",
        summary: "rough ground with hollows where bubbles were",
        heights: concrete,
    },
    Map {
        name: "fbm",
        summary: "hills: noise of six octaves",
        heights: |size, seed| normalised(octaves(size, seed, 4, 6, 0.5)),
    },
    Map {
        name: "crevices",
        summary: "rough plates with gaps between",
        heights: crevices,
    },
    Map {
        name: "bowls",
        summary: "hemispherical bowls side by side: integrating spheres, nearly",
        heights: bowls,
    },
    Map {
        name: "shapes",
        summary: "a cube, a pyramid, a cone and a dome on a plane",
        heights: shapes,
    },
];

/// The map of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Map> {
    MAPS.iter().find(|map| map.name == name)
}

/// A value at every texel; `place` runs from 0 to 1 both ways.
fn everywhere(size: usize, value: impl Fn(Vec2) -> f32) -> Vec<f32> {
    let at = |index: usize| (index as f32 + 0.5) / size as f32;
    (0..size * size)
        .map(|texel| value(Vec2::new(at(texel % size), at(texel / size))))
        .collect()
}

/// Brought to 0 to 1; all 0 where there is but one height.
pub(super) fn normalised(mut heights: Vec<f32>) -> Vec<f32> {
    let low = heights.iter().copied().fold(f32::INFINITY, f32::min);
    let high = heights.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let range = if high > low { high - low } else { 1.0 };
    for height in &mut heights {
        *height = (*height - low) / range;
    }
    heights
}

/// 0 below `low`, 1 above `high`, smooth in between.
fn smooth(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A number from 0 to 1 that belongs to a cell.
fn of_cell(seed: u64, x: i64, y: i64) -> f32 {
    let key = (x as u64).wrapping_mul(0x9e37_79b9).wrapping_add(y as u64);
    unit_f32(&mut seed::generator(seed, "height-map-cell", key))
}

/// Value noise that tiles: `cells` a side.
fn noise(place: Vec2, lattice: &[f32], cells: usize) -> f32 {
    let at = place * cells as f32;
    let cell = at.floor();
    let part = at - cell;
    let eased = part * part * (Vec2::splat(3.0) - 2.0 * part);
    let of = |dx: i64, dy: i64| {
        let wrap = |c: f32, d: i64| (c as i64 + d).rem_euclid(cells as i64) as usize;
        lattice[wrap(cell.y, dy) * cells + wrap(cell.x, dx)]
    };
    let top = of(0, 0) + (of(1, 0) - of(0, 0)) * eased.x;
    let bottom = of(0, 1) + (of(1, 1) - of(0, 1)) * eased.x;
    top + (bottom - top) * eased.y
}

/// Noise of several octaves, the first of `cells` a side, each `gain` of the one before.
fn octaves(size: usize, seed: u64, cells: usize, octaves: usize, gain: f32) -> Vec<f32> {
    let mut sum = vec![0.0; size * size];
    for octave in 0..octaves {
        let cells = cells << octave;
        let mut rng = seed::generator(seed, "height-map-noise", octave as u64);
        let lattice: Vec<f32> = (0..cells * cells).map(|_| unit_f32(&mut rng)).collect();
        let weight = gain.powi(octave as i32);
        let layer = everywhere(size, |place| weight * noise(place, &lattice, cells));
        for (sum, layer) in sum.iter_mut().zip(layer) {
            *sum += layer;
        }
    }
    sum
}

/// A value at every texel, read a little beside: edges that a ruler has drawn become edges that
/// weather has.
fn warped(size: usize, seed: u64, amount: f32, value: impl Fn(Vec2) -> f32) -> Vec<f32> {
    let shift = |way: u64| octaves(size, seed ^ (0x57a4 + way), 6, 5, 0.6);
    let (across, down) = (shift(0), shift(1));
    let at = |index: usize| (index as f32 + 0.5) / size as f32;
    (0..size * size)
        .map(|texel| {
            let place = Vec2::new(at(texel % size), at(texel / size));
            let shift = Vec2::new(across[texel], down[texel]) - 1.15;
            let place = place + amount * shift;
            value(place - place.floor())
        })
        .collect()
}

/// Heights with some roughness on top, brought to 0 to 1.
fn roughened(mut heights: Vec<f32>, amount: f32, rough: &[f32]) -> Vec<f32> {
    for (height, rough) in heights.iter_mut().zip(rough) {
        *height += amount * rough;
    }
    normalised(heights)
}

fn bricks(size: usize, seed: u64) -> Vec<f32> {
    const COLUMNS: f32 = 4.0;
    const COURSES: f32 = 8.0;
    let walls = warped(size, seed, 0.012, |place| {
        let course = (place.y * COURSES).floor();
        let shift = if course as i64 % 2 == 0 { 0.0 } else { 0.5 };
        let along = place.x * COLUMNS + shift;
        let brick = (along.floor() as i64).rem_euclid(COLUMNS as i64);
        let within = Vec2::new(along.fract(), (place.y * COURSES).fract());
        // Distance to the edge, in heights of a course; a brick is twice as long as high.
        let edge = Vec2::new(
            2.0 * (0.5 - (within.x - 0.5).abs()),
            0.5 - (within.y - 0.5).abs(),
        );
        let rise = smooth(0.02, 0.30, edge.min_element());
        rise * (0.6 + 0.4 * of_cell(seed, brick, course as i64))
    });
    roughened(walls, 0.45, &octaves(size, seed, 12, 6, 0.6))
}

fn pebbles(size: usize, seed: u64) -> Vec<f32> {
    let mut rng = seed::generator(seed, "height-map-pebbles", 0);
    let stones: Vec<(Vec2, f32, f32)> = (0..260)
        .map(|stone| {
            let centre = Vec2::new(unit_f32(&mut rng), unit_f32(&mut rng));
            // Large ones first, small ones in what they leave.
            let radius =
                0.09 * (1.0 - 0.75 * (stone as f32 / 260.0)) * (0.8 + 0.4 * unit_f32(&mut rng));
            (centre, radius, 0.7 + 0.6 * unit_f32(&mut rng))
        })
        .collect();
    normalised(everywhere(size, |place| {
        stones
            .iter()
            .fold(0.0_f32, |height, (centre, radius, flat)| {
                let apart = (place - centre + 0.5).fract_gl() - 0.5;
                let inside = 1.0 - apart.length_squared() / (radius * radius);
                height.max(if inside > 0.0 {
                    flat * radius * inside.sqrt()
                } else {
                    0.0
                })
            })
    }))
}

fn concrete(size: usize, seed: u64) -> Vec<f32> {
    let mut rng = seed::generator(seed, "height-map-holes", 0);
    let holes: Vec<(Vec2, f32)> = (0..160)
        .map(|_| {
            let centre = Vec2::new(unit_f32(&mut rng), unit_f32(&mut rng));
            (centre, 0.006 + 0.05 * unit_f32(&mut rng).powi(3))
        })
        .collect();
    // Where a bubble of air has burst: a round hollow, deep as it is wide.
    let ground = warped(size, seed, 0.004, |place| {
        let depth = holes.iter().fold(0.0_f32, |depth, (centre, radius)| {
            let apart = (place - centre + 0.5).fract_gl() - 0.5;
            let inside = radius * radius - apart.length_squared();
            depth.max(inside.max(0.0).sqrt())
        });
        -12.0 * depth
    });
    roughened(ground, 0.5, &octaves(size, seed, 8, 7, 0.65))
}

fn crevices(size: usize, seed: u64) -> Vec<f32> {
    let mut rng = seed::generator(seed, "height-map-plates", 0);
    let plates: Vec<(Vec2, f32)> = (0..40)
        .map(|_| {
            let centre = Vec2::new(unit_f32(&mut rng), unit_f32(&mut rng));
            (centre, unit_f32(&mut rng))
        })
        .collect();
    let heights = warped(size, seed, 0.02, |place| {
        let mut nearest = [(f32::INFINITY, 0.0); 2];
        for (centre, level) in &plates {
            let apart = ((place - centre + 0.5).fract_gl() - 0.5).length();
            if apart < nearest[0].0 {
                nearest = [(apart, *level), nearest[0]];
            } else if apart < nearest[1].0 {
                nearest[1] = (apart, *level);
            }
        }
        let gap = nearest[1].0 - nearest[0].0;
        smooth(0.004, 0.03, gap) * (0.75 + 0.25 * nearest[0].1)
    });
    roughened(heights, 0.22, &octaves(size, rng.next_u64(), 12, 6, 0.6))
}

fn bowls(size: usize, _: u64) -> Vec<f32> {
    const SIDE: f32 = 4.0;
    const RADIUS: f32 = 0.45;
    normalised(everywhere(size, |place| {
        let within = (place * SIDE).fract() - 0.5;
        let inside = RADIUS * RADIUS - within.length_squared();
        -inside.max(0.0).sqrt()
    }))
}

fn shapes(size: usize, _: u64) -> Vec<f32> {
    normalised(everywhere(size, |place| {
        let at = |x: f32, y: f32| place - Vec2::new(x, y);
        let cube: f32 = if at(0.25, 0.25).abs().max_element() < 0.12 {
            0.24
        } else {
            0.0
        };
        let pyramid = 0.24 * (1.0 - at(0.75, 0.25).abs().max_element() / 0.15).max(0.0);
        let cone = 0.24 * (1.0 - at(0.25, 0.75).length() / 0.15).max(0.0);
        let dome = (0.15_f32.powi(2) - at(0.75, 0.75).length_squared())
            .max(0.0)
            .sqrt();
        cube.max(pyramid).max(cone).max(dome)
    }))
}
