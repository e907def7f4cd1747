//! Rays through a depth buffer: the best answer that can be had from what a screen-space
//! technique is given.
//!
//! The buffer is taken for a height field: neighbouring samples are joined by triangles, and
//! everything behind them is solid, to any thickness, or to one and the same everywhere. A ray that
//! leaves the picture, or comes before the near plane, is open: nothing is known there.
//!
//! On the picture a ray is a straight line along which 1/depth is linear, and so it is over a
//! triangle. A ray therefore meets the field only between two crossings with the lines that
//! the triangles' edges draw on the picture: columns, rows, and one diagonal of each square of
//! four samples.

use glam::{DMat3, DVec2, DVec3, Vec3};

use super::occlusion::Surroundings;
use crate::scene::VisibleSurfaces;
use crate::scene::visible::PixelProjection;

/// Rounding of the stored depths, relative: a surface this little in front is the ray's own.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// A depth buffer as a height field.
#[derive(Debug)]
pub struct ScreenSpace<'a> {
    surfaces: &'a VisibleSurfaces,
    projection: PixelProjection,
    view_from_world: DMat3,
    /// 1/depth of each sample, 1/m; 0 where there is no surface.
    inverse_depth: Vec<f32>,
    size_px: [i64; 2],
    /// The nearest sample's.
    largest: f64,
    /// How deep what is seen goes on behind what is seen of it, metres.
    thickness_m: f64,
}

/// The start of a pixel's rays.
#[derive(Debug, Clone, Copy)]
pub struct PixelStart {
    /// On the picture, in samples.
    place: DVec2,
    /// The view-space point at depth 1 m in this direction.
    towards: DVec3,
    depth_m: f64,
}

/// A ray on the picture. `s` runs from 0 at its start; with t the distance in metres, z the
/// depth and d the direction's part along the view, s = t / z.
struct Line {
    place: DVec2,
    step: DVec2,
    inverse_depth: f64,
    /// Change of 1/depth with s.
    slope: f64,
    end: f64,
}

impl<'a> ScreenSpace<'a> {
    /// The height field of what a camera sees.
    #[must_use]
    pub fn new(surfaces: &'a VisibleSurfaces) -> Self {
        let projection = surfaces.projection();
        let inverse_depth: Vec<f32> = (0..surfaces.len())
            .map(|pixel| {
                if surfaces.has_surface(pixel) {
                    1.0 / surfaces.depth_m[pixel]
                } else {
                    0.0
                }
            })
            .collect();
        let largest = inverse_depth.iter().copied().fold(0.0, f32::max);
        Self {
            surfaces,
            view_from_world: DMat3::from_mat4(projection.view_from_world),
            projection,
            inverse_depth,
            size_px: [i64::from(surfaces.width_px), i64::from(surfaces.height_px)],
            largest: f64::from(largest),
            thickness_m: f64::INFINITY,
        }
    }

    /// The same where what is seen goes on so many metres behind what is seen of it, and rays
    /// pass farther behind. Samples farther apart than this in depth are not joined.
    #[must_use]
    pub fn with_thickness_m(mut self, thickness_m: f32) -> Self {
        self.thickness_m = f64::from(thickness_m);
        self
    }

    /// Whether a ray that lies behind the field by `gap` (1/m) at `s` has passed beyond its
    /// thickness.
    fn is_beyond(&self, line: &Line, s: f64, gap: f64) -> bool {
        let ray = line.inverse_depth + line.slope * s;
        let field = (gap + ray) / (1.0 - ROUNDING);
        // A ray beyond infinity is beyond everything that is not solid to there.
        self.thickness_m.is_finite() && (ray <= 0.0 || 1.0 / ray - 1.0 / field > self.thickness_m)
    }

    fn line(&self, start: &PixelStart, direction: Vec3, reach_m: f32) -> Line {
        let direction = self.view_from_world * direction.as_dvec3();
        // Depth gained a metre.
        let deeper = -direction.z;
        let across = direction.truncate() - start.towards.truncate() * deeper;
        let near_m = f64::from(self.surfaces.camera.near_m);
        let mut end = match f64::from(reach_m) {
            reach_m if reach_m.is_finite() => reach_m / (start.depth_m + reach_m * deeper),
            _ if deeper > 0.0 => 1.0 / deeper,
            _ => f64::INFINITY,
        };
        if deeper < 0.0 {
            // Up to the near plane, and no farther than the nearest surface.
            let nearest_m = near_m.max(1.0 / self.largest).min(start.depth_m);
            let before_nearest = (start.depth_m - nearest_m) / -deeper / nearest_m;
            if end < 0.0 || end > before_nearest {
                end = before_nearest;
            }
        }
        let mut line = Line {
            place: start.place,
            step: self.projection.to_px(across),
            inverse_depth: 1.0 / start.depth_m,
            slope: -deeper / start.depth_m,
            end,
        };
        line.end = line.end.min(line.leaves(self.size_px));
        line
    }

    /// 1/depth of the field at a place, known to lie on an edge between two samples.
    fn between(&self, from: [i64; 2], to: [i64; 2], share: f64) -> f64 {
        let at = |[x, y]: [i64; 2]| {
            let (x, y) = (
                x.clamp(0, self.size_px[0] - 1),
                y.clamp(0, self.size_px[1] - 1),
            );
            f64::from(self.inverse_depth[(y * self.size_px[0] + x) as usize])
        };
        at(from) * (1.0 - share) + at(to) * share
    }

