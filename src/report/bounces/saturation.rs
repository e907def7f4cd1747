//! What bounces do to colours: each sends an albedo's colour back once more.

use super::Figure;
use super::layout::{LEFT, OPENNESS, line, openness};
use super::look::{self, finish, hex};
use crate::multi_bounce::{published_direct, published_first_bounce};
use crate::reference::bounce_fit::{MeasuredBin, Study};
use crate::report::figure::axis::Scale;
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{Key, MARGIN, Sheet, WIDTH};
use crate::report::svg::{Anchor, Svg};
use crate::scene::srgb::encode_u8;

/// Albedos that are shown, linear RGB, with a class for their line.
const COLOURS: [(&str, [f64; 3], &str); 5] = [
    ("yellow paint", [0.80, 0.62, 0.15], "t4"),
    ("brick", [0.55, 0.22, 0.13], "t1"),
    ("grass", [0.25, 0.45, 0.12], "t2"),
    ("blue paint", [0.15, 0.30, 0.70], "t0"),
    ("warm white", [0.88, 0.84, 0.76], "t-none"),
];
/// Least light that is not direct, or not of the first bounce, of which a ratio is taken.
const LEAST: f64 = 0.01;

/// Swatches and saturation over τ, and the τ that the maps have.
pub fn figure(study: &Study) -> Figure {
    let title = "What later bounces do to colours, and how many there are";
    let mut sheet = Sheet::new(title);
    swatches(&mut sheet.svg, 62.0);
    saturations(&mut sheet.svg, 316.0);
    let top = measured(&mut sheet, study, 316.0);
    let captions = [
        String::from(
            "All bounces after the direct light have the colour ρ/(1−ρτ), with ρ the albedo of each channel and τ the share of each bounce that the next one brings again at an albedo of 1: 0 is one bounce, 1 is no end of them. Upper half of each swatch: as bright as that is beside τ = 1, for one and the same first bounce; lower half: its colour alone, the brightest channel at 1. Saturation: 1 − least/greatest channel, linear.",
        ),
        String::from(
            "Measured: lines: τ₂ = 1 − F₂/(1−F₀−F₁), what is left after the second bounce, by map; dashed: the published τ = 1 − F₁/(1−F₀). Only where at least 1 % of the light is left to share out.",
        ),
    ];
    Figure::new("saturation", title, finish(sheet, &captions, top))
}

/// ρ/(1−ρτ) in each channel, for albedos below 1.
fn bounced(rho: [f64; 3], tau: f64) -> [f64; 3] {
    rho.map(|rho| rho / (1.0 - rho * tau))
}

fn brightest(colour: [f64; 3]) -> f64 {
    colour.into_iter().fold(0.0, f64::max)
}

/// As bright as it is where the brightest channel at τ = 1 is 1.
fn exposed(rho: [f64; 3], tau: f64) -> [f64; 3] {
    let most = brightest(bounced(rho, 1.0));
    bounced(rho, tau).map(|channel| channel / most)
}

/// The colour without its brightness: the brightest channel is 1.
fn colour(rho: [f64; 3], tau: f64) -> [f64; 3] {
    let channels = bounced(rho, tau);
    let most = brightest(channels);
    channels.map(|channel| channel / most)
}

fn saturation(rho: [f64; 3], tau: f64) -> f64 {
    1.0 - colour(rho, tau).into_iter().fold(1.0, f64::min)
}

fn css(linear: [f64; 3]) -> String {
    hex(linear.map(|channel| encode_u8(channel as f32)))
}

fn swatches(svg: &mut Svg, top: f64) {
    const HIGH: f64 = 36.0;
    let left = LEFT + 66.0;
    let wide = (WIDTH - MARGIN - left) / 11.0;
    for k in 0..11 {
        let middle = left + wide * (f64::from(k) + 0.5);
        let text = format!("τ = {}", f64::from(k) / 10.0);
        svg.text("tick", middle, top - 8.0, Anchor::Middle, &text);
    }
    for (row, (name, rho, _)) in COLOURS.into_iter().enumerate() {
        let y = top + row as f64 * (HIGH + 5.0);
        svg.text("tick", left - 10.0, y + 0.5 * HIGH + 4.0, Anchor::End, name);
        for k in 0..11 {
            let tau = f64::from(k) / 10.0;
            let x = left + wide * f64::from(k);
            let both = [exposed(rho, tau), colour(rho, tau)];
            for (half, linear) in both.into_iter().enumerate() {
                let y = y + half as f64 * 0.5 * HIGH;
                svg.filled(&css(linear), (x, y), (wide - 1.0, 0.5 * HIGH));
            }
        }
    }
}

