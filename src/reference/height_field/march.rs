//! Where a ray meets a height field.
//!
//! Over a triangle the field is linear, and so is the ray: it can meet the field only between two
//! crossings with the lines that the triangles' edges draw on the ground, columns, rows and
//! diagonals. Squares that lie below the ray as a whole are passed over at once.

use glam::{Vec2, Vec3};

use super::field::{BLOCK, Border, HeightField};

/// A field this much above a ray, in texels, is the ray's own surface: rounding.
const ROUNDING: f32 = 1e-4;

/// Fields that a ray passes over before it is free: along a row or diagonal of a tiled field it could
/// go on at nearly the same height for ever.
const TILES: f32 = 32.0;

/// What a ray comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Met {
    /// Nothing: the sky.
    Sky,
    /// The texel nearest to where it meets the field.
    Texel(u32),
}

/// A ray from a texel, on its way.
struct Ray<'a> {
    field: &'a HeightField,
    /// Of the start.
    column: i64,
    row: i64,
    z: f32,
    direction: Vec3,
}

impl HeightField {
    /// What a ray from a texel meets along a unit direction.
    #[must_use]
    pub fn meets(&self, (x, y): (usize, usize), direction: Vec3) -> Met {
        let ray = Ray {
            field: self,
            column: x as i64,
            row: y as i64,
            z: self.at(x, y),
            direction,
        };
        ray.met()
    }
}

impl Ray<'_> {
    /// Place on the ground, relative to the start, at a distance.
    fn place(&self, t: f32) -> Vec2 {
        self.direction.truncate() * t
    }

    fn height(&self, t: f32) -> f32 {
        self.z + self.direction.z * t
    }

    fn met(&self) -> Met {
        let across = self.direction.truncate();
        if across.length_squared() < 1e-12 {
            return match self.direction.z > 0.0 {
                true => Met::Sky,
                false => self.texel(0.0),
            };
        }
        let end = self.leaves();
        let mut from = 0.0;
        loop {
            // Above everything, and rising.
            if self.direction.z >= 0.0 && self.height(from) >= self.field.highest() {
                return Met::Sky;
            }
            let block = Block::of(self, from);
            let to = block.leaves(self, from).min(end);
            let lowest = self.height(from).min(self.height(to));
            if lowest <= block.highest(self.field)
                && let Some(t) = self.met_between(&block, from, to)
            {
                return self.texel(t);
            }
            if to >= end {
                return Met::Sky;
            }
            from = to;
        }
    }

    /// Where it leaves an open field, or has passed over a tiled one often enough.
    fn leaves(&self) -> f32 {
        if self.field.border() == Border::Tiled {
            let side = self.field.width().max(self.field.height()) as f32;
            return TILES * side / self.direction.truncate().length();
        }
        let of = |from: i64, size: usize, step: f32| {
            let border = if step > 0.0 {
                size as i64 - 1 - from
            } else {
                -from
            };
            match step == 0.0 {
                true => f32::INFINITY,
                false => border as f32 / step,
            }
        };
        of(self.column, self.field.width(), self.direction.x).min(of(
            self.row,
            self.field.height(),
            self.direction.y,
        ))
    }

    /// The distance at which the field of a block is first met, between two others.
    fn met_between(&self, block: &Block, from: f32, to: f32) -> Option<f32> {
        let d = self.direction;
        let mut crossings = [
            Crossings::new(d.x, from),
            Crossings::new(d.y, from),
            Crossings::new(d.x + d.y, from),
        ];
        let mut before = (from, block.gap(self, from));
        if before.1 > ROUNDING && from > 0.0 {
            return Some(from);
        }
        loop {
            let mut next = 0;
            for other in 1..3 {
                if crossings[other].t < crossings[next].t {
                    next = other;
                }
            }
            let t = crossings[next].t.min(to);
            let gap = block.gap(self, t);
            if gap > ROUNDING {
                let share = -before.1 / (gap - before.1);
                return Some(before.0 + (t - before.0) * share.clamp(0.0, 1.0));
            }
            if t >= to {
                return None;
            }
            before = (t, gap);
            crossings[next].next();
        }
    }

    /// The texel nearest to a distance.
    fn texel(&self, t: f32) -> Met {
        let place = self.place(t);
        let of = |from: i64, offset: f32, size: usize| {
            let at = from + offset.round() as i64;
            match self.field.border() {
                Border::Tiled => at.rem_euclid(size as i64),
                Border::Open => at.clamp(0, size as i64 - 1),
            }
        };
        let (width, height) = (self.field.width(), self.field.height());
        let (x, y) = (
            of(self.column, place.x, width),
            of(self.row, place.y, height),
        );
        // A field has no more texels than a link can count.
        Met::Texel((y * width as i64 + x) as u32)
    }
}

