//! The exact distribution of Cochran's Q where it is cheap to write out.
//!
//! Under the null hypothesis each participant's votes for b could as well have fallen on any other
//! of the conditions, independently of the other participants (Cochran 1950). Q rises
//! with the sum of the squared votes by condition, so that this sum is what is compared. Which
//! condition is which does not matter for it: states that are permutations of each other are one.

use std::collections::BTreeMap;

use crate::analysis::tails::Probability;

/// Give up past so many steps: some hundredths of a second.
const MOST_STEPS: usize = 100_000;

/// P(Q ≥ observed): `columns` are the votes for b by condition, `participants[r]` how many
/// participants gave b r votes. `None` where there are too many ways.
pub fn p(columns: &[u64], participants: &[u64]) -> Option<Probability> {
    let k = columns.len();
    let discordant: u64 = participants.get(1..k)?.iter().sum();
    // Sums of squares then stay exact, and more would run past the steps anyway.
    if k > 16 || discordant > 2000 {
        return None;
    }
    // Who chose alike everywhere gives every condition the same: taken out.
    let everywhere = participants.get(k).copied().unwrap_or(0);
    let observed: u64 = (columns.iter())
        .map(|c| c.saturating_sub(everywhere).pow(2))
        .sum();
    let mut states = BTreeMap::from([(vec![0_u64; k], 1.0_f64)]);
    let mut steps = 0;
    for (votes, count) in participants.iter().enumerate().take(k).skip(1) {
        let ways = subsets(k, votes);
        for _ in 0..*count {
            let mut following = BTreeMap::new();
            steps += states.len() * ways.len();
            if steps > MOST_STEPS {
                return None;
            }
            for (state, mass) in &states {
                for way in &ways {
                    let mut next = state.clone();
                    for (column, chosen) in next.iter_mut().zip(0..) {
                        *column += u64::from(way >> chosen & 1);
                    }
                    next.sort_unstable();
                    *following.entry(next).or_insert(0.0) += mass / ways.len() as f64;
                }
            }
            states = following;
        }
    }
    let mass: f64 = (states.iter())
        .filter(|(state, _)| state.iter().map(|c| c * c).sum::<u64>() >= observed)
        .map(|(_, mass)| mass)
        .sum();
    Some(Probability::from_ln(mass.ln()))
}

/// Every choice of `size` of `k` conditions, as bits.
fn subsets(k: usize, size: usize) -> Vec<u32> {
    (0..1_u32 << k)
        .filter(|bits| bits.count_ones() as usize == size)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three participants, one vote each, all for the same of three conditions: 3 of 27 ways.
    #[test]
    fn counted_by_hand() {
        let p = p(&[3, 0, 0], &[0, 3, 0, 0]).unwrap();
        assert!((p.value() - 1.0 / 9.0).abs() < 1e-15);
    }

    /// Who chose alike everywhere changes nothing.
    #[test]
    fn concordant_participants_do_not_count() {
        let with = p(&[9, 6, 6], &[5, 3, 0, 6]).unwrap();
        assert!((with.value() - 1.0 / 9.0).abs() < 1e-15);
    }

    #[test]
    fn too_many_ways_are_given_up() {
        assert_eq!(p(&[100; 7], &[0, 100, 100, 100, 25, 0, 0, 0]), None);
        assert_eq!(p(&[5000, 1, 1], &[0, 5002, 0, 0]), None);
    }
}
