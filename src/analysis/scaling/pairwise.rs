//! Differences of the techniques on their scale, corrected by Holm.

use super::comparison::Comparisons;
use super::link::PROBIT_OF_JOD;
use super::scale::{Component, Method, Scale};
use crate::analysis::holm;
use crate::analysis::table::{Interval, Undefined};
use crate::analysis::tails::{Alpha, Probability, normal_critical, normal_upper};

/// The difference of two techniques of one component, in JOD.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Technique a, the earlier one.
    pub a: usize,
    /// Technique b.
    pub b: usize,
    /// Votes for a and for b in direct comparison.
    pub direct: (u64, u64),
    /// b − a.
    pub jod: f64,
    /// Standard error.
    pub se: f64,
    /// Wald interval.
    pub interval: Interval,
    /// jod / se.
    pub z: f64,
    /// Two-sided p of z.
    pub p: Probability,
    /// The same after Holm's correction over all pairs.
    pub p_holm: Probability,
    /// How the scale was fitted.
    pub method: Method,
}

/// Number of differences.
#[must_use]
pub fn count(components: &[Component]) -> usize {
    components
        .iter()
        .map(|component| component.members.len() * (component.members.len() - 1) / 2)
        .sum()
}

/// All differences within components.
#[must_use]
pub fn differences(
    table: &Comparisons,
    components: &[Component],
    scales: &[Result<Scale, Undefined>],
    alpha: Alpha,
) -> Vec<Difference> {
    let mut found = Vec::with_capacity(count(components));
    for (component, scale) in components.iter().zip(scales) {
        let Ok(scale) = scale else { continue };
        let members = &component.members;
        for one in 0..members.len() {
            for other in one + 1..members.len() {
                found.push(difference(
                    table,
                    scale,
                    (one, members[one]),
                    (other, members[other]),
                    alpha,
                ));
            }
        }
    }
    let p: Vec<Probability> = found.iter().map(|difference| difference.p).collect();
    for (difference, adjusted) in found.iter_mut().zip(holm::adjust(&p)) {
        difference.p_holm = adjusted;
    }
    found
}

fn difference(
    table: &Comparisons,
    scale: &Scale,
    (one, a): (usize, usize),
    (other, b): (usize, usize),
    alpha: Alpha,
) -> Difference {
    let jod = (scale.value(other) - scale.value(one)) / PROBIT_OF_JOD;
    let se = scale.standard_error(one, other) / PROBIT_OF_JOD;
    let direct = table
        .pairs
        .binary_search_by_key(&(a, b), |pair| (pair.i, pair.j))
        .map_or((0, 0), |at| {
            (table.pairs[at].i_wins, table.pairs[at].j_wins)
        });
    let z = if se > 0.0 { jod / se } else { 0.0 };
    let p = two_sided(z);
    Difference {
        a,
        b,
        direct,
        jod,
        se,
        interval: wald(jod, se, alpha),
        z,
        p,
        p_holm: p,
        method: scale.method,
    }
}

/// Two-sided p of a standard normal.
#[must_use]
pub fn two_sided(z: f64) -> Probability {
    normal_upper(z.abs()).times(2.0)
}

/// Estimate ± z se.
#[must_use]
pub fn wald(estimate: f64, se: f64, alpha: Alpha) -> Interval {
    let half = normal_critical(alpha) * se;
    Interval {
        low: estimate - half,
        high: estimate + half,
    }
}
