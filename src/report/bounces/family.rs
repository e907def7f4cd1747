//! Models beside the data at every albedo, one panel a model.

use super::cut;
use super::layout::{Grid, OPENNESS, openness, openness_finely, provenance};
use super::look::{finish, step, strip};
use super::models::{Shown, models};
use super::{Figure, stem_of};
use crate::reference::bounce_fit::{ALBEDOS, StudiedMap, Study};
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{MARGIN, Sheet};
use crate::report::svg::{Anchor, Mark, Svg};

/// Values that the panels show: somewhat beyond what light there can be.
const ENDS: (f64, f64) = (0.0, 1.12);
const COLUMNS: usize = 2;
/// How far dots lie apart at least, in openness.
const APART: f64 = 0.018;

/// One figure for the first map, and one for the first that no model was fitted to.
pub fn figures(study: &Study) -> Vec<Figure> {
    let held_out = study.maps.iter().skip(1).find(|map| map.held_out);
    study
        .maps
        .first()
        .into_iter()
        .chain(held_out)
        .map(|map| figure(study, map))
        .collect()
}

fn figure(study: &Study, map: &StudiedMap) -> Figure {
    let held_out = if map.held_out { ", held out" } else { "" };
    let title = format!("{}{held_out}: models at every albedo", map.name);
    let mut sheet = Sheet::new(&title);
    keys(&mut sheet.svg);
    let shown = models(study);
    let grid = Grid::new(COLUMNS, 86.0, 230.0);
    for (index, model) in shown.iter().enumerate() {
        let panel = grid.panel(index, ENDS);
        let titles = Titles {
            x: Some(OPENNESS),
            y: (index % COLUMNS == 0).then_some("irradiance E/π"),
            y_unit: "",
        };
        panel.draw(&mut sheet.svg, &titles);
        let (left, top) = (panel.x.start, panel.y.end);
        let note = if model.is_cosine {
            " (given the measured direct light)"
        } else {
            ""
        };
        let name = format!("{}{note}", model.name);
        sheet
            .svg
            .text("panel-title", left, top - 8.0, Anchor::Start, &name);
        draw(&mut sheet, &panel, map, model);
        if let Some(text) = outside(model) {
            // Left of where the pole is.
            let (right, bottom) = (panel.x.at(0.92), panel.y.start);
            for (line, text) in text.iter().enumerate() {
                let y = bottom - 26.0 + 15.0 * line as f64;
                sheet.svg.text("note", right, y, Anchor::End, text);
            }
        }
    }
    let captions = [
        provenance(map),
        String::from(
            "Every texel has the same albedo. A model without a pole stays below the dashed line, which is a point in the open; one that keeps energy lies on it at ρ = 1. Each mark stands for one stretch of one albedo's line that is not shown.",
        ),
    ];
    let svg = finish(sheet, &captions, grid.bottom(shown.len()));
    Figure::new(format!("family--{}", stem_of(map)), &title, svg)
}

/// What colours, lines and marks stand for.
fn keys(svg: &mut Svg) {
    let classes = (0..ALBEDOS.len()).map(albedo);
    let right = strip(svg, (MARGIN, 46.0), ["albedo ρ 0", "1, by tenths"], classes);
    svg.dots(
        "data t-none",
        &[0.0, 7.0, 14.0].map(|x| (right + 30.0 + x, 42.0)),
    );
    svg.text("key", right + 52.0, 46.0, Anchor::Start, "measured");
    svg.polyline(
        "line t-none",
        &[(right + 130.0, 42.0), (right + 158.0, 42.0)],
    );
    svg.text("key", right + 164.0, 46.0, Anchor::Start, "model");
    svg.mark("out", Mark::Up, (right + 226.0, 42.0), 3.2);
    svg.text(
        "key",
        right + 236.0,
        46.0,
        Anchor::Start,
        "beyond the panel",
    );
    svg.mark("out", Mark::Cross, (right + 362.0, 42.0), 3.2);
    svg.text("key", right + 372.0, 46.0, Anchor::Start, "no number");
}

/// What 8-bit textures can hold for which a model is no light there can be; none where all is well.
fn outside(model: &Shown) -> Option<[String; 2]> {
    if model.is_safe {
        return None;
    }
    let levels = || (0..=255).map(|level| f64::from(level) / 255.0);
    let all = levels().flat_map(|a| levels().map(move |rho| (a, rho)));
    let (mut none, mut outside) = (0, 0);
    for (alpha, rho) in all {
        let value = (model.value)(alpha, alpha, rho);
        none += usize::from(!value.is_finite());
        // Rounding is no light.
        outside += usize::from(value.is_finite() && !(-1e-9..=1.0 + 1e-9).contains(&value));
    }
    Some([
        format!("of 256 × 256 levels of α and ρ: {none} no number,"),
        format!("{outside} below 0 or above 1"),
    ])
}

fn albedo(place: usize) -> String {
    step(place, ALBEDOS.len())
}

fn draw(sheet: &mut Sheet, panel: &Panel, map: &StudiedMap, model: &Shown) {
    let svg = &mut sheet.svg;
    svg.line("whole", panel.at(0.0, 1.0), panel.at(1.0, 1.0));
    let mut apart = Vec::new();
    for bin in &map.measured.bins {
        let before = apart
            .last()
            .map_or(f64::NEG_INFINITY, |(openness, _)| *openness);
        if bin.openness - before >= APART {
            apart.push((bin.openness, bin));
        }
    }
    for (place, rho) in ALBEDOS.into_iter().enumerate() {
        let dots = apart
            .iter()
            .map(|(openness, bin)| panel.at(*openness, bin.received(rho)));
        svg.dots(
            &format!("data {}", albedo(place)),
            &dots.collect::<Vec<_>>(),
        );
    }
    for (place, rho) in ALBEDOS.into_iter().enumerate() {
        let class = format!("thin {}", albedo(place));
        if model.is_cosine {
            let bins = map.measured.bins.iter();
            let points = bins.filter_map(|bin| {
                Some((
                    bin.openness,
                    (model.value)(bin.openness, *bin.factors.first()?, rho),
                ))
            });
            cut::draw(svg, panel, &class, points, ENDS);
        } else {
            let points = |a| (a, (model.value)(a, f64::NAN, rho));
            match model.is_safe {
                true => cut::draw(svg, panel, &class, openness().map(points), ENDS),
                false => cut::draw(svg, panel, &class, openness_finely().map(points), ENDS),
            }
        }
    }
}
