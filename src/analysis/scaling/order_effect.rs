//! Is the image shown first preferred, whatever it is? One term δ for all pairs:
//! logit P(first preferred) = λ(first) − λ(second) + δ.
//!
//! Source: R. R. Davidson, R. J. Beaver (1977), Biometrics 33(4), 693–702, in its additive form.

use std::collections::BTreeMap;

use super::comparison::Comparisons;
use super::fit::{Design, Row, maximise};
use super::goodness::misfit;
use super::link::Link;
use super::scale::{Component, Method};
use crate::analysis::dataset::Dataset;
use crate::analysis::table::Undefined;
use crate::analysis::tails::{Probability, chi_square_upper};

/// The fitted position term.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrderEffect {
    /// δ in logits; above 0 the first image gains.
    pub delta: f64,
    /// Its standard error from the Fisher information.
    pub se: f64,
    /// Likelihood-ratio chi-square of δ = 0 and its p; none for a penalised fit.
    pub likelihood_ratio: Result<(f64, Probability), Undefined>,
    /// How it was fitted.
    pub method: Method,
}

/// Answers to a pair shown in one order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ordered {
    /// Shown first.
    pub first: usize,
    /// Shown second.
    pub second: usize,
    /// How often the first was chosen.
    pub first_wins: u64,
    /// How often the second.
    pub second_wins: u64,
}

/// The answers by order shown; `None` where only counts are known.
#[must_use]
pub fn ordered(data: &Dataset, table: &Comparisons) -> Option<Vec<Ordered>> {
    if !data.has_answers() {
        return None;
    }
    let mut cells: BTreeMap<(usize, usize), (u64, u64)> = BTreeMap::new();
    for (condition, pair) in data.conditions.iter().zip(table.pair_of_conditions(data)) {
        let (Some((pair, turned)), Some(orders)) = (pair, condition.orders) else {
            continue;
        };
        let pair = &table.pairs[pair];
        let (a, b) = if turned {
            (pair.j, pair.i)
        } else {
            (pair.i, pair.j)
        };
        for (key, first, second) in [
            ((a, b), orders.ab_first, orders.ab_second),
            ((b, a), orders.ba_first, orders.ba_second),
        ] {
            if first + second > 0 {
                let cell = cells.entry(key).or_default();
                cell.0 += u64::from(first);
                cell.1 += u64::from(second);
            }
        }
    }
    Some(
        cells
            .into_iter()
            .map(|((first, second), (first_wins, second_wins))| Ordered {
                first,
                second,
                first_wins,
                second_wins,
            })
            .collect(),
    )
}

/// Fits δ together with the scales of all components.
///
/// # Errors
/// Why there is none.
pub fn fit(
    answers: &[Ordered],
    components: &[Component],
    techniques: usize,
) -> Result<OrderEffect, Undefined> {
    if answers.is_empty() {
        return Err(Undefined::NO_VOTES);
    }
    if is_confounded(answers, techniques) {
        return Err(Undefined::degenerate(
            "the orders shown do not tell position from technique",
        ));
    }
    let method = if components.iter().all(Component::is_finite) && is_finite(answers, techniques) {
        Method::MaximumLikelihood
    } else {
        Method::Penalised
    };
    let design = design(answers, components, techniques);
    let failed = Undefined::no_finite_estimate("the fit did not converge");
    let link = Link::BradleyTerry;
    let fitted = maximise(&design, link, method == Method::Penalised, None).ok_or(failed)?;
    let at = design.parameters - 1;
    let likelihood_ratio = if method == Method::Penalised {
        Err(Undefined::no_finite_estimate(
            "no likelihood ratio where the likelihood has no finite maximum",
        ))
    } else {
        let reduced = Design {
            parameters: at,
            position: false,
            rows: design.rows.clone(),
        };
        let without = maximise(&reduced, link, false, None).ok_or(failed)?;
        let statistic = (misfit(&reduced, link, &without.beta).g2
            - misfit(&design, link, &fitted.beta).g2)
            .max(0.0);
        Ok((statistic, chi_square_upper(statistic, 1)))
    };
    Ok(OrderEffect {
        delta: fitted.beta[at],
        se: fitted.covariance[(at, at)].max(0.0).sqrt(),
        likelihood_ratio,
        method,
    })
}

/// Every component's first technique is its reference; δ is the last parameter.
fn design(answers: &[Ordered], components: &[Component], techniques: usize) -> Design {
    let mut parameter = vec![None; techniques];
    let mut next = 0;
    for component in components {
        for &member in component.members.iter().skip(1) {
            parameter[member] = Some(next);
            next += 1;
        }
    }
    Design {
        parameters: next + 1,
        position: true,
        rows: answers
            .iter()
            .map(|row| Row {
                plus: parameter[row.first],
                minus: parameter[row.second],
                wins: row.first_wins as f64,
                losses: row.second_wins as f64,
            })
            .collect(),
    }
}

/// Whether some λ give λ(second) − λ(first) = 1 in every order shown: then δ and λ are the same.
fn is_confounded(answers: &[Ordered], techniques: usize) -> bool {
    let mut steps = vec![Vec::new(); techniques];
    for row in answers {
        steps[row.first].push((row.second, 1_i64));
        steps[row.second].push((row.first, -1));
    }
    let mut level: Vec<Option<i64>> = vec![None; techniques];
    for root in 0..techniques {
        if level[root].is_some() {
            continue;
        }
        level[root] = Some(0);
        let mut open = vec![(root, 0)];
        while let Some((at, height)) = open.pop() {
            for &(next, step) in &steps[at] {
                match level[next] {
                    None => {
                        level[next] = Some(height + step);
                        open.push((next, height + step));
                    }
                    Some(known) if known != height + step => return false,
                    Some(_) => {}
                }
            }
        }
    }
    true
}

/// Whether δ has a finite maximum, given that the scales have.
///
/// By A. Albert, J. A. Anderson (1984), Biometrika 71(1), 1–10, it has none where some direction of
/// the parameters separates the answers. A direction with δ = ±1 asks for λ that satisfy a
/// difference constraint for each kind of answer (first chosen: λ(second) ≤ λ(first) ± 1; second
/// chosen: λ(first) ≤ λ(second) ∓ 1), and those have a solution exactly where their graph has no
/// negative cycle.
fn is_finite(answers: &[Ordered], techniques: usize) -> bool {
    [1_i64, -1].into_iter().all(|delta| {
        let mut arcs = Vec::new();
        for row in answers {
            if row.first_wins > 0 {
                arcs.push((row.first, row.second, delta));
            }
            if row.second_wins > 0 {
                arcs.push((row.second, row.first, -delta));
            }
        }
        has_negative_cycle(&arcs, techniques)
    })
}

/// Bellman–Ford.
fn has_negative_cycle(arcs: &[(usize, usize, i64)], nodes: usize) -> bool {
    let mut distance = vec![0_i64; nodes];
    for _ in 0..nodes {
        let mut changed = false;
        for &(from, to, weight) in arcs {
            if distance[from] + weight < distance[to] {
                distance[to] = distance[from] + weight;
                changed = true;
            }
        }
        if !changed {
            return false;
        }
    }
    true
}
