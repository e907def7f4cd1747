//! Mean ratings of the techniques, scale by scale.

use super::lookup::{Row, rows, table};
use super::shares::{LEFT, text};
use super::{Drawing, MOST_ROWS, StudyFigure};
use crate::analysis::Analysis;
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH};
use crate::report::figure::words::distinct;
use crate::report::svg::Anchor;

pub const FIGURE: StudyFigure = StudyFigure {
    id: "ratings",
    section: "ratings",
    draw,
};

const ROW: f64 = 26.0;
const HEAD: f64 = 28.0;
const TOP: f64 = 44.0;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    let table = table(analysis, "ratings", "ratings")?;
    let shown: Vec<Row> = rows(table)
        .filter(|row| row.number("mean").is_some())
        .take(MOST_ROWS)
        .collect();
    if shown.is_empty() {
        return None;
    }
    let heading = |row: &Row| format!("{}: {}", row.text("scale"), row.text("condition"));
    let headings: Vec<String> = shown.iter().map(heading).collect();
    let groups = distinct(headings.iter().map(String::as_str));
    let bottom = TOP + ROW * shown.len() as f64 + HEAD * groups.len() as f64 + 8.0;
    let panel = Panel {
        x: Scale::linear(
            shown.iter().flat_map(|row| ends(*row)),
            (LEFT, WIDTH - MARGIN),
        )
        .padded(0.05, 0.05),
        y: Scale::exactly(0.0, 1.0, (bottom, TOP)),
    };
    let mut sheet = Sheet::new("Mean ratings");
    panel.draw_x(&mut sheet.svg);
    let mut y = TOP;
    for group in groups {
        (sheet.svg).text("panel-title", LEFT + 6.0, y + 20.0, Anchor::Start, group);
        y += HEAD;
        for (row, _) in (shown.iter().zip(&headings)).filter(|(_, name)| *name == group) {
            let middle = y + ROW / 2.0;
            text(&mut sheet.svg, "label", row.text("technique"), middle + 4.5);
            if let Some(ends) = row.interval("mean_ci") {
                let (low, high) = (panel.x.at(ends.low), panel.x.at(ends.high));
                sheet.svg.line("whisker", (low, middle), (high, middle));
            }
            if let Some(mean) = row.number("mean") {
                sheet.svg.circle("dot", panel.x.at(mean), middle, 5.0);
            }
            y += ROW;
        }
    }
    let confidence = analysis.settings.alpha.confidence_percent();
    Some(Drawing {
        sheet,
        bottom: bottom + 24.0,
        caption: format!(
            "Mean of the participants' ratings, points, with {confidence} % intervals of the mean."
        ),
    })
}

fn ends(row: Row) -> Vec<f64> {
    let interval = row.interval("mean_ci");
    let ends = interval.into_iter().flat_map(|ends| [ends.low, ends.high]);
    ends.chain(row.number("mean")).collect()
}
