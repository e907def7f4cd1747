//! Cloth in the arches: curtains on rods, drawn aside, tied back or hanging full, and
//! carpets laid over the balustrade.

use std::f32::consts::{PI, TAU};

use glam::{IVec3, Vec2, Vec3};

use super::Side;
use super::arcade::Storey;
use super::materials::Stuff;
use crate::scene::modelling::math::{cos, lerp, on_circle, pow, rotation, sin, smoothstep};
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{Frame, MeshBuilder, Noise};

/// What hangs in an arch.
#[derive(Clone, Copy, PartialEq)]
enum Hanging {
    Bare,
    /// Two curtains pushed to the ends of the rod.
    Aside,
    /// Two curtains that meet at the top and are tied back to the columns.
    Tied,
    /// One curtain over the whole arch.
    Full,
    /// A carpet over the balustrade.
    Carpet,
}

/// By storey and side, from the left end of each long side.
const PLAN: [[[Hanging; 6]; 2]; 2] = {
    use Hanging::{Aside, Bare, Carpet, Full, Tied};
    [
        [
            [Bare, Tied, Bare, Full, Aside, Tied],
            [Tied, Bare, Full, Bare, Tied, Aside],
        ],
        [
            [Aside, Carpet, Tied, Carpet, Aside, Tied],
            [Carpet, Aside, Carpet, Tied, Carpet, Aside],
        ],
    ]
};

/// A curtain: where it hangs and how.
struct Curtain {
    /// Left end of the rod; x along it, y up, z into the court.
    rod: Frame,
    /// Stretch of the rod it takes, metres.
    span_m: f32,
    drop_m: f32,
    folds: f32,
    /// How far down the tie is (0 to 1) and what width it leaves, metres.
    tie: Option<(f32, f32)>,
    noise: Noise,
}

/// Hangings of one long side, on both storeys.
pub(super) fn build(stuff: &mut Stuff, side: &Side, storeys: &[Storey; 2], seed: u64) {
    if side.bays < 4 {
        return;
    }
    let side_number = usize::from(side.frame.origin_m.z > 0.0);
    for storey in storeys {
        let plan = &PLAN[usize::from(storey.upper)][side_number];
        for (bay, hanging) in (0_u8..).zip(plan) {
            let index = side_number as u64 * 100 + u64::from(bay) * 2 + u64::from(storey.upper);
            let arch = Arch {
                side,
                storey,
                x: f32::from(bay) * side.bay_m,
                color: (usize::from(bay) + 2 * side_number + usize::from(storey.upper)) % 3,
                noise: Noise::new(seed, "atrium curtain", index),
            };
            arch.hang(stuff, *hanging);
        }
    }
}

/// One arch to be hung.
struct Arch<'a> {
    side: &'a Side,
    storey: &'a Storey,
    /// Its left column, metres along the side.
    x: f32,
    color: usize,
    noise: Noise,
}

impl Arch<'_> {
    fn hang(&self, stuff: &mut Stuff, hanging: Hanging) {
        match hanging {
            Hanging::Bare => {}
            Hanging::Carpet => self.carpet(&mut stuff.cloth[self.color]),
            Hanging::Aside | Hanging::Tied | Hanging::Full => {
                let inset = self.storey.half_pier_m + 0.04;
                let width = self.side.bay_m - 2.0 * inset;
                let (y, z) = (self.storey.springing_m - 0.2, -0.05);
                self.rod(stuff, inset, y, z, width);
                let drop_m = y - self.storey.floor_m - 0.06;
                let (stretch, folds, tie) = match hanging {
                    Hanging::Full => (width, 15.0, None),
                    Hanging::Tied => (0.49 * width, 9.0, Some((0.60, 0.26))),
                    _ => (0.24 * width, 7.0, None),
                };
                let count = if hanging == Hanging::Full { 1 } else { 2 };
                for mirrored in 0..count {
                    let mut axes = self.side.frame.axes;
                    let mut start = self.x + inset;
                    if mirrored == 1 {
                        // Seen from behind, so that its x runs inwards too.
                        axes *= rotation(Vec3::Y, PI);
                        start += width;
                    }
                    let curtain = Curtain {
                        rod: Frame {
                            origin_m: self.side.frame.point(Vec3::new(start, y, z)),
                            axes,
                        },
                        span_m: stretch,
                        drop_m,
                        folds,
                        tie,
                        noise: self.noise,
                    };
                    curtain.build(stuff, self.color);
                }
            }
        }
    }

    fn rod(&self, stuff: &mut Stuff, inset: f32, y: f32, z: f32, width: f32) {
        let start = self.side.frame.point(Vec3::new(self.x + inset, y, z));
        let frame = Frame::along(start, self.side.frame.axes.x_axis, Vec3::Y);
        Pen::at(0.0, -0.06)
            .to(0.03, -0.06)
            .bulge(0.06, 0.02)
            .to(0.022, 0.0)
            .to(0.022, width)
            .to(0.03, width)
            .bulge(0.06, 0.02)
            .to(0.0, width + 0.06)
            .profile()
            .lathe(&mut stuff.metal, &frame, 12);
    }

    /// Over the rail: up inside, across, and down to the string course outside.
    fn carpet(&self, cloth: &mut MeshBuilder) {
        let (half, top) = (0.205, self.storey.column_foot_m - 0.005);
        let across_m = 0.62 * self.side.bay_m;
        let start = self.x + 0.5 * (self.side.bay_m - across_m);
        let bottom = self.storey.floor_m + 0.04;
        let path = [
            Vec2::new(half, bottom),
            Vec2::new(half, top - 0.03),
            Vec2::new(half - 0.03, top),
            Vec2::new(-half, top),
            Vec2::new(-half, top - 0.5),
        ];
        let lengths: Vec<f32> = path.windows(2).map(|w| w[0].distance(w[1])).collect();
        let total: f32 = lengths.iter().sum();
        let at = |t: f32| {
            let mut rest = t * total;
            for (i, &length) in lengths.iter().enumerate() {
                if rest <= length || i + 1 == lengths.len() {
                    return path[i].lerp(path[i + 1], rest / length);
                }
                rest -= length;
            }
            path[0]
        };
        cloth.tint(Vec3::splat(0.9));
        cloth.sheet(32, 24, |s, t| {
            let p = at(t);
            // Folds begin below the rail and deepen towards the hem.
            let hanging = smoothstep(0.02, 0.7, top - p.y);
            let wander = self.noise.gradient(Vec3::new(s * 3.0, p.y * 0.8, 2.5));
            let wave = sin(TAU * (4.0 * s + 0.4 * wander)) + 0.4 * sin(TAU * 9.0 * s + wander);
            let z = p.x + p.x.signum() * hanging * (0.012 + 0.03 * (1.0 + wave));
            let skew = 0.03 * hanging * (wander + (s - 0.5));
            let x = start + across_m * s + skew;
            (
                self.side.frame.point(Vec3::new(x, p.y, z)),
                Vec2::new(s * across_m, t * total),
            )
        });
        cloth.tint(Vec3::ONE);
    }
}

