//! The transport against what is exact.

use std::f32::consts::PI;

use glam::Vec3;

use super::march::Met;
use super::*;

mod groove;
mod sources;

const LINKS: LinkSettings = LinkSettings { rays: 256, seed: 1 };

fn field(size: usize, border: Border, height: impl Fn(f32, f32) -> f32) -> HeightField {
    let heights: Vec<f32> = (0..size * size)
        .map(|at| height((at % size) as f32, (at / size) as f32))
        .collect();
    HeightField::new((size, size), &heights, border).unwrap()
}

fn map(name: &str, size: usize, amplitude: f32) -> HeightField {
    let heights = (procedural::find(name).unwrap().heights)(size, 7);
    let heights: Vec<f32> = heights
        .iter()
        .map(|h| amplitude * size as f32 * h)
        .collect();
    HeightField::new((size, size), &heights, Border::Tiled).unwrap()
}

fn white(texels: usize) -> Vec<f32> {
    vec![1.0; texels]
}

#[test]
fn an_even_plane_sees_the_whole_sky() {
    let plane = field(40, Border::Tiled, |_, _| 3.0);
    let links = Links::cast(&plane, &LINKS, &|_| {});
    for texel in 0..plane.len() {
        let (openness, direct) = links.sky(texel);
        assert_eq!(openness, 1.0);
        // The heights of a net of 256 points average to a half within 1/512.
        assert!((direct / PI - 1.0).abs() < 1.0 / 256.0);
    }
    let bounces = Bounces::follow(&links, &white(plane.len()), &TransportSettings::default());
    assert_eq!(bounces.stopped, Stopped::Dark);
}

/// Down a step of one texel, along the ground, up to the top: what a ray from beside a wall
/// must meet.
#[test]
fn rays_meet_what_is_there() {
    // A wall of height 10 from column 20 on.
    let step = field(64, Border::Open, |x, _| if x >= 20.0 { 10.0 } else { 0.0 });
    let meets = |x: usize, direction: Vec3| step.meets((x, 32), direction.normalize());
    // The wall's face leans from (19, 0) to (20, 10): at height 5 it stands at 19.5.
    assert_eq!(
        meets(10, Vec3::new(9.5, 0.0, 4.9)),
        Met::Texel(32 * 64 + 19)
    );
    assert_eq!(
        meets(10, Vec3::new(9.5, 0.0, 5.5)),
        Met::Texel(32 * 64 + 20)
    );
    assert_eq!(meets(10, Vec3::new(10.0, 0.0, 10.1)), Met::Sky);
    assert_eq!(meets(10, Vec3::new(-1.0, 0.0, 0.01)), Met::Sky);
    assert_eq!(
        meets(20, Vec3::new(-1.0, 0.0, -0.001)),
        Met::Sky,
        "out over the edge"
    );
    assert_eq!(meets(10, Vec3::Z), Met::Sky);
}

/// A ray that runs along a row of a tiled field at nearly one height would meet nothing for ever, and
/// where floats are coarse would not even come on.
#[test]
fn a_ray_without_end_ends() {
    let mut heights = vec![0.0; 64 * 64];
    heights[10 * 64 + 10] = 50.0;
    heights[40 * 64 + 20] = 49.0;
    let spikes = HeightField::new((64, 64), &heights, Border::Tiled).unwrap();
    for rise in [0.0, 1e-9, 1e-7, 1e-5, 1e-3] {
        for across in [Vec3::X, -Vec3::X, Vec3::new(0.0, 1.0, 0.0)] {
            let found = spikes.meets((20, 40), (across + Vec3::Z * rise).normalize());
            assert_eq!(found, Met::Sky, "{across} {rise}");
        }
    }
    // Into the ground it goes, however gently.
    let down = Vec3::new(1.0, 0.0, -2e-2).normalize();
    assert_ne!(spikes.meets((20, 40), down), Met::Sky);
}

