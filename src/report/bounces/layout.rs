//! Panels in rows and columns, and lines in them.

use super::cut;
use crate::reference::bounce_fit::{LEAST_TEXELS, StudiedMap};
use crate::reference::height_field::CurvePoint;
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{MARGIN, WIDTH};
use crate::report::svg::Svg;

/// Left end of the axes.
pub const LEFT: f64 = 62.0;
/// Room between columns, and between rows, titles included.
const GAP: (f64, f64) = (26.0, 64.0);

/// What the axis to the right is in every figure over openness.
pub const OPENNESS: &str = "openness α (uniform)";

/// Equal panels side by side.
#[derive(Debug, Clone, Copy)]
pub struct Grid {
    /// How many in a row.
    pub columns: usize,
    /// Top of the first row.
    pub top: f64,
    /// Height of each.
    pub high: f64,
    /// Room between rows.
    pub below: f64,
    /// Room between columns.
    pub beside: f64,
}

impl Grid {
    /// With room for numbers and titles below each row.
    pub fn new(columns: usize, top: f64, high: f64) -> Self {
        Self {
            columns: columns.max(1),
            top,
            high,
            below: GAP.1,
            beside: GAP.0,
        }
    }

    /// The sides of a panel, left and right, bottom and top.
    pub fn sides(&self, index: usize) -> ((f64, f64), (f64, f64)) {
        let room = WIDTH - MARGIN - LEFT + self.beside;
        let wide = room / self.columns as f64 - self.beside;
        let left = LEFT + (index % self.columns) as f64 * (wide + self.beside);
        let top = self.top + (index / self.columns) as f64 * (self.high + self.below);
        ((left, left + wide), (top + self.high, top))
    }

    /// A panel over openness.
    pub fn panel(&self, index: usize, (low, high): (f64, f64)) -> Panel {
        let (x, y) = self.sides(index);
        Panel {
            x: Scale::exactly(0.0, 1.0, x),
            y: Scale::exactly(low, high, y),
        }
    }

    /// Below so many panels.
    pub fn bottom(&self, count: usize) -> f64 {
        let rows = count.div_ceil(self.columns);
        self.top + rows as f64 * (self.high + self.below)
    }
}

/// The curve of a bounce, of bins with enough texels.
pub fn curve(map: &StudiedMap, bounce: usize) -> impl Iterator<Item = &CurvePoint> + Clone {
    (map.curves.iter()).filter(move |at| at.bounce == bounce && at.texels >= LEAST_TEXELS)
}

/// A line over openness inside its panel.
pub fn line(
    svg: &mut Svg,
    panel: &Panel,
    class: &str,
    points: impl Iterator<Item = (f64, f64)>,
    ends: (f64, f64),
) {
    cut::draw(svg, panel, class, points, ends);
}

/// One standard deviation to either side of a curve, cut at the ends.
pub fn band(svg: &mut Svg, panel: &Panel, class: &str, map: &StudiedMap, bounce: usize) {
    let low = curve(map, bounce).map(|at| panel.at(at.openness, at.mean - at.deviation));
    let high = curve(map, bounce).map(|at| panel.at(at.openness, at.mean + at.deviation));
    let mut corners: Vec<_> = low.collect();
    let mut back: Vec<_> = high.collect();
    back.reverse();
    corners.extend(back);
    svg.polygon(&format!("band {class}"), &corners);
}

/// Openness at even steps, finer where the direct light nears the open.
pub fn openness() -> impl Iterator<Item = f64> + Clone {
    let coarse = (0..90).map(|k| f64::from(k) / 100.0);
    coarse.chain((0..=200).map(|k| 0.9 + f64::from(k) / 2000.0))
}

/// The same, finer still: for a model whose pole is narrower than the steps of the others.
pub fn openness_finely() -> impl Iterator<Item = f64> + Clone {
    let coarse = (0..90).map(|k| f64::from(k) / 100.0);
    coarse.chain((0..=800).map(|k| 0.9 + f64::from(k) / 8000.0))
}

/// A sentence on how a map was followed.
pub fn provenance(map: &StudiedMap) -> String {
    use crate::reference::height_field::Border;
    let border = match map.border {
        Border::Tiled => "tiled without end",
        Border::Open => "open at its border",
    };
    format!(
        "{}: {} × {} texels, amplitude {} of its width, {border}, {} rays a texel, {} bounces at an albedo of 1.",
        map.name,
        map.size_px.0,
        map.size_px.1,
        crate::report::figure::numbers::significant(map.amplitude, 3),
        map.rays,
        map.bounces
    )
}
