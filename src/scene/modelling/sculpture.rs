//! A sculpture: bodies melted together, with relief carved into their surfaces.

use glam::Vec3;

use super::math::{Frame, smoothstep};
use super::sdf::{Shape, smooth_carve, smooth_union};

/// How far the surface stands out (metres) at a point in its part's own frame.
pub type Relief = Box<dyn Fn(Vec3) -> f32 + Send + Sync>;

/// One body of a sculpture.
pub struct Part {
    frame: Frame,
    shape: Shape,
    blend_m: f32,
    carves: bool,
    relief: Option<(Relief, f32)>,
    centre_m: Vec3,
    radius_m: f32,
}

impl Part {
    /// A body in its place, added sharply.
    #[must_use]
    pub fn new(frame: Frame, shape: Shape) -> Self {
        let (centre, radius_m) = shape.bounding_sphere_m();
        Self {
            frame,
            shape,
            blend_m: 0.0,
            carves: false,
            relief: None,
            centre_m: frame.point(centre),
            radius_m,
        }
    }

    /// An ellipsoid in its place.
    #[must_use]
    pub fn ellipsoid(frame: Frame, radii_m: Vec3) -> Self {
        Self::new(frame, Shape::Ellipsoid { radii_m })
    }

    /// A ball.
    #[must_use]
    pub fn ball(centre_m: Vec3, radius_m: f32) -> Self {
        Self::ellipsoid(Frame::at(centre_m), Vec3::splat(radius_m))
    }

    /// A limb from `a` to `b` with its radius at both ends; its frame has y along it
    /// and z towards `front`.
    #[must_use]
    pub fn limb(a: (Vec3, f32), b: (Vec3, f32), front: Vec3) -> Self {
        Self::new(
            Frame::along(a.0, b.0 - a.0, front),
            Shape::RoundCone {
                length_m: a.0.distance(b.0),
                start_radius_m: a.1,
                end_radius_m: b.1,
            },
        )
    }

    /// A block with rounded edges.
    #[must_use]
    pub fn block(frame: Frame, half_m: Vec3, round_m: f32) -> Self {
        Self::new(frame, Shape::Block { half_m, round_m })
    }

    /// Melts into what is there within `blend_m`.
    #[must_use]
    pub fn blended(mut self, blend_m: f32) -> Self {
        self.blend_m = blend_m;
        self
    }

    /// Takes away instead of adding.
    #[must_use]
    pub fn carving(mut self) -> Self {
        self.carves = true;
        self
    }

    /// Raises the surface by `relief` of the point in this part's frame, never by
    /// more than `limit_m` either way.
    #[must_use]
    pub fn with_relief(
        mut self,
        limit_m: f32,
        relief: impl Fn(Vec3) -> f32 + Send + Sync + 'static,
    ) -> Self {
        self.radius_m += limit_m;
        self.relief = Some((Box::new(relief), limit_m));
        self
    }

    fn distance_m(&self, p: Vec3) -> f32 {
        let local = self.frame.local(p);
        let d = self.shape.distance_m(local);
        match &self.relief {
            // Far from the part's own surface (inside a blend, say) its relief fades out:
            // it cannot be told there, and is the dear part.
            Some((relief, limit)) if d.abs() < 4.0 * limit => {
                let fade = smoothstep(4.0 * limit, 2.0 * limit, d.abs());
                d - fade * relief(local)
            }
            Some(_) => d,
            None => d,
        }
    }
}

/// Bodies joined in order.
#[derive(Default)]
pub struct Sculpture {
    parts: Vec<Part>,
}

impl Sculpture {
    /// Nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a body.
    pub fn add(&mut self, part: Part) {
        self.parts.push(part);
    }

    /// Adds several.
    pub fn extend(&mut self, parts: impl IntoIterator<Item = Part>) {
        self.parts.extend(parts);
    }

    /// Corners of a box round all bodies that add, metres.
    #[must_use]
    pub fn bounds_m(&self) -> (Vec3, Vec3) {
        self.parts.iter().filter(|part| !part.carves).fold(
            (Vec3::splat(f32::MAX), Vec3::splat(f32::MIN)),
            |(low, high), part| {
                let reach = Vec3::splat(part.radius_m + 0.25 * part.blend_m);
                (
                    low.min(part.centre_m - reach),
                    high.max(part.centre_m + reach),
                )
            },
        )
    }

    /// Signed distance at `p`, metres, all parts looked at.
    #[must_use]
    pub fn distance_m(&self, p: Vec3) -> f32 {
        self.join(p, self.parts.iter())
    }

    /// Signed distance at `p` from the parts in `near` only (see [`Sculpture::near`]).
    #[must_use]
    pub fn distance_among_m(&self, p: Vec3, near: &[u16]) -> f32 {
        self.join(p, near.iter().map(|&i| &self.parts[i as usize]))
    }

    fn join<'a>(&self, p: Vec3, parts: impl Iterator<Item = &'a Part>) -> f32 {
        parts.fold(f32::MAX, |so_far, part| {
            let reach = p.distance(part.centre_m) - part.radius_m;
            if part.carves {
                if reach > part.blend_m - so_far {
                    return so_far;
                }
                return smooth_carve(so_far, part.distance_m(p), part.blend_m);
            }
            // Beyond the blend a further part changes nothing.
            if reach > so_far + part.blend_m {
                return so_far;
            }
            smooth_union(so_far, part.distance_m(p), part.blend_m)
        })
    }

    /// The parts that can shape the surface within `radius_m` of `centre_m`. A part left
    /// out is further from every point there than its blend reaches.
    #[must_use]
    pub fn near(&self, centre_m: Vec3, radius_m: f32) -> Vec<u16> {
        (0..self.parts.len())
            .filter(|&i| {
                let part = &self.parts[i];
                let gap = centre_m.distance(part.centre_m) - part.radius_m;
                gap <= 1.01 * radius_m + part.blend_m
            })
            .filter_map(|i| u16::try_from(i).ok())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn snowman() -> Sculpture {
        let mut s = Sculpture::new();
        s.add(Part::ball(Vec3::ZERO, 0.5));
        s.add(Part::ball(Vec3::Y * 0.7, 0.35).blended(0.1));
        s.add(Part::ball(Vec3::Y * 1.2, 0.25).blended(0.05));
        s.add(
            Part::ball(Vec3::new(0.0, 1.2, 0.25), 0.06)
                .carving()
                .blended(0.02),
        );
        s
    }

    proptest! {
        /// Leaving the far parts out moves no surface: signs within the radius agree.
        #[test]
        fn near_parts_are_enough(c in prop::array::uniform3(-1.5_f32..1.5), o in prop::array::uniform3(-0.05_f32..0.05)) {
            let s = snowman();
            let (centre, offset) = (Vec3::from(c), Vec3::from(o));
            let near = s.near(centre, 0.1);
            let (all, some) = (s.distance_m(centre + offset), s.distance_among_m(centre + offset, &near));
            prop_assert!(all.signum() == some.signum() || all.abs() < 1e-6);
            if all.abs() < 0.01 {
                prop_assert!((all - some).abs() < 1e-6, "{all} {some}");
            }
        }
    }

    #[test]
    fn carving_takes_away() {
        let s = snowman();
        assert!(s.distance_m(Vec3::new(0.0, 1.2, 0.22)) > 0.0);
        assert!(s.distance_m(Vec3::new(0.0, 1.2, -0.22)) < 0.0);
    }
}
