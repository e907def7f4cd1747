//! Nonlinear least squares within bounds, by the `levenberg-marquardt` crate (Moré 1978, MINPACK's
//! lmder), with intervals from the Jacobian at the solution.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Something to be found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unknown {
    /// What it is called.
    pub name: &'static str,
    /// Where the search starts, between the bounds.
    pub start: f64,
    /// Smallest value allowed.
    pub low: f64,
    /// Largest value allowed.
    pub high: f64,
}

/// What was found.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Fitted {
    /// Name of each unknown.
    pub names: Vec<&'static str>,
    /// Its value.
    pub values: Vec<f64>,
    /// Half width of its 95 % interval: Student's t, residuals taken as independent and alike. None
    /// where the data do not determine it, or it lies on its bound.
    pub half_widths: Vec<Option<f64>>,
    /// Root of the mean squared residual.
    pub rmse: f64,
    /// Residuals.
    pub residuals: usize,
}

/// No fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Not enough to go by.
    #[error(
        "{residuals} measurements cannot determine {unknowns} coefficients; the map needs more bins of openness"
    )]
    TooFew {
        /// Measurements.
        residuals: usize,
        /// Unknowns.
        unknowns: usize,
    },
    /// The solver gave up.
    #[error("least squares found no minimum: {reason}")]
    NoMinimum {
        /// Its word.
        reason: String,
    },
}

/// Finds the unknowns that make the squares of `residuals` least.
///
/// # Errors
/// [`FitError`].
pub fn least_squares(
    unknowns: &[Unknown],
    residuals: impl Fn(&[f64]) -> Vec<f64>,
) -> Result<Fitted, FitError> {
    let start: Vec<f64> = unknowns.iter().map(|unknown| unknown.start).collect();
    let count = residuals(&start).len();
    if count <= unknowns.len() {
        return Err(FitError::TooFew {
            residuals: count,
            unknowns: unknowns.len(),
        });
    }
    let free = unknowns
        .iter()
        .map(|unknown| unknown.to_free(unknown.start));
    let problem = Problem {
        unknowns,
        residuals: &residuals,
        free: DVector::from_iterator(unknowns.len(), free),
    };
    let (problem, report) = LevenbergMarquardt::new().minimize(problem);
    if !report.termination.was_successful() {
        return Err(FitError::NoMinimum {
            reason: format!("{:?}", report.termination),
        });
    }
    let values = problem.values(&problem.free);
    let found = residuals(&values);
    let squares: f64 = found.iter().map(|r| r * r).sum();
    let half_widths = half_widths(unknowns, &values, &residuals, squares);
    Ok(Fitted {
        names: unknowns.iter().map(|unknown| unknown.name).collect(),
        values,
        half_widths,
        rmse: (squares / count as f64).sqrt(),
        residuals: count,
    })
}

impl Unknown {
    /// From between the bounds to any number.
    fn to_free(self, value: f64) -> f64 {
        let share = ((value - self.low) / (self.high - self.low)).clamp(1e-9, 1.0 - 1e-9);
        (share / (1.0 - share)).ln()
    }

    /// And back.
    fn bounded(self, free: f64) -> f64 {
        self.low + (self.high - self.low) / (1.0 + (-free).exp())
    }
}

/// The unknowns brought from their bounds to the whole line.
struct Problem<'a, R> {
    unknowns: &'a [Unknown],
    residuals: &'a R,
    free: DVector<f64>,
}

impl<R: Fn(&[f64]) -> Vec<f64>> Problem<'_, R> {
    fn values(&self, free: &DVector<f64>) -> Vec<f64> {
        let bounded = self.unknowns.iter().zip(free.iter());
        bounded
            .map(|(unknown, free)| unknown.bounded(*free))
            .collect()
    }

    fn at(&self, free: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec((self.residuals)(&self.values(free)))
    }
}

impl<R: Fn(&[f64]) -> Vec<f64>> LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_, R> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, free: &DVector<f64>) {
        self.free.copy_from(free);
    }

    fn params(&self) -> DVector<f64> {
        self.free.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        Some(self.at(&self.free))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let columns: Vec<DVector<f64>> = (0..self.free.len())
            .map(|unknown| {
                slope(self.free[unknown], |free| {
                    let mut moved = self.free.clone();
                    moved[unknown] = free;
                    self.at(&moved)
                })
            })
            .collect();
        Some(DMatrix::from_columns(&columns))
    }
}

/// Slope of a list of numbers over one, by central differences: the step is the cube root of what a
/// double resolves, where rounding and curvature are alike.
fn slope(at: f64, value: impl Fn(f64) -> DVector<f64>) -> DVector<f64> {
    let step = f64::EPSILON.cbrt() * at.abs().max(1.0);
    (value(at + step) - value(at - step)) / (2.0 * step)
}

/// Half widths of the 95 % intervals: t √(s² (JᵀJ)⁻¹).
fn half_widths(
    unknowns: &[Unknown],
    values: &[f64],
    residuals: &impl Fn(&[f64]) -> Vec<f64>,
    squares: f64,
) -> Vec<Option<f64>> {
    let inside = |place: &usize| {
        let (unknown, value) = (unknowns[*place], values[*place]);
        let room = 1e-4 * (unknown.high - unknown.low);
        value > unknown.low + room && value < unknown.high - room
    };
    // What lies on its bound is held there, and says nothing of the others.
    let free: Vec<usize> = (0..values.len()).filter(inside).collect();
    let mut widths = vec![None; values.len()];
    if free.is_empty() {
        return widths;
    }
    let columns: Vec<DVector<f64>> = free
        .iter()
        .map(|&place| {
            slope(values[place], |value| {
                let mut moved = values.to_vec();
                moved[place] = value;
                DVector::from_vec(residuals(&moved))
            })
        })
        .collect();
    let jacobian = DMatrix::from_columns(&columns);
    let degrees = jacobian.nrows() as f64 - free.len() as f64;
    let (Some(inverse), Ok(student)) = (
        (jacobian.transpose() * &jacobian).try_inverse(),
        StudentsT::new(0.0, 1.0, degrees),
    ) else {
        return widths;
    };
    let t = student.inverse_cdf(0.975);
    for (row, place) in free.into_iter().enumerate() {
        let variance = inverse[(row, row)] * squares / degrees;
        widths[place] = (variance.is_finite() && variance >= 0.0).then(|| t * variance.sqrt());
    }
    widths
}
