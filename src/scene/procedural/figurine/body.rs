//! The dragon's body: a tapering tube along a looped spine, with overlapping scales,
//! ringed belly plates and a crest of spines.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::scene::modelling::math::{catmull_rom, cos, lerp, pow, smoothstep};
use crate::scene::modelling::sculpture::{Part, Sculpture};

/// One knot of the spine: where it is and which way its back points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Knot {
    /// Middle of the body, metres.
    pub at_m: Vec3,
    /// Radius of the body, metres.
    pub radius_m: f32,
    /// Way along the spine from the tail, metres.
    pub along_m: f32,
    /// Unit vector towards the head.
    pub ahead: Vec3,
    /// Unit vector towards the crest.
    pub back: Vec3,
}

/// The middle line of the body, from the tail's tip to the head.
#[derive(Debug, Clone)]
pub(super) struct Spine {
    pub knots: Vec<Knot>,
}

const KNOTS: usize = 140;
/// Length of a scale along the body, metres; round it there are always fifteen.
const SCALE_M: f32 = 0.0095;

impl Spine {
    /// The tail curls up on the left; the hips stand low, the back rears into a loop that
    /// leans away from the viewer, comes down to the chest and rises again into the neck,
    /// which looks to the right. Columns: the middle of the body and its radius (metres),
    /// and where the crest points.
    pub fn looped() -> Self {
        let control: [[f32; 7]; 21] = [
            [-0.150, 0.186, 0.040, 0.0024, 0.3, 1.0, 0.0],
            [-0.182, 0.206, 0.030, 0.0048, 0.0, 1.0, 0.0],
            [-0.215, 0.192, 0.015, 0.0078, -0.7, 0.7, 0.0],
            [-0.228, 0.150, 0.000, 0.0108, -1.0, 0.3, -0.1],
            [-0.208, 0.105, -0.020, 0.0145, -0.6, 0.6, -0.5],
            [-0.170, 0.066, -0.035, 0.0185, 0.0, 1.0, -0.5],
            [-0.120, 0.049, -0.030, 0.0230, 0.0, 1.0, 0.0],
            [-0.070, 0.056, 0.000, 0.0262, -0.4, 0.9, 0.1],
            [-0.040, 0.090, 0.030, 0.0278, -0.8, 0.2, 0.6],
            [-0.045, 0.137, 0.022, 0.0282, -0.5, 0.5, 0.7],
            [-0.058, 0.170, -0.020, 0.0282, -0.3, 1.0, 0.0],
            [-0.035, 0.155, -0.064, 0.0282, 0.2, 0.7, -0.7],
            [0.012, 0.108, -0.072, 0.0282, 0.5, 0.6, -0.6],
            [0.056, 0.068, -0.046, 0.0282, 0.1, 1.0, -0.4],
            [0.090, 0.064, 0.000, 0.0278, -0.2, 1.0, -0.2],
            [0.106, 0.092, 0.038, 0.0262, -0.7, 0.5, -0.4],
            [0.096, 0.138, 0.052, 0.0246, -1.0, 0.1, 0.0],
            [0.072, 0.182, 0.038, 0.0230, -1.0, 0.0, 0.2],
            [0.066, 0.222, 0.010, 0.0220, -0.9, 0.4, 0.0],
            [0.090, 0.250, -0.006, 0.0214, -0.4, 1.0, 0.0],
            [0.126, 0.254, 0.006, 0.0208, 0.0, 1.0, 0.0],
        ];
        let sample = |t: f32| {
            let [x, y, z, radius, back @ ..] = catmull_rom(&control, t);
            (Vec3::new(x, y, z), radius, Vec3::from(back))
        };
        let mut knots: Vec<Knot> = Vec::with_capacity(KNOTS);
        let mut along_m = 0.0;
        for i in 0..KNOTS {
            let t = i as f32 / (KNOTS - 1) as f32;
            let (at_m, radius_m, wish) = sample(t);
            let ahead =
                (sample((t + 0.002).min(1.0)).0 - sample((t - 0.002).max(0.0)).0).normalize();
            along_m += knots.last().map_or(0.0, |last| last.at_m.distance(at_m));
            let back = (wish - ahead * ahead.dot(wish)).normalize_or(Vec3::Y);
            knots.push(Knot {
                at_m,
                radius_m,
                along_m,
                ahead,
                back,
            });
        }
        Self { knots }
    }

    /// The knot nearest to the fraction `t` of the number of knots.
    pub fn at(&self, t: f32) -> &Knot {
        let last = self.knots.len() - 1;
        &self.knots[((t * last as f32) as usize).min(last)]
    }

