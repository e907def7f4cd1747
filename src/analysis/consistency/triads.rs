//! Circular triads, and how many of them chance gives.

use std::collections::BTreeMap;

use crate::analysis::tails::{Probability, gamma_upper, normal_upper};

/// The distribution is counted out up to this number of techniques, as far as it has been
/// published (G. G. Alway 1962, Biometrika 49(1/2), 265–269).
const MOST_COUNTED: u8 = 10;
/// And for this number of sets at most, whose distributions are convolved.
const MOST_SETS: usize = 400;

/// Circular triads of an observer, from how often each technique was preferred in one complete set:
/// d = t(t − 1)(2t − 1)/12 − ½ Σ a² (Kendall & Babington Smith 1940).
#[must_use]
pub fn circular(scores: &[u32]) -> u32 {
    let t = scores.len() as u64;
    let squares: u64 = scores.iter().map(|a| u64::from(*a).pow(2)).sum();
    // Both terms are whole once doubled: Σ a² is at most t(t − 1)(2t − 1)/6.
    let doubled = (t * t.saturating_sub(1) * (2 * t).saturating_sub(1) / 6).saturating_sub(squares);
    u32::try_from(doubled / 2).unwrap_or(u32::MAX)
}

/// The most circular triads t techniques can have: (t³ − t)/24 for odd t, (t³ − 4t)/24 for even t.
#[must_use]
pub fn most_circular(t: usize) -> u32 {
    let less = if t % 2 == 1 { t } else { 4 * t };
    u32::try_from((t.pow(3) - less.min(t.pow(3))) / 24).unwrap_or(u32::MAX)
}

/// Probabilities of 0, 1, 2, … circular triads where every preference is a fair coin's.
#[must_use]
pub fn distribution(t: u8) -> Vec<f64> {
    // By how often each technique was preferred, sorted: techniques are added one by one.
    let mut states: BTreeMap<Vec<u8>, f64> = BTreeMap::from([(vec![0], 1.0)]);
    for _ in 1..t {
        let mut next = BTreeMap::new();
        for (scores, probability) in &states {
            let mut kinds: Vec<(u8, u8)> = Vec::new();
            for &score in scores {
                match kinds.last_mut() {
                    Some((last, count)) if *last == score => *count += 1,
                    _ => kinds.push((score, 1)),
                }
            }
            add_one(&kinds, 0, Vec::new(), *probability, &mut next);
        }
        states = next;
    }
    let mut sums = vec![0.0; most_circular(t.into()) as usize + 1];
    for (scores, probability) in states {
        let scores: Vec<u32> = scores.into_iter().map(u32::from).collect();
        sums[circular(&scores) as usize] += probability;
    }
    sums
}

/// Lets the new technique meet those of every kind (score, how many): some of a kind win against it.
fn add_one(
    kinds: &[(u8, u8)],
    own: u8,
    scores: Vec<u8>,
    probability: f64,
    next: &mut BTreeMap<Vec<u8>, f64>,
) {
    let Some((&(score, count), rest)) = kinds.split_first() else {
        let mut scores = scores;
        scores.push(own);
        scores.sort_unstable();
        *next.entry(scores).or_default() += probability;
        return;
    };
    let mut ways = 0.5_f64.powi(count.into());
    for winners in 0..=count {
        let mut after = scores.clone();
        after.extend((0..count).map(|at| score + u8::from(at < winners)));
        add_one(rest, own + count - winners, after, probability * ways, next);
        ways *= f64::from(count - winners) / f64::from(winners + 1);
    }
}

/// Distributions that were needed.
#[derive(Debug, Default)]
pub struct Chance {
    known: BTreeMap<Vec<u8>, Vec<f64>>,
}

impl Chance {
    /// P(at most so many circular triads) in complete sets of these sizes, where every preference
    /// is a fair coin's: small for an observer who does not guess.
    pub fn at_most(&mut self, sizes: &[u8], circular: u32) -> Probability {
        if sizes.iter().any(|t| *t > MOST_COUNTED) || sizes.len() > MOST_SETS {
            return approximate(sizes, circular);
        }
        if !self.known.contains_key(sizes) {
            let sum = sizes
                .iter()
                .fold(vec![1.0], |sum, t| convolved(&sum, &distribution(*t)));
            self.known.insert(sizes.to_vec(), sum);
        }
        let sum = self.known.get(sizes).map_or(1.0, |known| {
            known.iter().take(circular as usize + 1).sum::<f64>()
        });
        Probability::from_ln(sum.ln())
    }
}

/// The distribution of the sum.
fn convolved(one: &[f64], other: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; one.len() + other.len() - 1];
    for (i, p) in one.iter().enumerate() {
        for (j, q) in other.iter().enumerate() {
            sum[i + j] += p * q;
        }
    }
    sum
}

/// Kendall's chi-square with degrees of freedom that match the first three cumulants, which add up
/// over sets: C/4, 3C/16 and −3C(t − 4)/32 with C = t(t − 1)(t − 2)/6 (P. A. P. Moran 1947, Biometrika
/// 34(3/4), 363–365). For one set that is ν = t(t − 1)(t − 2)/(t − 4)² as published.
pub(super) fn approximate(sizes: &[u8], circular: u32) -> Probability {
    let (mut mean, mut variance, mut third) = (0.0, 0.0, 0.0);
    for t in sizes.iter().map(|t| f64::from(*t)) {
        let triples = t * (t - 1.0) * (t - 2.0) / 6.0;
        mean += triples / 4.0;
        variance += 3.0 * triples / 16.0;
        third -= 3.0 * triples * (t - 4.0) / 32.0;
    }
    let distance = mean - f64::from(circular) - 0.5;
    let unit = -third / (4.0 * variance);
    let deviation = variance.sqrt();
    // With sets enough the skew is gone, and what is left is the normal.
    if unit < 0.01 * deviation {
        return normal_upper(distance / deviation);
    }
    let df = variance / (2.0 * unit * unit);
    // χ² with df degrees is twice a gamma of shape df/2.
    gamma_upper((distance / unit + df) / 2.0, df / 2.0)
}