    /// How far the field stands before the line (1/m) where it crosses a line of `family`.
    fn gap(&self, line: &Line, family: usize, s: f64, crossed: f64) -> f64 {
        let place = line.place + line.step * s;
        let field = match family {
            // A column, and a row: between the samples above and below, left and right.
            0 => {
                let (x, y) = (crossed as i64, place.y.floor());
                self.between([x, y as i64], [x, y as i64 + 1], place.y - y)
            }
            1 => {
                let (x, y) = (place.x.floor(), crossed as i64);
                self.between([x as i64, y], [x as i64 + 1, y], place.x - x)
            }
            // A diagonal x + y: between a square's upper right and lower left samples.
            _ => {
                let x = place.x.floor();
                let (x, y) = (x as i64, (crossed - x) as i64);
                self.between([x, y], [x + 1, y - 1], place.x - x as f64)
            }
        };
        let ray = line.inverse_depth + line.slope * s;
        field * (1.0 - ROUNDING) - ray
    }

    /// Where on a line the field is first met, in its own s.
    fn met(&self, line: &Line) -> Option<f64> {
        if line.step == DVec2::ZERO {
            // Straight away from the eye, into the surface itself; or straight towards it.
            return (line.slope < 0.0).then_some(0.0);
        }
        let mut crossings = [
            Crossings::new(line.place.x, line.step.x),
            Crossings::new(line.place.y, line.step.y),
            Crossings::new(line.place.x + line.place.y, line.step.x + line.step.y),
        ];
        let mut before = (0.0, 0.0);
        loop {
            let mut family = 0;
            for other in 1..3 {
                if crossings[other].s < crossings[family].s {
                    family = other;
                }
            }
            let Crossings { s, at, .. } = crossings[family];
            if !s.is_finite() {
                return None;
            }
            let gap = self.gap(line, family, s, at);
            if gap > 0.0 && !self.is_beyond(line, s, gap) {
                // Both are linear in between; a ray that comes back from behind is met here. At
                // its very end a ray meets nothing any more: to infinity, what is there is the sky.
                let share = match before.1 > 0.0 {
                    true => 1.0,
                    false => -before.1 / (gap - before.1),
                };
                let met = before.0 + (s - before.0) * share.clamp(0.0, 1.0);
                return (met < line.end * (1.0 - 1e-9)).then_some(met);
            }
            if s >= line.end {
                return None;
            }
            before = (s, gap);
            crossings[family].next();
        }
    }
}

/// Crossings of a line with the whole numbers of one coordinate.
#[derive(Debug, Clone, Copy)]
struct Crossings {
    from: f64,
    step: f64,
    /// The number crossed next, and where.
    at: f64,
    s: f64,
}

impl Crossings {
    /// From a start that is a whole number itself, which is not counted.
    fn new(from: f64, step: f64) -> Self {
        let mut crossings = Self {
            from,
            step,
            at: from,
            s: f64::INFINITY,
        };
        if step != 0.0 {
            crossings.next();
        }
        crossings
    }

    fn next(&mut self) {
        self.at += 1.0_f64.copysign(self.step);
        self.s = (self.at - self.from) / self.step;
    }
}

impl Line {
    /// Where it leaves the picture.
    fn leaves(&self, size_px: [i64; 2]) -> f64 {
        let mut end = f64::INFINITY;
        for (axis, &size_px) in size_px.iter().enumerate() {
            let (from, step) = (self.place[axis], self.step[axis]);
            let border = if step > 0.0 {
                size_px as f64 - 1.0
            } else {
                0.0
            };
            if step != 0.0 {
                end = end.min((border - from) / step);
            }
        }
        end
    }

    /// The distance of a point of the ray, metres.
    fn distance_m(&self, s: f64) -> f64 {
        // z = z₀ + t d, s = t / z, and the slope is −d / z₀.
        let inverse_depth = self.inverse_depth + self.slope * s;
        if inverse_depth > 0.0 {
            s / inverse_depth
        } else {
            f64::INFINITY
        }
    }
}

impl Surroundings for ScreenSpace<'_> {
    type Start = PixelStart;

    fn len(&self) -> usize {
        self.surfaces.len()
    }

    fn start(&self, pixel: usize) -> Option<(PixelStart, Vec3)> {
        if !self.surfaces.has_surface(pixel) {
            return None;
        }
        let place = self.projection.place_of(pixel);
        let start = PixelStart {
            place,
            towards: self.projection.ray_through(place),
            depth_m: f64::from(self.surfaces.depth_m[pixel]),
        };
        Some((start, self.surfaces.normals[pixel]))
    }

    fn is_blocked(&self, start: &PixelStart, direction: Vec3, reach_m: f32) -> bool {
        self.met(&self.line(start, direction, reach_m)).is_some()
    }

    fn nearest_m(&self, start: &PixelStart, direction: Vec3, reach_m: f32) -> Option<f32> {
        let line = self.line(start, direction, reach_m);
        let s = self.met(&line)?;
        Some(line.distance_m(s) as f32)
    }
}