    /// The head's end.
    pub fn head(&self) -> &Knot {
        &self.knots[self.knots.len() - 1]
    }
}

/// Height of the scales, in units of their own size, at `around` (turns, 0 at the
/// crest) and `along` (in scales): rounded shields in staggered rows, each rising
/// towards its free end.
pub(super) fn shield(around: f32, along: f32) -> f32 {
    let mut highest = 0.0_f32;
    for row in 0..2 {
        let shift = 0.5 * row as f32;
        let x = around + shift;
        let y = along + shift;
        let (fx, fy) = (x - x.floor() - 0.5, y - y.floor());
        // An arc-ended tongue that begins at fy = 1 and ends, highest, at fy = 0.
        let half = 0.62 * pow((fy * 1.6).min(1.0), 0.5);
        let inside = smoothstep(0.0, 0.16, half - fx.abs()) * smoothstep(0.0, 0.07, fy);
        let keel = 0.25 * (1.0 - (fx.abs() * 5.0).min(1.0));
        highest = highest.max(inside * (1.0 - 0.75 * fy + keel));
    }
    highest
}

pub(super) fn carve(sculpture: &mut Sculpture, spine: &Spine) {
    for pair in spine.knots.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        sculpture.add(segment(a, b));
    }
    crest(sculpture, spine);
    tail_tuft(sculpture, spine);
}

fn segment(a: Knot, b: Knot) -> Part {
    let length = a.at_m.distance(b.at_m);
    let limit = 0.20 * a.radius_m;
    let part = Part::limb((a.at_m, a.radius_m), (b.at_m, b.radius_m), a.back);
    let first = a.along_m / SCALE_M;
    let last = b.along_m / SCALE_M;
    part.with_relief(limit, move |p| {
        // 0 at the crest, ±½ at the belly.
        let turns = libm::atan2f(p.x, p.z) / TAU;
        let along = lerp(first, last, (p.y / length).clamp(0.0, 1.0));
        let belly = smoothstep(0.33, 0.36, turns.abs());
        let scale = shield(turns * 14.0, along * 0.8);
        let ring = along * 0.55;
        let ring = ring - ring.floor();
        let plate = smoothstep(0.0, 0.12, ring) * (1.0 - 0.6 * ring);
        let groove = smoothstep(0.0, 0.012, (turns.abs() - 0.345).abs());
        limit * (lerp(scale * 0.85, plate * 0.8, belly) * (0.3 + 0.7 * groove))
    })
}

/// A row of backward-leaning blades along the back.
fn crest(sculpture: &mut Sculpture, spine: &Spine) {
    let mut next_m = 0.09;
    for knot in &spine.knots[..spine.knots.len() - 6] {
        if knot.along_m < next_m {
            continue;
        }
        let r = knot.radius_m;
        next_m = knot.along_m + (0.62 * r).max(0.007);
        let lean = knot.back * 0.8 - knot.ahead * 0.75;
        let root = knot.at_m + knot.back * (0.86 * r);
        let tip = root + lean.normalize() * (0.95 * r);
        // Flat blades: three cones side by side along the spine, melted together.
        for (shift, size) in [(-0.28, 0.7), (0.0, 1.0), (0.28, 0.75)] {
            let offset = knot.ahead * (shift * r);
            let end = root.lerp(tip, size);
            sculpture.add(
                Part::limb(
                    (root + offset, 0.17 * r),
                    (end + offset * 0.4, 0.03 * r),
                    knot.ahead,
                )
                .blended(0.16 * r),
            );
        }
    }
}

/// Flame-like tufts at the tail's tip.
fn tail_tuft(sculpture: &mut Sculpture, spine: &Spine) {
    let tip = spine.knots[0];
    for i in 0..7 {
        let spread = (i as f32 - 3.0) / 3.0;
        let side = tip.ahead.cross(tip.back);
        let mut at = tip.at_m + tip.ahead * 0.010;
        let mut way =
            (-tip.ahead + tip.back * (0.75 * spread) + side * (0.2 * cos(spread * PI))).normalize();
        let mut radius = 0.0042;
        for step in 0..6 {
            let next = at + way * (0.0085 - 0.002 * spread.abs());
            let thinner = radius * if step < 2 { 1.0 } else { 0.72 };
            sculpture.add(Part::limb((at, radius), (next, thinner), tip.back).blended(0.002));
            at = next;
            radius = thinner;
            way = (way + tip.back * 0.16 - way.cross(side) * 0.12 * spread).normalize();
        }
    }
}
