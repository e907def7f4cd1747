//! Where the joints are. Metres; the origin is on the ground between the feet, the
//! figure faces +z, its left is +x. Pairs are [right, left].

use glam::{Mat3, Vec3};

use crate::scene::modelling::Frame;
use crate::scene::modelling::math::rotation;

/// A standing person.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    pub hips: [Vec3; 2],
    pub knees: [Vec3; 2],
    pub ankles: [Vec3; 2],
    /// Which way the feet point (unit, level).
    pub toes: [Vec3; 2],
    pub waist: Vec3,
    pub chest: Vec3,
    pub neck: Vec3,
    pub shoulders: [Vec3; 2],
    pub elbows: [Vec3; 2],
    pub wrists: [Vec3; 2],
    /// Which way the hands point from the wrist, and which way their palms face (unit).
    pub fingers: [Vec3; 2],
    pub palms: [Vec3; 2],
    /// How far the fingers are bent, 0 straight to 1 a fist.
    pub grip: [f32; 2],
    /// Eye level, middle of the head.
    pub head: Frame,
}

fn v(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

fn looking(at: Vec3, turn_rad: f32, nod_rad: f32, tilt_rad: f32) -> Frame {
    let axes: Mat3 =
        rotation(Vec3::Y, turn_rad) * rotation(Vec3::X, nod_rad) * rotation(Vec3::Z, tilt_rad);
    Frame { origin_m: at, axes }
}

impl Pose {
    /// 1.80 m; weight on the right leg, the right hand at the strap on his chest.
    pub fn man() -> Self {
        Self {
            hips: [v(-0.115, 0.945, 0.0), v(0.075, 0.925, 0.01)],
            knees: [v(-0.120, 0.505, 0.02), v(0.145, 0.50, 0.085)],
            ankles: [v(-0.115, 0.09, -0.035), v(0.195, 0.09, 0.045)],
            toes: [
                v(-0.22, 0.0, 1.0).normalize(),
                v(0.50, 0.0, 1.0).normalize(),
            ],
            waist: v(-0.022, 1.10, 0.0),
            chest: v(-0.008, 1.32, -0.005),
            neck: v(0.0, 1.515, -0.028),
            shoulders: [v(-0.174, 1.430, -0.02), v(0.175, 1.440, -0.02)],
            elbows: [v(-0.285, 1.172, 0.035), v(0.262, 1.185, -0.045)],
            wrists: [v(-0.115, 1.235, 0.215), v(0.278, 0.935, 0.045)],
            fingers: [
                v(0.75, 0.55, -0.2).normalize(),
                v(0.02, -0.96, 0.22).normalize(),
            ],
            palms: [
                v(0.1, -0.35, -0.9).normalize(),
                v(-0.95, 0.0, 0.1).normalize(),
            ],
            grip: [0.85, 0.35],
            head: looking(v(0.002, 1.685, 0.012), 0.18, 0.02, -0.02),
        }
    }

    /// 1.70 m; weight on the left leg, the right hand on her hip.
    pub fn woman() -> Self {
        Self {
            hips: [v(-0.075, 0.880, 0.01), v(0.108, 0.900, 0.0)],
            knees: [v(-0.135, 0.475, 0.085), v(0.098, 0.485, 0.02)],
            ankles: [v(-0.175, 0.085, 0.05), v(0.100, 0.085, -0.03)],
            toes: [
                v(-0.45, 0.0, 1.0).normalize(),
                v(0.18, 0.0, 1.0).normalize(),
            ],
            waist: v(0.020, 1.055, 0.0),
            chest: v(0.008, 1.245, 0.0),
            neck: v(0.0, 1.425, -0.025),
            shoulders: [v(-0.148, 1.366, -0.02), v(0.150, 1.353, -0.02)],
            elbows: [v(-0.345, 1.165, -0.055), v(0.232, 1.110, -0.055)],
            wrists: [v(-0.198, 0.995, 0.055), v(0.250, 0.878, 0.020)],
            fingers: [
                v(0.42, -0.45, 0.62).normalize(),
                v(0.0, -0.97, 0.16).normalize(),
            ],
            palms: [
                v(0.75, -0.25, -0.55).normalize(),
                v(-0.96, 0.0, 0.1).normalize(),
            ],
            grip: [0.25, 0.4],
            head: looking(v(0.004, 1.588, 0.012), -0.25, 0.0, 0.03),
        }
    }
}
