//! Gradient and cell noise from an integer hash, so that every machine draws the
//! same (Perlin 2002 for the fade, Worley 1996 for the cells).

use glam::{IVec2, IVec3, Vec2, Vec3};

use crate::seed;

/// One source of noise: the same seed, purpose and index give the same field.
#[derive(Debug, Clone, Copy)]
pub struct Noise {
    salt: u32,
}

/// The nearest points of a jittered grid round a place; see [`Noise::cells`].
#[derive(Debug, Clone, Copy)]
pub struct Cell {
    /// Distance to the nearest point, in cells.
    pub nearest: f32,
    /// Distance to the second nearest, in cells.
    pub second: f32,
    /// A number in [0, 1) that belongs to the nearest point.
    pub id: f32,
}

fn fade(t: Vec3) -> Vec3 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

impl Noise {
    /// A field of its own for each (seed, purpose, index).
    #[must_use]
    pub fn new(seed: u64, purpose: &str, index: u64) -> Self {
        let mut generator = seed::generator(seed, purpose, index);
        Self {
            salt: seed::below(&mut generator, u32::MAX),
        }
    }

    /// 32 well-mixed bits for a lattice point ("lowbias32", Ettinger 2018).
    fn hash(self, p: IVec3) -> u32 {
        let mut x = self.salt
            ^ p.x.cast_unsigned().wrapping_mul(0x8da6_b343)
            ^ p.y.cast_unsigned().wrapping_mul(0xd816_3841)
            ^ p.z.cast_unsigned().wrapping_mul(0xcb1a_b31f);
        x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
        x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
        x ^ (x >> 16)
    }

    /// A number in [0, 1) for a lattice point.
    #[must_use]
    pub fn at(self, p: IVec3) -> f32 {
        (self.hash(p) >> 8) as f32 / (1_u32 << 24) as f32
    }

    fn slope(self, lattice: IVec3, offset: Vec3) -> f32 {
        // The twelve edge directions of a cube, four of them twice (Perlin 2002). From a table,
        // because a branch taken at random is the dearest part of noise.
        const DIRECTIONS: [Vec3; 16] = [
            Vec3::new(1.0, 1.0, 0.0),
            Vec3::new(-1.0, 1.0, 0.0),
            Vec3::new(1.0, -1.0, 0.0),
            Vec3::new(-1.0, -1.0, 0.0),
            Vec3::new(1.0, 0.0, 1.0),
            Vec3::new(-1.0, 0.0, 1.0),
            Vec3::new(1.0, 0.0, -1.0),
            Vec3::new(-1.0, 0.0, -1.0),
            Vec3::new(0.0, 1.0, 1.0),
            Vec3::new(0.0, -1.0, 1.0),
            Vec3::new(0.0, 1.0, -1.0),
            Vec3::new(0.0, -1.0, -1.0),
            Vec3::new(1.0, 1.0, 0.0),
            Vec3::new(-1.0, 1.0, 0.0),
            Vec3::new(0.0, -1.0, 1.0),
            Vec3::new(0.0, -1.0, -1.0),
        ];
        DIRECTIONS[(self.hash(lattice) & 15) as usize].dot(offset)
    }

    /// Gradient noise in three dimensions, about −1 to 1, features of size 1.
    #[must_use]
    pub fn gradient(self, p: Vec3) -> f32 {
        let floor = p.floor();
        let (base, f) = (floor.as_ivec3(), p - floor);
        let w = fade(f);
        let corner = |x: i32, y: i32, z: i32| {
            let step = IVec3::new(x, y, z);
            self.slope(base + step, f - step.as_vec3())
        };
        let along_x = |y, z| {
            let (a, b) = (corner(0, y, z), corner(1, y, z));
            a + (b - a) * w.x
        };
        let along_y = |z| {
            let (a, b) = (along_x(0, z), along_x(1, z));
            a + (b - a) * w.y
        };
        let (a, b) = (along_y(0), along_y(1));
        a + (b - a) * w.z
    }

    /// `octaves` of gradient noise, each twice as fine and half as strong; about −1 to 1.
    #[must_use]
    pub fn fbm(self, p: Vec3, octaves: u32) -> f32 {
        (0..octaves)
            .map(|i| {
                let scale = (1_u32 << i) as f32;
                self.gradient(p * scale + Vec3::splat(17.3 * i as f32)) / scale
            })
            .sum()
    }

