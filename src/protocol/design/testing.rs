//! What the designs' tests have in common.

use std::collections::HashSet;

use super::{Design, InnerOrder};

/// Every condition once in every row and once in every place.
pub fn is_latin(square: &[Vec<usize>]) -> bool {
    let n = square.len();
    let all: HashSet<usize> = (0..n).collect();
    (0..n).all(|i| {
        square[i].len() == n
            && square[i].iter().copied().collect::<HashSet<_>>() == all
            && square.iter().map(|row| row[i]).collect::<HashSet<_>>() == all
    })
}

/// The conditions of a session in the order shown.
pub fn session_conditions(design: &Design, n: usize, seed: u64, slot: u32) -> Vec<usize> {
    let session = (design.order)(n, seed, slot, InnerOrder::Within);
    session.iter().map(|place| place.condition).collect()
}
