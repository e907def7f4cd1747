//! Maximum likelihood by Newton's method, and with Firth's penalty.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::firth;
use super::link::{At, Link};

/// Iterations after which a fit is given up; a dozen is usual.
const MOST_ITERATIONS: usize = 500;
/// A gradient under this share of the terms it is the sum of is zero but for rounding.
const GRADIENT_ZERO: f64 = 1e-14;
/// Under this share a gradient that no longer falls is as good as it gets.
const GRADIENT_TINY: f64 = 1e-11;
/// A gradient that gets no smaller than this has not converged.
pub const GRADIENT_GOOD: f64 = 1e-9;
/// No parameter moves further in one step.
const LONGEST_STEP: f64 = 4.0;

/// Votes between two techniques, in one order of presentation where that matters.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// Parameter of the one; `None` where it is the reference.
    pub plus: Option<usize>,
    /// Parameter of the other.
    pub minus: Option<usize>,
    /// Votes for the one.
    pub wins: f64,
    /// Votes for the other.
    pub losses: f64,
}

impl Row {
    /// Number of votes.
    pub(super) fn votes(&self) -> f64 {
        self.wins + self.losses
    }
}

/// A binomial model: η = λ(plus) − λ(minus), and where there is a position term + δ, the last
/// parameter.
#[derive(Debug, Clone)]
pub struct Design {
    /// Number of parameters.
    pub parameters: usize,
    /// Whether the last one is the position's.
    pub position: bool,
    /// The data.
    pub rows: Vec<Row>,
}

impl Design {
    /// η of a row.
    #[must_use]
    pub fn eta(&self, row: &Row, beta: &DVector<f64>) -> f64 {
        self.terms(row).map(|(at, sign)| sign * beta[at]).sum()
    }

    /// Parameters of a row with their sign.
    pub(super) fn terms(&self, row: &Row) -> impl Iterator<Item = (usize, f64)> + use<> {
        let delta = self.position.then(|| self.parameters - 1);
        let plus = row.plus.map(|at| (at, 1.0));
        let minus = row.minus.map(|at| (at, -1.0));
        plus.into_iter()
            .chain(minus)
            .chain(delta.map(|at| (at, 1.0)))
    }

    pub(super) fn add(&self, matrix: &mut DMatrix<f64>, row: &Row, weight: f64) {
        for (at, sign) in self.terms(row) {
            for (other, other_sign) in self.terms(row) {
                matrix[(at, other)] += sign * other_sign * weight;
            }
        }
    }
}

/// A fitted model.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The parameters.
    pub beta: DVector<f64>,
    /// Inverse of the Fisher information there.
    pub covariance: DMatrix<f64>,
    /// What was maximised, there.
    pub objective: f64,
    /// The largest component of the gradient, relative to the sum of its terms' sizes.
    pub gradient: f64,
}

/// The objective and its derivatives at one point.
pub(super) struct Local {
    pub objective: f64,
    pub score: DVector<f64>,
    /// Sizes of the terms that the score is the sum of.
    pub size: DVector<f64>,
    /// What the step is solved with.
    pub curvature: Cholesky<f64, Dyn>,
    /// The objective is known not to be concave here: no maximum, whatever the gradient.
    pub is_saddle: bool,
    pub fisher: Cholesky<f64, Dyn>,
}

impl Local {
    fn gradient(&self) -> f64 {
        self.score
            .iter()
            .zip(self.size.iter())
            .map(|(score, size)| if *size > 0.0 { score.abs() / size } else { 0.0 })
            .fold(0.0, f64::max)
    }
}

