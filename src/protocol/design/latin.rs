//! A Latin square: over n participants every condition stands once in every place.

use super::{Design, Place};
use crate::seed;

/// The thesis' design: participants `0…n−1` of a block take the rows of one
/// Latin square with every pair in its base order, `n…2n−1` the same rows with
/// every pair reversed; after `2n` a new square is drawn.
pub const LATIN: Design = Design {
    name: "latin",
    summary: "rows of a Latin square, n participants in base order, n reversed, then a new square",
    order,
};

fn order(conditions: usize, seed: u64, slot: u32) -> Vec<Place> {
    let slot = slot as usize;
    let block = slot / (2 * conditions);
    let in_block = slot % (2 * conditions);
    let reversed = in_block >= conditions;
    square(conditions, seed, block as u64)[in_block % conditions]
        .iter()
        .map(|&condition| Place {
            condition,
            reversed,
        })
        .collect()
}

/// A Latin square of order `n`: the cyclic square with its rows, columns and
/// symbols shuffled. `square[row][place]` is a condition.
fn square(n: usize, seed: u64, block: u64) -> Vec<Vec<usize>> {
    let mut rng = seed::generator(seed, "latin-square", block);
    let mut shuffled = || {
        let mut items: Vec<usize> = (0..n).collect();
        seed::shuffle(&mut rng, &mut items);
        items
    };
    let (rows, columns, symbols) = (shuffled(), shuffled(), shuffled());
    rows.iter()
        .map(|row| {
            columns
                .iter()
                .map(|column| symbols[(row + column) % n])
                .collect()
        })
        .collect()
}