/// Passing over blocks at once must not pass over what is in them: the same rays by small steps.
#[test]
fn blocks_hide_nothing() {
    let hills = map("fbm", 48, 0.4);
    let mut hit = 0;
    for ray in 0..2000_u32 {
        let turn = ray as f32 * 2.399_963;
        let direction = Vec3::new(turn.cos(), turn.sin(), 0.02 + (ray % 50) as f32 / 40.0);
        let direction = direction.normalize();
        let (x, y) = ((ray as usize * 7) % 48, (ray as usize * 13) % 48);
        let by_steps = stepped(&hills, (x, y), direction);
        let found = hills.meets((x, y), direction);
        // Where a ray only grazes, the two may part.
        if let Some(clearance) = by_steps.1
            && clearance.abs() < 0.02
        {
            continue;
        }
        assert_eq!(found != Met::Sky, by_steps.0, "{ray}: {found:?}");
        hit += usize::from(by_steps.0);
    }
    assert!((200..1900).contains(&hit), "{hit}");
}

/// Whether a ray is blocked, and how near to the field it came, by steps of a twentieth of a texel.
fn stepped(field: &HeightField, (x, y): (usize, usize), direction: Vec3) -> (bool, Option<f32>) {
    let size = field.width() as i64;
    let at = |x: i64, y: i64| field.at(x.rem_euclid(size) as usize, y.rem_euclid(size) as usize);
    let mut nearest = f32::INFINITY;
    let mut t = 0.05_f32;
    loop {
        let p = Vec3::new(x as f32, y as f32, field.at(x, y)) + direction * t;
        if p.z > field.highest() {
            return (false, Some(nearest));
        }
        let (cx, cy) = (p.x.floor(), p.y.floor());
        let (u, v) = (p.x - cx, p.y - cy);
        let (cx, cy) = (cx as i64, cy as i64);
        let (a, b, c, d) = (
            at(cx, cy),
            at(cx + 1, cy),
            at(cx, cy + 1),
            at(cx + 1, cy + 1),
        );
        let height = if u + v <= 1.0 {
            a + (b - a) * u + (c - a) * v
        } else {
            d + (c - d) * (1.0 - u) + (b - d) * (1.0 - v)
        };
        let above = p.z - height;
        if above < -0.02 {
            return (true, Some(above.min(nearest)));
        }
        // It starts on the field itself.
        if t > 0.5 {
            nearest = nearest.min(above.abs());
        }
        t += 0.05;
    }
}

/// At ρ = 1 nothing is lost: light that does not come from the sky comes from a texel that has all
/// of it. In every texel the bounces sum to π, to the sampling error of its own rays.
#[test]
fn no_light_is_lost_at_full_albedo() {
    for name in ["bricks", "fbm", "pebbles"] {
        let field = map(name, 64, 0.2);
        let links = Links::cast(&field, &LINKS, &|_| {});
        let settings = TransportSettings {
            bounces: 400,
            least: 1e-4,
        };
        let bounces = Bounces::follow(&links, &white(field.len()), &settings);
        assert_eq!(bounces.stopped, Stopped::Unseen, "{name}");
        for texel in 0..field.len() {
            let sum = bounces.sum(texel) / PI;
            assert!((sum - 1.0).abs() < 0.01, "{name}, texel {texel}: {sum}");
        }
    }
}

/// A hemispherical bowl is half an integrating sphere: E_i = π ½ (ρ/2)^i in every point.
#[test]
fn a_bowl_is_an_integrating_sphere() {
    const RADIUS: f32 = 100.0;
    let bowl = field(2 * RADIUS as usize + 21, Border::Open, |x, y| {
        let (x, y) = (x - RADIUS - 10.0, y - RADIUS - 10.0);
        -(RADIUS * RADIUS - x * x - y * y).max(0.0).sqrt()
    });
    let rho = 0.8;
    // A texel is a hundredth of the radius, and the rim's texels are the worst: the share of light
    // that is lost or found there is of that size, and counts again at every bounce.
    let links = Links::cast(&bowl, &LINKS, &|_| {});
    let bounces = Bounces::follow(
        &links,
        &vec![rho; bowl.len()],
        &TransportSettings {
            bounces: 4,
            least: 0.0,
        },
    );
    let size = bowl.width();
    for bounce in 0..4 {
        let expected = PI * 0.5 * (0.5 * rho).powi(bounce as i32);
        let (mut sum, mut count) = (0.0, 0);
        for texel in 0..bowl.len() {
            let (x, y) = ((texel % size) as f32, (texel / size) as f32);
            let apart = (x - RADIUS - 10.0).hypot(y - RADIUS - 10.0);
            // Near the rim a texel covers much of the bowl's height.
            if apart < 0.8 * RADIUS {
                let found = bounces.irradiance[bounce][texel];
                assert!(
                    (found / expected - 1.0).abs() < 0.15,
                    "{bounce} at {apart}: {found}"
                );
                sum += found / expected;
                count += 1;
            }
        }
        let mean = sum / count as f32;
        assert!((mean - 1.0).abs() < 0.02, "bounce {bounce}: {mean}");
    }
}