/// The maximum of the likelihood, or of the likelihood times Jeffreys' prior (`penalised`, see
/// [`firth`]). Steps are Newton's, halved while they lead down. `None` where the gradient does not
/// get to zero: the caller has checked existence first, so this is the last guard and not the rule.
#[must_use]
pub fn maximise(
    design: &Design,
    link: Link,
    penalised: bool,
    start: Option<&DVector<f64>>,
) -> Option<Fit> {
    let mut beta = start
        .cloned()
        .unwrap_or_else(|| DVector::zeros(design.parameters));
    let mut here = local(design, link, penalised, &beta)?;
    let mut gradient = here.gradient();
    // Halved where steps go to and fro across the maximum.
    let mut factor = 1.0;
    for _ in 0..MOST_ITERATIONS {
        if gradient <= GRADIENT_ZERO {
            break;
        }
        let mut step = here.curvature.solve(&here.score) * factor;
        let longest = step.amax();
        if !longest.is_finite() {
            return None;
        }
        if longest > LONGEST_STEP {
            step *= LONGEST_STEP / longest;
        }
        let Some((next_beta, next)) = improve(design, link, penalised, &beta, &here, &step) else {
            break;
        };
        let next_gradient = next.gradient();
        // Rounding has been reached when a tiny gradient no longer falls.
        if gradient <= GRADIENT_TINY && next_gradient >= gradient {
            break;
        }
        if next_gradient > 0.9 * gradient && next.score.dot(&here.score) < 0.0 {
            factor *= 0.5;
        }
        (beta, here, gradient) = (next_beta, next, next_gradient);
    }
    (gradient <= GRADIENT_GOOD && !here.is_saddle).then(|| Fit {
        covariance: here.fisher.inverse(),
        objective: here.objective,
        beta,
        gradient,
    })
}

/// The step, halved until the objective does not fall by more than rounding explains.
fn improve(
    design: &Design,
    link: Link,
    penalised: bool,
    beta: &DVector<f64>,
    here: &Local,
    step: &DVector<f64>,
) -> Option<(DVector<f64>, Local)> {
    let mut factor = 1.0;
    for _ in 0..60 {
        let next_beta = beta + step * factor;
        if let Some(next) = local(design, link, penalised, &next_beta)
            && next.objective >= here.objective - 1e-12 * here.objective.abs()
        {
            return Some((next_beta, next));
        }
        factor *= 0.5;
    }
    None
}

fn local(design: &Design, link: Link, penalised: bool, beta: &DVector<f64>) -> Option<Local> {
    let n = design.parameters;
    let (mut score, mut size) = (DVector::zeros(n), DVector::zeros(n));
    let (mut observed, mut fisher) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    let mut objective = 0.0;
    let mut points: Vec<(f64, At)> = Vec::with_capacity(design.rows.len());
    for row in &design.rows {
        let eta = design.eta(row, beta);
        let at = link.at(eta);
        points.push((eta, at));
        objective += row.wins * at.ln_win + row.losses * at.ln_loss;
        let (up, down) = (row.wins * at.win_pull, row.losses * at.loss_pull);
        for (parameter, sign) in design.terms(row) {
            score[parameter] += sign * (up - down);
            size[parameter] += up + down;
        }
        design.add(&mut fisher, row, row.votes() * at.information());
        let (win, loss) = link.curvature(eta, at);
        design.add(&mut observed, row, row.wins * win + row.losses * loss);
    }
    let fisher = Cholesky::new(fisher)?;
    let mut is_saddle = false;
    let curvature = if penalised {
        let penalty = firth::penalty(design, link, &points, &fisher);
        objective += penalty.value;
        score += penalty.slope;
        size += penalty.size;
        let exact = penalty
            .curvature
            .map(|curvature| Cholesky::new(observed + curvature));
        is_saddle = matches!(exact, Some(None));
        // Where the objective is not concave, a matrix that surely leads up.
        exact
            .flatten()
            .or_else(|| Cholesky::new(penalty.stand_in))?
    } else {
        Cholesky::new(observed)?
    };
    objective.is_finite().then_some(Local {
        objective,
        score,
        size,
        curvature,
        is_saddle,
        fisher,
    })
}
