//! A forest plot: technique b's share in every condition with both intervals, and the p that the
//! verdict rests on.

use super::shares::{LEFT, Shares, first_rows, name};
use super::{Drawing, StudyFigure};
use crate::analysis::Analysis;
use crate::analysis::conditions::{Family, main_family};
use crate::analysis::dataset::ConditionData;
use crate::analysis::tails::Probability;
use crate::analysis::{clopper_pearson, wilson};
use crate::report::figure::sheet::Sheet;
use crate::report::number::{MISSING, p_value};
use crate::report::svg::{Anchor, Svg};

pub const FIGURE: StudyFigure = StudyFigure {
    id: "forest",
    section: super::TESTS,
    draw,
};

const ROW: f64 = 36.0;
const TOP: f64 = 64.0;
/// The scale leaves room for three numbers behind it.
const SCALE: Shares = Shares {
    left: LEFT,
    right: 600.0,
};
/// Right ends of the numbers behind the scale.
const COLUMNS: [(f64, &str); 3] = [(660.0, "n"), (748.0, "exact p"), (838.0, "after Holm")];

fn draw(analysis: &Analysis) -> Option<Drawing> {
    let (conditions, rest) = first_rows(&analysis.data.conditions);
    if conditions.is_empty() {
        return None;
    }
    let bottom = TOP + ROW * conditions.len() as f64 + 8.0;
    let mut sheet = Sheet::new("Share of technique b, against an even split");
    SCALE.grid(&mut sheet.svg, TOP, bottom);
    for (x, title) in COLUMNS {
        sheet.svg.text("tick", x, TOP - 8.0, Anchor::End, title);
    }
    let family = main_family(&analysis.data, &analysis.settings);
    for (i, condition) in conditions.iter().enumerate() {
        let y = TOP + ROW * (i as f64 + 0.5) + 4.0;
        name(&mut sheet.svg, condition, y);
        estimate(&mut sheet.svg, condition, y, analysis);
        numbers(&mut sheet.svg, condition, &family, i, y);
    }
    let confidence = analysis.settings.alpha.confidence_percent();
    Some(Drawing {
        sheet,
        bottom,
        caption: format!(
            "Share of the votes for technique b of each condition. Thick: {confidence} % Wilson interval; thin: {confidence} % Clopper–Pearson (exact) interval. None of them is corrected for the number of conditions; the p at the right is.{rest}"
        ),
    })
}

fn estimate(svg: &mut Svg, condition: &ConditionData, y: f64, analysis: &Analysis) {
    let alpha = analysis.settings.alpha;
    let Some(share) = condition.votes.share_b() else {
        svg.text("tick", SCALE.x(0.5), y + 4.5, Anchor::Middle, "no votes");
        return;
    };
    if let Ok(exact) = clopper_pearson::interval(condition.votes, alpha) {
        let (low, high) = (SCALE.x(exact.low), SCALE.x(exact.high));
        svg.line("wide", (low, y), (high, y));
        for x in [low, high] {
            svg.line("wide", (x, y - 6.0), (x, y + 6.0));
        }
    }
    if let Ok(wilson) = wilson::interval(condition.votes, alpha) {
        let ends = ((SCALE.x(wilson.low), y), (SCALE.x(wilson.high), y));
        svg.line("whisker", ends.0, ends.1);
    }
    svg.circle("dot", SCALE.x(share), y, 5.5);
}

fn numbers(svg: &mut Svg, condition: &ConditionData, family: &Family, i: usize, y: f64) {
    let p = |p: Option<Probability>| p.map_or_else(|| MISSING.to_owned(), short_p);
    let texts = [
        condition.votes.total().to_string(),
        p(family.p[i].ok()),
        p(family.corrected[i].ok()),
    ];
    for ((x, _), text) in COLUMNS.iter().zip(texts) {
        svg.text("key", *x, y + 4.5, Anchor::End, &text);
    }
}

/// Three decimals in a figure; under that two digits and the power of ten.
fn short_p(p: Probability) -> String {
    match p.value() {
        value if value >= 0.0005 => format!("{value:.3}"),
        _ => p_value(p),
    }
}