/// A square of the ground that a ray crosses.
struct Block {
    /// Its corner, relative to the ray's start, whole texels.
    corner: Vec2,
    /// The same in the padded heights.
    x: usize,
    y: usize,
}

impl Block {
    /// The one that a ray is in from a distance on.
    fn of(ray: &Ray<'_>, t: f32) -> Self {
        let place = ray.place(t);
        let side = BLOCK as i64;
        let corner = |start: i64, at: f32, step: f32| {
            // On the line between two blocks, the one that it goes into.
            let nearest = at.round();
            let cell = match (at - nearest).abs() < 1e-3 {
                true if step < 0.0 => nearest as i64 - 1,
                true => nearest as i64,
                false => at.floor() as i64,
            };
            (start + cell).div_euclid(side) * side
        };
        let (x, y) = (
            corner(ray.column, place.x, ray.direction.x),
            corner(ray.row, place.y, ray.direction.y),
        );
        let wrapped = |at: i64, size: usize| match ray.field.border() {
            Border::Tiled => at.rem_euclid(size as i64) as usize,
            Border::Open => at.clamp(0, size as i64 - 1) as usize,
        };
        Self {
            corner: Vec2::new((x - ray.column) as f32, (y - ray.row) as f32),
            x: wrapped(x, ray.field.width()),
            y: wrapped(y, ray.field.height()),
        }
    }

    fn highest(&self, field: &HeightField) -> f32 {
        field.highest_of_block(self.x, self.y)
    }

    /// Where a ray leaves it; farther than `from`.
    fn leaves(&self, ray: &Ray<'_>, from: f32) -> f32 {
        let side = BLOCK as f32;
        let of = |corner: f32, step: f32| match step {
            step if step > 0.0 => (corner + side) / step,
            step if step < 0.0 => corner / step,
            _ => f32::INFINITY,
        };
        let out = of(self.corner.x, ray.direction.x).min(of(self.corner.y, ray.direction.y));
        // Rounding at a corner must not stop the ray, however far it has come.
        out.max(from + 1e-3 + 4.0 * f32::EPSILON * from)
    }

    /// How far the field stands above the ray at a distance.
    fn gap(&self, ray: &Ray<'_>, t: f32) -> f32 {
        let within = (ray.place(t) - self.corner).clamp(Vec2::ZERO, Vec2::splat(BLOCK as f32));
        let cell = within.floor().min(Vec2::splat(BLOCK as f32 - 1.0));
        let part = within - cell;
        let stride = ray.field.stride();
        let at = (self.y + cell.y as usize) * stride + self.x + cell.x as usize;
        let heights = ray.field.padded();
        let (here, right) = (heights[at], heights[at + 1]);
        let (below, opposite) = (heights[at + stride], heights[at + stride + 1]);
        let field = if part.x + part.y <= 1.0 {
            here + (right - here) * part.x + (below - here) * part.y
        } else {
            opposite + (below - opposite) * (1.0 - part.x) + (right - opposite) * (1.0 - part.y)
        };
        field - ray.height(t)
    }
}

/// Distances at which a coordinate that grows evenly from 0 is a whole number.
#[derive(Clone, Copy)]
struct Crossings {
    step: f32,
    number: f32,
    t: f32,
}

impl Crossings {
    /// The first beyond a distance.
    fn new(step: f32, from: f32) -> Self {
        let mut crossings = Self {
            step,
            number: 0.0,
            t: f32::INFINITY,
        };
        if step != 0.0 {
            let at = step * from;
            crossings.number = if step > 0.0 { at.floor() } else { at.ceil() };
            crossings.next();
            if crossings.t <= from {
                crossings.next();
            }
        }
        crossings
    }

    fn next(&mut self) {
        self.number += 1.0_f32.copysign(self.step);
        self.t = self.number / self.step;
    }
}
