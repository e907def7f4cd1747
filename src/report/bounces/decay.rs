//! How the bounces decay: a surface over openness and bounce, seen from the upper left, and the same
//! from straight above.

use super::layout::{LEFT, OPENNESS, curve, provenance};
use super::look::{finish, heat, strip};
use super::{Figure, stem_of};
use crate::reference::bounce_fit::StudiedMap;
use crate::report::figure::axis::Scale;
use crate::report::figure::numbers::tick;
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH};
use crate::report::svg::{Anchor, Svg};

/// Cells of the surface along the openness.
const CELLS: usize = 50;
/// Ratio of the largest to the smallest number that has a colour of its own.
const RANGE: f64 = 1e3;

/// The surface, and the map below it.
pub fn figure(map: &StudiedMap) -> Figure {
    let title = format!("{}: how the bounces decay", map.name);
    let mut sheet = Sheet::new(&title);
    let grid = Heights::of(map);
    let svg = &mut sheet.svg;
    let low = format!("E/π {} or less", tick_of(grid.highest / RANGE));
    let high = format!("{} (log)", tick_of(grid.highest));
    strip(
        svg,
        (MARGIN, 46.0),
        [&low, &high],
        (0..24).map(|k| heat(f64::from(k) / 23.0)),
    );
    let view = View {
        bounces: map.bounces.max(2),
        highest: grid.highest,
    };
    view.floor(svg);
    grid.draw(svg, &view);
    view.numbers(svg);
    from_above(svg, map, &grid, 478.0);
    let captions = [
        provenance(map),
        String::from(
            "Above: mean irradiance E/π of each bounce after the direct light, its height linear and its colour logarithmic; the first bounce stands at the back. Below: the same from above. Empty where no bin has enough texels.",
        ),
    ];
    let svg = finish(sheet, &captions, 742.0);
    Figure::new(format!("decay--{}", stem_of(map)), &title, svg)
}

fn tick_of(value: f64) -> String {
    crate::report::figure::numbers::significant(value, 2)
}

/// Means on an even grid, bounce by bounce from the first.
struct Heights {
    rows: Vec<Vec<Option<f64>>>,
    highest: f64,
}

impl Heights {
    fn of(map: &StudiedMap) -> Self {
        let rows: Vec<Vec<Option<f64>>> = (1..=map.bounces)
            .map(|bounce| {
                let points: Vec<_> = curve(map, bounce)
                    .map(|at| (at.openness, at.mean))
                    .collect();
                let at = |k| between(&points, k as f64 / CELLS as f64);
                (0..=CELLS).map(at).collect()
            })
            .collect();
        let all = rows.iter().flatten().flatten();
        let highest = all.copied().fold(0.0, f64::max);
        Self {
            rows,
            highest: if highest > 0.0 { highest } else { 1.0 },
        }
    }

    /// Share of the colours.
    fn colour(&self, value: f64) -> String {
        let share = 1.0 + (value.max(1e-300) / self.highest).ln() / RANGE.ln();
        heat(share)
    }

    /// Faces from the back to the front, and in a row from the right: the eye is at the left, so
    /// that each hides what it stands before.
    fn draw(&self, svg: &mut Svg, view: &View) {
        for (row, two) in self.rows.windows(2).enumerate() {
            for cell in (0..CELLS).rev() {
                let corners = [
                    (row, cell, two[0][cell]),
                    (row, cell + 1, two[0][cell + 1]),
                    (row + 1, cell + 1, two[1][cell + 1]),
                    (row + 1, cell, two[1][cell]),
                ];
                let heights: Option<Vec<f64>> = corners.iter().map(|corner| corner.2).collect();
                let Some(heights) = heights else {
                    continue;
                };
                let mean = heights.iter().sum::<f64>() / 4.0;
                let placed = corners
                    .iter()
                    .zip(&heights)
                    .map(|((row, cell, _), height)| {
                        view.at(*cell as f64 / CELLS as f64, row + 1, *height)
                    });
                let class = format!("face {}", self.colour(mean));
                svg.polygon(&class, &placed.collect::<Vec<_>>());
            }
        }
    }
}

/// Along straight lines between points; nothing more than a bin beyond them.
fn between(points: &[(f64, f64)], x: f64) -> Option<f64> {
    const NEAR: f64 = 0.0101;
    let above = points.partition_point(|point| point.0 < x);
    let right = points.get(above);
    let left = above.checked_sub(1).and_then(|below| points.get(below));
    match (left, right) {
        (Some(a), Some(b)) if b.0 - a.0 < 5.0 * NEAR => {
            Some(a.1 + (b.1 - a.1) * (x - a.0) / (b.0 - a.0))
        }
        (Some(a), _) if x - a.0 < NEAR => Some(a.1),
        (_, Some(b)) if b.0 - x < NEAR => Some(b.1),
        _ => None,
    }
}

/// A parallel view: openness to the right, bounces from the back to the front, height upwards.
struct View {
    bounces: usize,
    highest: f64,
}

