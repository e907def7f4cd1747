//! The head: open jaws with teeth and a tongue, deep-set eyes under brows, swept horns,
//! ears, whiskers and a mane of locks.

use glam::Vec3;

use super::body::Spine;
use crate::scene::modelling::Frame;
use crate::scene::modelling::math::{cos, on_circle, sin};
use crate::scene::modelling::sculpture::{Part, Sculpture};

/// The unit of the head: about a third of its length, metres.
const U: f32 = 0.0275;

/// Builds in the head's frame: x to its left, y up, z forwards, in units of [`U`].
struct Carver<'a> {
    sculpture: &'a mut Sculpture,
    frame: Frame,
}

impl Carver<'_> {
    fn point(&self, p: [f32; 3]) -> Vec3 {
        self.frame.point(Vec3::from(p) * U)
    }

    fn limb(&mut self, a: [f32; 3], ra: f32, b: [f32; 3], rb: f32, blend: f32) {
        let (a, b) = (self.point(a), self.point(b));
        let front = self.frame.axes.y_axis;
        self.sculpture
            .add(Part::limb((a, ra * U), (b, rb * U), front).blended(blend * U));
    }

    fn egg(&mut self, at: [f32; 3], radii: [f32; 3], blend: f32) {
        let frame = Frame {
            origin_m: self.point(at),
            axes: self.frame.axes,
        };
        self.sculpture
            .add(Part::ellipsoid(frame, Vec3::from(radii) * U).blended(blend * U));
    }

    fn hollow(&mut self, at: [f32; 3], radii: [f32; 3], blend: f32) {
        let frame = Frame {
            origin_m: self.point(at),
            axes: self.frame.axes,
        };
        self.sculpture.add(
            Part::ellipsoid(frame, Vec3::from(radii) * U)
                .carving()
                .blended(blend * U),
        );
    }

    /// A tapering lock or horn through several points.
    fn strand(&mut self, points: &[[f32; 3]], thick: f32, thin: f32, blend: f32) {
        let spans = (points.len() - 1) as f32;
        for (i, pair) in points.windows(2).enumerate() {
            let at = |k: f32| thick + (thin - thick) * k / spans;
            let i = i as f32;
            self.limb(pair[0], at(i), pair[1], at(i + 1.0), blend);
        }
    }
}

pub(super) fn carve(sculpture: &mut Sculpture, spine: &Spine) {
    let neck = spine.head();
    // It looks ahead along the neck, levelled.
    let ahead = Vec3::new(neck.ahead.x, 0.10, neck.ahead.z).normalize();
    let up = (Vec3::Y - ahead * ahead.y).normalize();
    let frame = Frame {
        origin_m: neck.at_m + ahead * (0.35 * U),
        axes: glam::Mat3::from_cols(up.cross(ahead), up, ahead),
    };
    let mut carver = Carver { sculpture, frame };
    skull(&mut carver);
    jaw(&mut carver);
    carver.hollow([0.0, -0.12, 1.55], [0.40, 0.17, 1.0], 0.08);
    mouth(&mut carver);
    for side in [-1.0, 1.0] {
        face(&mut carver, side);
        horn(&mut carver, side);
        mane(&mut carver, side);
    }
}

fn skull(c: &mut Carver) {
    c.egg([0.0, 0.12, 0.1], [0.82, 0.74, 0.95], 0.3);
    c.limb([0.0, 0.28, 0.6], 0.56, [0.0, 0.22, 1.9], 0.36, 0.25);
    // Nose and upper lip.
    c.egg([0.0, 0.36, 2.1], [0.46, 0.30, 0.34], 0.15);
    c.egg([0.0, 0.10, 2.05], [0.46, 0.20, 0.42], 0.12);
    // Wrinkles over the muzzle.
    for i in 0..4 {
        let z = 1.0 + 0.24 * i as f32;
        let y = 0.70 - 0.05 * i as f32;
        c.limb(
            [-0.34, y - 0.12, z],
            0.055,
            [0.0, y + 0.02, z + 0.07],
            0.075,
            0.06,
        );
        c.limb(
            [0.34, y - 0.12, z],
            0.055,
            [0.0, y + 0.02, z + 0.07],
            0.075,
            0.06,
        );
    }
}

fn jaw(c: &mut Carver) {
    // Dropped open about 25 degrees.
    c.limb([0.42, -0.42, 0.25], 0.30, [0.26, -0.86, 1.5], 0.16, 0.2);
    c.limb([-0.42, -0.42, 0.25], 0.30, [-0.26, -0.86, 1.5], 0.16, 0.2);
    c.limb([0.0, -0.72, 0.55], 0.26, [0.0, -0.98, 1.65], 0.19, 0.2);
    c.egg([0.0, -0.93, 1.72], [0.33, 0.17, 0.26], 0.12);
    // Beard.
    for i in 0..5 {
        let x = 0.16 * (i as f32 - 2.0);
        c.strand(
            &[
                [x, -1.0, 1.55],
                [1.2 * x, -1.4, 1.5],
                [1.5 * x, -1.75, 1.25 - 0.1 * x.abs()],
            ],
            0.13,
            0.02,
            0.06,
        );
    }
}

