//! A Latin square: over n participants every condition stands once in every place.

use rand_chacha::ChaCha20Rng;

use super::{Design, InnerOrder, Place};
use crate::seed;

/// The thesis' design: participants `0…n−1` of a block take the rows of one Latin square,
/// `n…2n−1` the same rows with every pair the other way round; after `2n` a new square is
/// drawn.
pub const LATIN: Design = Design {
    name: "latin",
    summary: "rows of a Latin square: n participants, n mirrored, then a new square",
    order,
    block_slots: |conditions| Some(2 * conditions),
};

fn order(conditions: usize, seed: u64, slot: u32, inner_order: InnerOrder) -> Vec<Place> {
    let slot = slot as usize;
    let block = (slot / (2 * conditions)) as u64;
    let rows = square(conditions, seed, block);
    inner_order.session_of_block(&rows, (seed, block), slot % (2 * conditions))
}

/// A Latin square of order `n`, drawn evenly from all there are:
/// `square[row][place]` is a condition.
///
/// Shuffling a cyclic square alone would not do: it only ever gives squares in
/// which one condition follows another all through a column pair.
fn square(n: usize, seed: u64, block: u64) -> Vec<Vec<usize>> {
    let mut rng = seed::generator(seed, "latin-square", block);
    let mut cube = Cube::shuffled_cyclic(n, &mut rng);
    // Only the chain of proper squares is even; to stop at the first one after a
    // number of moves would favour squares with long improper ways behind them.
    // They lie about n moves apart, which makes n³ moves in all.
    for _ in 0..n * n {
        cube.step(&mut rng);
        while cube.improper.is_some() {
            cube.step(&mut rng);
        }
    }
    cube.square()
}

/// A cell: row, place, condition.
type Cell = [usize; 3];

/// A square as its incidence cube: 1 where `condition` stands at (`row`,
/// `place`), 0 elsewhere; every line of cells sums to 1. An improper square has
/// one cell of −1. Random moves between neighbouring squares reach all of them
/// evenly: Jacobson & Matthews, "Generating uniformly distributed random Latin
/// squares", J. Combin. Des. 4 (1996).
struct Cube {
    n: usize,
    cells: Vec<i8>,
    improper: Option<Cell>,
}

impl Cube {
    /// The cyclic square with rows, places and conditions shuffled: a start that
    /// has no parity of its own (for n = 2 every move flips the square).
    fn shuffled_cyclic(n: usize, rng: &mut ChaCha20Rng) -> Self {
        let mut shuffled = || {
            let mut items: Vec<usize> = (0..n).collect();
            seed::shuffle(rng, &mut items);
            items
        };
        let (rows, places, conditions) = (shuffled(), shuffled(), shuffled());
        let mut cube = Self {
            n,
            cells: vec![0; n * n * n],
            improper: None,
        };
        for row in 0..n {
            for place in 0..n {
                let condition = conditions[(rows[row] + places[place]) % n];
                cube.add([row, place, condition], 1);
            }
        }
        cube
    }

    fn at(&self, [row, place, condition]: Cell) -> i8 {
        self.cells[(row * self.n + place) * self.n + condition]
    }

    fn add(&mut self, [row, place, condition]: Cell, change: i8) {
        self.cells[(row * self.n + place) * self.n + condition] += change;
    }

    /// One move of the Markov chain.
    fn step(&mut self, rng: &mut ChaCha20Rng) {
        if self.n < 2 {
            return;
        }
        let from = self.improper.unwrap_or_else(|| self.empty_cell(rng));
        let to = [0, 1, 2].map(|axis| self.one_along(axis, from, rng));
        // The eight corners of the box between `from` and `to` change sign in turn.
        for corner in 0..8_u8 {
            let far = [0, 1, 2].map(|axis| corner >> axis & 1 == 1);
            let cell = [0, 1, 2].map(|axis| if far[axis] { to[axis] } else { from[axis] });
            let change = if corner.count_ones() % 2 == 0 { 1 } else { -1 };
            self.add(cell, change);
        }
        self.improper = (self.at(to) < 0).then_some(to);
    }

    /// A cell of 0, each as likely as any other.
    fn empty_cell(&self, rng: &mut ChaCha20Rng) -> Cell {
        loop {
            let cell = [(); 3].map(|()| draw(rng, self.n));
            if self.at(cell) == 0 {
                return cell;
            }
        }
    }

