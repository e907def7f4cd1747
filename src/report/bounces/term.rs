//! One term of the light over openness, and what is said of it: the direct light or the first bounce.

use super::Figure;
use super::layout::{Grid, LEFT, OPENNESS, band, curve, line, openness, provenance};
use super::look::{self, finish};
use crate::multi_bounce::{COEFFICIENTS, Coefficients, published_direct, published_first_bounce};
use crate::reference::bounce_fit::{Fit, StudiedMap, Study, Term};
use crate::report::figure::axis::Scale;
use crate::report::figure::numbers::fixed;
use crate::report::figure::panel::{Panel, Titles};
use crate::report::figure::sheet::{Key, MARGIN, Sheet, WIDTH};
use crate::report::svg::Anchor;

/// A formula for the term.
struct Guess<'a> {
    name: String,
    class: &'static str,
    value: Box<dyn Fn(f64) -> f64 + 'a>,
}

/// The term of the first map with what is said of it, then what each says too much on every map.
pub fn figure(study: &Study, first: &StudiedMap, term: Term) -> Figure {
    let (bounce, stem, title) = match term {
        Term::Direct => (
            0,
            "direct",
            "direct light over openness, and what is said of it",
        ),
        Term::FirstBounce | Term::Family => (
            1,
            "first-bounce",
            "first bounce over openness, and what is said of it",
        ),
    };
    let title = format!("{}: {title}", first.name);
    let mut sheet = Sheet::new(&title);
    let guesses = guesses(study, bounce);
    let mut keys = vec![(
        Key::Marked("line t6", "mark t6"),
        String::from("measured: mean, ±1 SD, texels"),
    )];
    let lines: Vec<String> = guesses.iter().map(|guess| guess.class.to_owned()).collect();
    let named = guesses.iter().zip(&lines);
    keys.extend(named.map(|(guess, class)| (Key::Line(class), guess.name.clone())));
    let y = look::keys(&mut sheet, 46.0, &keys);
    let high = whole(&mut sheet, first, bounce, &guesses, y + 10.0);
    let top = y + 10.0 + high + 62.0;
    let (bottom, limit) = residuals(&mut sheet, study, bounce, &guesses, top);
    let captions = [
        provenance(first),
        format!(
            "Below: what is said minus what is measured, one line a map (colours as in the other figures; dashed: held out), within ±{}; triangles stand where a line leaves that.",
            fixed(limit, 3)
        ),
    ];
    Figure::new(stem, &title, finish(sheet, &captions, bottom))
}

fn guesses(study: &Study, bounce: usize) -> Vec<Guess<'_>> {
    let of = |name: &str, class, value: Box<dyn Fn(f64) -> f64>| Guess {
        name: name.to_owned(),
        class,
        value,
    };
    let mut found = match bounce {
        0 => vec![
            of("α alone, the usual term", "dash t0", Box::new(|a| a)),
            of("F₀ as published", "line t1", Box::new(published_direct)),
        ],
        _ => vec![of(
            "F₁ as published",
            "line t1",
            Box::new(published_first_bounce),
        )],
    };
    let wanted = [Term::Direct, Term::FirstBounce][bounce.min(1)];
    for fit in study.fits.iter().filter(|fit| fit.term == wanted) {
        found.push(Guess {
            name: fit_name(fit),
            class: if fit.published.is_empty() {
                "thin t2"
            } else {
                "dash t3"
            },
            value: Box::new(|a| fit.curve(a, &fit.fitted.values).unwrap_or(f64::NAN)),
        });
    }
    let ours = move |model: Coefficients| move |a: f64| ours(&model, bounce, a);
    found.push(of("greyfield", "thin t4", Box::new(ours(COEFFICIENTS))));
    if let Some(refitted) = study.refitted.filter(|found| *found != COEFFICIENTS) {
        found.push(of(
            super::models::REFITTED,
            "dash t5",
            Box::new(ours(refitted)),
        ));
    }
    found
}

fn fit_name(fit: &Fit) -> String {
    if !fit.published.is_empty() {
        return String::from("published form, refitted");
    }
    let named = fit.fitted.names.iter().zip(&fit.fitted.values);
    let values: Vec<String> = named
        .map(|(name, value)| format!("{name} = {}", fixed(*value, 3)))
        .collect();
    format!("{}, {}", fit.form, values.join(", "))
}

/// F₀ of our form, or its slope over the albedo at 0, which is F₁.
fn ours(model: &Coefficients, bounce: usize, openness: f64) -> f64 {
    const STEP: f64 = 1e-6;
    let direct = model.value(openness, 0.0);
    match bounce {
        0 => direct,
        _ => (model.value(openness, STEP) - direct) / STEP,
    }
}

