//! CSV of growth and of choices, with full precision, for other programs.

use serde::Serialize;

use crate::cost::scaling::{Exponent, ScalingRow};
use crate::cost::votes::{Estimate, Preference};
use crate::report::ReportError;

/// `scaling.csv`: one line a measurement of growth; times in milliseconds.
///
/// # Errors
/// [`ReportError::Csv`]; none is known to occur.
pub fn scaling_csv(rows: &[ScalingRow]) -> Result<String, ReportError> {
    written(rows)
}

/// `exponents.csv`: one line a scene, technique and axis.
///
/// # Errors
/// [`ReportError::Csv`]; none is known to occur.
pub fn exponents_csv(rows: &[Exponent]) -> Result<String, ReportError> {
    written(rows)
}

/// `preferences.csv`: one line a condition. Shares are 0 to 1, times milliseconds, JOD just
/// objectionable differences; missing numbers are empty.
///
/// # Errors
/// [`ReportError::Csv`]; none is known to occur.
pub fn preferences_csv(preferences: &[Preference]) -> Result<String, ReportError> {
    let lines: Vec<PreferenceLine> = preferences.iter().map(PreferenceLine::of).collect();
    written(&lines)
}

/// A [`Preference`] without structs inside, which CSV has no columns for.
#[derive(Serialize)]
struct PreferenceLine<'a> {
    condition: &'a str,
    scene: &'a str,
    validity: &'a str,
    hypothesis: &'a str,
    technique_a: &'a str,
    technique_b: &'a str,
    votes_a: u32,
    votes_b: u32,
    a_ms: f64,
    b_ms: f64,
    extra_ms: f64,
    a_rmse: f64,
    b_rmse: f64,
    a_flip_mean: f64,
    b_flip_mean: f64,
    share_b: f64,
    share_b_low: f64,
    share_b_high: f64,
    jod_b: Option<f64>,
    jod_b_low: Option<f64>,
    jod_b_high: Option<f64>,
    points_per_ms: Option<f64>,
}

impl<'a> PreferenceLine<'a> {
    fn of(one: &'a Preference) -> Self {
        let (a, b, share) = (&one.a, &one.b, &one.share_b);
        // Of an interval that reaches all or nothing of the votes the end is infinitely far.
        let jod = |of: fn(&Estimate) -> f64| {
            let value = one.jod_b.as_ref().map(of);
            value.filter(|value| value.is_finite())
        };
        Self {
            condition: &one.condition,
            scene: &one.scene,
            validity: &one.validity,
            hypothesis: &one.hypothesis,
            technique_a: &a.label,
            technique_b: &b.label,
            votes_a: a.votes,
            votes_b: b.votes,
            a_ms: a.ms,
            b_ms: b.ms,
            extra_ms: b.ms - a.ms,
            a_rmse: a.rmse,
            b_rmse: b.rmse,
            a_flip_mean: a.flip_mean,
            b_flip_mean: b.flip_mean,
            share_b: share.value,
            share_b_low: share.low,
            share_b_high: share.high,
            jod_b: jod(|jod| jod.value),
            jod_b_low: jod(|jod| jod.low),
            jod_b_high: jod(|jod| jod.high),
            points_per_ms: one.points_per_ms,
        }
    }
}

fn written<T: Serialize>(rows: &[T]) -> Result<String, ReportError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
