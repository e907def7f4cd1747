//! Stacked bars of the votes, conditions of one pair of techniques together, as in figures 30 to 32
//! of the 2010 study, with the interval that was missing there.

use super::shares::{Shares, first_rows, name};
use super::{Drawing, StudyFigure};
use crate::analysis::Analysis;
use crate::analysis::dataset::ConditionData;
use crate::analysis::wilson;
use crate::report::figure::sheet::{Sheet, shortened};
use crate::report::svg::{Anchor, Svg};

pub const FIGURE: StudyFigure = StudyFigure {
    id: "votes",
    section: super::CHOICES,
    draw,
};

const ROW: f64 = 42.0;
const BAR: f64 = 24.0;
const HEAD: f64 = 34.0;
const TOP: f64 = 64.0;

fn draw(analysis: &Analysis) -> Option<Drawing> {
    let (conditions, rest) = first_rows(&analysis.data.conditions);
    let groups = by_pair(conditions);
    if groups.is_empty() {
        return None;
    }
    let height: f64 = (groups.iter())
        .map(|group| HEAD + ROW * group.len() as f64)
        .sum();
    let bottom = TOP + height + 6.0;
    let mut sheet = Sheet::new("Votes for the two techniques of each condition");
    Shares::WHOLE.grid(&mut sheet.svg, TOP, bottom);
    let mut y = TOP;
    for group in groups {
        heading(&mut sheet.svg, group[0], y + 22.0);
        y += HEAD;
        for condition in group {
            row(&mut sheet.svg, condition, y, analysis);
            y += ROW;
        }
    }
    let confidence = analysis.settings.alpha.confidence_percent();
    Some(Drawing {
        sheet,
        bottom,
        caption: format!(
            "Votes for the first technique (grey) and the second (blue) of each condition. The bar across the border of the two colours is the {confidence} % Wilson interval; where it crosses the dashed line an even split is not ruled out before correction.{rest}"
        ),
    })
}

/// Conditions of one pair together, pairs in order of appearance.
fn by_pair(conditions: &[ConditionData]) -> Vec<Vec<&ConditionData>> {
    let mut groups: Vec<Vec<&ConditionData>> = Vec::new();
    for condition in conditions {
        let pair = (&condition.technique_a, &condition.technique_b);
        match (groups.iter_mut())
            .find(|group| (&group[0].technique_a, &group[0].technique_b) == pair)
        {
            Some(group) => group.push(condition),
            None => groups.push(vec![condition]),
        }
    }
    groups
}

fn heading(svg: &mut Svg, condition: &ConditionData, y: f64) {
    let Shares { left, right } = Shares::WHOLE;
    let half = (right - left) / 2.0 - 10.0;
    let a = shortened(&condition.technique_a, 13.0, half);
    let b = shortened(&condition.technique_b, 13.0, half);
    svg.text("panel-title", left, y, Anchor::Start, &a);
    svg.text("panel-title", right, y, Anchor::End, &b);
}

fn row(svg: &mut Svg, condition: &ConditionData, top: f64, analysis: &Analysis) {
    let middle = top + BAR / 2.0;
    name(svg, condition, middle);
    Shares::WHOLE.bar(svg, condition.votes, (top, BAR), "no votes");
    if let Ok(interval) = wilson::interval(condition.votes, analysis.settings.alpha) {
        let x = |share_b: f64| Shares::WHOLE.x(1.0 - share_b);
        svg.interval(x(interval.high), x(interval.low), middle);
    }
}
