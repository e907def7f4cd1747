//! The head: open jaws with teeth and a tongue, deep-set eyes under brows, swept horns,
//! ears, whiskers and a mane of locks.

use glam::Vec3;

use super::body::Spine;
use crate::scene::modelling::Frame;
use crate::scene::modelling::math::{cos, on_circle, sin};
use crate::scene::modelling::sculpture::{Part, Sculpture};

/// The unit of the head: about a third of its length, metres.
const U: f32 = 0.0300;

/// Smallest radius of a strand's end, in units of [`U`].
const THINNEST: f32 = 0.042;

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
        // Thinner tips fall between the marching cubes and leave crumbs.
        let (ra, rb) = (ra.max(THINNEST), rb.max(THINNEST));
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
    // It looks past the viewer, to the right.
    let ahead = Vec3::new(1.0, -0.02, 0.42).normalize();
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
    c.egg([0.0, 0.12, 0.1], [0.80, 0.72, 0.95], 0.3);
    // The muzzle dips behind the nose and rises to it.
    c.limb([0.0, 0.26, 0.6], 0.50, [0.0, 0.16, 1.45], 0.34, 0.25);
    c.limb([0.0, 0.14, 1.4], 0.33, [0.0, 0.18, 2.05], 0.29, 0.15);
    c.egg([0.0, 0.40, 2.12], [0.30, 0.24, 0.30], 0.10);
    c.egg([0.0, 0.06, 2.10], [0.42, 0.17, 0.34], 0.08);
    // The upper lip rolls out over the teeth, and dips under the nose.
    for side in [-1.0, 1.0] {
        c.strand(
            &[
                [0.0, 0.08, 2.46],
                [0.24 * side, 0.02, 2.40],
                [0.44 * side, -0.05, 2.08],
                [0.46 * side, 0.03, 1.65],
                [0.54 * side, 0.05, 1.20],
                [0.64 * side, -0.10, 0.80],
            ],
            0.085,
            0.105,
            0.03,
        );
    }
    // Ridges over the muzzle, each a shallow chevron.
    for i in 0..5 {
        let z = 0.98 + 0.21 * i as f32;
        let y = 0.66 - 0.075 * i as f32 + 0.018 * (i * i) as f32;
        for x in [-0.36, 0.36] {
            c.limb(
                [x, y - 0.20, z - 0.05],
                0.045,
                [0.0, y, z + 0.08],
                0.070,
                0.025,
            );
        }
    }
}

