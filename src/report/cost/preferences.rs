//! What people chose, beside what the images cost.

use super::CostReport;
use super::palette::{Look, Palette};
use super::series::is_none;
use super::sheet::finish;
use crate::cost::votes::{Preference, Side};
use crate::report::figure::axis::Scale;
use crate::report::figure::labels::{Area, Label, Placer};
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH, shortened};
use crate::report::figure::words::distinct;
use crate::report::svg::{Anchor, Svg};

const LEFT: f64 = 66.0;
const GAP: f64 = 22.0;
const TOP: f64 = 92.0;
const HIGH: f64 = 330.0;
/// Room for images that take no time, left of the axis of times.
const NOTHING: f64 = 40.0;
/// Panels side by side.
const COLUMNS: usize = 3;
/// The levels of validity in their order.
const LEVELS: [&str; 3] = ["low", "moderate", "high"];

/// Every condition as a line from image a to image b: share of the votes over the time of the
/// image's occlusion (milliseconds), with b's Wilson interval; one panel a level of validity. A
/// standalone SVG.
#[must_use]
pub fn preferences(report: &CostReport) -> String {
    let source = report.votes_source;
    let title = match source {
        "" => String::from("What people chose, and what it costs"),
        _ => format!("{}, beside their cost", capitalised(source)),
    };
    let mut sheet = Sheet::new(&title);
    let subtitle = "each line goes from the first image of a condition to the second; bar: 95 % Wilson interval";
    sheet.svg.text("key", MARGIN, 46.0, Anchor::Start, subtitle);
    let palette = Palette::of(report);
    let drawn = drawn(report.preferences);
    let levels = levels(&drawn);
    let columns = levels.len().clamp(1, COLUMNS);
    let wide = (WIDTH - MARGIN - LEFT + GAP) / columns as f64 - GAP;
    let mut top = TOP;
    for line in levels.chunks(columns) {
        for (column, level) in line.iter().enumerate() {
            let left = LEFT + (wide + GAP) * column as f64;
            let title = shortened(&format!("validity: {level}"), 13.0, wide);
            sheet
                .svg
                .text("panel-title", left, top - 12.0, Anchor::Start, &title);
            let here: Vec<&Preference> = (drawn.iter().copied())
                .filter(|one| one.validity == *level)
                .collect();
            let panel = axes(&drawn, (left, left + wide), top);
            frame(&mut sheet.svg, &panel, left, column == 0);
            conditions(&mut sheet.svg, &panel, left, &here, report, &palette);
        }
        top += HIGH + 74.0;
    }
    let rows: Vec<_> = report.rows.iter().collect();
    let note =
        "Images that take no time stand at 0; those of about one time are drawn side by side.";
    finish(sheet, report, &rows, &[note], top - 14.0)
}

fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    let first = chars.next().into_iter().flat_map(char::to_uppercase);
    first.chain(chars).collect()
}

fn drawn(preferences: &[Preference]) -> Vec<&Preference> {
    let is_drawn = |one: &&Preference| {
        let share = &one.share_b;
        let numbers = [one.a.ms, one.b.ms, share.value, share.low, share.high];
        numbers.iter().all(|number| number.is_finite())
    };
    preferences.iter().filter(is_drawn).collect()
}

/// Low, moderate, high, then others by first appearance.
fn levels<'a>(preferences: &[&'a Preference]) -> Vec<&'a str> {
    let mut found = distinct(preferences.iter().map(|one| one.validity.as_str()));
    found.sort_by_key(|level| {
        let place = LEVELS.iter().position(|known| known == level);
        place.unwrap_or(LEVELS.len())
    });
    found
}

fn axes(preferences: &[&Preference], (left, right): (f64, f64), top: f64) -> Panel {
    let times = preferences.iter().flat_map(|one| [one.a.ms, one.b.ms]);
    Panel {
        x: Scale::log(times, 4.0, (left + NOTHING, right)).padded(0.12, 0.12),
        y: Scale::exactly(0.0, 100.0, (top + HIGH, top)),
    }
}

