//! Time against error: every technique through its sample counts, the front of what nothing
//! beats, what no occlusion at all costs, and what the depth buffer cannot know.

use super::CostReport;
use super::palette::Palette;
use super::series::{self, Line, front_of, is_none, is_of_grid};
use super::sheet::finish;
use crate::cost::configuration::Resolution;
use crate::cost::row::Row;
use crate::report::figure::axis::Scale;
use crate::report::figure::labels::{Area, Label, Placer};
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{Key, MARGIN, Sheet, WIDTH, shortened};
use crate::report::svg::{Anchor, Svg};

/// Left end of the axes.
const LEFT: f64 = 66.0;
/// Least ratio of the ends of the time axis.
const TIME_RATIO: f64 = 4.0;

/// Keys of the lines, of all panels.
const KEYS: [(Key, &str); 4] = [
    (Key::Marked("line t-none", "mark t-none"), "full resolution"),
    (Key::Marked("half t-none", "open t-none"), "half resolution"),
    (Key::Mark("open t-none"), "other blur or named setting"),
    (Key::Line("front"), "front: nothing is faster and better"),
];

const NOTE: &str = "Lines run through the sample counts (small numbers), with the widest blur measured. Other settings are drawn where they are on the front, or where a set of images names them. Bars: 95 % intervals of the median time.";

/// Time against the error of the occlusion in one scene: RMSE of k_A (0 closed to 1 open)
/// against the ray-traced truth over milliseconds. A standalone SVG.
#[must_use]
pub fn plane(report: &CostReport, scene: &str) -> String {
    let rows = series::once(report.rows, scene);
    let title = format!("{scene}: error of the occlusion against time");
    let mut sheet = Sheet::new(&title);
    sheet.keys(MARGIN, 46.0, &KEYS);
    let what = What {
        y: |row| row.rmse,
        title: "RMSE of the occlusion against the truth",
        loss: rows.first().map(|row| row.information_loss_rmse),
    };
    let panel = axes(&rows, &rows, &what, (62.0, 482.0));
    draw(
        &mut sheet.svg,
        &panel,
        &rows,
        &Palette::of(report),
        &what,
        (is_log(&rows, &what), true),
    );
    finish(sheet, report, &rows, &[NOTE], 540.0)
}

/// Time against what can be seen in one scene: mean FLIP (0 to 1) against the image with the
/// true occlusion over milliseconds, one panel a lighting variant. A standalone SVG.
#[must_use]
pub fn flip_plane(report: &CostReport, scene: &str) -> String {
    const HIGH: f64 = 300.0;
    let lightings = series::lightings(report.rows, scene);
    let mut sheet = Sheet::new(&format!("{scene}: visible difference against time"));
    sheet.keys(MARGIN, 46.0, &KEYS);
    let what = What {
        y: |row| row.flip_mean,
        title: "mean FLIP",
        loss: None,
    };
    let all: Vec<Vec<&Row>> = (lightings.iter())
        .map(|lighting| series::under(report.rows, scene, lighting))
        .collect();
    let together = all.concat();
    let mut top = 84.0;
    for (index, (lighting, rows)) in lightings.iter().zip(&all).enumerate() {
        let name = shortened(
            &format!("lighting: {lighting}"),
            13.0,
            WIDTH - LEFT - MARGIN,
        );
        sheet
            .svg
            .text("panel-title", LEFT, top - 10.0, Anchor::Start, &name);
        let panel = axes(&together, rows, &what, (top, top + HIGH));
        let is_last = index + 1 == lightings.len();
        draw(
            &mut sheet.svg,
            &panel,
            rows,
            &Palette::of(report),
            &what,
            (is_log(&together, &what), is_last),
        );
        top += HIGH + 54.0;
    }
    finish(sheet, report, &together, &[NOTE], top + 2.0)
}

/// What is drawn upwards.
struct What {
    y: fn(&Row) -> f64,
    title: &'static str,
    /// What no technique that looks at the depth buffer alone can know.
    loss: Option<f64>,
}

