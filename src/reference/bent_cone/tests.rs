//! Cones against integrals over the sphere, and the limits that any opening has to meet.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;

use super::*;
use crate::scene::modelling::math;

/// Directions spread evenly over the sphere, each for 4π over their number.
fn everywhere(count: u32) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |i| {
        let z = 1.0 - 2.0 * (i as f32 + 0.5) / count as f32;
        let radius = (1.0 - z * z).sqrt();
        let (sin, cos) = (2.399_963_2 * i as f32 % TAU).sin_cos();
        Vec3::new(radius * cos, radius * sin, z)
    })
}

const COUNT: u32 = 40_000;

/// What is open of a hemisphere, by its definition, and the radiance that comes in: ∫ L cos over it.
fn integrated(
    normal: Vec3,
    weighting: Weighting,
    light: &Irradiance,
    is_open: impl Fn(Vec3) -> bool,
) -> (Opening, Vec3) {
    let (mut opening, mut irradiance, mut whole) = (Opening::CLOSED, Vec3::ZERO, 0.0);
    for direction in everywhere(COUNT).filter(|d| d.dot(normal) > 0.0) {
        let cosine = direction.dot(normal);
        let part = match weighting {
            Weighting::Cosine => cosine,
            Weighting::Uniform => 1.0,
        };
        whole += part;
        if is_open(direction) {
            opening = opening.with(direction, part);
            irradiance += light.radiance(direction) * (cosine * 4.0 * PI / COUNT as f32);
        }
    }
    (opening.scaled(1.0 / whole), irradiance)
}

fn unit([z, turn]: [f32; 2]) -> Vec3 {
    let (sin, cos) = (turn * TAU).sin_cos();
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(radius * cos, z, radius * sin)
}

/// A light that no normal receives less than nothing of: what the renderer is given.
fn light_of(values: [f32; 9]) -> Irradiance {
    let mut coefficients = values.map(|value| Vec3::new(value, 0.5 * value, -value));
    coefficients[0] = Vec3::splat(2.0 * values[0].abs() + 3.0);
    Irradiance { coefficients }.without_ringing()
}

fn any_light() -> impl Strategy<Value = Irradiance> {
    proptest::array::uniform9(-2.0_f32..2.0).prop_map(light_of)
}

fn any_direction() -> impl Strategy<Value = Vec3> {
    [-1.0_f32..1.0, 0.0_f32..1.0].prop_map(unit)
}

fn dark() -> Irradiance {
    Irradiance {
        coefficients: [Vec3::ZERO; 9],
    }
}

#[test]
fn a_mean_and_its_cone_are_each_others_inverse() {
    for weighting in [Weighting::Cosine, Weighting::Uniform] {
        for step in 0..=50 {
            let cone = BentCone {
                direction: Vec3::Z,
                cos_half_angle: step as f32 / 50.0,
            };
            let opening = Opening {
                share: 0.3,
                moment: cone.direction * 0.3 * cone.mean_length(weighting),
            };
            let found = opening.cone(weighting).unwrap();
            // Near a hemisphere the angle hangs on the length's root.
            assert!((found.cos_half_angle - cone.cos_half_angle).abs() < 2e-3);
        }
        assert!(Opening::CLOSED.cone(weighting).is_none());
    }
}

/// Half of a hemisphere: the mean of all directions alike is (½, ½), so 45° from the normal; by
/// the cosine it is (4/3π, 2/3), 32.5°.
#[test]
fn half_a_hemisphere_leans_by_its_known_angle() {
    for (weighting, tangent) in [(Weighting::Uniform, 1.0), (Weighting::Cosine, 2.0 / PI)] {
        let (opening, _) = integrated(Vec3::Z, weighting, &dark(), |d| d.x > 0.0);
        let cone = opening.cone(weighting).unwrap();
        assert!((opening.share - 0.5).abs() < 1e-3);
        assert!(cone.direction.y.abs() < 1e-3);
        let found = cone.direction.x.atan2(cone.direction.z);
        assert!((found - f32::atan(tangent)).abs() < 2e-3, "{found}");
    }
}

