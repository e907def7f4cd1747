//! The same map at several amplitudes.

use super::Figure;
use super::layout::{Grid, OPENNESS, curve, line, provenance};
use super::look::{self, finish, step};
use crate::reference::bounce_fit::{StudiedMap, Study};
use crate::report::figure::numbers::significant;
use crate::report::figure::panel::Titles;
use crate::report::figure::sheet::{Key, Sheet};
use crate::report::svg::Anchor;

/// Direct light, first bounce and sum over openness at every amplitude; none where none were asked
/// for.
pub fn figure(study: &Study) -> Option<Figure> {
    let sweep = &study.sweep;
    let first = sweep.first()?;
    let title = "The same map at several amplitudes";
    let mut sheet = Sheet::new(title);
    let looks: Vec<String> = (0..sweep.len())
        .map(|place| format!("line {}", step(place, sweep.len())))
        .collect();
    let named = sweep.iter().zip(&looks);
    let keys: Vec<_> = named
        .map(|(map, look)| {
            (
                Key::Line(look),
                format!("amplitude {} of the width", significant(map.amplitude, 2)),
            )
        })
        .collect();
    let y = look::keys(&mut sheet, 46.0, &keys);
    let grid = Grid {
        beside: 60.0,
        ..Grid::new(3, y + 24.0, 260.0)
    };
    panels(&mut sheet, sweep, &looks, &grid);
    let captions = [
        provenance(first),
        String::from(
            "The others differ in amplitude alone, the height from the lowest to the highest point. Means of bins of openness; a low map has no closed points, a high one hardly any open ones, and their lines are short.",
        ),
    ];
    let svg = finish(sheet, &captions, grid.bottom(3));
    Some(Figure::new("amplitudes", title, svg))
}

/// A curve of a map, by openness.
type Curve = fn(&StudiedMap) -> Vec<(f64, f64)>;

fn panels(sheet: &mut Sheet, sweep: &[StudiedMap], looks: &[String], grid: &Grid) {
    let lowest = sweep.iter().flat_map(sums).map(|(_, sum)| sum);
    let missing = 1.0 - lowest.fold(0.99, f64::min);
    let near = (1.0 - 1.2 * missing, 1.0 + 0.3 * missing);
    let shown: [(&str, Curve, (f64, f64)); 3] = [
        ("direct light E₀/π", |map| points(map, 0), (0.0, 1.05)),
        (
            "first bounce E₁/π",
            |map| points(map, 1),
            (0.0, highest(sweep)),
        ),
        ("sum ΣE/π at ρ = 1, close by", sums, near),
    ];
    for (index, (name, of, ends)) in shown.into_iter().enumerate() {
        let panel = grid.panel(index, ends);
        let titles = Titles {
            x: Some(OPENNESS),
            y: Some(""),
            y_unit: "",
        };
        panel.draw(&mut sheet.svg, &titles);
        let (left, top) = (panel.x.start, panel.y.end);
        (sheet.svg).text("panel-title", left, top - 8.0, Anchor::Start, name);
        for (map, look) in sweep.iter().zip(looks) {
            line(&mut sheet.svg, &panel, look, of(map).into_iter(), ends);
        }
    }
}

fn points(map: &StudiedMap, bounce: usize) -> Vec<(f64, f64)> {
    curve(map, bounce)
        .map(|at| (at.openness, at.mean))
        .collect()
}

fn sums(map: &StudiedMap) -> Vec<(f64, f64)> {
    let bins = map.measured.bins.iter();
    bins.map(|bin| (bin.openness, bin.received(1.0))).collect()
}

fn highest(sweep: &[StudiedMap]) -> f64 {
    let all = sweep.iter().flat_map(|map| curve(map, 1)).map(|at| at.mean);
    1.06 * all.fold(1e-3, f64::max)
}
