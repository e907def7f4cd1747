//! How time grows with pixels, samples, reach and triangles.

use super::CostReport;
use super::palette::Palette;
use super::sheet::finish;
use crate::cost::scaling::{Axis, Exponent, ScalingRow};
use crate::report::figure::axis::Scale;
use crate::report::figure::labels::spread;
use crate::report::figure::numbers::fixed;
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH, shortened};
use crate::report::figure::words::distinct;
use crate::report::svg::{Anchor, Svg};

const LEFT: f64 = 58.0;
/// Room for names right of each panel.
const NAMES: f64 = 148.0;
const GAP: f64 = 40.0;
const HIGH: f64 = 230.0;

/// The times of one scene beside what they grow with: 2 × 2 panels, both axes logarithmic, time
/// as a multiple of that at the smallest value, exponents behind the names. A standalone SVG.
#[must_use]
pub fn scaling(report: &CostReport, scene: &str) -> String {
    let palette = Palette::of(report);
    let mut sheet = Sheet::new(&format!("{scene}: how time grows"));
    let subtitle = "time as a multiple of the first point; behind each name the exponent ± half its 95 % interval";
    sheet.svg.text("key", MARGIN, 44.0, Anchor::Start, subtitle);
    let wide = (WIDTH - LEFT - MARGIN - 2.0 * NAMES - GAP) / 2.0;
    for (index, axis) in Axis::ALL.into_iter().enumerate() {
        let left = LEFT + (index % 2) as f64 * (wide + NAMES + GAP);
        let top = 86.0 + (index / 2) as f64 * (HIGH + 78.0);
        let lines = lines(report.scaling, scene, axis);
        let exponents: Vec<&Exponent> = (report.exponents.iter())
            .filter(|found| found.scene == scene && found.axis == axis)
            .collect();
        let svg = &mut sheet.svg;
        svg.text("panel-title", left, top - 10.0, Anchor::Start, title(axis));
        if lines.is_empty() {
            svg.text("tick", left, top + 14.0, Anchor::Start, "not measured");
            continue;
        }
        let panel = axes(&lines, (left, left + wide), top);
        let titles = Titles {
            x: Some(unit(axis)),
            y: Some(if index % 2 == 0 { "time, relative" } else { "" }),
            y_unit: "×",
        };
        panel.draw(svg, &titles);
        guide(svg, &panel, &lines);
        draw(svg, &panel, &lines, &exponents, &palette);
    }
    let note = "Times without blur. Dotted: growth in proportion.";
    finish(
        sheet,
        report,
        &[],
        &[note],
        86.0 + 2.0 * (HIGH + 78.0) - 22.0,
    )
}

fn title(axis: Axis) -> &'static str {
    match axis {
        Axis::Pixels => "with the pixels of the picture",
        Axis::Samples => "with the samples a pixel",
        Axis::Radius => "with the reach",
        Axis::Triangles => "with the triangles of the same surface",
    }
}

fn unit(axis: Axis) -> &'static str {
    match axis {
        Axis::Pixels => "pixels (log)",
        Axis::Samples => "samples a pixel (log)",
        Axis::Radius => "reach, metres (log)",
        Axis::Triangles => "triangles (log)",
    }
}

struct Line<'a> {
    technique: &'a str,
    points: Vec<Point>,
}

/// Times are multiples of the line's first.
struct Point {
    value: f64,
    time: f64,
    interval: Option<(f64, f64)>,
}

fn lines<'a>(rows: &'a [ScalingRow], scene: &str, axis: Axis) -> Vec<Line<'a>> {
    let is_drawn = |row: &&ScalingRow| {
        let is_log = |number: f64| number > 0.0 && number.is_finite();
        row.scene == scene && row.axis == axis && is_log(row.value) && is_log(row.ms)
    };
    let rows: Vec<&ScalingRow> = rows.iter().filter(is_drawn).collect();
    let names = distinct(rows.iter().map(|row| row.technique.as_str()));
    let line = |technique: &'a str| {
        let mut own: Vec<_> = rows
            .iter()
            .filter(|row| row.technique == technique)
            .collect();
        own.sort_by(|a, b| a.value.total_cmp(&b.value));
        let first = own.first().map_or(1.0, |row| row.ms);
        let point = |row: &&&ScalingRow| {
            let ends = row.low_ms.zip(row.high_ms);
            let ends = ends.filter(|(low, high)| low.is_finite() && high.is_finite());
            Point {
                value: row.value,
                time: row.ms / first,
                interval: ends.map(|(low, high)| (low / first, high / first)),
            }
        };
        Line {
            technique,
            points: own.iter().map(point).collect(),
        }
    };
    names.into_iter().map(line).collect()
}

