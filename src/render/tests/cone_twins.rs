//! What the bent cone's shaders compute, beside the same on the processor: see `twins`.

use std::f64::consts::PI;

use super::twins::{Source, grid, integral, on_gpu};
use super::*;
use crate::reference::Opening;
use crate::render::light::LightUniform;

/// The sum of a slice's directions, by its definition.
#[test]
fn the_directions_of_a_slice_are_their_integral() {
    let angles: Vec<[f64; 2]> = grid(-0.5, 0.5, 16)
        .flat_map(|n| grid(n - 0.5, n + 0.5, 24).map(move |angle| [angle, n]))
        .map(|turns| turns.map(|turn| f64::from(turn) * PI))
        .collect();
    let inputs: Vec<[f32; 4]> = (angles.iter())
        .map(|[angle, n]| [angle.sin(), angle.cos(), n.sin(), n.cos()].map(|x| x as f32))
        .collect();
    let statements = "var slice: Slice;
        slice.sin_normal = x.z;
        slice.cos_normal = max(x.w, 0.0);
        let side = select(1.0, -1.0, x.x < 0.0);
        y = vec4f(arc_moment(slice, side, x.y), 0.0, 0.0);";
    let source = Source::of_technique("gtao");
    for (&[angle, n], found) in angles.iter().zip(on_gpu(&source, statements, &[], &inputs)) {
        for (found, along) in found.iter().zip([f64::sin as fn(f64) -> f64, f64::cos]) {
            let light = |t: f64| (t - n).cos() * t.sin().abs() * along(t);
            let exact = integral(0.0, angle, light) * angle.signum();
            let off = f64::from(*found) - exact;
            // At the eye's own direction the side means nothing, and neither does the sum.
            assert!(off.abs() < 2e-6, "{angle}, {n}: {found}, {exact}");
        }
    }
}

/// Sectors of even angle, by the angles between which they lie.
#[test]
fn the_directions_of_sectors_are_their_integral() {
    let masks = [1_u32, 0x8000_0000, 0xffff_ffff, 0x00ff_0f00, 0xf0f0_0001, 0];
    let normals: Vec<f32> = grid(-0.45, 0.45, 6).map(|turn| turn * PI as f32).collect();
    let cases: Vec<(u32, f32)> = (masks.iter())
        .flat_map(|&mask| normals.iter().map(move |&n| (mask, n)))
        .collect();
    let inputs: Vec<[f32; 4]> = (cases.iter())
        .map(|&(mask, n)| {
            [
                n.sin(),
                n.cos(),
                (mask & 0xffff) as f32,
                (mask >> 16) as f32,
            ]
        })
        .collect();
    let statements = "var slice: Slice;
        slice.sin_normal = x.x;
        slice.cos_normal = x.y;
        y = vec4f(moment_in(slice, u32(x.z) | u32(x.w) << 16u), 0.0, 0.0);";
    let source = Source::of_technique("vbao");
    for ((mask, n), found) in cases.iter().zip(on_gpu(&source, statements, &[], &inputs)) {
        let n = f64::from(*n);
        let edge = |sector: u32| n + PI * (f64::from(sector) / 32.0 - 0.5);
        for (found, along) in found.iter().zip([f64::sin as fn(f64) -> f64, f64::cos]) {
            let light = |t: f64| (t - n).cos() * t.sin().abs() * along(t);
            let exact: f64 = (0..32)
                .filter(|sector| mask >> sector & 1 == 1)
                .map(|sector| integral(edge(sector), edge(sector + 1), light))
                .sum();
            let off = f64::from(*found) - exact;
            assert!(off.abs() < 2e-5, "{mask:x}, {n}: {found}, {exact}");
        }
    }
}

/// Light through a bent cone is what the processor says.
#[test]
fn light_through_a_cone_is_the_processors() {
    let mut lit = brightest("none");
    lit.lighting.environment = Some(crate::scene::Environment::from_axes(
        [3.0, 0.5, 1.0, 0.2, 0.4, 0.0].map(glam::Vec3::splat),
    ));
    let light = LightUniform::new(&lit, None);
    let nine = lit.lighting.environment.as_ref().unwrap().irradiance();
    let inputs: Vec<[f32; 4]> = grid(-0.9, 0.9, 6)
        .flat_map(|x| grid(-0.9, 0.9, 6).map(move |y| (x, y)))
        .flat_map(|(x, y)| grid(0.0, 1.0, 5).map(move |share| [x, y, 0.3, share]))
        .collect();
    let source = Source {
        wgsl: "//!use bent_cone\n".into(),
        params: String::new(),
    };
    let bound: [(u32, &[u8]); 1] = [(4, bytemuck::bytes_of(&light))];
    let statements = "y = vec4f(irradiance_within(x.w, x.xyz), 0.0);";
    for (input, found) in (inputs.iter()).zip(on_gpu(&source, statements, &bound, &inputs)) {
        let opening = Opening {
            share: input[3],
            moment: glam::Vec3::new(input[0], input[1], input[2]),
        };
        let exact = opening.irradiance(&nine).x;
        assert!(
            (found[0] - exact).abs() < 1e-4,
            "{input:?}: {found:?}, {exact}"
        );
    }
}