impl View {
    const FRONT_LEFT: (f64, f64) = (96.0, 410.0);
    const WIDE: f64 = 440.0;
    /// From the front to the back.
    const BACK: (f64, f64) = (240.0, -130.0);
    const HIGH: f64 = 190.0;

    fn at(&self, openness: f64, bounce: usize, height: f64) -> (f64, f64) {
        let depth = self.bounces.saturating_sub(bounce) as f64 / (self.bounces - 1) as f64;
        (
            Self::FRONT_LEFT.0 + Self::WIDE * openness + Self::BACK.0 * depth,
            Self::FRONT_LEFT.1 + Self::BACK.1 * depth - Self::HIGH * height / self.highest,
        )
    }

    /// Bounces that the axis names.
    fn named(&self) -> impl Iterator<Item = usize> + use<> {
        let last = self.bounces;
        let every = if last > 10 { 5 } else { 1 };
        std::iter::once(1).chain((2..=last).filter(move |bounce| bounce % every == 0))
    }

    /// Heights that the wall names.
    fn heights(&self) -> Vec<(f64, String)> {
        let scale = Scale::exactly(0.0, self.highest, (0.0, self.highest));
        let named = scale.ticks().into_iter();
        named
            .filter_map(|tick| Some((tick.at, tick.label?)))
            .collect()
    }

    /// Lines on the floor and on the wall at the back.
    fn floor(&self, svg: &mut Svg) {
        for k in 0..=5 {
            let openness = f64::from(k) / 5.0;
            svg.line(
                "grid",
                self.at(openness, self.bounces, 0.0),
                self.at(openness, 1, 0.0),
            );
            svg.line(
                "grid",
                self.at(openness, 1, 0.0),
                self.at(openness, 1, self.highest),
            );
        }
        for bounce in self.named() {
            svg.line("grid", self.at(0.0, bounce, 0.0), self.at(1.0, bounce, 0.0));
        }
        for (height, _) in self.heights() {
            svg.line("grid", self.at(0.0, 1, height), self.at(1.0, 1, height));
        }
        let corners = [(0.0, 1), (0.0, self.bounces), (1.0, self.bounces), (1.0, 1)];
        let corners = corners.map(|(openness, bounce)| self.at(openness, bounce, 0.0));
        svg.polyline("frame", &corners);
    }

    fn numbers(&self, svg: &mut Svg) {
        for k in 0..=5 {
            let openness = f64::from(k) / 5.0;
            let (x, y) = self.at(openness, self.bounces, 0.0);
            svg.text("tick", x, y + 16.0, Anchor::Middle, &tick(openness));
        }
        let (x, y) = self.at(0.5, self.bounces, 0.0);
        svg.text("tick", x, y + 34.0, Anchor::Middle, OPENNESS);
        for bounce in self.named() {
            let (x, y) = self.at(1.0, bounce, 0.0);
            svg.text("tick", x + 9.0, y + 5.0, Anchor::Start, &bounce.to_string());
        }
        let (x, y) = self.at(1.0, self.bounces.div_ceil(2), 0.0);
        svg.text("tick", x + 40.0, y + 14.0, Anchor::Start, "bounce");
        for (height, label) in self.heights() {
            let (x, y) = self.at(0.0, 1, height);
            svg.text("tick", x - 8.0, y + 4.0, Anchor::End, &label);
        }
        let (x, y) = self.at(0.0, 1, 0.5 * self.highest);
        svg.text_upwards("tick", x - 48.0, y, Anchor::Middle, "irradiance E/π");
    }
}

/// A cell a bin and bounce.
fn from_above(svg: &mut Svg, map: &StudiedMap, grid: &Heights, top: f64) {
    let bounces = map.bounces.max(1) as f64;
    let panel = Panel {
        x: Scale::exactly(0.0, 1.0, (LEFT, WIDTH - MARGIN)),
        y: Scale::exactly(bounces + 0.5, 0.5, (top + 200.0, top)),
    };
    panel.draw_x(svg);
    for bounce in 1..=map.bounces {
        for at in curve(map, bounce) {
            let (left, high) = panel.at(at.openness - 0.005, bounce as f64 - 0.5);
            let (right, low) = panel.at(at.openness + 0.005, bounce as f64 + 0.5);
            let class = format!("cell {}", grid.colour(at.mean));
            svg.rect(&class, left, high, right - left, low - high);
        }
    }
    let middle = 0.5 * (LEFT + WIDTH - MARGIN);
    svg.text("tick", middle, top + 234.0, Anchor::Middle, OPENNESS);
    for bounce in (View {
        bounces: map.bounces.max(1),
        highest: 1.0,
    })
    .named()
    {
        let y = panel.y.at(bounce as f64) + 4.0;
        svg.text("tick", LEFT - 7.0, y, Anchor::End, &bounce.to_string());
    }
    svg.text_upwards("tick", 16.0, top + 100.0, Anchor::Middle, "bounce");
}
