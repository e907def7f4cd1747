//! Names beside what they name, without overlap: each goes to the free place nearest to its
//! point, with a thin line where that is not near.

use crate::report::svg::{Anchor, Svg, text_width};

/// An upright rectangle.
#[derive(Debug, Clone, Copy)]
pub struct Area {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Right edge.
    pub right: f64,
    /// Lower edge.
    pub bottom: f64,
}

impl Area {
    /// Around a point.
    pub fn around((x, y): (f64, f64), radius: f64) -> Self {
        Self {
            left: x - radius,
            top: y - radius,
            right: x + radius,
            bottom: y + radius,
        }
    }

    fn overlap(&self, other: &Self) -> f64 {
        let wide = self.right.min(other.right) - self.left.max(other.left);
        let high = self.bottom.min(other.bottom) - self.top.max(other.top);
        wide.max(0.0) * high.max(0.0)
    }

    /// How long a straight line is inside (Liang & Barsky 1984).
    fn inside(&self, (x, y): (f64, f64), (to_x, to_y): (f64, f64)) -> f64 {
        let (dx, dy) = (to_x - x, to_y - y);
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (step, room) in [
            (-dx, x - self.left),
            (dx, self.right - x),
            (-dy, y - self.top),
            (dy, self.bottom - y),
        ] {
            if step == 0.0 {
                if room < 0.0 {
                    return 0.0;
                }
            } else if step < 0.0 {
                from = from.max(room / step);
            } else {
                to = to.min(room / step);
            }
        }
        (to - from).max(0.0) * dx.hypot(dy)
    }
}

/// A text to be placed.
pub struct Label<'a> {
    /// What it says.
    pub text: &'a str,
    /// Classes of the text; a leading line gets `colour` and `leader`.
    pub class: &'a str,
    /// Class that sets its colour.
    pub colour: &'a str,
    /// Size of its letters.
    pub size: f64,
    /// Left away where there is no free place.
    pub is_optional: bool,
}

/// What is on the drawing already.
pub struct Placer {
    bounds: Area,
    taken: Vec<Area>,
    lines: Vec<((f64, f64), (f64, f64))>,
}

struct Place {
    area: Area,
    /// Where the text stands, and by which of its ends.
    text: (f64, f64, Anchor),
    distance: f64,
}

impl Placer {
    /// Nothing is there yet.
    pub fn new(bounds: Area) -> Self {
        Self {
            bounds,
            taken: Vec::new(),
            lines: Vec::new(),
        }
    }

    /// Something that names are to stay clear of.
    pub fn take(&mut self, area: Area) {
        self.taken.push(area);
    }

    /// Lines through points, which names had better not cross.
    pub fn cross(&mut self, points: &[(f64, f64)]) {
        self.lines
            .extend(points.windows(2).map(|two| (two[0], two[1])));
    }

    /// Writes a name near a point.
    pub fn place(&mut self, svg: &mut Svg, point: (f64, f64), label: &Label) {
        let wide = text_width(label.text, label.size);
        let best = candidates(point, wide, label.size)
            .filter(|place| self.is_within(&place.area))
            .map(|place| (self.cost(&place, point), place))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((cost, place)) = best else {
            return;
        };
        if label.is_optional && (cost > 25.0 || place.distance > 14.0) {
            return;
        }
        let (x, y, anchor) = place.text;
        if place.distance > 16.0 {
            let area = &place.area;
            let end = (
                point.0.clamp(area.left, area.right),
                point.1.clamp(area.top, area.bottom),
            );
            svg.line(&format!("leader {}", label.colour), point, end);
            self.cross(&[point, end]);
        }
        let class = format!("{} {}", label.class, label.colour);
        svg.text(&class, x, y, anchor, label.text);
        self.taken.push(place.area);
    }

    fn is_within(&self, area: &Area) -> bool {
        let bounds = &self.bounds;
        area.left >= bounds.left
            && area.right <= bounds.right
            && area.top >= bounds.top
            && area.bottom <= bounds.bottom
    }

    fn cost(&self, place: &Place, point: (f64, f64)) -> f64 {
        let covered: f64 = (self.taken.iter())
            .map(|area| place.area.overlap(area))
            .sum();
        let crossed: f64 = (self.lines.iter())
            .map(|line| place.area.inside(line.0, line.1))
            .sum();
        // Left of a point is where its line comes from.
        let left = f64::from(u8::from(place.text.0 < point.0));
        4.0 * covered + crossed + 0.9 * place.distance + 2.0 * left
    }
}

/// Places around a point, at growing distances.
fn candidates(point: (f64, f64), wide: f64, size: f64) -> impl Iterator<Item = Place> {
    const DISTANCES: [f64; 8] = [8.0, 13.0, 20.0, 30.0, 42.0, 58.0, 80.0, 110.0];
    const AROUND: usize = 24;
    let places = move |distance: f64| {
        (0..AROUND).map(move |k| {
            let angle = std::f64::consts::TAU * k as f64 / AROUND as f64;
            let (x, y) = (
                point.0 + distance * angle.cos(),
                point.1 + distance * angle.sin(),
            );
            let (anchor, left) = match angle.cos() {
                cos if cos > 0.3 => (Anchor::Start, x),
                cos if cos < -0.3 => (Anchor::End, x - wide),
                _ => (Anchor::Middle, x - 0.5 * wide),
            };
            // Straight above and below a text has to clear the point by its height, too.
            let middle = y + 0.5 * size * angle.sin();
            let area = Area {
                left,
                right: left + wide,
                top: middle - 0.55 * size,
                bottom: middle + 0.55 * size,
            };
            Place {
                area,
                text: (x, middle + 0.36 * size, anchor),
                distance,
            }
        })
    };
    DISTANCES.into_iter().flat_map(places)
}

/// Heights for a column of names, as near as can be to where they belong and `gap` apart; all
/// between two ends, closer together where there is no room.
pub fn spread(wanted: &[f64], gap: f64, (low, high): (f64, f64)) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|a, b| wanted[*a].total_cmp(&wanted[*b]));
    let gap = gap.min((high - low) / (wanted.len().max(2) - 1) as f64);
    let mut heights = wanted.to_vec();
    let mut least = low;
    for &index in &order {
        heights[index] = heights[index].max(least);
        least = heights[index] + gap;
    }
    let mut most = high;
    for &index in order.iter().rev() {
        heights[index] = heights[index].min(most);
        most = heights[index] - gap;
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_line_is_measured_inside() {
        let area = Area::around((0.0, 0.0), 1.0);
        assert!((area.inside((-5.0, 0.0), (5.0, 0.0)) - 2.0).abs() < 1e-12);
        assert_eq!(area.inside((-5.0, 2.0), (5.0, 2.0)), 0.0);
        assert_eq!(area.inside((-5.0, 0.0), (-3.0, 0.0)), 0.0);
    }

    proptest! {
        #[test]
        fn spread_names_keep_their_distance(
            wanted in prop::collection::vec(-50.0_f64..150.0, 1..12),
        ) {
            let mut found = spread(&wanted, 8.0, (0.0, 100.0));
            found.sort_by(f64::total_cmp);
            prop_assert!(found.iter().all(|height| (-1e-9..=100.0 + 1e-9).contains(height)));
            prop_assert!(found.windows(2).all(|two| two[1] - two[0] > 8.0 - 1e-9));
        }
    }
}