/// Data and formulas on one scale; how high the panel is.
fn whole(sheet: &mut Sheet, map: &StudiedMap, bounce: usize, guesses: &[Guess], top: f64) -> f64 {
    const HIGH: f64 = 320.0;
    let most = match bounce {
        0 => 1.03,
        _ => {
            let measured = curve(map, bounce).map(|at| at.mean + 1.5 * at.deviation);
            let said = openness().map(published_first_bounce);
            1.05 * measured.chain(said).fold(1e-3, f64::max)
        }
    };
    let panel = Panel {
        x: Scale::exactly(0.0, 1.0, (LEFT, WIDTH - MARGIN)),
        y: Scale::exactly(0.0, most, (top + HIGH, top)),
    };
    let titles = Titles {
        x: Some(OPENNESS),
        y: Some(if bounce == 0 {
            "direct light E₀/π"
        } else {
            "first bounce E₁/π"
        }),
        y_unit: "",
    };
    let svg = &mut sheet.svg;
    panel.draw(svg, &titles);
    let inside = map
        .texels
        .iter()
        .filter(|texel| f64::from(texel[1 + bounce]) <= most);
    let dots = inside.map(|texel| panel.at(f64::from(texel[0]), f64::from(texel[1 + bounce])));
    svg.dots("dots t6", &dots.collect::<Vec<_>>());
    band(svg, &panel, "t6", map, bounce);
    let points = curve(map, bounce).map(|at| (at.openness, at.mean));
    line(svg, &panel, "line t6", points, (0.0, most));
    for guess in guesses {
        let points = openness().map(|a| (a, (guess.value)(a)));
        line(svg, &panel, guess.class, points, (0.0, most));
    }
    HIGH
}

/// What a formula says minus what a map has, by openness.
fn missed<'a>(
    map: &'a StudiedMap,
    bounce: usize,
    guess: &'a Guess,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    map.measured.bins.iter().filter_map(move |bin| {
        let measured = bin.factors.get(bounce)?;
        Some((bin.openness, (guess.value)(bin.openness) - measured))
    })
}

/// A round number that most of what the better formulas miss lies within.
fn limit(study: &Study, bounce: usize, guesses: &[Guess]) -> f64 {
    const ROUND: [f64; 5] = [0.02, 0.03, 0.05, 0.1, 0.2];
    const MOST: f64 = 0.9;
    let mut all: Vec<f64> = (guesses.iter().skip(1))
        .flat_map(|guess| (study.maps.iter()).flat_map(move |map| missed(map, bounce, guess)))
        .map(|(_, missed)| missed.abs())
        .filter(|missed| missed.is_finite())
        .collect();
    all.sort_by(f64::total_cmp);
    let most = all.get((MOST * all.len() as f64) as usize).copied();
    let most = most.unwrap_or(0.0);
    ROUND
        .into_iter()
        .find(|round| *round >= most)
        .unwrap_or(0.2)
}

/// A panel a formula; the height below them, and how far they reach.
fn residuals(
    sheet: &mut Sheet,
    study: &Study,
    bounce: usize,
    guesses: &[Guess],
    top: f64,
) -> (f64, f64) {
    let columns = if guesses.len() == 4 { 4 } else { 3 };
    let limit = limit(study, bounce, guesses);
    let grid = Grid {
        below: 56.0,
        ..Grid::new(columns, top, 110.0)
    };
    for (index, guess) in guesses.iter().enumerate() {
        let panel = grid.panel(index, (-limit, limit));
        let is_last_row = index + columns >= guesses.len();
        let titles = Titles {
            x: is_last_row.then_some("openness α"),
            y: (index % columns == 0).then_some("said − measured"),
            y_unit: "",
        };
        let svg = &mut sheet.svg;
        panel.draw(svg, &titles);
        let (left, right) = (panel.x.start, panel.x.end);
        let name = crate::report::figure::sheet::shortened(&guess.name, 13.0, right - left);
        svg.text("panel-title", left, panel.y.end - 8.0, Anchor::Start, &name);
        svg.line("zero", (left, panel.y.at(0.0)), (right, panel.y.at(0.0)));
        for (place, map) in study.maps.iter().enumerate() {
            let weight = if map.held_out { "dash" } else { "thin" };
            let missed = missed(map, bounce, guess);
            line(
                svg,
                &panel,
                &format!("{weight} {}", look::map(place)),
                missed,
                (-limit, limit),
            );
        }
    }
    (grid.bottom(guesses.len()), limit)
}
