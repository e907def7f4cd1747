//! Friedman's test: do techniques have different ranks with the same people? With Kendall's
//! coefficient of concordance, which is the same number on another scale.

use super::blocks::Blocks;
use super::statistic::About;
use super::table::Undefined;
use super::tails::{Probability, chi_square_upper, f_upper};

/// The declaration.
pub const ABOUT: About = About {
    id: "friedman",
    name: "Friedman's test with Kendall's W",
    formula: "χ² = (k − 1) Σⱼ (Rⱼ − n (k + 1)/2)² / (Σ r² − n k (k + 1)²/4), R the rank sums of k techniques over n blocks, k − 1 degrees of freedom; F = (n − 1) χ² / (n (k − 1) − χ²); W = χ² / (n (k − 1))",
    source: "M. Friedman (1937), JASA 32(200), 675–701; R. L. Iman & J. M. Davenport (1980), Communications in Statistics A 9(6), 571–595; M. G. Kendall & B. Babington Smith (1939), Annals of Mathematical Statistics 10(3), 275–287",
    validity: "p from the exact permutation distribution, given the ties, where it can be enumerated; else from F, of which chi-square is the cautious approximation. Blocks must be independent: of blocks participant × condition they are not",
};

/// With more sums of ranks to go through than this the exact distribution is left alone.
const MOST_STEPS: usize = 1_500_000;
/// Techniques of which all orders can be gone through.
const MOST_TECHNIQUES: usize = 6;

/// The result of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friedman {
    /// The statistic, corrected for ties.
    pub chi_square: f64,
    /// Its degrees of freedom.
    pub df: u32,
    /// Its p by the chi-square approximation.
    pub p_chi_square: Probability,
    /// Iman and Davenport's F, and its p.
    pub f: Result<(f64, Probability), Undefined>,
    /// p by the permutation distribution.
    pub p_exact: Result<Probability, Undefined>,
    /// Kendall's coefficient of concordance, 0 to 1.
    pub w: f64,
}

impl Friedman {
    /// The p to go by, and where it is from.
    #[must_use]
    pub fn p(&self) -> (Probability, &'static str) {
        match (self.p_exact, self.f) {
            (Ok(p), _) => (p, "exact"),
            (_, Ok((_, p))) => (p, "F"),
            _ => (self.p_chi_square, "chi-square"),
        }
    }
}

/// The test of complete blocks.
///
/// # Errors
/// Fewer than two blocks or techniques, or ties alone.
pub fn friedman(blocks: &Blocks) -> Result<Friedman, Undefined> {
    const FEW: Undefined = Undefined::degenerate("fewer than two complete blocks");
    const ONE: Undefined = Undefined::degenerate("fewer than two techniques");
    const TIES: Undefined = Undefined::degenerate("every block ties all techniques");
    const AGREED: Undefined =
        Undefined::no_finite_estimate("all blocks agree: F has no finite value");
    let (n, k) = (blocks.count(), blocks.techniques.len());
    if k < 2 {
        return Err(ONE);
    }
    if n < 2 {
        return Err(FEW);
    }
    // In whole numbers: twice the ranks, so that sums of squares are four times theirs.
    let ranks = blocks.doubled_ranks();
    let mut sums = vec![0_i64; k];
    for row in ranks.chunks_exact(k) {
        for (sum, &rank) in sums.iter_mut().zip(row) {
            *sum += i64::from(rank);
        }
    }
    let mean = (n * (k + 1)) as i64;
    let between: i128 = sums.iter().map(|sum| i128::from(sum - mean).pow(2)).sum();
    let squares: i128 = ranks.iter().map(|&rank| i128::from(rank).pow(2)).sum();
    let within = squares - (n * k * (k + 1) * (k + 1)) as i128;
    if within <= 0 {
        return Err(TIES);
    }
    let df = u32::try_from(k - 1).unwrap_or(u32::MAX);
    let chi_square = f64::from(df) * between as f64 / within as f64;
    let most = n as f64 * f64::from(df);
    // n (k − 1) − χ², exact where it is 0.
    let rest = n as i128 * within - between;
    let f = if rest > 0 {
        let value = (n as f64 - 1.0) * between as f64 / rest as f64;
        let df_rest = (n as f64 - 1.0) * f64::from(df);
        Ok((value, f_upper(value, f64::from(df), df_rest)))
    } else {
        Err(AGREED)
    };
    Ok(Friedman {
        chi_square,
        df,
        p_chi_square: chi_square_upper(chi_square, df),
        f,
        p_exact: exact(&ranks, k, between),
        w: (chi_square / most).min(1.0),
    })
}

