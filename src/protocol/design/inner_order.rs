//! Which of a pair's two images comes first: in which sessions, and in which trials of one.

use rand_chacha::ChaCha20Rng;
use serde::{Deserialize, Serialize};

use super::Place;
use crate::seed;

/// How the reversed pairs are spread over the sessions.
///
/// Either way the second half of a block goes through the orders of the first again with
/// every pair the other way round. So over a block every condition is reversed in half of
/// the sessions, and so it is at each position where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum InnerOrder {
    /// By whole participants, as in the thesis: the first half of a block sees every pair
    /// in its base order, the second half every pair reversed.
    Block,
    /// Within each participant: half of the pairs of every session are reversed.
    #[default]
    Within,
}

impl InnerOrder {
    /// Both, in the order they are offered.
    pub const ALL: [Self; 2] = [Self::Block, Self::Within];

    /// Name in a protocol.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Block => "block",
            Self::Within => "within",
        }
    }

    /// The way of this name.
    ///
    /// # Errors
    /// What was found and what is allowed.
    pub fn named(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|order| order.name() == name);
        found.ok_or_else(|| format!("found {name:?}, allowed is block, within"))
    }

    /// A session of a block: the first half takes `rows` one by one (`rows[row][place]` is a
    /// condition), the second half takes them again, mirrored.
    pub(super) fn session_of_block(
        self,
        rows: &[Vec<usize>],
        (seed, block): (u64, u64),
        in_block: usize,
    ) -> Vec<Place> {
        let row = in_block % rows.len();
        let mirrored = in_block >= rows.len();
        let first_half = match self {
            Self::Block => vec![false; rows[row].len()],
            Self::Within => {
                let mut rng = seed::generator(seed, "inner-order", block);
                Pattern::drawn(rows, &mut rng).reversed.swap_remove(row)
            }
        };
        let place = |&condition: &usize| Place {
            condition,
            reversed: first_half[condition] != mirrored,
        };
        rows[row].iter().map(place).collect()
    }

    /// A session of a design without blocks, each with a draw of its own. Without a block
    /// whose halves could differ, `block` goes by turns: every other participant.
    pub(super) fn session_alone(self, row: &[usize], seed: u64, slot: u32) -> Vec<Place> {
        let reversed = match self {
            Self::Block => vec![slot % 2 == 1; row.len()],
            Self::Within => {
                let mut rng = seed::generator(seed, "inner-order", u64::from(slot));
                let count = half(row.len(), &mut rng);
                let mut reversed: Vec<bool> = (0..row.len()).map(|i| i < count).collect();
                seed::shuffle(&mut rng, &mut reversed);
                reversed
            }
        };
        let place = |(&condition, reversed)| Place {
            condition,
            reversed,
        };
        row.iter().zip(reversed).map(place).collect()
    }
}

/// Half of a number; of an odd one either neighbour of its half.
fn half(count: usize, rng: &mut ChaCha20Rng) -> usize {
    let odd_one = if count % 2 == 1 { draw(rng, 2) } else { 0 };
    count / 2 + odd_one
}

/// Which conditions are reversed in which row of a block's first half.
struct Pattern<'a> {
    rows: &'a [Vec<usize>],
    /// `[row][condition]`
    reversed: Vec<Vec<bool>>,
}

impl<'a> Pattern<'a> {
    /// A random one in which every row has half of its conditions reversed, and every
    /// condition is reversed in half of the rows (of an odd number, one of the two nearest
    /// to the half). Then random exchanges between two rows that leave both as they are
    /// but even out the positions, so that half a block is not far off either.
    fn drawn(rows: &'a [Vec<usize>], rng: &mut ChaCha20Rng) -> Self {
        let mut pattern = Self::start(rows, rng);
        let mut surplus = pattern.surplus_by_place();
        let conditions = rows[0].len();
        // Each exchange moves 4 of the rows × conditions cells: 16 moves a cell on average.
        for _ in 0..4 * rows.len() * conditions {
            pattern.exchange(&mut surplus, rng);
        }
        pattern
    }

    /// In row r the conditions r, r + 1, … are reversed, counted round the circle of
    /// conditions: half of them. Where that is not a whole number, half of the rows have
    /// one more; these rows follow each other, so that the odd ones differ. Then rows and
    /// conditions are shuffled.
    fn start(rows: &'a [Vec<usize>], rng: &mut ChaCha20Rng) -> Self {
        let conditions = rows[0].len();
        let rows_with_one_more = match conditions % 2 {
            0 => 0,
            _ => half(rows.len(), rng),
        };
        let mut shuffled = |count: usize| {
            let mut items: Vec<usize> = (0..count).collect();
            seed::shuffle(rng, &mut items);
            items
        };
        let (row_order, circle) = (shuffled(rows.len()), shuffled(conditions));
        let row = |&row: &usize| {
            let count = conditions / 2 + usize::from(row < rows_with_one_more);
            let is_reversed = |&at: &usize| (at + row) % conditions < count;
            circle.iter().map(is_reversed).collect()
        };
        Self {
            rows,
            reversed: row_order.iter().map(row).collect(),
        }
    }

    /// By how much the reversed outnumber the others at each place.
    fn surplus_by_place(&self) -> Vec<i32> {
        let mut surplus = vec![0; self.rows[0].len()];
        for (row, reversed) in self.rows.iter().zip(&self.reversed) {
            for (place, &condition) in row.iter().enumerate() {
                surplus[place] += if reversed[condition] { 1 } else { -1 };
            }
        }
        surplus
    }

    /// Two rows exchange two conditions, one that only the first has reversed for one that
    /// only the second has (Ryser's interchange), unless the places get less even by it.
    fn exchange(&mut self, surplus: &mut Vec<i32>, rng: &mut ChaCha20Rng) {
        if self.rows.len() < 2 {
            return;
        }
        let a = draw(rng, self.rows.len());
        let b = (a + 1 + draw(rng, self.rows.len() - 1)) % self.rows.len();
        let (Some(p), Some(q)) = (self.only_in(a, b, rng), self.only_in(b, a, rng)) else {
            return;
        };
        let cells = [(a, p), (a, q), (b, p), (b, q)];
        let mut changed = surplus.clone();
        for (row, condition) in cells {
            let step = if self.reversed[row][condition] { -2 } else { 2 };
            changed[self.place_of(row, condition)] += step;
        }
        let unevenness = |surplus: &[i32]| surplus.iter().map(|s| s * s).sum::<i32>();
        if unevenness(&changed) <= unevenness(surplus) {
            *surplus = changed;
            for (row, condition) in cells {
                self.reversed[row][condition] ^= true;
            }
        }
    }

    /// One of the conditions that are reversed in a row but not in another.
    fn only_in(&self, row: usize, not_in: usize, rng: &mut ChaCha20Rng) -> Option<usize> {
        let (row, not_in) = (&self.reversed[row], &self.reversed[not_in]);
        let found: Vec<usize> = (0..row.len()).filter(|&c| row[c] && !not_in[c]).collect();
        (!found.is_empty()).then(|| found[draw(rng, found.len())])
    }

    fn place_of(&self, row: usize, condition: usize) -> usize {
        let is_it = |&found: &usize| found == condition;
        // Every row has every condition.
        self.rows[row].iter().position(is_it).unwrap_or(0)
    }
}

fn draw(rng: &mut ChaCha20Rng, bound: usize) -> usize {
    seed::below(rng, u32::try_from(bound).unwrap_or(u32::MAX)) as usize
}
