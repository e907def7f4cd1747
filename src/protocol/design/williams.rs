//! A Williams design: besides the places, what follows what is balanced.

use super::{Design, InnerOrder, Place};
use crate::seed;

/// Every condition stands equally often in every place and equally often right after every
/// other: with an even number n of conditions over n participants, with an odd one over 2n.
///
/// E. J. Williams, "Experimental designs balanced for the estimation of residual effects of
/// treatments", Australian Journal of Scientific Research A 2 (1949); J. V. Bradley,
/// "Complete counterbalancing of immediate sequential effects in a Latin square design",
/// Journal of the American Statistical Association 53 (1958).
pub const WILLIAMS: Design = Design {
    name: "williams",
    summary: "rows of a Williams square (a pair of squares if n is odd): places and what follows what are balanced",
    order,
    block_slots: |conditions| Some(2 * rows_in_all(conditions)),
};

fn order(conditions: usize, seed: u64, slot: u32, inner_order: InnerOrder) -> Vec<Place> {
    let slot = slot as usize;
    let block_slots = 2 * rows_in_all(conditions);
    let block = (slot / block_slots) as u64;
    let rows = rows(conditions, seed, block);
    inner_order.session_of_block(&rows, (seed, block), slot % block_slots)
}

const fn rows_in_all(conditions: usize) -> usize {
    match conditions % 2 {
        0 => conditions,
        _ => 2 * conditions,
    }
}

/// The square of a block, or both squares one after the other: `rows[row][place]` is a
/// condition. Conditions are relabelled, and the rows of each square shuffled; the squares
/// stay apart, so that n participants are enough for balanced places.
fn rows(n: usize, seed: u64, block: u64) -> Vec<Vec<usize>> {
    let mut rng = seed::generator(seed, "williams-square", block);
    let mut labels: Vec<usize> = (0..n).collect();
    seed::shuffle(&mut rng, &mut labels);
    let zigzag = zigzag(n);
    let square = |first_row: &[usize]| -> Vec<Vec<usize>> {
        let row = |shift| {
            first_row
                .iter()
                .map(|at| labels[(at + shift) % n])
                .collect()
        };
        (0..n).map(row).collect()
    };
    let mut rows = square(&zigzag);
    seed::shuffle(&mut rng, &mut rows);
    if n % 2 == 1 {
        let backwards: Vec<usize> = zigzag.into_iter().rev().collect();
        let mut second = square(&backwards);
        seed::shuffle(&mut rng, &mut second);
        rows.append(&mut second);
    }
    rows
}

/// 0, 1, n − 1, 2, n − 2, …: for even n the steps from one to the next, round the circle of
/// n, are all different. For odd n they are the odd numbers below n, each twice, and those of
/// the same row backwards are the even ones.
fn zigzag(n: usize) -> Vec<usize> {
    let at = |place: usize| match place % 2 {
        1 => place.div_ceil(2),
        _ => (n - place / 2) % n,
    };
    (0..n).map(at).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use proptest::prelude::*;

    use super::super::testing::{is_latin, session_conditions};
    use super::*;

    /// How often `next` comes right after `condition`: `[condition][next]`.
    fn followers(rows: &[Vec<usize>]) -> Vec<Vec<u32>> {
        let n = rows[0].len();
        let mut counts = vec![vec![0; n]; n];
        for pair in rows.iter().flat_map(|row| row.windows(2)) {
            counts[pair[0]][pair[1]] += 1;
        }
        counts
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(128))]

        #[test]
        fn every_condition_follows_every_other_equally_often(
            n in 2_usize..=26, seed: u64, block in 0_u32..1000,
        ) {
            let in_all = u32::try_from(rows_in_all(n)).unwrap();
            let start = block * 2 * in_all;
            let half = |from: u32| -> Vec<Vec<usize>> {
                (from..from + in_all)
                    .map(|slot| session_conditions(&WILLIAMS, n, seed, slot))
                    .collect()
            };
            let rows = half(start);
            // The second half of a block is the first again.
            prop_assert_eq!(&rows, &half(start + in_all));
            for square in rows.chunks(n) {
                prop_assert!(is_latin(square));
            }
            let times = if n % 2 == 0 { 1 } else { 2 };
            for (condition, counts) in followers(&rows).iter().enumerate() {
                for (next, &count) in counts.iter().enumerate() {
                    prop_assert_eq!(count, if next == condition { 0 } else { times });
                }
            }
        }
    }

    #[test]
    fn every_block_and_every_seed_draws_a_new_square() {
        for n in 6..=26 {
            let drawn: HashSet<_> = (0..4)
                .map(|block| rows(n, 1, block))
                .chain([rows(n, 2, 0)])
                .collect();
            assert_eq!(drawn.len(), 5, "n = {n}");
        }
    }

    /// Bradley's first row is 1, 2, n, 3, n − 1, …; here it is counted from 0.
    #[test]
    fn the_first_row_is_as_in_the_books() {
        assert_eq!(zigzag(4), [0, 1, 3, 2]);
        assert_eq!(zigzag(5), [0, 1, 4, 2, 3]);
    }

    /// Three conditions have six orders: the pair of squares is all of them.
    #[test]
    fn three_conditions_take_all_six_orders() {
        let orders: HashSet<Vec<usize>> = rows(3, 4, 5).into_iter().collect();
        assert_eq!(orders.len(), 6);
    }
}
