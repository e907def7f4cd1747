//! Intervals of a share, and sizes of the two tests of an even split: no simulation, all cases summed.

use greyfield::analysis::dataset::Votes;
use greyfield::analysis::table::{Interval, Undefined};
use greyfield::analysis::tails::{Alpha, Binomial, Probability, beta_lower, chi_square_upper};
use greyfield::analysis::{chi_square, clopper_pearson, exact_binomial, wilson};

use super::Effort;
use super::claim::{AT_LEAST_95, AT_MOST_5, Claim, Measured, NEAR_95};

type Method = fn(Votes, Alpha) -> Result<Interval, Undefined>;

/// Shares over which the mean coverage is taken.
const SHARES: (f64, f64) = (0.05, 0.95);

/// Wilson on average, Clopper–Pearson always.
pub fn intervals(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in effort.of(&[36, 100], &[10, 20, 50, 200, 1000]) {
        let exact = Measured::Exact;
        claims.push(Claim::new(
            format!("Wilson, n = {n}: mean over shares 0.05 to 0.95"),
            NEAR_95,
            exact(mean_coverage(&intervals_of(wilson::interval, n))),
        ));
        claims.push(Claim::told(
            format!("Wilson, n = {n}: at the worst share in 0.05 to 0.95"),
            exact(least_coverage(&intervals_of(wilson::interval, n), SHARES)),
        ));
        // A count's end is known to 12 digits, and so is the coverage, which is 95 % exactly at the worst share
        // where the other tail holds 2.5 % too.
        let least = least_coverage(&intervals_of(clopper_pearson::interval, n), (0.0, 1.0));
        claims.push(Claim::new(
            format!("Clopper–Pearson, n = {n}: at the worst of all shares"),
            *AT_LEAST_95.start() - 1e-12..=1.0,
            exact(least),
        ));
        claims.push(Claim::told(
            format!("Clopper–Pearson, n = {n}: mean over shares 0.05 to 0.95"),
            exact(mean_coverage(&intervals_of(clopper_pearson::interval, n))),
        ));
    }
    claims
}

/// The interval of every count, 0 to n.
fn intervals_of(method: Method, n: u32) -> Vec<Interval> {
    (0..=n)
        .filter_map(|b| method(Votes { a: n - b, b }, Alpha::FIVE_PERCENT).ok())
        .collect()
}

/// The integral of the coverage over [`SHARES`] by their length: that of P(X = k) over an interval of p is a
/// difference of beta tails, ∫ C(n, k) pᵏ (1 − p)ⁿ⁻ᵏ dp = I(k + 1, n − k + 1)/(n + 1).
fn mean_coverage(intervals: &[Interval]) -> f64 {
    let n = intervals.len() as f64 - 1.0;
    let sum: f64 = (intervals.iter().enumerate())
        .map(|(k, interval)| {
            let (low, high) = (interval.low.max(SHARES.0), interval.high.min(SHARES.1));
            let up_to = |p: f64| beta_lower(p, k as f64 + 1.0, n - k as f64 + 1.0).value();
            if low < high {
                up_to(high) - up_to(low)
            } else {
                0.0
            }
        })
        .sum();
    sum / (n + 1.0) / (SHARES.1 - SHARES.0)
}

/// The infimum of the coverage over shares. Between two ends of intervals it is P(i ≤ X ≤ j), which rises and
/// then falls in p: it is least at an end, as p comes near from below or from above.
fn least_coverage(intervals: &[Interval], (from, to): (f64, f64)) -> f64 {
    let n = intervals.len() as u32 - 1;
    let ends = intervals.iter().flat_map(|it| [it.low, it.high]);
    let inside = ends.filter(|end| (from..=to).contains(end) && *end > 0.0 && *end < 1.0);
    let mut least = 1.0_f64;
    for p in inside.chain([from, to].into_iter().filter(|p| *p > 0.0 && *p < 1.0)) {
        let Some(x) = Binomial::new(n, p) else {
            continue;
        };
        let coverage = |covers: &dyn Fn(&Interval) -> bool| -> f64 {
            (0..=n)
                .zip(intervals)
                .filter(|(_, interval)| covers(interval))
                .map(|(k, _)| x.ln_pmf(k).exp())
                .sum()
        };
        if p > from {
            least = least.min(coverage(&|it| it.low < p && p <= it.high));
        }
        if p < to {
            least = least.min(coverage(&|it| it.low <= p && p < it.high));
        }
    }
    least
}

/// What a test of an even split rejects under an even split, alone and as the smallest p of seven times as strict
/// tests.
pub fn sizes(effort: Effort) -> Vec<Claim> {
    let mut claims = Vec::new();
    for n in effort.of(&[36, 100], &[10, 20, 50, 200, 1000]) {
        claims.push(Claim::new(
            format!("exact test of an even split, n = {n}: size"),
            AT_MOST_5,
            Measured::Exact(size(n, 0.05, exact_p)),
        ));
        claims.push(Claim::told(
            format!("chi-square test of an even split, n = {n}: size"),
            Measured::Exact(size(n, 0.05, chi_square_p)),
        ));
    }
    claims
}

/// P(p ≤ level) for n votes of an even split.
pub fn size(n: u32, level: f64, p: fn(Votes) -> Option<Probability>) -> f64 {
    let Some(x) = Binomial::new(n, 0.5) else {
        return 0.0;
    };
    (0..=n)
        .filter(|b| p(Votes { a: n - b, b: *b }).is_some_and(|p| p.value() <= level))
        .map(|b| x.ln_pmf(b).exp())
        .sum()
}

pub fn exact_p(votes: Votes) -> Option<Probability> {
    exact_binomial::exact_p(votes).ok()
}

pub fn chi_square_p(votes: Votes) -> Option<Probability> {
    chi_square::chi_square(votes)
        .ok()
        .map(|x| chi_square_upper(x, 1))
}