impl Curtain {
    /// How wide the cloth hangs at `t` of its way down, metres.
    fn width_m(&self, t: f32) -> f32 {
        match self.tie {
            // Its own weight, evened out: a little wider below.
            None => self.span_m * lerp(1.0, 1.06, t),
            Some((tie, waist_m)) if t < tie => {
                let k = pow(t / tie, 2.4);
                lerp(self.span_m, waist_m, k)
            }
            Some((tie, waist_m)) => {
                let flare = 1.0 + 0.9 * smoothstep(tie, 1.0, t);
                waist_m * flare
            }
        }
    }

    /// Where the cloth is at `s` across and `t` down, in the rod's frame, metres.
    fn point_m(&self, s: f32, t: f32) -> Vec3 {
        let width = self.width_m(t);
        let fold_m = width / self.folds;
        let settled = smoothstep(0.0, 0.45, t);
        let wander = self
            .noise
            .gradient(Vec3::new(s * self.folds * 0.45, t * 1.1, 1.5));
        let slow = self.noise.gradient(Vec3::new(s * 2.0, t * 0.8, 7.5));
        let phase = TAU * (self.folds * s + (0.30 * wander + 0.25 * slow) * settled);
        // Pleats of one size at the rod; further down neighbours merge into wider folds.
        let size = 0.85
            + 0.55
                * self
                    .noise
                    .gradient(Vec3::new(s * self.folds * 0.9, t * 0.6, 3.5));
        let merged = 0.42 * settled;
        let wave =
            (1.0 - merged) * sin(phase) * size + merged * 1.3 * sin(0.5 * phase + 2.0 * slow);
        // The cloth is longer than the rod is wide: what is not across goes into depth.
        let depth = (0.34 * fold_m).clamp(0.035, 0.085) * lerp(0.75, 1.25, settled);
        let overhang = 0.85 * fold_m / (2.0 * TAU) * sin(2.0 * phase);
        let sway = 0.07 * slow * t;
        let hem = 0.015 * self.noise.gradient(Vec3::new(s * self.folds, 0.0, 5.5)) * t;
        Vec3::new(
            width * s - overhang,
            -self.drop_m * t - 0.03 - 0.02 * cos(phase) * smoothstep(0.05, 0.0, t) + hem,
            depth * wave + sway,
        )
    }

    fn build(&self, stuff: &mut Stuff, color: usize) {
        let cloth = &mut stuff.cloth[color];
        let columns = (self.folds * 7.0) as u32;
        // Metres of cloth to a metre of rod.
        let ease = 1.9;
        let uv = |s: f32, t: f32| Vec2::new(s * self.span_m * ease, t * self.drop_m);
        let mut part = |from: f32, to: f32, rows: u32, tint: Vec3| {
            cloth.tint(tint);
            // Rows run upwards, so that the sheet faces +z of the rod.
            cloth.sheet(columns, rows, |s, t| {
                let down = lerp(to, from, t);
                (self.rod.point(self.point_m(s, down)), uv(s, down))
            });
        };
        let shade = 0.85 + 0.3 * self.noise.at(IVec3::new(1, 2, 3));
        let base = Vec3::splat(shade);
        part(0.0, 0.93, 22, base);
        part(0.93, 0.965, 2, Vec3::new(1.6, 1.5, 1.0));
        part(0.965, 1.0, 2, base * 0.8);
        cloth.tint(Vec3::ONE);
        if let Some((tie, waist_m)) = self.tie {
            self.rope(&mut stuff.metal, tie, waist_m);
        }
    }

    /// The cord round a tied curtain, up to a hook on the column.
    fn rope(&self, cord: &mut MeshBuilder, tie: f32, waist_m: f32) {
        let middle = Vec3::new(0.5 * waist_m, -self.drop_m * tie - 0.03, 0.0);
        cord.sheet(8, 32, |s, t| {
            let around = on_circle(-t * TAU);
            let rim = Vec3::new(
                around.x * (0.5 * waist_m + 0.015),
                0.05 * -around.x,
                around.y * 0.12,
            );
            let out = Vec3::new(around.x, 0.0, around.y);
            let c = on_circle(-s * TAU) * 0.022;
            let p = middle + rim + out * c.x + Vec3::Y * c.y;
            (self.rod.point(p), Vec2::new(s, t))
        });
    }
}
