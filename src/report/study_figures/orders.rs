//! How evenly each condition was shown in its two orders.

use super::shares::{Shares, first_rows, text};
use super::{Drawing, StudyFigure};
use crate::analysis::Analysis;
use crate::analysis::dataset::Votes;
use crate::report::figure::sheet::Sheet;

pub const FIGURE: StudyFigure = StudyFigure {
    id: "orders",
    section: "position_bias",
    draw,
};

const ROW: f64 = 30.0;
const BAR: f64 = 20.0;
const TOP: f64 = 64.0;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    if !analysis.data.has_answers() {
        return None;
    }
    let (conditions, rest) = first_rows(&analysis.data.conditions);
    let bottom = TOP + ROW * conditions.len() as f64 + 8.0;
    let mut sheet = Sheet::new("Balance of the two orders");
    Shares::WHOLE.grid(&mut sheet.svg, TOP, bottom);
    for (i, condition) in conditions.iter().enumerate() {
        let top = TOP + ROW * i as f64 + 8.0;
        text(
            &mut sheet.svg,
            "label",
            &condition.id,
            top + BAR / 2.0 + 4.5,
        );
        let (a, b) = condition.orders.map(|counts| counts.orders())?;
        let parts = Votes { a, b };
        Shares::WHOLE.bar(&mut sheet.svg, parts, (top, BAR), "no answers");
    }
    Some(Drawing {
        sheet,
        bottom,
        caption: format!(
            "Answered trials of each condition in its base order, technique a first (grey), and turned round, technique b first (blue). Where the border is off the dashed line, a preference for a position shows as one for a technique.{rest}"
        ),
    })
}
