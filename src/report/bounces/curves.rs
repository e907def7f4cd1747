//! What every bounce brings, over openness.

use super::layout::{LEFT, OPENNESS, band, curve, line, provenance};
use super::look::{self, finish, strip};
use super::{Figure, stem_of};
use crate::reference::bounce_fit::{LEAST_TEXELS, StudiedMap};
use crate::report::figure::axis::Scale;
use crate::report::figure::labels::{Area, Label, Placer};
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{Key, MARGIN, Sheet, WIDTH};
use crate::report::svg::Anchor;

/// Smallest share of a logarithmic axis.
const LEAST: f64 = 1e-5;
/// Bounces that have a number beside their curve.
const NUMBERED: usize = 4;

/// Each bounce of a map: texels, means and deviations.
pub fn figure(map: &StudiedMap) -> Figure {
    let title = format!("{}: irradiance of every bounce over openness", map.name);
    let mut sheet = Sheet::new(&title);
    let (direct, first) = (class(map, 0), class(map, 1));
    let dots = [format!("mark {direct}"), format!("mark {first}")];
    let keys = [
        (
            Key::Mark(&dots[0]),
            String::from("direct light: texels, mean, ±1 SD"),
        ),
        (
            Key::Mark(&dots[1]),
            String::from("first bounce: texels, mean, ±1 SD"),
        ),
    ];
    let y = look::keys(&mut sheet, 46.0, &keys);
    let last = format!("to {}", map.bounces);
    let ramp = (2..=map.bounces).map(|bounce| class(map, bounce));
    strip(
        &mut sheet.svg,
        (MARGIN, y + 6.0),
        ["bounces from 2", &last],
        ramp,
    );
    all(&mut sheet, map, y + 26.0);
    later(&mut sheet, map, y + 396.0);
    let captions = [
        provenance(map),
        format!(
            "Shares E/π of the irradiance of a point in the open under a sky of unit radiance; albedo 1. Lines: means of bins of 0.01 of α with {LEAST_TEXELS} texels or more; bands: one standard deviation of the texels in a bin; dots: some of the texels, evenly over the map."
        ),
    ];
    let svg = finish(sheet, &captions, y + 664.0);
    Figure::new(format!("curves--{}", stem_of(map)), &title, svg)
}

fn class(map: &StudiedMap, bounce: usize) -> String {
    look::bounce(bounce, map.bounces)
}

/// Direct light and all bounces on one scale.
fn all(sheet: &mut Sheet, map: &StudiedMap, top: f64) {
    let panel = Panel {
        x: Scale::exactly(0.0, 1.0, (LEFT, WIDTH - MARGIN)),
        y: Scale::exactly(0.0, 1.05, (top + 290.0, top)),
    };
    let titles = Titles {
        x: Some(OPENNESS),
        y: Some("irradiance E/π"),
        y_unit: "",
    };
    let svg = &mut sheet.svg;
    panel.draw(svg, &titles);
    for bounce in 0..2 {
        let dots = map.texels.iter().map(|texel| {
            let share = f64::from(texel[1 + bounce]);
            panel.at(f64::from(texel[0]), share)
        });
        let class = class(map, bounce);
        svg.dots(&format!("dots {class}"), &dots.collect::<Vec<_>>());
        band(svg, &panel, &class, map, bounce);
    }
    for bounce in (0..=map.bounces).rev() {
        let points = curve(map, bounce).map(|at| (at.openness, at.mean));
        let weight = if bounce < 2 { "line" } else { "thin" };
        line(
            svg,
            &panel,
            &format!("{weight} {}", class(map, bounce)),
            points,
            (0.0, 1.05),
        );
    }
}

/// All but the direct light, close by and by ratios.
fn later(sheet: &mut Sheet, map: &StudiedMap, top: f64) {
    const HIGH: f64 = 210.0;
    let middle = 0.5 * (LEFT + WIDTH - MARGIN);
    let highest = curve(map, 1).map(|at| at.mean + at.deviation);
    let highest = highest.fold(1e-3, f64::max);
    let least = (1..=map.bounces)
        .flat_map(|bounce| curve(map, bounce))
        .map(|at| at.mean)
        .filter(|mean| *mean >= LEAST);
    let linear = Panel {
        x: Scale::exactly(0.0, 1.0, (LEFT, middle - 14.0)),
        y: Scale::exactly(0.0, 1.06 * highest, (top + HIGH, top)),
    };
    let log = Panel {
        x: Scale::exactly(0.0, 1.0, (middle + 48.0, WIDTH - MARGIN)),
        y: Scale::log(least, 10.0, (top + HIGH, top)).padded(0.02, 0.03),
    };
    for (panel, name) in [
        (&linear, "the bounces alone, E/π"),
        (&log, "the same by ratios, E/π (log)"),
    ] {
        let titles = Titles {
            x: Some(OPENNESS),
            y: Some(""),
            y_unit: "",
        };
        panel.draw(&mut sheet.svg, &titles);
        let left = panel.x.start;
        sheet
            .svg
            .text("panel-title", left, top - 10.0, Anchor::Start, name);
    }
    for bounce in 1..=map.bounces.min(3) {
        band(&mut sheet.svg, &linear, &class(map, bounce), map, bounce);
    }
    for bounce in (1..=map.bounces).rev() {
        let class = format!("thin {}", class(map, bounce));
        let points = curve(map, bounce).map(|at| (at.openness, at.mean));
        line(
            &mut sheet.svg,
            &linear,
            &class,
            points.clone(),
            (0.0, 1.06 * highest),
        );
        let shown = points.filter(|(_, mean)| *mean >= LEAST);
        line(&mut sheet.svg, &log, &class, shown, (LEAST, f64::INFINITY));
    }
    numbers(sheet, map, &linear);
}

/// Numbers at the peaks of the first bounces.
fn numbers(sheet: &mut Sheet, map: &StudiedMap, panel: &Panel) {
    let mut placer = Placer::new(panel.area());
    for bounce in 1..=map.bounces.min(NUMBERED) {
        let points: Vec<_> = curve(map, bounce)
            .map(|at| panel.at(at.openness, at.mean))
            .collect();
        placer.cross(&points);
    }
    for bounce in 1..=map.bounces.min(NUMBERED) {
        let peak = curve(map, bounce).max_by(|a, b| a.mean.total_cmp(&b.mean));
        let Some(peak) = peak else {
            continue;
        };
        let point = panel.at(peak.openness, peak.mean);
        placer.take(Area::around(point, 2.0));
        let label = Label {
            text: &bounce.to_string(),
            class: "count",
            colour: &class(map, bounce),
            size: 11.0,
            is_optional: false,
        };
        placer.place(&mut sheet.svg, point, &label);
    }
}
