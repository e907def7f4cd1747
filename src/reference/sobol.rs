//! Low-discrepancy points: the first two dimensions of Sobol's sequence, Owen-scrambled.
//!
//! The scrambling is by a hash of the bits above each bit (Laine & Karras 2011; as in Burley
//! 2020, "Practical Hash-based Owen Scrambling"; with the constants of Vegdahl 2021, "Building
//! a Better LK Hash"). Every prefix of 2^k points stays a (0, k, 2)-net: one point in each box
//! of area 2^-k with sides that are powers of two. Differently seeded points are independent.

/// The second dimension's numbers with their bits reversed, for the first `count` points. (The
/// first dimension's, reversed, are 0, 1, 2, ….)
#[derive(Debug, Clone)]
pub struct Sobol {
    second: Vec<u32>,
}

/// Two seeds, one a dimension.
#[derive(Debug, Clone, Copy)]
pub struct Scramble {
    first: u32,
    second: u32,
}

impl Scramble {
    /// The scrambling of one series of points: `base` is drawn from the seed on record, and
    /// every (`pixel`, `replicate`) gets its own.
    #[must_use]
    pub fn new(base: u64, pixel: u64, replicate: u64) -> Self {
        let bits = mix(mix(base ^ mix(pixel)).wrapping_add(replicate));
        Self {
            first: (bits >> 32) as u32,
            second: bits as u32,
        }
    }
}

/// The finaliser of `SplitMix64` (Steele, Lea & Flood 2014), after its increment.
pub(super) fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

impl Sobol {
    /// Room for `count` points.
    #[must_use]
    pub fn new(count: usize) -> Self {
        // Direction numbers of the second dimension: v(k+1) = v(k) xor v(k)/2, reversed.
        let mut directions = [1_u32; 32];
        for k in 1..32 {
            directions[k] = directions[k - 1] ^ (directions[k - 1] << 1);
        }
        let mut second = vec![0_u32; count];
        for index in 1..count {
            let lowest = index.trailing_zeros() as usize;
            second[index] = second[index & (index - 1)] ^ directions[lowest];
        }
        Self { second }
    }

    /// Number of points there is room for.
    #[must_use]
    pub fn len(&self) -> usize {
        self.second.len()
    }

    /// Whether there is no point.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.second.is_empty()
    }

    /// A point of the unit square, each coordinate in [0, 1).
    ///
    /// # Panics
    /// If there is no room for `index`.
    #[must_use]
    #[inline]
    pub fn point(&self, index: usize, scramble: Scramble) -> [f32; 2] {
        [
            unit(scrambled(index as u32, scramble.first)),
            unit(scrambled(self.second[index], scramble.second)),
        ]
    }
}

/// Owen-scrambles a number given with its bits reversed; what comes back is not reversed.
#[inline]
fn scrambled(reversed: u32, seed: u32) -> u32 {
    let mut x = reversed;
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// The upper 24 bits as a number in [0, 1).
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1_u32 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sequence itself, without scrambling: Joe & Kuo's tables begin so.
    #[test]
    fn the_second_dimension_begins_as_published() {
        let sobol = Sobol::new(8);
        let values: Vec<f32> = sobol
            .second
            .iter()
            .map(|bits| unit(bits.reverse_bits()))
            .collect();
        assert_eq!(values, [0.0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875]);
    }

    /// A (0, k, 2)-net: each elementary box of area 2^-k holds exactly one of 2^k points.
    #[test]
    fn every_prefix_of_a_power_of_two_is_a_net() {
        for seed in 0..20 {
            for k in 0..=8_u32 {
                let count = 1_usize << k;
                let sobol = Sobol::new(count);
                let scramble = Scramble::new(seed, 17, seed);
                for columns_log2 in 0..=k {
                    let (columns, rows) = (1 << columns_log2, 1 << (k - columns_log2));
                    let mut boxes = vec![0; count];
                    for index in 0..count {
                        let [x, y] = sobol.point(index, scramble);
                        let column = (x * columns as f32) as usize;
                        let row = (y * rows as f32) as usize;
                        boxes[row * columns + column] += 1;
                    }
                    assert!(boxes.iter().all(|&held| held == 1), "{seed} {k} {boxes:?}");
                }
            }
        }
    }

    /// Each scrambled point by itself is even over the square, so that estimates have no bias.
    #[test]
    fn any_one_point_is_even_over_the_square() {
        let sobol = Sobol::new(4);
        for index in [0, 3] {
            let mut counts = [0_u32; 64];
            for pixel in 0..64_000 {
                let [x, y] = sobol.point(index, Scramble::new(1, pixel, 5));
                counts[(y * 8.0) as usize * 8 + (x * 8.0) as usize] += 1;
            }
            let chi2: f64 = counts
                .iter()
                .map(|&c| (f64::from(c) - 1000.0).powi(2) / 1000.0)
                .sum();
            // 63 degrees of freedom: 103.4 is the 0.1 % point.
            assert!(chi2 < 103.4, "{chi2}");
        }
    }
}
