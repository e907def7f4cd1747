//! Maximum likelihood of the proportional-odds model by Newton's method.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use crate::analysis::table::Undefined;

/// Newton steps; a likelihood with a maximum takes about ten.
const MOST_STEPS: usize = 60;

/// One rating.
#[derive(Debug, Clone, Copy)]
pub struct Observation {
    /// Which of the points of the scale, from 0.
    pub category: usize,
    /// Which technique; 0 is the reference.
    pub technique: usize,
    /// Which condition; 0 is the reference.
    pub condition: usize,
    /// Whose; observations of one cluster follow each other.
    pub cluster: u32,
}

/// What was estimated.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Log odds of the techniques from 1.
    pub effects: Vec<f64>,
    /// Their cluster-robust standard errors.
    pub errors: Vec<Result<f64, Undefined>>,
}

/// Where the parameters of an observation stand: thresholds, then techniques, then conditions.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    upper: Option<usize>,
    lower: Option<usize>,
    technique: Option<usize>,
    condition: Option<usize>,
}

/// Log-likelihood of an observation and its derivatives by θ_upper − η and θ_lower − η.
struct Term {
    ln: f64,
    gradient: [f64; 2],
    /// Second derivatives: upper, mixed, lower.
    curvature: [f64; 3],
}

/// Log-likelihood of all, its gradient, minus its Hessian, and the least weight of a bound.
struct Total {
    ln: f64,
    gradient: DVector<f64>,
    information: DMatrix<f64>,
    least: f64,
}

/// Fits `[categories, techniques, conditions]`; every category is in use.
///
/// # Errors
/// Where the likelihood has no maximum at a finite value.
pub fn fit(observations: &[Observation], size: [usize; 3]) -> Result<Fit, Undefined> {
    const SEPARATED: Undefined = Undefined::no_finite_estimate(
        "the ratings separate the techniques or conditions: the likelihood has no maximum at a finite value",
    );
    let mut cells: BTreeMap<Place, f64> = BTreeMap::new();
    for it in observations {
        *cells.entry(place(it, size)).or_default() += 1.0;
    }
    let cells: Vec<(Place, f64)> = cells.into_iter().collect();
    let mut at = start(observations, size);
    let mut total = sum(&cells, &at);
    for _ in 0..MOST_STEPS {
        let factor = total.information.clone().cholesky().ok_or(SEPARATED)?;
        let step = factor.solve(&total.gradient);
        let Some((next, reached)) = climb(&cells, &at, &step, total.ln, size[0] - 1) else {
            break;
        };
        let is_still = step.amax() <= 1e-13 * (1.0 + at.amax());
        (at, total) = (next, reached);
        if is_still {
            break;
        }
    }
    // At a maximum the bounds pull with positive weights that sum to zero; there is one if and only
    // if there are such weights (Haberman 1980; Stiemke's alternative). On the way to infinity the
    // weights of what is separated fade no faster than the gradient, so that it stays as large as the
    // least of them, until both drown in the rounding of the sum.
    let rounding = observations.len() as f64 * f64::EPSILON;
    if total.gradient.amax() + rounding > 1e-3 * total.least {
        return Err(SEPARATED);
    }
    let factor = total.information.clone().cholesky().ok_or(SEPARATED)?;
    let errors = errors(observations, size, &at, &factor.inverse());
    let techniques = size[0] - 1..size[0] + size[1] - 2;
    Ok(Fit {
        effects: techniques.map(|i| at[i]).collect(),
        errors,
    })
}

fn place(it: &Observation, [categories, techniques, _]: [usize; 3]) -> Place {
    let thresholds = categories - 1;
    let of = |level: usize, before: usize| level.checked_sub(1).map(|level| before + level);
    Place {
        upper: Some(it.category).filter(|&category| category < thresholds),
        lower: it.category.checked_sub(1),
        technique: of(it.technique, thresholds),
        condition: of(it.condition, thresholds + techniques - 1),
    }
}

/// Thresholds at the logits of the shares below them, no effects.
fn start(
    observations: &[Observation],
    [categories, techniques, conditions]: [usize; 3],
) -> DVector<f64> {
    let mut counts = vec![0.0; categories];
    for it in observations {
        counts[it.category] += 1.0;
    }
    let mut at = DVector::zeros(categories + techniques + conditions - 3);
    let mut below = 0.0;
    for (threshold, count) in counts[..categories - 1].iter().enumerate() {
        below += count;
        at[threshold] = (below / (observations.len() as f64 - below)).ln();
    }
    at
}

/// A step up, halved until the thresholds keep their order and the likelihood does not fall.
fn climb(
    cells: &[(Place, f64)],
    at: &DVector<f64>,
    step: &DVector<f64>,
    before: f64,
    thresholds: usize,
) -> Option<(DVector<f64>, Total)> {
    let mut factor = 1.0;
    for _ in 0..40 {
        let next = at + step * factor;
        let in_order = (1..thresholds).all(|i| next[i - 1] < next[i]);
        if in_order {
            let total = sum(cells, &next);
            if total.ln >= before - 1e-14 * before.abs() {
                return Some((next, total));
            }
        }
        factor /= 2.0;
    }
    None
}