    /// Gradient noise over the unit square that repeats in both directions, with
    /// `cells` features across.
    #[must_use]
    pub fn tiling(self, uv: Vec2, cells: IVec2) -> f32 {
        let p = uv * cells.as_vec2();
        let floor = p.floor();
        let (base, f) = (floor.as_ivec2(), p - floor);
        let w = fade(f.extend(0.0));
        // Wrapped once; a neighbour is at most one further.
        let wrap = |l: i32, cells: i32| if l == cells { 0 } else { l };
        let base = IVec2::new(base.x.rem_euclid(cells.x), base.y.rem_euclid(cells.y));
        let corner = |x: i32, y: i32| {
            let step = IVec2::new(x, y);
            let l = base + step;
            let wrapped = IVec3::new(wrap(l.x, cells.x), wrap(l.y, cells.y), 0);
            // Eight directions of about one length.
            const DIRECTIONS: [Vec2; 8] = [
                Vec2::new(1.0, 1.0),
                Vec2::new(1.0, -1.0),
                Vec2::new(-1.0, 1.0),
                Vec2::new(-1.0, -1.0),
                Vec2::new(1.4, 0.0),
                Vec2::new(-1.4, 0.0),
                Vec2::new(0.0, 1.4),
                Vec2::new(0.0, -1.4),
            ];
            DIRECTIONS[(self.hash(wrapped) & 7) as usize].dot(f - step.as_vec2())
        };
        let along_x = |y| {
            let (a, b) = (corner(0, y), corner(1, y));
            a + (b - a) * w.x
        };
        let (a, b) = (along_x(0), along_x(1));
        a + (b - a) * w.y
    }

    /// Octaves of [`Noise::tiling`].
    #[must_use]
    pub fn tiling_fbm(self, uv: Vec2, cells: IVec2, octaves: u32) -> f32 {
        (0..octaves)
            .map(|i| {
                let scale = 1 << i;
                self.tiling(uv, cells * scale) / scale as f32
            })
            .sum()
    }

    /// Cell noise over the unit square that repeats, `cells` points across.
    #[must_use]
    pub fn cells(self, uv: Vec2, cells: IVec2) -> Cell {
        let p = uv * cells.as_vec2();
        let base = p.floor().as_ivec2();
        let mut found = Cell {
            nearest: f32::MAX,
            second: f32::MAX,
            id: 0.0,
        };
        for y in -1..=1 {
            for x in -1..=1 {
                let cell = base + IVec2::new(x, y);
                let key = IVec3::new(cell.x.rem_euclid(cells.x), cell.y.rem_euclid(cells.y), 0);
                let jitter = Vec2::new(self.at(key + IVec3::Z), self.at(key + 2 * IVec3::Z));
                let distance = (cell.as_vec2() + jitter - p).length();
                if distance < found.nearest {
                    found.second = found.nearest;
                    found.nearest = distance;
                    found.id = self.at(key);
                } else {
                    found.second = found.second.min(distance);
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn noise_is_zero_on_the_lattice_and_varies_between() {
        let noise = Noise::new(1, "test", 0);
        assert_eq!(noise.gradient(Vec3::new(3.0, -2.0, 7.0)), 0.0);
        let values: Vec<f32> = (0..200)
            .map(|i| noise.gradient(Vec3::new(i as f32 * 0.37, 0.4, 0.7)))
            .collect();
        let low = values.iter().copied().fold(f32::MAX, f32::min);
        let high = values.iter().copied().fold(f32::MIN, f32::max);
        assert!(low < -0.3 && high > 0.3, "{low} {high}");
    }

    proptest! {
        #[test]
        fn tiling_noise_repeats(x in 0.0_f32..1.0, y in 0.0_f32..1.0, seed: u64) {
            let noise = Noise::new(seed, "test", 0);
            let cells = IVec2::new(4, 8);
            let here = noise.tiling(Vec2::new(x, y), cells);
            let next = noise.tiling(Vec2::new(x + 1.0, y - 1.0), cells);
            prop_assert!((here - next).abs() < 1e-4, "{here} {next}");
            prop_assert!(here.abs() <= 1.5);
        }

        #[test]
        fn the_nearest_cell_is_the_nearest(x in 0.0_f32..1.0, y in 0.0_f32..1.0) {
            let cell = Noise::new(3, "test", 0).cells(Vec2::new(x, y), IVec2::splat(5));
            prop_assert!(cell.nearest <= cell.second);
            prop_assert!((0.0..1.0).contains(&cell.id));
        }
    }
}
