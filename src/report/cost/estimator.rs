//! The error of a technique beside the part that a better estimator would not make.

use super::CostReport;
use super::palette::Palette;
use super::series::{self, is_none, is_of_grid};
use super::sheet::finish;
use crate::cost::configuration::Resolution;
use crate::cost::row::Row;
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{Key, MARGIN, Sheet, WIDTH, shortened};
use crate::report::svg::{Anchor, Svg};

/// The sample count whose nearest is shown.
const SAMPLES: f64 = 16.0;
/// Panels side by side.
const COLUMNS: usize = 3;
/// Where the first panel begins, behind the names.
const LEFT: f64 = 128.0;
const GAP: f64 = 34.0;
const ROW: f64 = 24.0;

/// Of every technique at about 16 samples a pixel (full resolution, widest blur) in every scene:
/// its whole RMSE against the truth and its RMSE against the best that the depth buffer allows,
/// both of k_A. A standalone SVG.
#[must_use]
pub fn estimator(report: &CostReport) -> String {
    let palette = Palette::of(report);
    let mut sheet = Sheet::new("What the estimator gets wrong, and what is wrong in all");
    let keys = [
        (Key::Mark("mark t-none"), "RMSE against the truth"),
        (
            Key::Mark("open t-none"),
            "against the depth buffer's best answer",
        ),
        (
            Key::Line("loss-line"),
            "that answer itself against the truth",
        ),
    ];
    sheet.keys(MARGIN, 46.0, &keys);
    let scenes = report.scenes();
    let shown: Vec<(&str, Vec<&Row>)> = (scenes.iter())
        .map(|scene| (*scene, representative(report.rows, scene)))
        .collect();
    let names: Vec<&str> = (std::iter::once(series::NONE))
        .chain(palette.names().iter().copied())
        .filter(|name| {
            let rows = shown.iter().flat_map(|(_, rows)| rows);
            rows.clone().any(|row| row.technique == *name)
        })
        .collect();
    let columns = COLUMNS.min(shown.len().max(1));
    let wide = (WIDTH - MARGIN - LEFT + GAP) / columns as f64 - GAP;
    let high = ROW * names.len() as f64 + 8.0;
    let most = shown
        .iter()
        .flat_map(|(_, rows)| rows)
        .flat_map(|row| numbers(row));
    let most = most.chain(std::iter::once(0.0));
    let whole = Scale::linear(most, (0.0, wide)).padded(0.0, 0.06);
    let mut top = 92.0;
    for line in shown.chunks(columns) {
        names_at(&mut sheet.svg, &names, &palette, top);
        for (column, (scene, rows)) in line.iter().enumerate() {
            let left = LEFT + (wide + GAP) * column as f64;
            let x = whole.between(left, left + wide);
            let y = Scale::exactly(0.0, names.len().max(1) as f64, (top, top + high));
            let title = shortened(scene, 13.0, wide);
            sheet
                .svg
                .text("panel-title", left, top - 12.0, Anchor::Start, &title);
            scene_panel(&mut sheet.svg, (x, y), &names, rows, &palette);
        }
        top += high + 62.0;
    }
    let rows: Vec<&Row> = shown
        .iter()
        .flat_map(|(_, rows)| rows.iter().copied())
        .collect();
    let note = format!(
        "RMSE of k_A at the sample count nearest to {SAMPLES} of each technique, full resolution, widest blur."
    );
    finish(sheet, report, &rows, &[&note], top - 8.0)
}

fn numbers(row: &Row) -> [f64; 3] {
    [row.rmse, row.estimator_rmse, row.information_loss_rmse]
}

/// Each technique's row whose samples are nearest to 16, and none's.
fn representative<'a>(rows: &'a [Row], scene: &str) -> Vec<&'a Row> {
    let rows = series::once(rows, scene);
    let none = rows.iter().find(|row| is_none(&row.technique)).copied();
    let lines = series::lines(&rows);
    let full = lines
        .iter()
        .filter(|line| line.resolution == Resolution::Full);
    let away = |row: &Row| (f64::from(row.samples.max(1)) / SAMPLES).ln().abs();
    let nearest = full.filter_map(|line| {
        let of_grid = line.rows.iter().filter(|row| is_of_grid(row));
        of_grid.min_by(|a, b| away(a).total_cmp(&away(b))).copied()
    });
    none.into_iter().chain(nearest).collect()
}

fn names_at(svg: &mut Svg, names: &[&str], palette: &Palette, top: f64) {
    for (place, name) in names.iter().enumerate() {
        let look = palette.look(name);
        let y = top + 4.0 + ROW * (place as f64 + 0.5);
        svg.mark(
            &format!("mark {}", look.class),
            look.mark,
            (MARGIN + 6.0, y),
            4.6,
        );
        let shown = match is_none(name) {
            true => String::from("no occlusion"),
            false => shortened(name, 12.0, LEFT - MARGIN - 26.0),
        };
        let class = format!("name {}", look.class);
        svg.text(&class, MARGIN + 18.0, y + 4.0, Anchor::Start, &shown);
    }
}

fn scene_panel(
    svg: &mut Svg,
    (x, y): (Scale, Scale),
    names: &[&str],
    rows: &[&Row],
    palette: &Palette,
) {
    // The rows lie downwards, so that the panel is upside down.
    let panel = Panel {
        x,
        y: Scale::exactly(0.0, 1.0, (y.end, y.start)),
    };
    let area = panel.area();
    for tick in x.ticks() {
        svg.line("grid", (tick.at, area.top), (tick.at, area.bottom));
        if let Some(label) = tick.label {
            svg.text("tick", tick.at, area.bottom + 16.0, Anchor::Middle, &label);
        }
    }
    svg.text(
        "tick",
        0.5 * (x.start + x.end),
        area.bottom + 33.0,
        Anchor::Middle,
        "RMSE",
    );
    if let Some(row) = rows.first() {
        let at = x.at(row.information_loss_rmse);
        svg.line("loss-line", (at, area.top), (at, area.bottom));
    }
    for row in rows {
        let Some(place) = names.iter().position(|name| *name == row.technique) else {
            continue;
        };
        let look = palette.look(&row.technique);
        let height = area.top + 4.0 + ROW * (place as f64 + 0.5);
        let (whole, part) = (x.at(row.rmse), x.at(row.estimator_rmse));
        svg.line(
            &format!("bar {}", look.class),
            (whole, height),
            (part, height),
        );
        svg.mark(
            &format!("open {}", look.class),
            look.mark,
            (part, height),
            4.6,
        );
        svg.mark(
            &format!("mark {}", look.class),
            look.mark,
            (whole, height),
            5.0,
        );
    }
}
