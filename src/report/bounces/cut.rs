//! Lines kept inside their panel, with marks where they would leave it.

use crate::report::figure::panel::Panel;
use crate::report::svg::{Mark, Svg};

/// Where a line is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Above the panel.
    Above,
    /// Below it.
    Below,
    /// No finite number.
    Nowhere,
}

/// A line in the pieces that are inside.
#[derive(Debug, Default, PartialEq)]
pub struct Cut {
    /// Each piece, from the left.
    pub pieces: Vec<Vec<(f64, f64)>>,
    /// The middle of each stretch outside, and where it is.
    pub outside: Vec<(f64, Side)>,
}

/// Cuts a line to values of `low` to `high`; it ends where it crosses them.
pub fn cut(points: impl Iterator<Item = (f64, f64)>, (low, high): (f64, f64)) -> Cut {
    let mut cut = Cut::default();
    let mut piece: Vec<(f64, f64)> = Vec::new();
    let mut stretch: Option<(f64, f64, Side)> = None;
    let mut before: Option<(f64, f64)> = None;
    for (x, y) in points {
        let side = match y {
            y if !y.is_finite() => Some(Side::Nowhere),
            y if y > high => Some(Side::Above),
            y if y < low => Some(Side::Below),
            _ => None,
        };
        let crossing = before.and_then(|from| crossing(from, (x, y), (low, high)));
        match side {
            None => {
                if let Some((from, to, side)) = stretch.take() {
                    cut.outside.push((0.5 * (from + to), side));
                    piece.extend(crossing);
                }
                piece.push((x, y));
            }
            Some(side) => {
                if !piece.is_empty() {
                    piece.extend(crossing);
                    cut.pieces.push(std::mem::take(&mut piece));
                }
                stretch = match stretch {
                    Some((from, _, same)) if same == side => Some((from, x, side)),
                    other => {
                        let ended = other.map(|(from, to, side)| (0.5 * (from + to), side));
                        cut.outside.extend(ended);
                        Some((x, x, side))
                    }
                };
            }
        }
        before = Some((x, y));
    }
    let ended = stretch.map(|(from, to, side)| (0.5 * (from + to), side));
    cut.outside.extend(ended);
    if !piece.is_empty() {
        cut.pieces.push(piece);
    }
    cut
}

/// Where a straight line between two points, one of them inside, crosses an end.
fn crossing(from: (f64, f64), to: (f64, f64), (low, high): (f64, f64)) -> Option<(f64, f64)> {
    let rise = to.1 - from.1;
    if !rise.is_finite() || rise == 0.0 {
        return None;
    }
    [low, high].into_iter().find_map(|end| {
        let part = (end - from.1) / rise;
        let is_between = part > 0.0 && part < 1.0;
        is_between.then_some((from.0 + part * (to.0 - from.0), end))
    })
}

/// Draws a line of a class within its panel's values.
pub fn draw(
    svg: &mut Svg,
    panel: &Panel,
    class: &str,
    points: impl Iterator<Item = (f64, f64)>,
    ends: (f64, f64),
) {
    let cut = cut(points, ends);
    for piece in &cut.pieces {
        let points: Vec<_> = piece.iter().map(|(x, y)| panel.at(*x, *y)).collect();
        match points[..] {
            // One bin alone makes no line.
            [(x, y)] => svg.circle(&format!("mark {}", colour(class)), x, y, 2.2),
            _ => svg.polyline(class, &points),
        }
    }
    for (x, side) in cut.outside {
        let (mark, y) = match side {
            Side::Above => (Mark::Up, panel.y.end + 5.0),
            Side::Below => (Mark::Down, panel.y.start - 5.0),
            Side::Nowhere => (Mark::Cross, panel.y.end + 5.0),
        };
        svg.mark("out", mark, (panel.x.at(x), y), 3.2);
    }
}

/// The class that sets the colour: the last of several.
fn colour(class: &str) -> &str {
    class.rsplit(' ').next().unwrap_or(class)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_where_it_leaves() {
        let points = [
            (0.0, 0.5),
            (1.0, 1.5),
            (2.0, 2.0),
            (3.0, 0.0),
            (4.0, f64::NAN),
        ];
        let found = cut(points.into_iter(), (0.0, 1.0));
        assert_eq!(
            found.pieces,
            [vec![(0.0, 0.5), (0.5, 1.0)], vec![(2.5, 1.0), (3.0, 0.0)]]
        );
        assert_eq!(found.outside, [(1.5, Side::Above), (4.0, Side::Nowhere)]);
    }

    #[test]
    fn nothing_is_no_line() {
        assert_eq!(cut(std::iter::empty(), (0.0, 1.0)), Cut::default());
    }
}