fn jaw(c: &mut Carver) {
    // Dropped open about 30 degrees.
    for side in [-1.0, 1.0] {
        c.limb(
            [0.44 * side, -0.42, 0.25],
            0.29,
            [0.27 * side, -0.94, 1.5],
            0.15,
            0.2,
        );
        // Lower lip.
        c.strand(
            &[
                [0.52 * side, -0.50, 0.70],
                [0.38 * side, -0.74, 1.25],
                [0.26 * side, -0.88, 1.75],
                [0.0, -0.92, 1.92],
            ],
            0.08,
            0.08,
            0.03,
        );
    }
    c.limb([0.0, -0.74, 0.55], 0.26, [0.0, -1.06, 1.65], 0.19, 0.2);
    c.egg([0.0, -1.02, 1.74], [0.31, 0.17, 0.26], 0.12);
    // Beard: locks of several lengths that part and curl forwards.
    for i in 0..7 {
        let x = 0.115 * (i as f32 - 3.0);
        let long = 1.0 - 0.35 * (i as f32 - 3.0).abs() / 3.0 - 0.2 * (i % 2) as f32;
        let z = 1.62 - 0.28 * (i % 3) as f32;
        c.strand(
            &[
                [x, -1.08, z],
                [1.3 * x, -1.08 - 0.40 * long, z - 0.08],
                [1.8 * x, -1.08 - 0.78 * long, z - 0.20],
                [2.3 * x, -1.08 - 1.08 * long, z - 0.12],
                [2.5 * x, -1.08 - 1.22 * long, z + 0.06],
            ],
            0.115,
            0.02,
            0.015,
        );
    }
    // Spikes along the jaw.
    for side in [-1.0, 1.0] {
        for i in 0..5 {
            let k = i as f32;
            let root = [side * (0.62 - 0.06 * k), -0.44 - 0.11 * k, 0.12 + 0.27 * k];
            c.limb(
                root,
                0.13,
                [root[0] + 0.26 * side, root[1] - 0.26, root[2] - 0.42],
                0.02,
                0.02,
            );
        }
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
    // Nostril with a flared wing that curls back.
    c.egg([0.25 * side, 0.38, 2.26], [0.19, 0.18, 0.20], 0.05);
    c.strand(
        &[
            [0.20 * side, 0.46, 2.46],
            [0.38 * side, 0.56, 2.28],
            [0.46 * side, 0.46, 2.06],
            [0.44 * side, 0.30, 2.00],
        ],
        0.085,
        0.06,
        0.02,
    );
    c.hollow([0.36 * side, 0.42, 2.34], [0.13, 0.11, 0.15], 0.03);
    // Eye in its socket under a heavy brow, with lids and a drilled pupil.
    c.hollow([0.62 * side, 0.44, 0.98], [0.30, 0.24, 0.32], 0.05);
    c.egg([0.50 * side, 0.43, 0.95], [0.235, 0.225, 0.235], 0.0);
    for (y, lift) in [(0.43, 0.20), (0.43, -0.19)] {
        c.strand(
            &[
                [0.46 * side, y, 1.23],
                [0.66 * side, y + lift * 0.8, 1.10],
                [0.72 * side, y + lift, 0.90],
                [0.66 * side, y + 0.04, 0.66],
            ],
            0.055,
            0.065,
            0.02,
        );
    }
    c.hollow([0.70 * side, 0.43, 1.07], [0.075, 0.085, 0.075], 0.01);
    c.strand(
        &[
            [0.22 * side, 0.62, 1.34],
            [0.46 * side, 0.76, 1.14],
            [0.74 * side, 0.80, 0.86],
            [0.92 * side, 0.88, 0.52],
            [1.06 * side, 1.10, 0.26],
        ],
        0.17,
        0.04,
        0.03,
    );
    // Tufts of the brow.
    for i in 0..3 {
        let k = i as f32;
        c.limb(
            [(0.52 + 0.17 * k) * side, 0.80 + 0.02 * k, 1.02 - 0.22 * k],
            0.10,
            [(0.64 + 0.20 * k) * side, 1.12 + 0.03 * k, 0.72 - 0.26 * k],
            0.02,
            0.02,
        );
    }
    // Cheek bone, and the hollow under it.
    c.egg([0.66 * side, 0.0, 0.50], [0.26, 0.26, 0.40], 0.12);
    c.hollow([0.74 * side, -0.30, 0.72], [0.14, 0.12, 0.22], 0.05);
    // Whisker: from beside the nose out and down, then up in a curl.
    let whisker: Vec<[f32; 3]> = (0..16)
        .map(|i| {
            let t = i as f32 / 15.0;
            let swing = on_circle(-1.6 + 4.4 * t);
            [
                side * (0.40 + 1.05 * t),
                0.14 + 0.62 * (swing.y + 1.0) * t - 0.55 * sin(3.0 * t),
                2.12 - 0.30 * t + 0.25 * swing.x * t,
            ]
        })
        .collect();
    c.strand(&whisker, 0.085, 0.025, 0.02);
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

/// Locks of hair that stream back from cheek and nape in three tiers, parted from each
/// other, each curling at its end.
fn mane(c: &mut Carver, side: f32) {
    for tier in 0..3 {
        for i in 0..7 {
            let (row, k) = (tier as f32, i as f32);
            let angle = -1.25 + 0.40 * k + 0.2 * (row - 1.0);
            let root = on_circle(angle) * (0.72 + 0.05 * row);
            let length = 1.75 - 0.06 * (k - 2.5) * (k - 2.5) - 0.12 * row;
            let curl = 0.42 * sin(2.1 * k + 1.3 * row + if side > 0.0 { 0.0 } else { 0.7 });
            let lock: Vec<[f32; 3]> = (0..9)
                .map(|j| {
                    let t = j as f32 / 8.0;
                    let out = 1.0 + 0.85 * t;
                    [
                        side * (root.x * out + 0.12 * sin(5.0 * t + k)),
                        root.y * out + 0.1 + curl * t * t + 0.12 * sin(6.0 * t + row),
                        0.10 - 0.42 * row - length * t,
                    ]
                })
                .collect();
            c.strand(&lock, 0.185, 0.03, 0.012);
        }
    }
}
