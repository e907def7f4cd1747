//! Firth's penalty, which keeps estimates finite where votes went one way: the likelihood is
//! multiplied by Jeffreys' prior |I(β)|^½.
//!
//! Source: D. Firth (1993), Biometrika 80(1), 27–38. For both links here the maximum is finite where
//! the design has full rank, that is, where the comparisons are connected: I. Kosmidis, D. Firth
//! (2021), Biometrika 108(1), 71–82.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::fit::{Design, Fit, Row, maximise};
use super::link::{At, Link};
use crate::analysis::table::Undefined;

/// With more rows the exact second derivative, which costs their square, is not worth it.
const MOST_ROWS: usize = 64;

/// With more parameters than this, other maxima are not looked for around every one.
const MOST_SEARCHED: usize = 24;

/// The highest maximum of the penalised likelihood.
///
/// It need not be the only one: the penalty is not concave. Three techniques with 1500 : 0 votes between
/// the ends and 3 : 0 between neighbours have two, mirror images of each other. So the search starts
/// from where all techniques are equal, from half a vote more for everybody in every pair (which is
/// concave), and from the best of these with each technique moved elsewhere.
///
/// # Errors
/// Two different maxima are equally high, or none was found.
pub(super) fn maximum(design: &Design, link: Link) -> Result<Fit, Undefined> {
    let from = |start: Option<&DVector<f64>>| maximise(design, link, true, start);
    let mut smoothed = design.clone();
    for row in &mut smoothed.rows {
        row.wins += 0.5;
        row.losses += 0.5;
    }
    let smoothed = maximise(&smoothed, link, false, None);
    let mut found: Vec<Fit> = from(None).into_iter().collect();
    found.extend(smoothed.as_ref().and_then(|fit| from(Some(&fit.beta))));
    let centre = highest(&found)
        .or(smoothed.as_ref())
        .map(|fit| fit.beta.clone());
    if let Some(centre) = centre
        && (2..=MOST_SEARCHED).contains(&design.parameters)
    {
        for start in elsewhere(&centre, link) {
            found.extend(from(Some(&start)));
        }
    }
    let none = Undefined::no_finite_estimate("no maximum of the penalised likelihood was found");
    let best = highest(&found).ok_or(none)?;
    let as_high =
        |fit: &&Fit| fit.objective > best.objective - 1e-8 * best.objective.abs().max(1.0);
    if found
        .iter()
        .filter(as_high)
        .any(|fit| (&fit.beta - &best.beta).amax() > 1e-3)
    {
        return Err(Undefined::no_finite_estimate(
            "the likelihood has no finite maximum, and the penalised one has two that are equally high",
        ));
    }
    Ok(best.clone())
}

/// The parameters with one technique moved: to either end of the scale, and far up and down.
fn elsewhere(centre: &DVector<f64>, link: Link) -> Vec<DVector<f64>> {
    let far = match link {
        Link::BradleyTerry => 4.0,
        Link::Thurstone => 2.0,
    };
    // The reference is 0 and belongs to the scale.
    let (low, high) = (centre.min().min(0.0), centre.max().max(0.0));
    let mut starts = Vec::new();
    for moved in 0..=centre.len() {
        let here = centre.get(moved).copied().unwrap_or(0.0);
        for to in [low, high, here - far, here + far] {
            let mut start = centre.clone();
            match start.get_mut(moved) {
                Some(one) => *one = to,
                // The reference moves where all others do, the other way.
                None => start.add_scalar_mut(-to),
            }
            starts.push(start);
        }
    }
    starts
}

fn highest(found: &[Fit]) -> Option<&Fit> {
    found
        .iter()
        .max_by(|one, other| one.objective.total_cmp(&other.objective))
}

/// ½ ln |I| and its derivatives at one point.
pub(super) struct Penalty {
    pub value: f64,
    pub slope: DVector<f64>,
    /// Sizes of the terms that the slope is the sum of.
    pub size: DVector<f64>,
    /// Minus the second derivative; `None` with many rows.
    pub curvature: Option<DMatrix<f64>>,
    /// In place of the whole objective's curvature: always positive definite.
    pub stand_in: DMatrix<f64>,
}

/// The penalty where the rows' η and F are `points`.
pub(super) fn penalty(
    design: &Design,
    link: Link,
    points: &[(f64, At)],
    fisher: &Cholesky<f64, Dyn>,
) -> Penalty {
    let n = design.parameters;
    let covariance = fisher.inverse();
    let (mut slope, mut size) = (DVector::zeros(n), DVector::zeros(n));
    let mut stand_in = DMatrix::zeros(n, n);
    let mut second = DMatrix::zeros(n, n);
    let mut slopes = Vec::with_capacity(design.rows.len());
    for (row, &(eta, at)) in design.rows.iter().zip(points) {
        let weight = row.votes() * at.information();
        // The row's diagonal element of the hat matrix.
        let leverage = weight * product(design, &covariance, row, row);
        let (first, next) = link.information_slope(eta, at);
        let pull = 0.5 * leverage * first;
        for (parameter, sign) in design.terms(row) {
            slope[parameter] += sign * pull;
            size[parameter] += pull.abs();
        }
        // As if half the leverage were added to wins and to losses.
        design.add(
            &mut stand_in,
            row,
            (row.votes() + leverage) * at.information(),
        );
        design.add(&mut second, row, -0.5 * leverage * (first * first + next));
        slopes.push(weight * first);
    }
    Penalty {
        value: fisher.l_dirty().diagonal().map(f64::ln).sum(),
        slope,
        size,
        curvature: (design.rows.len() <= MOST_ROWS)
            .then(|| second + crossed(design, &covariance, &slopes)),
        stand_in,
    }
}

/// x′Cy of two rows.
fn product(design: &Design, covariance: &DMatrix<f64>, one: &Row, other: &Row) -> f64 {
    let mut sum = 0.0;
    for (at, sign) in design.terms(one) {
        for (beside, other_sign) in design.terms(other) {
            sum += sign * other_sign * covariance[(at, beside)];
        }
    }
    sum
}

/// ½ Σ over pairs of rows of w′ᵣ w′ₛ (xᵣ′Cxₛ)² xᵣxₛ′: what d C = −C dI C adds.
fn crossed(design: &Design, covariance: &DMatrix<f64>, slopes: &[f64]) -> DMatrix<f64> {
    let n = design.parameters;
    let mut sum = DMatrix::zeros(n, n);
    for (one, slope) in design.rows.iter().zip(slopes) {
        for (other, other_slope) in design.rows.iter().zip(slopes) {
            let between = product(design, covariance, one, other);
            let weight = 0.5 * slope * other_slope * between * between;
            for (at, sign) in design.terms(one) {
                for (beside, other_sign) in design.terms(other) {
                    sum[(at, beside)] += sign * other_sign * weight;
                }
            }
        }
    }
    sum
}
