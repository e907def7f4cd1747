//! Rows as a figure wants them: of one scene and lighting, as lines, and the front of them.

use crate::cost::configuration::Resolution;
use crate::cost::front::front;
use crate::cost::row::Row;
use crate::report::figure::words::distinct;

/// Registry name of no occlusion at all.
pub const NONE: &str = "none";

/// Whether a technique is no occlusion at all, which takes no time.
pub fn is_none(technique: &str) -> bool {
    technique == NONE
}

/// The rows of a scene under one lighting that can be drawn: finite times and errors.
pub fn under<'a>(rows: &'a [Row], scene: &str, lighting: &str) -> Vec<&'a Row> {
    let is_drawn = |row: &&Row| {
        let numbers = [row.rmse, row.estimator_rmse, row.information_loss_rmse];
        row.scene == scene
            && row.lighting == lighting
            && (row.total_ms.is_finite() && row.total_ms >= 0.0)
            && numbers.iter().all(|number| number.is_finite())
            && row.flip_mean.is_finite()
    };
    rows.iter().filter(is_drawn).collect()
}

/// The lighting variants of a scene, in the order of the rows.
pub fn lightings<'a>(rows: &'a [Row], scene: &str) -> Vec<&'a str> {
    let of_scene = rows.iter().filter(|row| row.scene == scene);
    distinct(of_scene.map(|row| row.lighting.as_str()))
}

/// The rows of a scene, each configuration once: times and errors are found under the first
/// lighting and are the same under the others.
pub fn once<'a>(rows: &'a [Row], scene: &str) -> Vec<&'a Row> {
    match lightings(rows, scene).first() {
        Some(lighting) => under(rows, scene, lighting),
        None => Vec::new(),
    }
}

/// A technique through its sample counts.
pub struct Line<'a> {
    /// Registry name.
    pub technique: &'a str,
    /// Full or half.
    pub resolution: Resolution,
    /// By samples.
    pub rows: Vec<&'a Row>,
}

/// Whether a row is of the sweep's grid, and not of settings that a set of images gave a name.
pub fn is_of_grid(row: &Row) -> bool {
    row.label == format!("{}-{}", row.technique, row.samples)
}

/// The lines of some rows of one scene: each technique at each resolution with the widest blur
/// that it has there. What has no time is no part of one.
pub fn lines<'a>(rows: &[&'a Row]) -> Vec<Line<'a>> {
    let timed: Vec<&'a Row> = (rows.iter().copied())
        .filter(|row| is_of_grid(row) && row.total_ms > 0.0)
        .collect();
    let mut found = Vec::new();
    for resolution in [Resolution::Half, Resolution::Full] {
        for technique in distinct(timed.iter().map(|row| row.technique.as_str())) {
            let is_here = |row: &&&Row| row.technique == technique && row.resolution == resolution;
            let here = || timed.iter().filter(is_here).copied();
            let Some(widest) = here().map(|row| row.blur_px).max() else {
                continue;
            };
            let mut rows: Vec<&Row> = here().filter(|row| row.blur_px == widest).collect();
            rows.sort_by_key(|row| row.samples);
            found.push(Line {
                technique,
                resolution,
                rows,
            });
        }
    }
    found
}

/// What nothing else beats in both time and another number, fastest first; of equals the first.
pub fn front_of<'a>(rows: &[&'a Row], y: fn(&Row) -> f64) -> Vec<&'a Row> {
    let points: Vec<(f64, f64)> = rows.iter().map(|row| (row.total_ms, y(row))).collect();
    let is_on = front(&points);
    let mut on: Vec<&Row> = (rows.iter().zip(is_on))
        .filter_map(|(row, is_on)| is_on.then_some(*row))
        .collect();
    on.sort_by(|a, b| a.total_ms.total_cmp(&b.total_ms));
    on.dedup_by(|b, a| a.total_ms == b.total_ms);
    on
}
