//! Mean ranks of the versions of each scene, best at the left.

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
    id: "ranks",
    section: "rankings",
    draw,
};

const ROW: f64 = 26.0;
const HEAD: f64 = 28.0;
const TOP: f64 = 44.0;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    let table = table(analysis, "rankings", "ranks")?;
    let shown: Vec<(Row, f64)> = rows(table)
        .filter_map(|row| Some((row, row.number("mean_rank")?)))
        .take(MOST_ROWS)
        .collect();
    if shown.is_empty() {
        return None;
    }
    let groups = distinct(shown.iter().map(|(row, _)| row.text("condition")));
    let bottom = TOP + ROW * shown.len() as f64 + HEAD * groups.len() as f64 + 8.0;
    let worst = shown.iter().map(|(_, rank)| *rank).fold(2.0, f64::max);
    let panel = Panel {
        x: Scale::exactly(1.0, worst.ceil(), (LEFT + 8.0, WIDTH - MARGIN - 8.0)),
        y: Scale::exactly(0.0, 1.0, (bottom, TOP)),
    };
    let mut sheet = Sheet::new("Mean ranks");
    panel.draw_x(&mut sheet.svg);
    let mut y = TOP;
    for group in groups {
        (sheet.svg).text("panel-title", LEFT + 6.0, y + 20.0, Anchor::Start, group);
        y += HEAD;
        for (row, rank) in (shown.iter()).filter(|(row, _)| row.text("condition") == group) {
            let middle = y + ROW / 2.0;
            text(&mut sheet.svg, "label", row.text("technique"), middle + 4.5);
            let from = panel.x.at(1.0);
            (sheet.svg).line("wide", (from, middle), (panel.x.at(*rank), middle));
            sheet.svg.circle("dot", panel.x.at(*rank), middle, 5.0);
            y += ROW;
        }
    }
    Some(Drawing {
        sheet,
        bottom: bottom + 24.0,
        caption: "Mean of the ranks that participants gave each version; 1 is the best.".to_owned(),
    })
}
