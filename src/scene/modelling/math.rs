//! Elementary functions and frames that give the same bits on every machine.

use glam::{Mat3, Vec2, Vec3};

/// Sine of an angle in radians.
#[must_use]
pub fn sin(angle_rad: f32) -> f32 {
    libm::sinf(angle_rad)
}

/// Cosine of an angle in radians.
#[must_use]
pub fn cos(angle_rad: f32) -> f32 {
    libm::cosf(angle_rad)
}

/// Angle of the point (x, y), radians in (−π, π].
#[must_use]
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// `base` to the power `exponent`; a negative base counts as 0.
#[must_use]
pub fn pow(base: f32, exponent: f32) -> f32 {
    libm::powf(base.max(0.0), exponent)
}

/// e to the power `x`.
#[must_use]
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// The point at `angle_rad` on the unit circle.
#[must_use]
pub fn on_circle(angle_rad: f32) -> Vec2 {
    Vec2::new(cos(angle_rad), sin(angle_rad))
}

/// 0 below `low`, 1 above `high`, a smooth cubic step between. `low` may be above
/// `high`: then the step falls.
#[must_use]
pub fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A bump of height 1 at `centre` that falls smoothly to 0 at `centre ± reach`.
#[must_use]
pub fn bump(centre: f32, reach: f32, x: f32) -> f32 {
    let t = 1.0 - ((x - centre) / reach).abs().min(1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Straight line from `a` at 0 to `b` at 1.
#[must_use]
pub fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Rotation about a unit axis, right-handed (Rodrigues).
#[must_use]
pub fn rotation(axis: Vec3, angle_rad: f32) -> Mat3 {
    let (s, c) = (sin(angle_rad), cos(angle_rad));
    let turn = |v: Vec3| v * c + axis.cross(v) * s + axis * (axis.dot(v) * (1.0 - c));
    Mat3::from_cols(turn(Vec3::X), turn(Vec3::Y), turn(Vec3::Z))
}

/// Some unit vector at a right angle to the unit vector `n`.
#[must_use]
pub fn perpendicular(n: Vec3) -> Vec3 {
    let other = if n.x.abs() < 0.7 { Vec3::X } else { Vec3::Y };
    n.cross(other).normalize()
}

/// Catmull-Rom spline through `points` (uniform knots), at `t` in [0, 1] over the
/// whole; the end points are met with the chord's direction.
#[must_use]
pub fn catmull_rom<const N: usize>(points: &[[f32; N]], t: f32) -> [f32; N] {
    let spans = points.len() - 1;
    let along = t.clamp(0.0, 1.0) * spans as f32;
    let span = (along as usize).min(spans - 1);
    let t = along - span as f32;
    let at = |i: usize| &points[i.min(spans)];
    let (p0, p1, p2, p3) = (
        at(span.saturating_sub(1)),
        at(span),
        at(span + 1),
        at(span + 2),
    );
    std::array::from_fn(|k| {
        let (a, b, c, d) = (p0[k], p1[k], p2[k], p3[k]);
        0.5 * (2.0 * b
            + t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a))))
    })
}

/// A right-handed place to build at: where its origin stands and how its axes lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The origin, metres.
    pub origin_m: Vec3,
    /// Columns are the frame's x, y and z axes (unit, orthogonal).
    pub axes: Mat3,
}

impl Frame {
    /// The world's own frame.
    pub const WORLD: Self = Self {
        origin_m: Vec3::ZERO,
        axes: Mat3::IDENTITY,
    };

    /// Axes of the world, origin at `origin_m`.
    #[must_use]
    pub fn at(origin_m: Vec3) -> Self {
        Self {
            origin_m,
            axes: Mat3::IDENTITY,
        }
    }

    /// Origin at `origin_m`, turned about the vertical.
    #[must_use]
    pub fn turned(origin_m: Vec3, about_y_rad: f32) -> Self {
        Self {
            origin_m,
            axes: rotation(Vec3::Y, about_y_rad),
        }
    }

    /// y axis along `along`, z axis as near to `front` as that allows.
    #[must_use]
    pub fn along(origin_m: Vec3, along: Vec3, front: Vec3) -> Self {
        let y = along.normalize();
        let mut x = y.cross(front);
        if x.length_squared() < 1e-12 {
            x = perpendicular(y);
        }
        let x = x.normalize();
        Self {
            origin_m,
            axes: Mat3::from_cols(x, y, x.cross(y)),
        }
    }

    /// A point of this frame, in the parent's coordinates.
    #[must_use]
    pub fn point(&self, local_m: Vec3) -> Vec3 {
        self.origin_m + self.axes * local_m
    }

    /// A direction of this frame, in the parent's coordinates.
    #[must_use]
    pub fn direction(&self, local: Vec3) -> Vec3 {
        self.axes * local
    }

    /// A point of the parent, in this frame's coordinates.
    #[must_use]
    pub fn local(&self, parent_m: Vec3) -> Vec3 {
        let d = parent_m - self.origin_m;
        Vec3::new(
            self.axes.x_axis.dot(d),
            self.axes.y_axis.dot(d),
            self.axes.z_axis.dot(d),
        )
    }

    /// A frame given in this one's coordinates, in the parent's.
    #[must_use]
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            origin_m: self.point(inner.origin_m),
            axes: self.axes * inner.axes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::{FRAC_PI_2, TAU};

    #[test]
    fn rotation_is_right_handed() {
        let turned = rotation(Vec3::Y, FRAC_PI_2) * Vec3::Z;
        assert!((turned - Vec3::X).length() < 1e-6, "{turned}");
    }

    #[test]
    fn a_frame_undoes_itself() {
        let frame = Frame::along(Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, 1.0, 0.2), Vec3::Z);
        let p = Vec3::new(-0.3, 0.7, 2.0);
        assert!((frame.local(frame.point(p)) - p).length() < 1e-5);
        assert!((frame.axes.determinant() - 1.0).abs() < 1e-5);
    }

    #[test]
    fn the_spline_meets_its_points() {
        let points = [[0.0, 1.0], [2.0, 3.0], [5.0, -1.0], [6.0, 0.0]];
        for (i, point) in points.iter().enumerate() {
            let [x, y] = catmull_rom(&points, i as f32 / 3.0);
            assert!((x - point[0]).abs() < 1e-5 && (y - point[1]).abs() < 1e-5);
        }
    }

    #[test]
    fn steps_and_bumps_have_their_ends() {
        assert_eq!(smoothstep(1.0, 2.0, 0.5), 0.0);
        assert_eq!(smoothstep(2.0, 1.0, 0.5), 1.0);
        assert_eq!(bump(3.0, 1.0, 3.0), 1.0);
        assert_eq!(bump(3.0, 1.0, 4.5), 0.0);
        assert!((on_circle(TAU) - Vec2::X).length() < 1e-6);
    }
}
