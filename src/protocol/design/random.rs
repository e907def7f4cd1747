//! Everybody's own random order: nothing is balanced but by chance.

use super::{Design, InnerOrder, Place};
use crate::seed;

/// Each slot a shuffle of its own.
pub const RANDOM: Design = Design {
    name: "random",
    summary: "each participant an own shuffle, nothing balanced between participants: for comparison and piloting only",
    order,
    block_slots: |_| None,
};

fn order(conditions: usize, seed: u64, slot: u32, inner_order: InnerOrder) -> Vec<Place> {
    let mut rng = seed::generator(seed, "random-order", u64::from(slot));
    let mut row: Vec<usize> = (0..conditions).collect();
    seed::shuffle(&mut rng, &mut row);
    inner_order.session_alone(&row, seed, slot)
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;

    /// 24 orders of four conditions times 6 choices of the two that are reversed.
    /// Chi-square with 143 degrees of freedom: 198.3 is the 0.15 % point.
    #[test]
    fn all_orders_and_choices_of_reversed_pairs_come_evenly() {
        let mut counts: HashMap<Vec<Place>, f64> = HashMap::new();
        for slot in 0..14_400 {
            let session = order(4, 11, slot, InnerOrder::Within);
            *counts.entry(session).or_default() += 1.0;
        }
        assert_eq!(counts.len(), 144);
        let chi2: f64 = counts.values().map(|c| (c - 100.0).powi(2) / 100.0).sum();
        assert!(chi2 < 198.3, "{chi2}");
    }

    #[test]
    fn inner_orders_by_block_take_turns() {
        for slot in 0..20 {
            let session = order(5, 3, slot, InnerOrder::Block);
            assert!(
                session
                    .iter()
                    .all(|place| place.reversed == (slot % 2 == 1))
            );
        }
    }
}