/// ln(F(u) − F(l)) = ln F(u) + ln F(−l) + ln(1 − e^(l − u)) for the logistic F, which loses nothing
/// in the tails.
fn term(upper: Option<f64>, lower: Option<f64>) -> Term {
    let logistic = |x: f64| 1.0 / (1.0 + (-x).exp());
    let ln_logistic = |x: f64| {
        if x < 0.0 {
            x - x.exp().ln_1p()
        } else {
            -(-x).exp().ln_1p()
        }
    };
    let mut term = Term {
        ln: 0.0,
        gradient: [0.0; 2],
        curvature: [0.0; 3],
    };
    if let Some(u) = upper {
        let rest = logistic(-u);
        term.ln += ln_logistic(u);
        term.gradient[0] += rest;
        term.curvature[0] -= rest * (1.0 - rest);
    }
    if let Some(l) = lower {
        let rest = logistic(l);
        term.ln += ln_logistic(-l);
        term.gradient[1] -= rest;
        term.curvature[2] -= rest * (1.0 - rest);
    }
    if let (Some(u), Some(l)) = (upper, lower) {
        let h = 1.0 / (u - l).exp_m1();
        term.ln += (-(l - u).exp_m1()).ln();
        term.gradient[0] += h;
        term.gradient[1] -= h;
        let bend = h * (1.0 + h);
        term.curvature[0] -= bend;
        term.curvature[1] += bend;
        term.curvature[2] -= bend;
    }
    term
}

fn term_at(place: &Place, at: &DVector<f64>) -> Term {
    let value = |parameter: Option<usize>| parameter.map_or(0.0, |i| at[i]);
    let eta = value(place.technique) + value(place.condition);
    term(
        place.upper.map(|i| at[i] - eta),
        place.lower.map(|i| at[i] - eta),
    )
}

/// The parameters of a place and their derivatives by the two bounds.
fn parts(place: &Place) -> impl Iterator<Item = (usize, [f64; 2])> + use<> {
    [
        (place.upper, [1.0, 0.0]),
        (place.lower, [0.0, 1.0]),
        (place.technique, [-1.0, -1.0]),
        (place.condition, [-1.0, -1.0]),
    ]
    .into_iter()
    .filter_map(|(parameter, by)| Some((parameter?, by)))
}

fn sum(cells: &[(Place, f64)], at: &DVector<f64>) -> Total {
    let n = at.len();
    let mut total = Total {
        ln: 0.0,
        gradient: DVector::zeros(n),
        information: DMatrix::zeros(n, n),
        least: f64::INFINITY,
    };
    for (place, count) in cells {
        let Term {
            ln,
            gradient: [gu, gl],
            curvature: [uu, ul, ll],
        } = term_at(place, at);
        total.ln += count * ln;
        if place.upper.is_some() {
            total.least = total.least.min(gu);
        }
        if place.lower.is_some() {
            total.least = total.least.min(-gl);
        }
        for (i, [u, l]) in parts(place) {
            total.gradient[i] += count * (gu * u + gl * l);
            for (j, [v, m]) in parts(place) {
                let bend = uu * u * v + ul * (u * m + l * v) + ll * l * m;
                total.information[(i, j)] -= count * bend;
            }
        }
    }
    total
}

/// Cluster-robust standard errors of the techniques, given the inverse of the information.
fn errors(
    observations: &[Observation],
    size: [usize; 3],
    at: &DVector<f64>,
    inverse: &DMatrix<f64>,
) -> Vec<Result<f64, Undefined>> {
    const ONE: Undefined = Undefined::degenerate("one participant only: no standard error");
    const ALIKE: Undefined =
        Undefined::degenerate("the participants do not differ: no standard error");
    let n = at.len();
    let mut meat = DMatrix::zeros(n, n);
    let mut clusters = 0.0;
    for cluster in observations.chunk_by(|one, other| one.cluster == other.cluster) {
        let mut score: DVector<f64> = DVector::zeros(n);
        for it in cluster {
            let place = place(it, size);
            let [gu, gl] = term_at(&place, at).gradient;
            for (i, [u, l]) in parts(&place) {
                score[i] += gu * u + gl * l;
            }
        }
        meat += &score * score.transpose();
        clusters += 1.0;
    }
    let sandwich = inverse * meat * inverse;
    (size[0] - 1..size[0] + size[1] - 2)
        .map(|i| {
            let variance = sandwich[(i, i)] * clusters / (clusters - 1.0);
            if clusters < 2.0 {
                Err(ONE)
            } else if variance <= 1e-12 * inverse[(i, i)] {
                Err(ALIKE)
            } else {
                Ok(variance.sqrt())
            }
        })
        .collect()
}