fn frame(svg: &mut Svg, panel: &Panel, left: f64, is_first: bool) {
    let area = panel.area();
    let middle = 0.5 * (left + area.right);
    for percent in [0, 25, 50, 75, 100] {
        let y = panel.y.at(f64::from(percent));
        svg.line("grid", (left, y), (area.left - 8.0, y));
        svg.line("grid", (area.left, y), (area.right, y));
        if is_first {
            let label = format!("{percent} %");
            svg.text("tick", left - 7.0, y + 4.0, Anchor::End, &label);
        }
    }
    panel.draw_x(svg);
    let nothing = left + 0.5 * (NOTHING - 8.0);
    svg.line("axis", (left, area.bottom), (area.left - 8.0, area.bottom));
    svg.text("tick", nothing, area.bottom + 16.0, Anchor::Middle, "0");
    let even = panel.y.at(50.0);
    svg.line("loss-line", (left, even), (area.right, even));
    svg.text(
        "tick",
        middle,
        area.bottom + 34.0,
        Anchor::Middle,
        "ms of the image's occlusion (log)",
    );
    if is_first {
        let height = 0.5 * (area.top + area.bottom);
        svg.text_upwards("tick", 16.0, height, Anchor::Middle, "share of the votes");
    }
}

/// Where an image lies; what takes no time has a place of its own.
fn place(panel: &Panel, left: f64, ms: f64, share: f64) -> (f64, f64) {
    let x = match ms > 0.0 {
        true => panel.x.at(ms),
        false => left + 0.5 * (NOTHING - 8.0),
    };
    (x, panel.y.at(100.0 * share))
}

/// A condition, and its images with what they look like and where they lie.
type End<'a> = (&'a Preference, (Look, (f64, f64)), (Look, (f64, f64)));

fn conditions(
    svg: &mut Svg,
    panel: &Panel,
    left: f64,
    preferences: &[&Preference],
    report: &CostReport,
    palette: &Palette,
) {
    let area = panel.area();
    let mut placer = Placer::new(Area { left, ..area });
    let even = panel.y.at(50.0);
    placer.cross(&[(left, even), (area.right, even)]);
    let mut ends: Vec<End> = Vec::new();
    for one in preferences {
        let share = &one.share_b;
        let from = place(panel, left, one.a.ms, 1.0 - share.value);
        let mut to = place(panel, left, one.b.ms, share.value);
        // Intervals of images with one time would hide each other.
        while (ends.iter()).any(|(_, _, (_, other)): &End| (other.0 - to.0).abs() < 4.0)
            && to.0 + 8.0 < area.right
        {
            to.0 += 8.0;
        }
        let (a, b) = (look(&one.a, report, palette), look(&one.b, report, palette));
        svg.line(&format!("line {}", b.class), from, to);
        placer.cross(&[from, to]);
        let (low, high) = (
            panel.y.at(100.0 * share.low),
            panel.y.at(100.0 * share.high),
        );
        let class = format!("bar {}", b.class);
        svg.line(&class, (to.0, low), (to.0, high));
        for y in [low, high] {
            svg.line(&class, (to.0 - 4.0, y), (to.0 + 4.0, y));
        }
        placer.cross(&[(to.0, low), (to.0, high)]);
        for (look, point) in [(&a, from), (&b, to)] {
            svg.mark(&format!("mark {}", look.class), look.mark, point, 5.4);
            placer.take(Area::around(point, 6.4));
        }
        ends.push((*one, (a, from), (b, to)));
    }
    for (one, (a, from), (b, to)) in &ends {
        let room = 0.8 * (area.right - left);
        let text = shortened(&format!("{}, {}", one.b.label, one.scene), 11.0, room);
        name(svg, &mut placer, *to, &text, &b.class);
        let text = shortened(&one.a.label, 11.0, room);
        name(svg, &mut placer, *from, &text, &a.class);
    }
}

fn name(svg: &mut Svg, placer: &mut Placer, point: (f64, f64), text: &str, colour: &str) {
    let label = Label {
        text,
        class: "count",
        colour,
        size: 11.0,
        is_optional: false,
    };
    placer.place(svg, point, &label);
}

/// Of an image by its label, which rows join to a technique.
fn look(side: &Side, report: &CostReport, palette: &Palette) -> Look {
    let row = report.rows.iter().find(|row| row.label == side.label);
    match row {
        Some(row) if !is_none(&row.technique) => palette.look(&row.technique),
        _ => palette.look(""),
    }
}
