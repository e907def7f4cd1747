//! From radiance to levels: exposure and the tone curves, at values worked out by hand.

use glam::Vec3;

use super::*;
use crate::scene::ToneMap;

/// The level of a background of `radiance`.
fn level(radiance: f32, exposure_ev: f32, tone_map: ToneMap) -> [u8; 3] {
    let mut request = request("none");
    request.lighting.background = Background::Colour(Vec3::splat(radiance));
    request.lighting.exposure_ev = exposure_ev;
    request.lighting.tone_map = tone_map;
    rgb(&draw(&Geometry::default(), &request), (80, 60))
}

#[test]
fn a_stop_is_a_factor_of_two() {
    assert_level(level(0.2, 1.0, ToneMap::None), 0.4);
    assert_level(level(0.2, -2.0, ToneMap::None), 0.05);
    assert_level(level(3.0, 0.0, ToneMap::None), 1.0);
}

/// Reinhard et al. 2002, eq. 4: L (1 + L/w²)/(1 + L). White becomes 1 whatever it is, and 1 becomes half
/// of 1 + 1/w².
#[test]
fn reinhards_curve_has_its_fixed_points() {
    let curve = |white| ToneMap::ReinhardExtended { white };
    for white in [1.5, 4.0, 16.0] {
        assert_level(level(white, 0.0, curve(white)), 1.0);
        assert_level(
            level(1.0, 0.0, curve(white)),
            0.5 * (1.0 + 1.0 / (white * white)),
        );
    }
    assert_level(level(0.5, 3.0, curve(4.0)), 1.0);
}

/// Narkowicz 2016: x (2.51 x + 0.03)/(x (2.43 x + 0.59) + 0.14), so 1 becomes 2.54/3.16; it reaches 1
/// a little above 7, and stays there.
#[test]
fn the_aces_curve_has_its_shoulder() {
    assert_level(level(1.0, 0.0, ToneMap::Aces), 2.54 / 3.16);
    assert_level(level(0.1, 0.0, ToneMap::Aces), 0.0281 / 0.2233);
    assert_level(level(40.0, 0.0, ToneMap::Aces), 1.0);
    assert_level(level(0.0, 0.0, ToneMap::Aces), 0.0);
}
