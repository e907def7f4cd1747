//! One coordinate system of a figure: its grid, its ticks, its titles.

use super::axis::Scale;
use super::labels::Area;
use crate::report::svg::{Anchor, Svg};

/// Two scales that span an area.
#[derive(Debug, Clone, Copy)]
pub struct Panel {
    /// To the right.
    pub x: Scale,
    /// Upwards.
    pub y: Scale,
}

/// What stands along the axes; nothing where a neighbour has it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Titles<'a> {
    /// Below.
    pub x: Option<&'a str>,
    /// At the left, upwards; empty for numbers alone.
    pub y: Option<&'a str>,
    /// Behind each number at the left.
    pub y_unit: &'a str,
}

impl Panel {
    /// Where a point lies.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.x.at(x), self.y.at(y))
    }

    /// What it spans.
    pub fn area(&self) -> Area {
        Area {
            left: self.x.start,
            right: self.x.end,
            top: self.y.end,
            bottom: self.y.start,
        }
    }

    /// The grid with ticks and titles.
    pub fn draw(&self, svg: &mut Svg, titles: &Titles) {
        let area = self.area();
        self.draw_x(svg);
        for tick in self.y.ticks() {
            let class = grid_class(tick.label.is_some());
            svg.line(class, (area.left, tick.at), (area.right, tick.at));
            if let (Some(label), Some(_)) = (tick.label, titles.y) {
                let label = format!("{label}{}", titles.y_unit);
                svg.text("tick", area.left - 7.0, tick.at + 4.0, Anchor::End, &label);
            }
        }
        svg.line("axis", (area.left, area.top), (area.left, area.bottom));
        if let Some(title) = titles.x {
            let middle = 0.5 * (area.left + area.right);
            svg.text("tick", middle, area.bottom + 34.0, Anchor::Middle, title);
        }
        if let Some(title) = titles.y.filter(|title| !title.is_empty()) {
            let middle = 0.5 * (area.top + area.bottom);
            let left = f64::max(16.0, area.left - 46.0);
            svg.text_upwards("tick", left, middle, Anchor::Middle, title);
        }
    }

    /// The grid of the axis to the right, and that axis with its ticks.
    pub fn draw_x(&self, svg: &mut Svg) {
        let area = self.area();
        for tick in self.x.ticks() {
            let class = grid_class(tick.label.is_some());
            svg.line(class, (tick.at, area.top), (tick.at, area.bottom));
            if let Some(label) = tick.label {
                svg.text("tick", tick.at, area.bottom + 16.0, Anchor::Middle, &label);
            }
        }
        svg.line("axis", (area.left, area.bottom), (area.right, area.bottom));
    }
}

fn grid_class(is_labelled: bool) -> &'static str {
    match is_labelled {
        true => "grid",
        false => "minor",
    }
}