/// Kept or cast again, links are the same.
#[test]
fn what_is_not_kept_is_found_again() {
    let field = map("pebbles", 32, 0.2);
    let albedo: Vec<f32> = (0..field.len())
        .map(|texel| (texel % 7) as f32 / 7.0)
        .collect();
    let settings = TransportSettings::default();
    let kept = Bounces::follow(&Links::cast(&field, &LINKS, &|_| {}), &albedo, &settings);
    let again = Bounces::follow(&Links::recast(&field, &LINKS), &albedo, &settings);
    assert_eq!(kept.irradiance, again.irradiance);
    assert_eq!(kept.openness, again.openness);
}

#[test]
fn heights_that_are_none_are_refused() {
    let new = |size, heights: &[f32]| HeightField::new(size, heights, Border::Tiled);
    assert!(matches!(
        new((1, 1), &[0.0]),
        Err(HeightFieldError::Size { .. })
    ));
    assert!(matches!(
        new((2, 2), &[0.0; 3]),
        Err(HeightFieldError::Count { .. })
    ));
    let nan = [0.0, 0.0, 0.0, f32::NAN];
    assert!(matches!(
        new((2, 2), &nan),
        Err(HeightFieldError::NotFinite { x: 1, y: 1, .. })
    ));
}

#[test]
fn every_map_fills_its_range_and_is_the_same_every_time() {
    for map in procedural::MAPS {
        let heights = (map.heights)(64, 3);
        let (low, high) = heights.iter().fold((1.0_f32, 0.0_f32), |(low, high), &h| {
            (low.min(h), high.max(h))
        });
        assert_eq!(
            (heights.len(), low, high),
            (64 * 64, 0.0, 1.0),
            "{}",
            map.name
        );
        assert_eq!(heights, (map.heights)(64, 3));
    }
}

/// What is open to a texel bends away from what closes it: not at all in the open, by 45° at the foot of an
/// endless wall (32.5° by the cosine), and not at all in the middle of a pit, whose aperture it has.
#[test]
fn openings_bend_away_from_what_closes_them() {
    use crate::reference::Weighting::{Cosine, Uniform};
    let fine = LinkSettings {
        rays: 4096,
        seed: 3,
    };
    let opening = |field: &HeightField, texel: usize, weighting| {
        let links = Links::recast(field, &fine);
        let opening = links.opening(field, texel, weighting);
        (opening.share, opening.cone(weighting).unwrap())
    };
    let middle = 32 * 65 + 32;
    let plane = field(65, Border::Tiled, |_, _| 0.0);
    let wall = field(65, Border::Open, |x, _| if x >= 34.0 { 1e5 } else { 0.0 });
    // The pit's wall leans over one texel: its rim is 20 to 21 texels away.
    let pit = field(65, Border::Open, |x, y| {
        if (x - 32.0).hypot(y - 32.0) >= 20.5 {
            20.5
        } else {
            0.0
        }
    });
    for (weighting, tangent) in [(Uniform, 1.0_f32), (Cosine, 2.0 / PI)] {
        let (share, cone) = opening(&plane, middle, weighting);
        assert!(share > 0.995 && cone.direction.z > 0.9999, "{cone:?}");
        assert!(cone.cos_half_angle < 0.05, "{cone:?}");
        let (share, cone) = opening(&wall, middle, weighting);
        assert!((share - 0.5).abs() < 0.02, "{share}");
        let leans = (-cone.direction.x).atan2(cone.direction.z);
        assert!((leans - tangent.atan()).abs() < 0.03, "{leans}");
        let (_, cone) = opening(&pit, middle, weighting);
        assert!(cone.direction.z > 0.999, "{cone:?}");
        assert!((cone.half_angle_rad() - PI / 4.0).abs() < 0.03, "{cone:?}");
    }
}