const HIGH: f64 = 230.0;

fn saturations(svg: &mut Svg, top: f64) {
    let right = 0.5 * (LEFT + WIDTH - MARGIN) - 90.0;
    let panel = Panel {
        x: Scale::exactly(0.0, 1.0, (LEFT, right)),
        y: Scale::exactly(0.0, 1.0, (top + HIGH, top)),
    };
    let titles = Titles {
        x: Some("τ"),
        y: Some("saturation of the colour"),
        y_unit: "",
    };
    panel.draw(svg, &titles);
    let ends = COLOURS.map(|(_, rho, _)| panel.y.at(saturation(rho, 1.0)));
    let heights = crate::report::figure::labels::spread(&ends, 14.0, (top, top + HIGH));
    for ((name, rho, class), height) in COLOURS.into_iter().zip(heights) {
        let points = (0..=50).map(|k| f64::from(k) / 50.0);
        let points = points.map(|tau| (tau, saturation(rho, tau)));
        line(svg, &panel, &format!("line {class}"), points, (0.0, 1.0));
        let text = format!("name {class}");
        svg.text(&text, right + 7.0, height + 4.0, Anchor::Start, name);
    }
}

/// τ₂ over openness by map; the height below.
fn measured(sheet: &mut Sheet, study: &Study, top: f64) -> f64 {
    let looks: Vec<String> = (0..study.maps.len())
        .map(|place| format!("line {}", look::map(place)))
        .collect();
    let panel = Panel {
        x: Scale::exactly(
            0.0,
            1.0,
            (0.5 * (LEFT + WIDTH - MARGIN) + 70.0, WIDTH - MARGIN),
        ),
        y: Scale::exactly(0.0, 1.0, (top + HIGH, top)),
    };
    let titles = Titles {
        x: Some(OPENNESS),
        y: Some("measured τ₂"),
        y_unit: "",
    };
    panel.draw(&mut sheet.svg, &titles);
    let published = openness().filter_map(|a| {
        let left = 1.0 - published_direct(a);
        (left > LEAST).then(|| (a, 1.0 - published_first_bounce(a) / left))
    });
    line(&mut sheet.svg, &panel, "dash t-none", published, (0.0, 1.0));
    for (map, look) in study.maps.iter().zip(&looks) {
        let points = map
            .measured
            .bins
            .iter()
            .filter_map(|bin| Some((bin.openness, tau_2(bin)?)));
        line(&mut sheet.svg, &panel, look, points, (0.0, 1.0));
    }
    let named = study.maps.iter().zip(&looks);
    let keys: Vec<_> = named
        .map(|(map, look)| (Key::Line(look), map.name.clone()))
        .chain([(Key::Line("dash t-none"), String::from("published τ"))])
        .collect();
    look::keys(sheet, top + HIGH + 62.0, &keys) + 12.0
}

/// What is left after the second bounce, as a share of what was left after the first; none where
/// that is too little to say.
fn tau_2(bin: &MeasuredBin) -> Option<f64> {
    let [direct, first, second, ..] = bin.factors[..] else {
        return None;
    };
    let left = 1.0 - direct - first;
    (left > LEAST).then(|| 1.0 - second / left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounces_saturate_and_add_light() {
        for (name, rho, _) in COLOURS {
            let taus = (0..=10).map(|k| f64::from(k) / 10.0);
            let found: Vec<f64> = taus.map(|tau| saturation(rho, tau)).collect();
            assert!(
                found.windows(2).all(|two| two[0] < two[1]),
                "{name} {found:?}"
            );
            assert!(brightest(exposed(rho, 0.5)) < 1.0 && exposed(rho, 1.0) == colour(rho, 1.0));
        }
        assert_eq!(css([0.0, 1.0, 0.5]), "#00ffbc");
    }
}
