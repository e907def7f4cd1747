//! Kendall's coefficient of agreement u.

use super::sets::{Judged, Sets};
use crate::analysis::conclusion::{p_text, plural};
use crate::analysis::table::{Cell, Column, Group, Style, Table, Undefined};
use crate::analysis::tails::{Alpha, Probability, chi_square_upper};

/// Steps of counting out the exact distribution at most.
const MOST_STEPS: u64 = 20_000_000;

/// How far the observers of one complete set agree.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// The scene, where known.
    pub scene: Option<String>,
    /// Number of techniques.
    pub techniques: usize,
    /// Observers who judged every pair.
    pub observers: u32,
    /// u and what chance says of it.
    pub result: Result<Coefficient, Undefined>,
}

/// u, and its tests against choices at random.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficient {
    /// 1: all agree; −1/(m − 1) or −1/m: as little as can be.
    pub u: f64,
    /// Σ over pairs of (γ − (m − γ))²/m.
    pub chi_square: f64,
    /// Number of pairs.
    pub df: u32,
    /// From chi-square.
    pub p: Probability,
    /// Counted out.
    pub p_exact: Result<Probability, Undefined>,
}

/// u of every set that at least one observer completed.
#[must_use]
pub fn all(sets: &Sets, judged: &Judged) -> Vec<Agreement> {
    sets.sets
        .iter()
        .zip(judged.complete.iter().zip(&judged.for_i))
        .filter(|(_, (observers, _))| **observers > 0)
        .map(|(set, (&observers, for_i))| Agreement {
            scene: set.scene.clone(),
            techniques: set.techniques,
            observers,
            result: coefficient(observers, for_i),
        })
        .collect()
}

/// u from how many of m observers preferred i in each pair.
///
/// Kendall & Babington Smith 1940: u = 2Σ/(C(m, 2) C(t, 2)) − 1 with Σ the number of agreeing pairs of
/// observers. Put in the differences D = γ − (m − γ), that is u = (X²/pairs − 1)/(m − 1) with
/// X² = Σ D²/m, which is a chi-square with one degree of freedom a pair in the limit of many
/// observers. Their own chi-square with a broken number of degrees tends to the same.
///
/// # Errors
/// Fewer than two observers.
pub fn coefficient(observers: u32, for_i: &[u32]) -> Result<Coefficient, Undefined> {
    if observers < 2 || for_i.is_empty() {
        return Err(Undefined::degenerate(
            "agreement needs two observers who judged every pair",
        ));
    }
    let m = f64::from(observers);
    let chi_square: f64 = for_i
        .iter()
        .map(|count| (2.0 * f64::from(*count) - m).powi(2) / m)
        .sum();
    let df = u32::try_from(for_i.len()).unwrap_or(u32::MAX);
    Ok(Coefficient {
        u: (chi_square / f64::from(df) - 1.0) / (m - 1.0),
        chi_square,
        df,
        p: chi_square_upper(chi_square, df),
        p_exact: exact(observers, for_i),
    })
}

/// P(Σ D² at least as large), every choice a fair coin's.
fn exact(observers: u32, for_i: &[u32]) -> Result<Probability, Undefined> {
    let m = u64::from(observers);
    let pairs = for_i.len() as u64;
    // D² = 4k + (m mod 2).
    let step = |count: u64| (2 * count).abs_diff(m).pow(2) / 4;
    let longest = step(0);
    if pairs
        .saturating_mul(pairs)
        .saturating_mul(longest)
        .saturating_mul(m)
        > MOST_STEPS
    {
        return Err(Undefined::not_available(
            "too many outcomes to count out; chi-square is good here",
        ));
    }
    let mut one: Vec<(usize, f64)> = Vec::new();
    let mut ways = 0.5_f64.powf(m as f64);
    for count in 0..=m {
        one.push((step(count) as usize, ways));
        ways *= (m - count) as f64 / (count + 1) as f64;
    }
    let mut sums = vec![1.0];
    for _ in 0..pairs {
        let mut next = vec![0.0; sums.len() + longest as usize];
        for (at, probability) in sums.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            for &(step, ways) in &one {
                next[at + step] += probability * ways;
            }
        }
        sums = next;
    }
    let observed: u64 = for_i.iter().map(|count| step(u64::from(*count))).sum();
    let tail: f64 = sums.iter().skip(observed as usize).rev().sum();
    Ok(Probability::from_ln(tail.ln()))
}

/// In a sentence.
pub(super) fn finding(agreed: &[Agreement], alpha: Alpha) -> Option<String> {
    let defined: Vec<&Coefficient> = agreed
        .iter()
        .filter_map(|a| a.result.as_ref().ok())
        .collect();
    if let ([only], [one]) = (agreed, defined.as_slice()) {
        let p = one.p_exact.unwrap_or(one.p);
        return Some(format!(
            "Kendall's u over {} is {:.3} (p {} against choices at random).",
            plural(only.observers as usize, "observer"),
            one.u,
            p_text(p)
        ));
    }
    let beyond = defined
        .iter()
        .filter(|one| one.p_exact.unwrap_or(one.p).at_most(alpha))
        .count();
    (!defined.is_empty()).then(|| {
        format!(
            "Observers agree more than choices at random would in {beyond} of {} (Kendall's u, alpha = {}, not corrected).",
            plural(defined.len(), "complete set"),
            alpha.get()
        )
    })
}

pub(super) fn table(agreed: &[Agreement]) -> Table {
    let rows = agreed
        .iter()
        .map(|set| {
            let scene = set.scene.clone().unwrap_or_else(|| "all".to_owned());
            vec![
                Cell::Text(scene),
                Cell::Count(u32::try_from(set.techniques).unwrap_or(u32::MAX)),
                Cell::Count(set.observers),
                Cell::or_undefined(set.result, |one| Cell::Number(one.u)),
                Cell::or_undefined(set.result, |one| Cell::Number(one.chi_square)),
                Cell::or_undefined(set.result, |one| Cell::Count(one.df)),
                Cell::or_undefined(set.result, |one| Cell::Probability(one.p)),
                Cell::or_undefined(set.result.and_then(|one| one.p_exact), Cell::Probability),
            ]
        })
        .collect();
    Table {
        columns: vec![
            Column::new("scene", "scene", Style::Text, Group::Key),
            Column::new("techniques", "techniques", Style::Count, Group::Choices),
            Column::new("observers", "observers", Style::Count, Group::Choices),
            Column::new("u", "u", Style::Decimals(3), Group::Effects),
            Column::new("chi_square", "χ²", Style::Decimals(3), Group::Tests),
            Column::new("df", "df", Style::Count, Group::Tests),
            Column::new("p", "p", Style::P, Group::Tests),
            Column::new("p_exact", "p exact", Style::P, Group::Tests),
        ],
        rows,
    }
}