/// Rows that are drawn: the lines, what is on the front, and named settings.
fn drawn<'a>(rows: &[&'a Row], what: &What) -> (Vec<Line<'a>>, Vec<&'a Row>, Vec<&'a Row>) {
    let lines = series::lines(rows);
    let front = front_of(rows, what.y);
    let is_on_line = |row: &Row| {
        (lines.iter()).any(|line| line.rows.iter().any(|other| std::ptr::eq(*other, row)))
    };
    let is_on_front = |row: &Row| front.iter().any(|other| std::ptr::eq(*other, row));
    let alone: Vec<&Row> = (rows.iter().copied())
        .filter(|row| row.total_ms > 0.0 && !is_on_line(row))
        .filter(|row| is_on_front(row) || !is_of_grid(row))
        .collect();
    (lines, front, alone)
}

/// Least ratio of the errors of a figure from which on their axis is logarithmic: one bad
/// technique would press the good ones together.
const LOG_FROM: f64 = 4.0;

/// Axes around what is drawn; `wide` are the rows of all panels of the figure, which share the
/// time and how errors are spread.
fn axes(wide: &[&Row], rows: &[&Row], what: &What, (top, bottom): (f64, f64)) -> Panel {
    let times = shown(wide, what).into_iter().map(|point| point.0);
    let errors = errors(rows, what);
    let y = match is_log(wide, what) {
        true => Scale::log(errors.into_iter(), 1.5, (bottom, top)),
        false => Scale::linear(errors.into_iter(), (bottom, top)),
    };
    Panel {
        x: Scale::log(times, TIME_RATIO, (LEFT, WIDTH - MARGIN)).padded(0.04, 0.13),
        y: y.padded(0.06, 0.08),
    }
}

/// Times and errors of what is drawn.
fn shown(rows: &[&Row], what: &What) -> Vec<(f64, f64)> {
    let (lines, _, alone) = drawn(rows, what);
    let on_lines = lines.iter().flat_map(|line| line.rows.iter().copied());
    let point = |row: &Row| (row.total_ms, (what.y)(row));
    on_lines.chain(alone).map(point).collect()
}

/// Errors of what is drawn, and those they are compared with.
fn errors(rows: &[&Row], what: &What) -> Vec<f64> {
    let none = rows.iter().filter(|row| is_none(&row.technique));
    let drawn = shown(rows, what).into_iter().map(|point| point.1);
    let compared = none.map(|row| (what.y)(row)).chain(what.loss);
    drawn.chain(compared).collect()
}

fn is_log(rows: &[&Row], what: &What) -> bool {
    let errors = errors(rows, what);
    let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let most = errors.iter().copied().fold(0.0, f64::max);
    least > 0.0 && most > LOG_FROM * least
}

fn draw(
    svg: &mut Svg,
    panel: &Panel,
    rows: &[&Row],
    palette: &Palette,
    what: &What,
    (is_log, is_last): (bool, bool),
) {
    let title = match is_log {
        true => format!("{} (log)", what.title),
        false => what.title.to_owned(),
    };
    let titles = Titles {
        x: is_last.then_some("time of the occlusion passes, milliseconds (log)"),
        y: Some(&title),
        y_unit: "",
    };
    panel.draw(svg, &titles);
    let (lines, front, alone) = drawn(rows, what);
    let mut placer = Placer::new(panel.area());
    draw_front(svg, panel, &mut placer, &front, what);
    references(svg, panel, &mut placer, rows, what);
    let at = |row: &Row| panel.at(row.total_ms, (what.y)(row));
    for line in &lines {
        let look = palette.look(line.technique);
        let points: Vec<_> = line.rows.iter().map(|row| at(row)).collect();
        let is_full = line.resolution == Resolution::Full;
        let (class, mark) = if is_full {
            ("line", "mark")
        } else {
            ("half", "open")
        };
        svg.polyline(&format!("{class} {}", look.class), &points);
        placer.cross(&points);
        for row in &line.rows {
            bar(svg, panel, row, (what.y)(row), &look.class);
            let radius = if is_full { 4.6 } else { 2.6 };
            svg.mark(
                &format!("{mark} {}", look.class),
                look.mark,
                at(row),
                radius,
            );
            placer.take(Area::around(at(row), radius + 1.0));
        }
    }
    for row in &alone {
        let look = palette.look(&row.technique);
        bar(svg, panel, row, (what.y)(row), &look.class);
        svg.mark(&format!("open {}", look.class), look.mark, at(row), 4.2);
        placer.take(Area::around(at(row), 5.0));
    }
    names(svg, &mut placer, &lines, &alone, palette, &at);
}

