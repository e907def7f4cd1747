//! The techniques on one scale of just-objectionable differences.

use super::lookup::{Row, rows, table};
use super::shares::{LEFT, text};
use super::{Drawing, MOST_ROWS, StudyFigure};
use crate::analysis::Analysis;
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH};
use crate::report::figure::words::distinct;
use crate::report::svg::{Anchor, Svg};

pub const FIGURE: StudyFigure = StudyFigure {
    id: "jod",
    section: "scaling",
    draw,
};

const ROW: f64 = 28.0;
const HEAD: f64 = 26.0;
const TOP: f64 = 44.0;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    let table = table(analysis, "scaling", "jod")?;
    let shown: Vec<Row> = rows(table)
        .filter(|row| row.number("jod").is_some())
        .take(MOST_ROWS)
        .collect();
    if shown.is_empty() {
        return None;
    }
    let names: Vec<String> = shown.iter().map(|row| row.label("component")).collect();
    let components = distinct(names.iter().map(String::as_str));
    let several = components.len() > 1;
    let heads = if several { components.len() } else { 0 };
    let bottom = TOP + ROW * shown.len() as f64 + HEAD * heads as f64 + 10.0;
    let panel = Panel {
        x: Scale::linear(
            shown.iter().flat_map(|row| ends(*row)),
            (LEFT, WIDTH - MARGIN),
        )
        .padded(0.05, 0.05),
        y: Scale::exactly(0.0, 1.0, (bottom, TOP)),
    };
    let mut sheet = Sheet::new("Techniques on a scale of preference (JOD)");
    panel.draw_x(&mut sheet.svg);
    let mut y = TOP + 4.0;
    for component in components {
        if several {
            let title = format!("scale {component}");
            let left = LEFT + 6.0;
            (sheet.svg).text("panel-title", left, y + 16.0, Anchor::Start, &title);
            y += HEAD;
        }
        for row in shown
            .iter()
            .filter(|row| row.label("component") == component)
        {
            estimate(&mut sheet.svg, &panel, *row, y + ROW / 2.0);
            y += ROW;
        }
    }
    Some(Drawing {
        sheet,
        bottom: bottom + 24.0,
        caption: caption(analysis, several),
    })
}

/// Every value that a row shows.
fn ends(row: Row) -> Vec<f64> {
    let intervals = ["jod_ci", "jod_bootstrap"].map(|key| row.interval(key));
    let ends = intervals
        .into_iter()
        .flatten()
        .flat_map(|ends| [ends.low, ends.high]);
    ends.chain(row.number("jod")).chain([0.0]).collect()
}

fn estimate(svg: &mut Svg, panel: &Panel, row: Row, y: f64) {
    text(svg, "label", row.text("technique"), y + 4.5);
    if let Some(bootstrap) = row.interval("jod_bootstrap") {
        let (low, high) = (panel.x.at(bootstrap.low), panel.x.at(bootstrap.high));
        svg.line("wide", (low, y), (high, y));
        for x in [low, high] {
            svg.line("wide", (x, y - 6.0), (x, y + 6.0));
        }
    }
    if let Some(wald) = row.interval("jod_ci") {
        let ends = (panel.x.at(wald.low), panel.x.at(wald.high));
        svg.line("whisker", (ends.0, y), (ends.1, y));
    }
    if let Some(jod) = row.number("jod") {
        let class = if row.interval("jod_ci").is_some() {
            "dot"
        } else {
            "ring"
        };
        svg.circle(class, panel.x.at(jod), y, 5.5);
    }
}

fn caption(analysis: &Analysis, several: bool) -> String {
    let confidence = analysis.settings.alpha.confidence_percent();
    let apart = if several {
        " The scales were never compared with each other: each has a zero of its own, and distances between them mean nothing."
    } else {
        ""
    };
    format!(
        "Thurstone case V; 1 JOD apart means that 75 % prefer the one further right. Thick: {confidence} % Wald interval; thin: bootstrap over participants, where they are known. The first technique of a scale stands at 0 (ring), and the intervals are of the distance to it.{apart}"
    )
}
