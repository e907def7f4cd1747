//! The published forms and ours, fitted to measured curves.

use super::ALBEDOS;
use super::least_squares::{Fitted, Unknown, least_squares};
use super::measured::{Measured, MeasuredBin};
use crate::multi_bounce::Coefficients;

pub use super::least_squares::FitError;

/// A form with what was found for it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Fit {
    /// What is fitted, as a formula.
    pub form: &'static str,
    /// Which curve it is fitted to.
    pub term: Term,
    /// The published values of its unknowns, where there are any.
    pub published: Vec<f64>,
    /// What was found.
    pub fitted: Fitted,
}

/// A curve over openness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Term {
    /// F₀.
    Direct,
    /// F₁.
    FirstBounce,
    /// E/E₀ at every albedo.
    Family,
}

/// A form of one curve.
struct Form {
    formula: &'static str,
    term: Term,
    unknowns: &'static [Unknown],
    published: &'static [f64],
    value: fn(openness: f64, unknowns: &[f64]) -> f64,
}

const fn unknown(name: &'static str, start: f64, low: f64, high: f64) -> Unknown {
    Unknown {
        name,
        start,
        low,
        high,
    }
}

/// The notes' eq. 7 and 11 with their numbers set free, and a direct term that cannot exceed 1.
const FORMS: &[Form] = &[
    Form {
        formula: "F₀ = α (1 + q (1−α)^p)",
        term: Term::Direct,
        unknowns: &[unknown("p", 0.75, 0.05, 5.0), unknown("q", 0.5, 0.0, 5.0)],
        published: &[0.75, 0.5],
        value: |a, u| a * (1.0 + u[1] * (1.0 - a).powf(u[0])),
    },
    Form {
        formula: "F₀ = 1 − (1−α)^k",
        term: Term::Direct,
        unknowns: &[unknown("k", 1.5, 0.2, 5.0)],
        published: &[],
        value: |a, u| 1.0 - (1.0 - a).powf(u[0]),
    },
    Form {
        formula: "F₁ = A α (1−α)^1.5 exp(−B α^¼)",
        term: Term::FirstBounce,
        unknowns: &[
            unknown("A", 27.0, 0.0, 1000.0),
            unknown("B", 3.3, -5.0, 12.0),
        ],
        published: &[27.576_937_094_210_385, 3.336_439_200_342_380_4],
        value: |a, u| u[0] * a * (1.0 - a).powf(1.5) * (-u[1] * a.powf(0.25)).exp(),
    },
];

impl Term {
    fn of(self, bin: &MeasuredBin) -> f64 {
        let factor = match self {
            Self::Direct => 0,
            Self::FirstBounce | Self::Family => 1,
        };
        bin.factors.get(factor).copied().unwrap_or(0.0)
    }
}

/// Fits the published forms. Every bin of every map counts alike.
///
/// # Errors
/// [`FitError`].
pub fn fit_forms(maps: &[Measured]) -> Result<Vec<Fit>, FitError> {
    let bins = || maps.iter().flat_map(|map| &map.bins);
    FORMS
        .iter()
        .map(|form| {
            let residuals = |u: &[f64]| {
                bins()
                    .map(|bin| (form.value)(bin.openness, u) - form.term.of(bin))
                    .collect()
            };
            Ok(Fit {
                form: form.formula,
                term: form.term,
                published: form.published.to_vec(),
                fitted: least_squares(form.unknowns, residuals)?,
            })
        })
        .collect()
}

/// The coefficients of `greyfield`, in the order of [`Coefficients`].
const GREYFIELD: [Unknown; 7] = [
    unknown("k0", 1.0, 0.3, 3.0),
    unknown("k1", 0.7, 0.0, 3.0),
    unknown("c1", 0.9, 0.05, 1.0),
    unknown("m1", 1.5, 0.2, 8.0),
    unknown("c2", 0.7, 0.01, 0.95),
    unknown("m2", 2.0, 0.2, 12.0),
    // Of what no ray leaves, next to nothing is lit: at α = 0 and ρ = 0.9 a share of 0.039 at most.
    unknown("f", 0.003, 0.001, 0.005),
];

/// Fits our own form to the whole family of albedos, 0 to 0.9 (at 1 it is 1, always). Every map counts
/// alike, and so do the bins of a map.
///
/// # Errors
/// [`FitError`].
pub fn fit_greyfield(maps: &[Measured]) -> Result<(Coefficients, Fit), FitError> {
    let bins: usize = maps.iter().map(|map| map.bins.len()).sum();
    let residuals = |u: &[f64]| {
        let model = coefficients(u);
        let mut all = Vec::with_capacity(bins * ALBEDOS.len());
        for map in maps {
            // The mean of all weights is 1, so that the rmse is one of E/E₀.
            let share = bins as f64 / (map.bins.len() * maps.len()) as f64;
            for bin in &map.bins {
                let missed = |rho: &f64| model.value(bin.openness, *rho) - bin.received(*rho);
                all.extend(ALBEDOS[..10].iter().map(|rho| share.sqrt() * missed(rho)));
            }
        }
        all
    };
    let fitted = least_squares(&GREYFIELD, residuals)?;
    let model = coefficients(&fitted.values);
    let fit = Fit {
        form: "E/E₀ = F₀ + (1−F₀) [ρ g₁ + (1−g₁) ρ² g₂ / (1 − ρ + ρ g₂)]",
        term: Term::Family,
        published: Vec::new(),
        fitted,
    };
    Ok((model, fit))
}

fn coefficients(u: &[f64]) -> Coefficients {
    Coefficients {
        k0: u[0],
        k1: u[1],
        c1: u[2],
        m1: u[3],
        c2: u[4],
        m2: u[5],
        f: u[6],
    }
}