fn axes(lines: &[Line], sides: (f64, f64), top: f64) -> Panel {
    let points = || lines.iter().flat_map(|line| &line.points);
    let x = Scale::log(points().map(|point| point.value), 1.5, sides);
    let y = Scale::log(points().map(|point| point.time), 4.0, (top + HIGH, top));
    Panel {
        x: x.padded(0.04, 0.04),
        y: y.padded(0.06, 0.06),
    }
}

/// What grows in proportion.
fn guide(svg: &mut Svg, panel: &Panel, lines: &[Line]) {
    let values = || {
        lines
            .iter()
            .flat_map(|line| line.points.iter().map(|point| point.value))
    };
    let (low, high) = (
        values().fold(f64::INFINITY, f64::min),
        values().fold(0.0, f64::max),
    );
    // A straight line that leaves the panel is cut where it does.
    let steps = (0..=40).map(|step| (high / low).powf(f64::from(step) / 40.0));
    let points: Vec<_> = steps.map(|ratio| panel.at(low * ratio, ratio)).collect();
    let top = panel.y.end;
    let inside: Vec<_> = points
        .into_iter()
        .take_while(|point| point.1 > top)
        .collect();
    if let (Some(&from), Some(&to)) = (inside.first(), inside.last()) {
        svg.line("guide", from, to);
    }
}

fn draw(svg: &mut Svg, panel: &Panel, lines: &[Line], exponents: &[&Exponent], palette: &Palette) {
    let mut ends = Vec::new();
    for line in lines {
        let look = palette.look(line.technique);
        let points: Vec<_> = (line.points.iter())
            .map(|point| panel.at(point.value, point.time))
            .collect();
        svg.polyline(&format!("line {}", look.class), &points);
        for (measured, point) in line.points.iter().zip(&points) {
            if let Some((low, high)) = measured.interval {
                let bar = format!("bar {}", look.class);
                let value = measured.value;
                svg.line(&bar, panel.at(value, low), panel.at(value, high));
            }
            svg.mark(&format!("mark {}", look.class), look.mark, *point, 4.0);
        }
        ends.push(
            points
                .last()
                .copied()
                .unwrap_or((panel.x.end, panel.y.start)),
        );
    }
    let wanted: Vec<f64> = ends.iter().map(|end| end.1).collect();
    let heights = spread(&wanted, 14.0, (panel.y.end + 2.0, panel.y.start - 2.0));
    for ((line, end), height) in lines.iter().zip(ends).zip(heights) {
        let look = palette.look(line.technique);
        let x = panel.x.end + 14.0;
        let leader = format!("leader {}", look.class);
        svg.line(&leader, (end.0 + 5.0, end.1), (x - 3.0, height));
        let found = exponents
            .iter()
            .find(|found| found.technique == line.technique);
        let number = found.map_or(String::new(), |found| exponent(found).replace(' ', ""));
        let room = NAMES - 16.0;
        let name = shortened(&format!("{} {number}", line.technique), 11.0, room);
        svg.text(
            &format!("count {}", look.class),
            x,
            height + 4.0,
            Anchor::Start,
            &name,
        );
    }
}

/// An exponent with half its interval.
pub fn exponent(found: &Exponent) -> String {
    match found.half_width.filter(|half| half.is_finite()) {
        Some(half) => format!("{} ± {}", fixed(found.exponent, 2), fixed(half, 2)),
        None => fixed(found.exponent, 2),
    }
}