    /// Where a 1 stands on the line through `cell` along `axis`. There is one
    /// through an empty cell, and two through the cell of −1: either, then.
    fn one_along(&self, axis: usize, cell: Cell, rng: &mut ChaCha20Rng) -> usize {
        let mut ones = (0..self.n).filter(|&index| {
            let mut other = cell;
            other[axis] = index;
            self.at(other) == 1
        });
        let first = ones.next().unwrap_or(cell[axis]);
        match ones.next() {
            Some(second) if draw(rng, 2) == 1 => second,
            _ => first,
        }
    }

    fn square(&self) -> Vec<Vec<usize>> {
        let condition_at = |row, place| (0..self.n).find(|&c| self.at([row, place, c]) == 1);
        (0..self.n)
            .map(|row| {
                (0..self.n)
                    .filter_map(|place| condition_at(row, place))
                    .collect()
            })
            .collect()
    }
}

fn draw(rng: &mut ChaCha20Rng, bound: usize) -> usize {
    seed::below(rng, u32::try_from(bound).unwrap_or(u32::MAX)) as usize
}

#[cfg(test)]
mod tests {
    use std::collections::{HashMap, HashSet};

    use proptest::prelude::*;

    use super::super::testing::is_latin;
    use super::*;

    fn thesis(n: usize, seed: u64, slot: u32) -> Vec<Place> {
        order(n, seed, slot, InnerOrder::Block)
    }

    fn conditions(places: &[Place]) -> Vec<usize> {
        places.iter().map(|place| place.condition).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn a_block_is_a_latin_square_twice_the_second_time_reversed(
            n in 2_usize..=26, seed: u64, block in 0_u32..1000,
        ) {
            let block_start = block * 2 * u32::try_from(n).unwrap();
            let rows: Vec<Vec<Place>> =
                (0..2 * n).map(|r| thesis(n, seed, block_start + u32::try_from(r).unwrap())).collect();
            let base: Vec<Vec<usize>> = rows[..n].iter().map(|row| conditions(row)).collect();
            let again: Vec<Vec<usize>> = rows[n..].iter().map(|row| conditions(row)).collect();
            prop_assert!(is_latin(&base));
            prop_assert_eq!(base, again);
            prop_assert!(rows[..n].iter().flatten().all(|place| !place.reversed));
            prop_assert!(rows[n..].iter().flatten().all(|place| place.reversed));
        }
    }

    #[test]
    fn every_block_and_every_seed_draws_a_new_square() {
        // From n = 5 on there are 161,280 squares or more.
        for n in 5..=26 {
            let squares: HashSet<_> = (0..4)
                .map(|block| square(n, 1, block))
                .chain([square(n, 2, 0)])
                .collect();
            assert_eq!(squares.len(), 5, "n = {n}");
        }
    }

    /// There are 12 squares of order 3. Chi-square with 11 degrees of freedom:
    /// 31.26 is the 0.1 % point.
    #[test]
    fn all_squares_of_order_3_are_drawn_evenly() {
        let mut counts: HashMap<Vec<Vec<usize>>, f64> = HashMap::new();
        for block in 0..6000 {
            *counts.entry(square(3, 5, block)).or_default() += 1.0;
        }
        assert_eq!(counts.len(), 12);
        let chi2: f64 = counts.values().map(|c| (c - 500.0).powi(2) / 500.0).sum();
        assert!(chi2 < 31.26, "{chi2}");
    }

    /// Of the 576 squares of order 4, 144 are of the Klein four-group's kind, which
    /// no shuffling of a cyclic square reaches. The number of 2×2 sub-squares
    /// (intercalates) tells them apart: 12 in the Klein group's table, 4 in the
    /// cyclic group's.
    #[test]
    fn a_quarter_of_the_squares_of_order_4_are_not_shuffled_cyclic_ones() {
        let intercalates = |square: &[Vec<usize>]| {
            let pairs = || (0..4).flat_map(|a| (a + 1..4).map(move |b| (a, b)));
            pairs()
                .flat_map(|rows| pairs().map(move |places| (rows, places)))
                .filter(|&((r, s), (p, q))| {
                    square[r][p] == square[s][q] && square[r][q] == square[s][p]
                })
                .count()
        };
        let mut klein = 0;
        for block in 0..4000 {
            match intercalates(&square(4, 9, block)) {
                12 => klein += 1,
                4 => {}
                other => panic!("{other} intercalates"),
            }
        }
        // 1000 ± 4 standard deviations of a binomial with p = 1/4.
        assert!((890..=1110).contains(&klein), "{klein}");
    }
}
