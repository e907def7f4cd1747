//! What every model says too much or too little, by albedo.

use super::Figure;
use super::cut;
use super::layout::Grid;
use super::look::{self, finish};
use super::models::{Shown, models};
use crate::reference::bounce_fit::{StudiedMap, Study};
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{Key, Sheet, shortened};
use crate::report::svg::{Anchor, Svg};

/// Albedos that have a row.
const SHOWN: [f64; 4] = [0.0, 0.3, 0.6, 0.9];
/// What the panels reach up and down to.
const LIMIT: f64 = 0.12;
/// What a model had better miss at most, root mean square.
pub const GOAL: f64 = 0.005;

/// One figure for the maps fitted to and one for those held out, where there are any.
pub fn figures(study: &Study) -> Vec<Figure> {
    let of = |held_out: bool, stem: &str, title: &str| {
        let maps = study.maps.iter().enumerate();
        let maps: Vec<_> = maps.filter(|(_, map)| map.held_out == held_out).collect();
        (!maps.is_empty()).then(|| figure(study, &maps, (stem, title)))
    };
    let fitted = "What the models miss on the maps fitted to";
    let held_out = "What the models miss on maps they were not fitted to";
    let both = [
        of(false, "residuals--fitted", fitted),
        of(true, "residuals--held-out", held_out),
    ];
    both.into_iter().flatten().collect()
}

fn figure(study: &Study, maps: &[(usize, &StudiedMap)], (stem, title): (&str, &str)) -> Figure {
    let mut sheet = Sheet::new(title);
    let looks: Vec<String> = maps
        .iter()
        .map(|(place, _)| format!("line {}", look::map(*place)))
        .collect();
    let named = maps.iter().zip(&looks);
    let keys: Vec<_> = named
        .map(|((_, map), look)| (Key::Line(look), map.name.clone()))
        .collect();
    let y = look::keys(&mut sheet, 46.0, &keys);
    // Direct light alone misses far more than the others; its panel would be empty.
    let shown: Vec<Shown> = models(study)
        .into_iter()
        .filter(|model| model.name != "none")
        .collect();
    let grid = Grid {
        below: 20.0,
        ..Grid::new(shown.len(), y + 24.0, 120.0)
    };
    for (row, rho) in SHOWN.into_iter().enumerate() {
        for (column, model) in shown.iter().enumerate() {
            let panel = grid.panel(row * shown.len() + column, (-LIMIT, LIMIT));
            let first = (row == 0).then_some(model.name.as_str());
            axes(
                &mut sheet.svg,
                &panel,
                rho,
                (column == 0, row + 1 == SHOWN.len()),
                first,
            );
            for (place, map) in maps {
                missed(&mut sheet.svg, &panel, (map, *place), model, rho);
            }
        }
    }
    let captions = [String::from(
        "Model minus measured E/π, by bin of openness; one row an albedo ρ. The grey band is ±0.005, what the root mean square is to stay within. Triangles: a line leaves the panel there; crosses: the model is no finite number. Direct light alone (none) is left out: it misses more than the panels show.",
    )];
    let svg = finish(
        sheet,
        &captions,
        grid.bottom(SHOWN.len() * shown.len()) + 40.0,
    );
    Figure::new(stem, title, svg)
}

fn axes(
    svg: &mut Svg,
    panel: &Panel,
    rho: f64,
    (is_first, is_last): (bool, bool),
    name: Option<&str>,
) {
    let area = panel.area();
    let row = format!("missed at ρ = {rho}");
    svg.line("axis", (area.left, area.top), (area.left, area.bottom));
    for tick in panel.y.ticks() {
        svg.line("grid", (area.left, tick.at), (area.right, tick.at));
        if let (Some(label), true) = (tick.label, is_first) {
            svg.text("tick", area.left - 7.0, tick.at + 4.0, Anchor::End, &label);
        }
    }
    if is_first {
        let middle = 0.5 * (area.top + area.bottom);
        svg.text_upwards("tick", 16.0, middle, Anchor::Middle, &row);
    }
    if is_last {
        panel.draw_x(svg);
        let middle = 0.5 * (area.left + area.right);
        svg.text(
            "tick",
            middle,
            area.bottom + 34.0,
            Anchor::Middle,
            "openness α",
        );
    }
    if let Some(name) = name {
        let name = shortened(name, 13.0, area.right - area.left + 20.0);
        svg.text(
            "panel-title",
            area.left,
            area.top - 9.0,
            Anchor::Start,
            &name,
        );
    }
    let (high, low) = (panel.y.at(GOAL), panel.y.at(-GOAL));
    svg.rect("goal", area.left, high, area.right - area.left, low - high);
    svg.line(
        "zero",
        (area.left, panel.y.at(0.0)),
        (area.right, panel.y.at(0.0)),
    );
}

fn missed(
    svg: &mut Svg,
    panel: &Panel,
    (map, place): (&StudiedMap, usize),
    model: &Shown,
    rho: f64,
) {
    let points = map.measured.bins.iter().filter_map(|bin| {
        let said = (model.value)(bin.openness, *bin.factors.first()?, rho);
        Some((bin.openness, said - bin.received(rho)))
    });
    let class = format!("thin {}", look::map(place));
    cut::draw(svg, panel, &class, points, (-LIMIT, LIMIT));
}
