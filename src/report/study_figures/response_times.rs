//! Response times by condition on a logarithmic axis.

use super::lookup::{Row, rows, table};
use super::shares::{LEFT, text};
use super::{Drawing, MOST_ROWS, StudyFigure};
use crate::analysis::Analysis;
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH};
use crate::report::svg::Svg;

pub const FIGURE: StudyFigure = StudyFigure {
    id: "response-times",
    section: "response_times",
    draw,
};

const ROW: f64 = 30.0;
const BOX: f64 = 16.0;
const TOP: f64 = 44.0;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    let table = table(analysis, "response_times", "by_condition")?;
    let shown: Vec<(Row, [f64; 5])> = rows(table)
        .filter_map(|row| Some((row, five(row)?)))
        .take(MOST_ROWS)
        .collect();
    if shown.is_empty() {
        return None;
    }
    let bottom = TOP + ROW * shown.len() as f64 + 10.0;
    let seconds = shown.iter().flat_map(|(_, five)| five.map(|ms| ms / 1e3));
    let panel = Panel {
        x: Scale::log(seconds, 4.0, (LEFT, WIDTH - MARGIN)).padded(0.04, 0.04),
        y: Scale::exactly(0.0, 1.0, (bottom, TOP)),
    };
    let mut sheet = Sheet::new("Response times");
    panel.draw_x(&mut sheet.svg);
    for (i, (row, five)) in shown.iter().enumerate() {
        let y = TOP + ROW * (i as f64 + 0.5) + 5.0;
        text(&mut sheet.svg, "label", row.text("condition"), y + 4.5);
        box_plot(&mut sheet.svg, &panel, five.map(|ms| ms / 1e3), y);
        if let Some(mean) = row.number("geometric_mean_ms") {
            sheet.svg.circle("dot", panel.x.at(mean / 1e3), y, 4.5);
        }
    }
    Some(Drawing {
        sheet,
        bottom: bottom + 24.0,
        caption: "From the question's first frame to the answer, seconds, logarithmic axis. Box: the middle half of the answers with their median; whiskers: 5th to 95th percentile; dot: geometric mean.".to_owned(),
    })
}

/// Percentiles 5, 25, 50, 75 and 95, milliseconds; `None` unless all are there and positive.
fn five(row: Row) -> Option<[f64; 5]> {
    let mut values = [0.0; 5];
    for (value, key) in values
        .iter_mut()
        .zip(["p5_ms", "q1_ms", "median_ms", "q3_ms", "p95_ms"])
    {
        *value = row.number(key).filter(|ms| *ms > 0.0)?;
    }
    Some(values)
}

fn box_plot(svg: &mut Svg, panel: &Panel, five: [f64; 5], y: f64) {
    let [low, q1, median, q3, high] = five.map(|seconds| panel.x.at(seconds));
    svg.line("wide", (low, y), (high, y));
    for x in [low, high] {
        svg.line("wide", (x, y - 4.0), (x, y + 4.0));
    }
    svg.rect("box", q1, y - BOX / 2.0, q3 - q1, BOX);
    svg.line("median", (median, y - BOX / 2.0), (median, y + BOX / 2.0));
}