/// P of a sum of squares of the rank sums at least as large, if in every block each order of its own
/// ranks is equally likely. Goes block by block through the sums that can be; as the techniques are
/// exchangeable, sums that differ only by their order are one.
fn exact(ranks: &[u32], k: usize, between: i128) -> Result<Probability, Undefined> {
    const TOO_MANY: Undefined =
        Undefined::not_available("too many arrangements for the exact distribution");
    let n = ranks.len() / k;
    // Without ties the sums over i blocks are k^(k − 2) i^(k − 1) points of a lattice at first order
    // (Stanley 1980), of which one in k! is looked at, k! times, for every i to n.
    let (size, power) = (k as f64, i32::try_from(k).unwrap_or(i32::MAX));
    let steps = size.powi(power - 3) * (n as f64).powi(power);
    if k > MOST_TECHNIQUES || steps > MOST_STEPS as f64 {
        return Err(TOO_MANY);
    }
    let mut sorted: Vec<Vec<u32>> = ranks
        .chunks_exact(k)
        .map(|row| {
            let mut row = row.to_vec();
            row.sort_unstable();
            row
        })
        .collect();
    sorted.sort_unstable();
    let mut states = vec![(0, 1.0)];
    let mut steps = 0;
    for alike in sorted.chunk_by(|one, other| one == other) {
        let orders: Vec<u64> = orders(&alike[0]).iter().map(|order| pack(order)).collect();
        let chance = 1.0 / orders.len() as f64;
        for _ in alike {
            steps += states.len() * orders.len();
            // Ties make the lattice finer.
            if steps > 4 * MOST_STEPS {
                return Err(TOO_MANY);
            }
            states = step(&states, &orders, chance, k);
        }
    }
    let mean = (n * (k + 1)) as i128;
    let reached = states.iter().filter(|(sums, _)| {
        let squares = unpack(*sums, k).map(|sum| (i128::from(sum) - mean).pow(2));
        squares.sum::<i128>() >= between
    });
    let p: f64 = reached.map(|(_, chance)| chance).sum();
    Ok(Probability::from_ln(p.min(1.0).ln()))
}

/// The sums of k ≤ [`MOST_TECHNIQUES`] techniques in one word, 64/k bits each; [`MOST_STEPS`] keeps the
/// blocks so few that they fit.
fn pack(sums: &[u32]) -> u64 {
    let bits = 64 / sums.len();
    let at = |(i, &sum): (usize, &u32)| u64::from(sum) << (i * bits);
    sums.iter().enumerate().map(at).sum()
}

fn unpack(packed: u64, k: usize) -> impl Iterator<Item = u64> {
    let bits = 64 / k;
    (0..k).map(move |i| packed >> (i * bits) & ((1 << bits) - 1))
}

/// One block more.
fn step(states: &[(u64, f64)], orders: &[u64], chance: f64, k: usize) -> Vec<(u64, f64)> {
    let mut next = Vec::with_capacity(states.len() * orders.len());
    for (sums, before) in states {
        for order in orders {
            let mut sorted = [0_u32; MOST_TECHNIQUES];
            for (sum, given) in sorted.iter_mut().zip(unpack(sums + order, k)) {
                *sum = given as u32;
            }
            sorted[..k].sort_unstable();
            next.push((pack(&sorted[..k]), before * chance));
        }
    }
    // Stable, so that chances are added in the same order everywhere.
    next.sort_by_key(|(sums, _)| *sums);
    next.dedup_by(|other, one| {
        let same = other.0 == one.0;
        if same {
            one.1 += other.1;
        }
        same
    });
    next
}

/// All different orders of sorted values.
fn orders(values: &[u32]) -> Vec<Vec<u32>> {
    let mut order = values.to_vec();
    let mut all = vec![order.clone()];
    // The next in lexicographic order.
    while let Some(at) = (1..order.len()).rev().find(|&i| order[i - 1] < order[i]) {
        let last = order.iter().rposition(|&value| value > order[at - 1]);
        order.swap(at - 1, last.unwrap_or(at));
        order[at..].reverse();
        all.push(order.clone());
    }
    all
}

#[cfg(test)]
mod tests;
