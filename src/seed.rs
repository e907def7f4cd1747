//! Seeded randomness. Every random number in Greyfield comes from a generator
//! made here, so that a seed on record is enough to draw the same numbers again
//! on any machine, forever.
//!
//! The generator is ChaCha20 (RFC 7539 block function, as in `rand_chacha`),
//! named and versioned as [`GENERATOR`]. The sampling on top of the raw words
//! ([`below`], [`shuffle`], [`unit_f64`]) is our own, a few lines, because the
//! sampling helpers of the `rand` crates may change between versions and a
//! participant's order must not.

use rand_chacha::ChaCha20Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};

/// Name and version of the generator and of the sampling on top of it, as it
/// stands in records. Changing any number drawn means a new name.
pub const GENERATOR: &str = "greyfield-chacha20-v1";

/// A generator for one purpose of one seed. `purpose` keeps streams apart (the
/// noise of a renderer must not move when a design draws one number more), and
/// `index` numbers members of a series (block 0, block 1, …).
#[must_use]
pub fn generator(seed: u64, purpose: &str, index: u64) -> ChaCha20Rng {
    let mut hasher = Sha256::new();
    hasher.update(GENERATOR.as_bytes());
    hasher.update(seed.to_le_bytes());
    hasher.update(index.to_le_bytes());
    hasher.update(purpose.as_bytes());
    ChaCha20Rng::from_seed(hasher.finalize().into())
}

/// A whole number drawn evenly from `0..bound` (rejection, no modulo bias).
///
/// # Panics
/// If `bound` is 0: there is nothing to draw from.
pub fn below(rng: &mut ChaCha20Rng, bound: u32) -> u32 {
    assert!(bound > 0, "nothing to draw from: the bound is 0");
    // 2^32 mod bound: words below it would over-represent the small residues.
    let reject_below = bound.wrapping_neg() % bound;
    loop {
        let word = rng.next_u32();
        if word >= reject_below {
            return word % bound;
        }
    }
}

/// Fisher–Yates, from the last place down.
pub fn shuffle<T>(rng: &mut ChaCha20Rng, items: &mut [T]) {
    for last in (1..items.len()).rev() {
        let bound = u32::try_from(last + 1).unwrap_or(u32::MAX);
        items.swap(last, below(rng, bound) as usize);
    }
}

/// A number in [0, 1) with 53 random bits.
pub fn unit_f64(rng: &mut ChaCha20Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// A number in [0, 1) with 24 random bits.
pub fn unit_f32(rng: &mut ChaCha20Rng) -> f32 {
    (rng.next_u32() >> 8) as f32 / (1_u32 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First block of the all-zero key and nonce, RFC 8439 appendix A.1, test vector 1.
    #[test]
    fn chacha20_keystream_is_the_published_one() {
        let mut rng = ChaCha20Rng::from_seed([0; 32]);
        let words: Vec<u32> = (0..4).map(|_| rng.next_u32()).collect();
        assert_eq!(words, [0xade0_b876, 0x903d_f1a0, 0xe56a_5d40, 0x28bd_8653]);
    }

    #[test]
    fn purposes_and_indices_give_different_streams() {
        let first = |purpose, index| generator(1, purpose, index).next_u64();
        assert_ne!(first("design", 0), first("design", 1));
        assert_ne!(first("design", 0), first("noise", 0));
        assert_eq!(first("design", 0), first("design", 0));
    }

    #[test]
    fn below_is_even_and_in_range() {
        let mut rng = generator(3, "test", 0);
        let mut counts = [0_u32; 7];
        for _ in 0..70_000 {
            counts[below(&mut rng, 7) as usize] += 1;
        }
        // Chi-square with 6 degrees of freedom: 22.46 is the 0.1 % point.
        let chi2: f64 = counts
            .iter()
            .map(|&c| (f64::from(c) - 10_000.0).powi(2) / 10_000.0)
            .sum();
        assert!(chi2 < 22.46, "{counts:?}");
    }

    #[test]
    fn shuffle_keeps_the_items() {
        let mut items: Vec<u32> = (0..100).collect();
        shuffle(&mut generator(9, "test", 0), &mut items);
        assert_ne!(items, (0..100).collect::<Vec<_>>());
        items.sort_unstable();
        assert_eq!(items, (0..100).collect::<Vec<_>>());
    }

    #[test]
    fn unit_numbers_stay_below_one() {
        let mut rng = generator(5, "test", 0);
        for _ in 0..10_000 {
            assert!((0.0..1.0).contains(&unit_f64(&mut rng)));
            assert!((0.0..1.0).contains(&unit_f32(&mut rng)));
        }
    }
}