/// A pit's opening is its own cone, whatever directions count by.
#[test]
fn a_pit_has_its_own_aperture() {
    for half_angle in [0.2_f32, 0.7, 1.2, 1.5] {
        for weighting in [Weighting::Uniform, Weighting::Cosine] {
            let cos = half_angle.cos();
            let (opening, _) = integrated(Vec3::Y, weighting, &dark(), |d| d.y > cos);
            let cone = opening.cone(weighting).unwrap();
            assert!(cone.direction.dot(Vec3::Y) > 0.9999);
            assert!(
                (cone.half_angle_rad() - half_angle).abs() < 0.01,
                "{half_angle}: {}",
                cone.half_angle_rad()
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn whatever_is_open_gives_a_number_that_is_not_negative(
        light in any_light(), share in 0.0_f32..=1.0, length in 0.0_f32..=1.2, towards in any_direction(),
        normal in any_direction(), cos_half_angle in 0.0_f32..=1.0,
    ) {
        let opening = Opening { share, moment: towards * share * length };
        let found = opening.irradiance(&light);
        prop_assert!(found.is_finite() && found.min_element() >= 0.0, "{found}");
        let cone = BentCone { direction: towards, cos_half_angle };
        let found = cone.irradiance(normal, share, &light);
        prop_assert!(found.is_finite() && found.min_element() >= 0.0, "{found}");
    }

    /// Open is the plain irradiance, closed is dark, and constant light knows no direction.
    #[test]
    fn limits(light in any_light(), normal in any_direction(), towards in any_direction(),
              share in 0.0_f32..=1.0, length in 0.0_f32..=1.0) {
        let whole = Opening::whole(normal, Weighting::Cosine);
        let (found, plain) = (whole.irradiance(&light), light.at(normal));
        prop_assert!((found - plain).length() < 1e-4 * (1.0 + plain.length()), "{found} {plain}");
        prop_assert_eq!(Opening::CLOSED.irradiance(&light), Vec3::ZERO);
        let mut constant = [Vec3::ZERO; 9];
        // Radiance 1: its coefficient is √4π, times π for the cosine.
        constant[0] = Vec3::splat(PI * (4.0 * PI).sqrt());
        let constant = Irradiance { coefficients: constant };
        let opening = Opening { share, moment: towards * share * length };
        prop_assert!((opening.irradiance(&constant).x - PI * share).abs() < 1e-5);
        let cone = BentCone { direction: normal, cos_half_angle: length * 0.99 };
        prop_assert!((cone.irradiance(normal, share, &constant).x - PI * share).abs() < 1e-4);
        // And a hemisphere as a cone is the hemisphere.
        let hemisphere = BentCone { direction: normal, cos_half_angle: 0.0 };
        let found = hemisphere.irradiance(normal, 1.0, &light);
        prop_assert!((found - plain).length() < 2e-3 * (1.0 + plain.length()), "{found} {plain}");
    }

    /// What turns together stays the same.
    #[test]
    fn turned_light_through_a_turned_opening(
        light in any_light(), share in 0.1_f32..=1.0, length in 0.0_f32..=1.0, towards in any_direction(),
        normal in any_direction(), angle_rad in -3.0_f32..3.0,
    ) {
        let turn = math::rotation(Vec3::Y, angle_rad);
        let turned_light = light.turned(angle_rad);
        let opening = Opening { share, moment: towards * share * length };
        let turned = Opening { share, moment: turn * opening.moment };
        let (before, after) = (opening.irradiance(&light), turned.irradiance(&turned_light));
        prop_assert!((before - after).length() < 1e-4 * (1.0 + before.length()), "{before} {after}");
        let cone = BentCone { direction: towards, cos_half_angle: 0.9 * length };
        let turned = BentCone { direction: turn * towards, ..cone };
        let before = cone.irradiance(normal, share, &light);
        let after = turned.irradiance(turn * normal, share, &turned_light);
        prop_assert!((before - after).length() < 2e-3 * (1.0 + before.length()), "{before} {after}");
    }

    /// An upright cone: all three bands are those of the integral over it.
    #[test]
    fn an_upright_cone_lets_in_its_integral(
        light in any_light(), normal in any_direction(), half_angle in 0.3_f32..FRAC_PI_2,
    ) {
        let cos = half_angle.cos();
        let (opening, exact) = integrated(normal, Weighting::Cosine, &light, |d| d.dot(normal) > cos);
        let exact = exact.max(Vec3::ZERO);
        let found = opening.irradiance(&light);
        prop_assert!((found - exact).length() < 0.01 * (exact.length() + 0.1), "{found} {exact}");
    }

    /// Whatever is open, two bands of light come in exactly.
    #[test]
    fn two_bands_come_in_through_anything(
        mut light in any_light(), normal in any_direction(), a in any_direction(), b in any_direction(),
    ) {
        light.coefficients[4..].fill(Vec3::ZERO);
        // Two holes, one with a straight edge.
        let is_open = |d: Vec3| d.dot(a) > 0.8 || (d.dot(b) > 0.1 && d.dot(a) < 0.2);
        let (opening, exact) = integrated(normal, Weighting::Cosine, &light, is_open);
        let found = opening.irradiance(&light);
        prop_assert!((found - exact.max(Vec3::ZERO)).length() < 2e-3 * (exact.length() + 1.0), "{found} {exact}");
    }

    /// A cone that leans, cut off by the surface.
    #[test]
    fn a_leaning_cone_lets_in_its_integral(
        light in any_light(), normal in any_direction(), lean in 0.0_f32..1.4, half_angle in 0.3_f32..FRAC_PI_2,
    ) {
        let direction = frame_of(normal) * Vec3::new(lean.sin(), 0.0, lean.cos());
        let cone = BentCone { direction, cos_half_angle: half_angle.cos() };
        let is_open = |d: Vec3| d.dot(direction) > cone.cos_half_angle;
        let (opening, exact) = integrated(normal, Weighting::Cosine, &light, is_open);
        let found = cone.irradiance(normal, opening.share, &light);
        prop_assert!((found - exact.max(Vec3::ZERO)).length() < 0.01 * (exact.length() + 0.3), "{found} {exact}");
    }
}
