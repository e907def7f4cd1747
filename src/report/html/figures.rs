//! The figures: stacked votes with intervals, and the position chosen.

use crate::analysis::Analysis;
use crate::analysis::dataset::{ConditionData, Votes};
use crate::analysis::position_bias::{pooled, positions_as_votes};
use crate::analysis::settings::Settings;
use crate::analysis::wilson;
use crate::report::svg::{Anchor, Svg};

const WIDTH: f64 = 860.0;
/// Left end of the scale from 0 to 100 %; the labels stand before it.
const LEFT: f64 = 230.0;
const RIGHT: f64 = 830.0;
/// A figure with more rows says less than the table.
const MOST_ROWS: usize = 100;

fn x(share: f64) -> f64 {
    LEFT + (RIGHT - LEFT) * share
}

/// Stacked bars of the votes for a and b, with the Wilson interval across their border.
pub fn votes(analysis: &Analysis) -> String {
    const ROW: f64 = 58.0;
    const BAR: f64 = 24.0;
    let conditions = first_rows(&analysis.data.conditions);
    let height = 34.0 + ROW * conditions.len() as f64 + 14.0;
    let mut svg = Svg::new(WIDTH, height);
    axis(&mut svg, height, "share of votes");
    for (row, condition) in conditions.iter().enumerate() {
        let top = 42.0 + ROW * row as f64;
        label(&mut svg, condition, top + BAR);
        svg.text(
            "technique",
            LEFT,
            top + 8.0,
            Anchor::Start,
            &condition.technique_a,
        );
        svg.text(
            "technique",
            RIGHT,
            top + 8.0,
            Anchor::End,
            &condition.technique_b,
        );
        bar(
            &mut svg,
            condition.votes,
            top + 14.0,
            BAR,
            &analysis.settings,
        );
    }
    svg.line("even", (x(0.5), 28.0), (x(0.5), height - 10.0));
    svg.finish("Votes for the two techniques of each condition")
}

fn bar(svg: &mut Svg, votes: Votes, top: f64, height: f64, settings: &Settings) {
    let Some(share_b) = votes.share_b() else {
        svg.rect("none", LEFT, top, RIGHT - LEFT, height);
        svg.text("tick", x(0.25), top + 16.0, Anchor::Middle, "no votes");
        return;
    };
    let border = x(1.0 - share_b);
    svg.rect("a", LEFT, top, border - LEFT, height);
    svg.rect("b", border, top, RIGHT - border, height);
    // The number keeps to the outer end of its part, where the interval rarely reaches.
    if votes.a > 0 {
        svg.text(
            "count-a",
            LEFT + 8.0,
            top + 16.5,
            Anchor::Start,
            &votes.a.to_string(),
        );
    }
    if votes.b > 0 {
        svg.text(
            "count-b",
            RIGHT - 8.0,
            top + 16.5,
            Anchor::End,
            &votes.b.to_string(),
        );
    }
    if let Ok(interval) = wilson::interval(votes, settings.alpha) {
        svg.interval(
            x(1.0 - interval.high),
            x(1.0 - interval.low),
            top + height / 2.0,
        );
    }
}

/// Share of trials in which the first image was chosen: pooled, then by condition.
pub fn positions(analysis: &Analysis) -> String {
    const ROW: f64 = 30.0;
    let conditions = first_rows(&analysis.data.conditions);
    let height = 34.0 + ROW * (conditions.len() + 1) as f64 + 16.0;
    let mut svg = Svg::new(WIDTH, height);
    axis(&mut svg, height, "chose the image shown first");
    svg.line("even", (x(0.5), 28.0), (x(0.5), height - 10.0));
    let mut row = |number: usize, name: &str, class: &str, votes: Votes| {
        let y = 50.0 + ROW * number as f64;
        svg.text("label", LEFT - 16.0, y + 4.5, Anchor::End, name);
        if let (Some(share), Ok(interval)) = (
            votes.share_b(),
            wilson::interval(votes, analysis.settings.alpha),
        ) {
            svg.interval(x(interval.low), x(interval.high), y);
            svg.circle(class, x(share), y, if number == 0 { 6.5 } else { 5.0 });
        } else {
            svg.text("tick", x(0.5), y + 4.5, Anchor::Middle, "no answers");
        }
    };
    row(0, "all conditions", "pooled", pooled(&analysis.data));
    for (i, condition) in conditions.iter().enumerate() {
        let votes = condition.orders.as_ref().map(positions_as_votes);
        row(i + 1, &condition.id, "dot", votes.unwrap_or_default());
    }
    svg.finish("How often the image shown first was chosen, by condition")
}

fn first_rows(conditions: &[ConditionData]) -> &[ConditionData] {
    &conditions[..conditions.len().min(MOST_ROWS)]
}

fn axis(svg: &mut Svg, height: f64, title: &str) {
    svg.text("tick", LEFT - 36.0, 18.0, Anchor::End, title);
    for percent in [0, 25, 50, 75, 100] {
        let at = x(f64::from(percent) / 100.0);
        svg.text("tick", at, 18.0, Anchor::Middle, &format!("{percent} %"));
        svg.line("grid", (at, 28.0), (at, height - 10.0));
    }
}

fn label(svg: &mut Svg, condition: &ConditionData, y: f64) {
    match &condition.hypothesis {
        Some(hypothesis) => {
            svg.text("label", LEFT - 16.0, y - 1.0, Anchor::End, &condition.id);
            svg.text("technique", LEFT - 16.0, y + 14.0, Anchor::End, hypothesis);
        }
        None => svg.text("label", LEFT - 16.0, y + 6.5, Anchor::End, &condition.id),
    }
}
