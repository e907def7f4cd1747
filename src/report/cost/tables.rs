//! The tables of the page, with as many digits as people read.

use super::scaling::exponent;
use super::series::{self, front_of};
use super::{CostReport, knee};
use crate::cost::row::Row;
use crate::cost::votes::Preference;
use crate::report::figure::numbers::{MISSING, fixed, ms, or_missing, significant};
use crate::report::markup::{Column, table};

/// The front of a scene in time and RMSE.
pub fn front(page: &mut String, report: &CostReport, scene: &str) {
    let rows = series::once(report.rows, scene);
    let front = front_of(&rows, |row| row.rmse);
    let points: Vec<(f64, f64)> = front.iter().map(|row| (row.total_ms, row.rmse)).collect();
    let bend = knee(&points);
    let cells = |(index, row): (usize, &&Row)| {
        let is_bend = bend == Some(index);
        vec![
            row.configuration.clone(),
            ms(row.total_ms),
            interval_ms(row),
            fixed(row.rmse, 4),
            fixed(row.bias, 4),
            fixed(row.estimator_rmse, 4),
            fixed(row.flip_mean, 4),
            String::from(if is_bend { "the front bends here" } else { "" }),
        ]
    };
    let cells: Vec<_> = front.iter().enumerate().map(cells).collect();
    table(
        page,
        "",
        "The front: nothing measured here is at least as fast and has less error (fastest first)",
        &[
            Column::Words("configuration"),
            Column::Numbers("ms"),
            Column::Numbers("95 % interval"),
            Column::Numbers("RMSE"),
            Column::Numbers("bias"),
            Column::Numbers("estimator RMSE"),
            Column::Numbers("FLIP"),
            Column::Words(""),
        ],
        &cells,
    );
}

fn interval_ms(row: &Row) -> String {
    match (row.total_low_ms, row.total_high_ms) {
        (Some(low), Some(high)) => format!("[{}, {}]", ms(low), ms(high)),
        _ => MISSING.to_owned(),
    }
}

/// Votes by condition.
pub fn votes(page: &mut String, report: &CostReport) {
    let cells: Vec<_> = report.preferences.iter().map(vote_cells).collect();
    table(
        page,
        "",
        "Votes beside cost, with 95 % intervals",
        &[
            Column::Words("condition"),
            Column::Words("validity"),
            Column::Words("a"),
            Column::Words("b"),
            Column::Numbers("votes a : b"),
            Column::Numbers("share of b"),
            Column::Numbers("JOD of b"),
            Column::Numbers("extra ms"),
            Column::Numbers("points per ms"),
        ],
        &cells,
    );
}

fn vote_cells(one: &Preference) -> Vec<String> {
    let share = &one.share_b;
    let percent = |share: f64| fixed(100.0 * share, 0);
    let jod = one.jod_b.map(|jod| {
        let [value, low, high] = [jod.value, jod.low, jod.high].map(|end| fixed(end, 2));
        format!("{value} [{low}, {high}]")
    });
    vec![
        one.condition.clone(),
        one.validity.clone(),
        one.a.label.clone(),
        one.b.label.clone(),
        format!("{} : {}", one.a.votes, one.b.votes),
        format!(
            "{} % [{}, {}]",
            percent(share.value),
            percent(share.low),
            percent(share.high)
        ),
        jod.unwrap_or_else(|| MISSING.to_owned()),
        ms(one.b.ms - one.a.ms),
        or_missing(one.points_per_ms, |points| significant(points, 2)),
    ]
}

/// Exponents of growth.
pub fn exponents(page: &mut String, report: &CostReport) {
    let cells: Vec<_> = (report.exponents.iter())
        .map(|found| {
            vec![
                found.technique.clone(),
                found.scene.clone(),
                found.axis.name().to_owned(),
                exponent(found),
                found.points.to_string(),
            ]
        })
        .collect();
    table(
        page,
        "",
        "Exponents of time as a power of what is varied: 1 grows in proportion, 0 does not grow (± half the 95 % interval)",
        &[
            Column::Words("technique"),
            Column::Words("scene"),
            Column::Words("grows with"),
            Column::Numbers("exponent"),
            Column::Numbers("points"),
        ],
        &cells,
    );
}

/// Every row.
pub fn rows(page: &mut String, report: &CostReport) {
    let cells: Vec<_> = report.rows.iter().map(row_cells).collect();
    table(
        page,
        "tall",
        "One row a configuration and lighting",
        &[
            Column::Words("configuration"),
            Column::Words("scene"),
            Column::Words("lighting"),
            Column::Numbers("ms"),
            Column::Numbers("95 % interval"),
            Column::Numbers("own pass"),
            Column::Numbers("blur"),
            Column::Numbers("upsampling"),
            Column::Numbers("frames"),
            Column::Numbers("RMSE"),
            Column::Numbers("MAE"),
            Column::Numbers("p95"),
            Column::Numbers("bias"),
            Column::Numbers("estimator RMSE"),
            Column::Numbers("estimator bias"),
            Column::Numbers("FLIP"),
            Column::Numbers("FLIP p95"),
            Column::Numbers("SSIM"),
            Column::Numbers("run"),
            Column::Words("parameters"),
        ],
        &cells,
    );
}

fn row_cells(row: &Row) -> Vec<String> {
    let four = |value: f64| fixed(value, 4);
    vec![
        row.configuration.clone(),
        row.scene.clone(),
        row.lighting.clone(),
        ms(row.total_ms),
        interval_ms(row),
        or_missing(row.occlusion_ms, ms),
        or_missing(row.blur_ms, ms),
        or_missing(row.upsample_ms, ms),
        row.frames.to_string(),
        four(row.rmse),
        four(row.mae),
        four(row.p95),
        four(row.bias),
        four(row.estimator_rmse),
        four(row.estimator_bias),
        four(row.flip_mean),
        four(row.flip_p95),
        four(row.ssim),
        row.run.to_string(),
        row.parameters.clone(),
    ]
}
