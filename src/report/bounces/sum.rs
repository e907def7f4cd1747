//! All bounces together: at an albedo of 1 nothing is lost.

use super::Figure;
use super::layout::{LEFT, OPENNESS, curve, line, provenance};
use super::look::{self, finish, strip};
use crate::reference::bounce_fit::{StudiedMap, Study};
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{Key, MARGIN, Sheet, WIDTH};
use crate::report::svg::Anchor;

/// The bounces of the first map on top of each other, and the sums of all maps close by.
pub fn figure(study: &Study, first: &StudiedMap) -> Figure {
    let title = "The sum of all bounces at an albedo of 1";
    let mut sheet = Sheet::new(title);
    let looks: Vec<String> = (0..study.maps.len())
        .map(|place| format!("line {}", look::map(place)))
        .collect();
    let named = study.maps.iter().zip(&looks);
    let keys: Vec<_> = named
        .map(|(map, look)| (Key::Line(look), map.name.clone()))
        .collect();
    let y = look::keys(&mut sheet, 46.0, &keys);
    let words = ["left: direct and bounces", &format!("to {}", first.bounces)];
    let classes = (0..=first.bounces).map(|bounce| look::bounce(bounce, first.bounces));
    strip(&mut sheet.svg, (MARGIN, y + 8.0), words, classes);
    layers(&mut sheet, first, y + 50.0);
    sums(&mut sheet, study, first, y + 50.0);
    let captions = [
        provenance(first),
        String::from(
            "What does not arrive directly arrives after one or more bounces, so that the sum is the π of a point in the open whatever the openness (dashed). Left: means of the bounces on top of each other. Right: means of the sums by map, and the first map's texels; what is missing is what later bounces would have brought, and more than 1 is the spread of the rays.",
        ),
    ];
    Figure::new("sum", title, finish(sheet, &captions, y + 408.0))
}

const HIGH: f64 = 300.0;

fn sides() -> [(f64, f64); 2] {
    let middle = 0.5 * (LEFT + WIDTH - MARGIN);
    [(LEFT, middle - 20.0), (middle + 62.0, WIDTH - MARGIN)]
}

/// Each bounce as a layer on those before.
fn layers(sheet: &mut Sheet, map: &StudiedMap, top: f64) {
    let panel = Panel {
        x: Scale::exactly(0.0, 1.0, sides()[0]),
        y: Scale::exactly(0.0, 1.05, (top + HIGH, top)),
    };
    let titles = Titles {
        x: Some(OPENNESS),
        y: Some("sum of bounces ΣE/π"),
        y_unit: "",
    };
    let svg = &mut sheet.svg;
    panel.draw(svg, &titles);
    svg.text(
        "panel-title",
        panel.x.start,
        top - 8.0,
        Anchor::Start,
        &map.name,
    );
    let mut below: Vec<(f64, f64)> = curve(map, 0).map(|at| (at.openness, 0.0)).collect();
    for bounce in 0..=map.bounces {
        let means = curve(map, bounce).map(|at| at.mean);
        let above: Vec<_> = (below.iter().zip(means))
            .map(|((x, y), mean)| (*x, y + mean))
            .collect();
        let corners = below.iter().chain(above.iter().rev());
        let corners: Vec<_> = corners.map(|(x, y)| panel.at(*x, *y)).collect();
        let class = format!("layer {}", look::bounce(bounce, map.bounces));
        svg.polygon(&class, &corners);
        below = above;
    }
    svg.line("whole", panel.at(0.0, 1.0), panel.at(1.0, 1.0));
}

/// Sums of all maps around 1.
fn sums(sheet: &mut Sheet, study: &Study, first: &StudiedMap, top: f64) {
    let means = study.maps.iter().flat_map(|map| &map.measured.bins);
    let means = means
        .map(|bin| bin.received(1.0))
        .filter(|sum| sum.is_finite());
    let least = means.fold(0.99, f64::min).max(0.0);
    let ends = (
        1.0 - 1.15 * (1.0 - least),
        1.0 + 0.35 * (1.0 - least).max(0.02),
    );
    let panel = Panel {
        x: Scale::exactly(0.0, 1.0, sides()[1]),
        y: Scale::exactly(ends.0, ends.1, (top + HIGH, top)),
    };
    let titles = Titles {
        x: Some(OPENNESS),
        y: Some(""),
        y_unit: "",
    };
    let svg = &mut sheet.svg;
    panel.draw(svg, &titles);
    svg.text(
        "panel-title",
        panel.x.start,
        top - 8.0,
        Anchor::Start,
        "every map: ΣE/π, close by",
    );
    let inside = first
        .texels
        .iter()
        .map(|texel| (f64::from(texel[0]), f64::from(texel[3])));
    let inside = inside.filter(|(_, sum)| (ends.0..=ends.1).contains(sum));
    let dots = inside.map(|(openness, sum)| panel.at(openness, sum));
    svg.dots("dots t-none", &dots.collect::<Vec<_>>());
    for (place, map) in study.maps.iter().enumerate() {
        let bins = map.measured.bins.iter();
        let points = bins.map(|bin| (bin.openness, bin.received(1.0)));
        line(
            svg,
            &panel,
            &format!("line {}", look::map(place)),
            points,
            ends,
        );
    }
    svg.line("whole", panel.at(0.0, 1.0), panel.at(1.0, 1.0));
}
