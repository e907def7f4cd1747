//! Cloth in the arches: curtains on rods, gathered to the sides or hanging full.

use std::f32::consts::{PI, TAU};

use glam::{IVec3, Vec2, Vec3};

use super::Side;
use super::arcade::Storey;
use super::materials::Stuff;
use crate::scene::modelling::math::{lerp, pow, sin, smoothstep};
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder, Noise};

/// A curtain: where it hangs and how.
struct Curtain {
    /// Left end of the rod; x along it, y up, z into the court.
    rod: Frame,
    width_m: f32,
    drop_m: f32,
    pleats: f32,
    /// How far the cloth is drawn to the left (0 hangs full, 1 a bundle), at its waist.
    drawn: f32,
    noise: Noise,
}

/// Hangings of one side, on both storeys.
pub(super) fn build(stuff: &mut Stuff, side: &Side, storeys: &[Storey; 2], seed: u64) {
    if side.bays < 4 {
        return;
    }
    let side_number = u64::from(side.frame.origin_m.z > 0.0);
    for storey in storeys {
        for bay in 0..side.bays {
            let index = side_number * 100 + u64::from(bay) * 2 + u64::from(storey.upper);
            let color = (bay as usize + side_number as usize) % 3;
            let x = bay as f32 * side.bay_m;
            if storey.upper {
                pair(
                    stuff,
                    side,
                    storey,
                    x,
                    color,
                    Noise::new(seed, "atrium curtain", index),
                );
            } else if (bay + side_number as u32) % 2 == 1 {
                full(
                    stuff,
                    side,
                    storey,
                    x,
                    color,
                    Noise::new(seed, "atrium curtain", index),
                );
            }
        }
    }
}

fn rod(stuff: &mut Stuff, side: &Side, x: f32, y: f32, z: f32, width: f32) {
    let start = side.frame.point(Vec3::new(x, y, z));
    let frame = Frame::along(start, side.frame.axes.x_axis, Vec3::Y);
    Pen::at(0.0, -0.06)
        .to(0.03, -0.06)
        .bulge(0.06, 0.02)
        .to(0.018, 0.0)
        .to(0.018, width)
        .to(0.03, width)
        .bulge(0.06, 0.02)
        .to(0.0, width + 0.06)
        .profile()
        .lathe(&mut stuff.metal, &frame, 12);
}

/// Two curtains tied back to the columns.
fn pair(stuff: &mut Stuff, side: &Side, storey: &Storey, x: f32, color: usize, noise: Noise) {
    let inset = storey.half_pier_m + 0.05;
    let width = side.bay_m - 2.0 * inset;
    let (y, z) = (storey.springing_m + 0.1, -0.05);
    rod(stuff, side, x + inset, y, z, width);
    for mirrored in [false, true] {
        let start = if mirrored {
            x + inset + width
        } else {
            x + inset
        };
        let mut axes = side.frame.axes;
        if mirrored {
            axes *= crate::scene::modelling::math::rotation(Vec3::Y, PI);
        }
        let curtain = Curtain {
            rod: Frame {
                origin_m: side.frame.point(Vec3::new(start, y, z)),
                axes,
            },
            width_m: 0.5 * width,
            drop_m: y - storey.floor_m - 0.12,
            pleats: 7.0,
            drawn: 0.86,
            noise,
        };
        curtain.build(&mut stuff.cloth[color]);
    }
}

/// One curtain that fills the arch.
fn full(stuff: &mut Stuff, side: &Side, storey: &Storey, x: f32, color: usize, noise: Noise) {
    let inset = storey.half_pier_m - 0.08;
    let width = side.bay_m - 2.0 * inset;
    let (y, z) = (storey.springing_m - 0.35, -0.1);
    rod(stuff, side, x + inset, y, z, width);
    let curtain = Curtain {
        rod: Frame {
            origin_m: side.frame.point(Vec3::new(x + inset, y, z)),
            axes: side.frame.axes,
        },
        width_m: width,
        drop_m: y - storey.floor_m - 0.5,
        pleats: 13.0,
        drawn: 0.0,
        noise,
    };
    curtain.build(&mut stuff.cloth[color]);
}

impl Curtain {
    /// Where the cloth is at `s` across and `t` down, in the rod's frame, metres.
    fn point_m(&self, s: f32, t: f32) -> Vec3 {
        let wander = self.noise.gradient(Vec3::new(s * 3.0, t * 1.3, 1.5));
        let fine = self.noise.gradient(Vec3::new(s * 9.0, t * 3.0, 7.5));
        // Pleats are tight at the rod and open and lean a little on their way down.
        let phase =
            TAU * self.pleats * s + 1.6 * wander * smoothstep(0.05, 0.6, t) + 0.5 * fine * t;
        let variety = 0.7 + 0.5 * self.noise.gradient(Vec3::new(s * self.pleats, 0.3, 3.5));
        let waist = (-((t - 0.62) / 0.2) * ((t - 0.62) / 0.2)).max(-30.0);
        let tied = self.drawn * crate::scene::modelling::math::exp(waist);
        let below = smoothstep(0.55, 0.95, t);
        let gathered = 1.0
            - lerp(
                tied,
                self.drawn * 0.62,
                below * (1.0 - tied / self.drawn.max(1e-3)),
            );
        let gathered = if self.drawn > 0.0 { gathered } else { 1.0 };
        let depth =
            lerp(0.045, 0.095, smoothstep(0.0, 0.5, t)) * variety * lerp(0.75, 1.0, gathered);
        // Folds are rounder towards the room than away from it.
        let wave = sin(phase);
        let rounded = wave.signum() * pow(wave.abs(), 0.8);
        let sway = 0.12 * wander * t * gathered;
        let edge = if self.drawn > 0.0 {
            // The free edge falls in a curve to the tie.
            0.10 * sin(PI * (t / 0.62).min(1.0)) * s * self.drawn
        } else {
            0.0
        };
        let lean = 0.035 * sin(phase + 1.1) * smoothstep(0.1, 0.6, t);
        let scallop = -0.03 * (1.0 - wave.abs()) * smoothstep(0.06, 0.0, t);
        Vec3::new(
            self.width_m * (s * gathered + edge) + lean,
            -self.drop_m * t + scallop - 0.02,
            depth * rounded + sway,
        )
    }

    fn build(&self, cloth: &mut MeshBuilder) {
        let columns = (self.pleats * 8.0) as u32;
        let ease = 1.8;
        let uv = |s: f32, t: f32| Vec2::new(s * self.width_m * ease, t * self.drop_m);
        let mut part = |from: f32, to: f32, rows: u32, tint: Vec3| {
            cloth.tint(tint);
            // Rows run upwards, so that the sheet faces +z of the rod.
            cloth.sheet(columns, rows, |s, t| {
                let down = lerp(to, from, t);
                (self.rod.point(self.point_m(s, down)), uv(s, down))
            });
        };
        let shade = 0.9 + 0.2 * self.noise.at(IVec3::new(1, 2, 3));
        let base = Vec3::splat(shade);
        part(0.0, 0.92, 40, base);
        part(0.92, 0.965, 2, Vec3::new(1.2, 1.9, 1.6));
        part(0.965, 1.0, 2, base * 0.8);
        cloth.tint(Vec3::ONE);
    }
}
