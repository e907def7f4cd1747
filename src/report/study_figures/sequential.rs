//! The anytime-valid test on its way: the evidence after every vote, one small panel a condition.

use super::{Drawing, StudyFigure};
use crate::analysis::Analysis;
use crate::analysis::sequential;
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH, shortened};
use crate::report::svg::Anchor;

pub const FIGURE: StudyFigure = StudyFigure {
    id: "anytime",
    section: "sequential",
    draw,
};

const COLUMNS: usize = 3;
const LEFT: f64 = 52.0;
const GAP: f64 = 30.0;
const TOP: f64 = 62.0;
const HIGH: f64 = 120.0;
const STEP: f64 = HIGH + 58.0;
/// More panels say less than the table.
const MOST_PANELS: usize = 12;
/// Points of a line; a run of a million votes is thinned.
const MOST_POINTS: usize = 400;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    let paths = sequential::paths(&analysis.data, MOST_PANELS)?;
    let longest = paths.iter().map(Vec::len).max().filter(|&n| n > 1)?;
    let limit = -analysis.settings.alpha.get().log10();
    let values = || paths.iter().flatten().copied();
    let (low, high) = (
        values().fold(-1.0, f64::min),
        values().fold(limit + 0.4, f64::max),
    );
    let wide = (WIDTH - MARGIN - LEFT + GAP) / COLUMNS as f64 - GAP;
    let mut sheet = Sheet::new("Evidence after every vote");
    for (i, path) in paths.iter().enumerate() {
        let left = LEFT + (wide + GAP) * (i % COLUMNS) as f64;
        let top = TOP + STEP * (i / COLUMNS) as f64;
        let panel = Panel {
            x: Scale::exactly(0.0, (longest - 1) as f64, (left, left + wide)),
            y: Scale::exactly(low, high, (top + HIGH, top)),
        };
        let is_first = i % COLUMNS == 0;
        let titles = Titles {
            x: (i + COLUMNS >= paths.len()).then_some("votes"),
            y: is_first.then_some("log₁₀ e"),
            y_unit: "",
        };
        panel.draw(&mut sheet.svg, &titles);
        let name = shortened(&analysis.data.conditions[i].id, 13.0, wide);
        (sheet.svg).text("panel-title", left, top - 8.0, Anchor::Start, &name);
        let y = panel.y.at(limit);
        sheet.svg.line("limit", (left, y), (left + wide, y));
        let even = panel.y.at(0.0);
        sheet.svg.line("even", (left, even), (left + wide, even));
        let step = path.len().div_ceil(MOST_POINTS).max(1);
        let last = path.len().saturating_sub(1);
        let points: Vec<_> = (path.iter().enumerate())
            .filter(|(n, _)| n % step == 0 || *n == last)
            .map(|(n, log10)| panel.at(n as f64, *log10))
            .collect();
        sheet.svg.polyline("path", &points);
    }
    let rows = paths.len().div_ceil(COLUMNS) as f64;
    let more = analysis.data.conditions.len() - paths.len();
    let more = match more {
        0 => String::new(),
        _ => format!(" {more} conditions more are in the table."),
    };
    Some(Drawing {
        sheet,
        bottom: TOP + STEP * rows - 18.0,
        caption: format!(
            "e-value after each vote, participants in order of appearance. A line that once touches the dashed one at the top (1/alpha = {:.0}) has shown a preference at alpha = {}, whenever one looks; below the other dashed line the votes speak for an even split. Not corrected for the number of conditions.{more}",
            1.0 / analysis.settings.alpha.get(),
            analysis.settings.alpha.get(),
        ),
    })
}