fn mouth(c: &mut Carver) {
    c.strand(
        &[
            [0.0, -0.55, 0.5],
            [0.0, -0.52, 1.1],
            [0.0, -0.58, 1.6],
            [0.0, -0.40, 1.95],
            [0.0, -0.16, 2.1],
        ],
        0.20,
        0.06,
        0.04,
    );
    for side in [-1.0, 1.0] {
        for i in 0..6 {
            let k = i as f32;
            let z = 0.95 + 0.2 * k;
            let x = side * (0.40 - 0.018 * k * k * 0.5);
            let fang = if i == 4 { 0.36 } else { 0.17 };
            c.limb([x, 0.0, z], 0.07, [0.96 * x, -fang, z + 0.02], 0.012, 0.02);
            let low = -0.72 - 0.05 * k;
            let tall = if i == 4 { 0.30 } else { 0.15 };
            c.limb(
                [0.82 * x, low, z - 0.05],
                0.06,
                [0.82 * x, low + tall, z - 0.02],
                0.012,
                0.02,
            );
        }
    }
}

fn face(c: &mut Carver, side: f32) {
    // Nostril with a flared rim.
    c.egg([0.30 * side, 0.46, 2.22], [0.17, 0.16, 0.18], 0.06);
    c.hollow([0.34 * side, 0.46, 2.38], [0.08, 0.07, 0.12], 0.03);
    // Eye in its socket under a heavy brow.
    c.hollow([0.60 * side, 0.50, 0.92], [0.24, 0.20, 0.26], 0.06);
    c.egg([0.52 * side, 0.49, 0.90], [0.20, 0.20, 0.20], 0.0);
    c.strand(
        &[
            [0.30 * side, 0.68, 1.25],
            [0.56 * side, 0.80, 1.02],
            [0.80 * side, 0.80, 0.70],
            [0.98 * side, 0.98, 0.35],
        ],
        0.14,
        0.05,
        0.08,
    );
    c.strand(
        &[
            [0.46 * side, 0.30, 1.15],
            [0.72 * side, 0.30, 0.9],
            [0.78 * side, 0.42, 0.62],
        ],
        0.08,
        0.05,
        0.05,
    );
    // Cheek and the corner of the lips.
    c.egg([0.66 * side, -0.05, 0.45], [0.30, 0.34, 0.42], 0.2);
    c.strand(
        &[
            [0.46 * side, 0.02, 1.9],
            [0.52 * side, 0.05, 1.3],
            [0.60 * side, -0.12, 0.75],
            [0.50 * side, -0.5, 0.7],
        ],
        0.09,
        0.10,
        0.06,
    );
    // Whisker: a long curl from beside the nose.
    let whisker: Vec<[f32; 3]> = (0..14)
        .map(|i| {
            let t = i as f32 / 13.0;
            let swing = on_circle(4.6 * t);
            [
                side * (0.40 + 1.25 * t + 0.2 * sin(5.0 * t)),
                0.24 + 0.75 * swing.y * t - 0.25 * t,
                2.05 + 0.35 * (swing.x - 1.0) - 0.7 * t,
            ]
        })
        .collect();
    c.strand(&whisker, 0.10, 0.03, 0.03);
    // Ear.
    c.strand(
        &[
            [0.78 * side, 0.42, 0.0],
            [1.15 * side, 0.62, -0.30],
            [1.42 * side, 0.66, -0.72],
        ],
        0.20,
        0.04,
        0.1,
    );
    c.hollow([1.10 * side, 0.66, -0.10], [0.12, 0.09, 0.28], 0.04);
}

fn horn(c: &mut Carver, side: f32) {
    let horn: Vec<[f32; 3]> = (0..11)
        .map(|i| {
            let t = i as f32 / 10.0;
            [
                side * (0.42 + 0.38 * t + 0.1 * sin(3.0 * t)),
                0.72 + 0.9 * t - 0.3 * t * t + 0.18 * t * t * t,
                0.15 - 1.9 * t - 0.15 * cos(3.0 * t),
            ]
        })
        .collect();
    c.strand(&horn, 0.22, 0.05, 0.05);
    // A branch, and rings at the root.
    c.strand(
        &[
            horn[4],
            [side * 0.86, 1.38, -0.75],
            [side * 0.98, 1.62, -1.05],
        ],
        0.13,
        0.03,
        0.05,
    );
    for i in 0..3 {
        let [x, y, z] = horn[i];
        let [a, b, d] = horn[i + 1];
        let k = 0.12;
        c.limb(
            [x, y, z],
            0.27 - 0.02 * i as f32,
            [x + k * (a - x), y + k * (b - y), z + k * (d - z)],
            0.27 - 0.02 * i as f32,
            0.03,
        );
    }
}

/// Locks of hair that stream back from cheek and nape, each curling at its end.
fn mane(c: &mut Carver, side: f32) {
    for row in 0..3 {
        for i in 0..6 {
            let (row, k) = (row as f32, i as f32);
            let angle = -1.15 + 0.45 * k + 0.2 * row;
            let root = on_circle(angle) * (0.66 + 0.06 * row);
            let length = 1.5 - 0.12 * (k - 2.5) * (k - 2.5) * 0.5 - 0.15 * row;
            let curl = 0.34 * sin(2.1 * k + 1.3 * row + if side > 0.0 { 0.0 } else { 0.7 });
            let lock: Vec<[f32; 3]> = (0..7)
                .map(|j| {
                    let t = j as f32 / 6.0;
                    let out = 1.0 + 0.75 * t;
                    [
                        side * (root.x * out + 0.12 * sin(5.0 * t + k)),
                        root.y * out + 0.1 + curl * t * t + 0.10 * sin(6.0 * t + row),
                        -0.05 - 0.36 * row - length * t,
                    ]
                })
                .collect();
            c.strand(&lock, 0.20, 0.03, 0.06);
        }
    }
}
