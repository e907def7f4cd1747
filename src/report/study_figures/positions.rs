//! How often the image shown first was chosen: pooled, then by condition.

use super::shares::{Shares, first_rows, text};
use super::{Drawing, StudyFigure};
use crate::analysis::Analysis;
use crate::analysis::dataset::Votes;
use crate::analysis::position_bias::{pooled, positions_as_votes};
use crate::analysis::wilson;
use crate::report::figure::sheet::Sheet;
use crate::report::svg::{Anchor, Svg};

pub const FIGURE: StudyFigure = StudyFigure {
    id: "position-bias",
    section: "position_bias",
    draw,
};

const ROW: f64 = 28.0;
const TOP: f64 = 64.0;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    if !analysis.data.has_answers() {
        return None;
    }
    let (conditions, rest) = first_rows(&analysis.data.conditions);
    let bottom = TOP + ROW * (conditions.len() + 1) as f64 + 8.0;
    let mut sheet = Sheet::new("How often the image shown first was chosen");
    Shares::WHOLE.grid(&mut sheet.svg, TOP, bottom);
    let all = ("all conditions", "pooled", pooled(&analysis.data));
    row(&mut sheet.svg, 0, all, analysis);
    for (i, condition) in conditions.iter().enumerate() {
        let votes = condition.orders.as_ref().map(positions_as_votes);
        let one = (condition.id.as_str(), "dot", votes.unwrap_or_default());
        row(&mut sheet.svg, i + 1, one, analysis);
    }
    let confidence = analysis.settings.alpha.confidence_percent();
    Some(Drawing {
        sheet,
        bottom,
        caption: format!(
            "Share of trials in which the image shown first was chosen, with {confidence} % Wilson intervals. The intervals take the trials as independent.{rest}"
        ),
    })
}

fn row(
    svg: &mut Svg,
    number: usize,
    (name, class, votes): (&str, &str, Votes),
    analysis: &Analysis,
) {
    let y = TOP + ROW * (number as f64 + 0.5) + 4.0;
    text(svg, "label", name, y + 4.5);
    let share = votes.share_b();
    let interval = wilson::interval(votes, analysis.settings.alpha);
    let (Some(share), Ok(interval)) = (share, interval) else {
        let middle = Shares::WHOLE.x(0.5);
        svg.text("tick", middle, y + 4.5, Anchor::Middle, "no answers");
        return;
    };
    let x = |share: f64| Shares::WHOLE.x(share);
    svg.interval(x(interval.low), x(interval.high), y);
    svg.circle(class, x(share), y, if number == 0 { 6.5 } else { 5.0 });
}