/// The front: from one point on nothing is better until the next.
fn draw_front(svg: &mut Svg, panel: &Panel, placer: &mut Placer, front: &[&Row], what: &What) {
    let mut points = Vec::new();
    for row in front {
        let (x, y) = panel.at(row.total_ms, (what.y)(row));
        if let Some(&(_, before)) = points.last() {
            points.push((x, before));
        }
        points.push((x, y));
    }
    if let Some(&(_, last)) = points.last() {
        points.push((panel.x.end, last));
    }
    svg.polyline("front", &points);
    placer.cross(&points);
}

fn references(svg: &mut Svg, panel: &Panel, placer: &mut Placer, rows: &[&Row], what: &What) {
    let none = rows.iter().find(|row| is_none(&row.technique)).copied();
    let lines = [
        (none.map(what.y), "none-line", "no occlusion"),
        (what.loss, "loss-line", "the most that depths tell"),
    ];
    let ends = |y: f64| [panel.x.start, panel.x.end].map(|x| (x, panel.y.at(y)));
    for (y, class, _) in lines {
        if let Some(y) = y {
            svg.line(class, ends(y)[0], ends(y)[1]);
            placer.cross(&ends(y));
        }
    }
    for (y, _, text) in lines {
        let Some(y) = y else {
            continue;
        };
        // The label keeps to the left end, where techniques are too fast to be.
        let label = Label {
            text,
            class: "note",
            colour: "",
            size: 12.0,
            is_optional: false,
        };
        placer.place(svg, ends(y)[0], &label);
    }
}

fn bar(svg: &mut Svg, panel: &Panel, row: &Row, y: f64, colour: &str) {
    if let (Some(low), Some(high)) = (row.total_low_ms, row.total_high_ms)
        && low.is_finite()
        && high.is_finite()
    {
        svg.line(
            &format!("bar {colour}"),
            panel.at(low, y),
            panel.at(high, y),
        );
    }
}

/// Names at the ends of full lines, then at lone marks, then sample counts where there is room.
fn names(
    svg: &mut Svg,
    placer: &mut Placer,
    lines: &[Line],
    alone: &[&Row],
    palette: &Palette,
    at: &dyn Fn(&Row) -> (f64, f64),
) {
    let has_full = |technique: &str| {
        (lines.iter())
            .any(|line| line.technique == technique && line.resolution == Resolution::Full)
    };
    let is_named = |line: &&Line| line.resolution == Resolution::Full || !has_full(line.technique);
    for line in lines.iter().filter(is_named) {
        if let Some(last) = line.rows.last() {
            write(
                svg,
                placer,
                palette,
                last,
                at(last),
                (line.technique, "name", false),
            );
        }
    }
    for row in alone {
        let text = match is_of_grid(row) {
            true if row.resolution == Resolution::Half => format!("{} half", row.samples),
            true => row.samples.to_string(),
            false => row.label.clone(),
        };
        write(
            svg,
            placer,
            palette,
            row,
            at(row),
            (&text, "count", is_of_grid(row)),
        );
    }
    for line in lines.iter().filter(is_named) {
        for row in &line.rows {
            let text = row.samples.to_string();
            write(svg, placer, palette, row, at(row), (&text, "count", true));
        }
    }
}

fn write(
    svg: &mut Svg,
    placer: &mut Placer,
    palette: &Palette,
    row: &Row,
    point: (f64, f64),
    (text, class, is_optional): (&str, &str, bool),
) {
    let label = Label {
        text: &shortened(text, 12.0, 200.0),
        class,
        colour: &palette.look(&row.technique).class,
        size: if class == "name" { 12.5 } else { 11.0 },
        is_optional,
    };
    placer.place(svg, point, &label);
}
