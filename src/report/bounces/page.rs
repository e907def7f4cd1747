//! The study as one page: no script, no font, no picture from elsewhere.

use std::fmt::Write as _;

use super::methods::methods;
use super::residuals::GOAL;
use super::{Figure, figures, tables};
use crate::reference::bounce_fit::Study;
use crate::report::VERSION;
use crate::report::markup::{figure, paragraph};
use crate::report::svg::escape;

/// What analysis pages look like, so that these look the same.
const STYLE: &str = concat!(
    include_str!("../html/page.css"),
    include_str!("../cost/page.css")
);

const TITLE: &str = "Light between the points of height fields";

/// The whole page, `bounces.html`; `command` is what it was made with.
#[must_use]
pub fn page(study: &Study, command: &str) -> String {
    let mut page = String::new();
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Greyfield: {TITLE}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n"
    );
    let drawn = figures(study);
    result(&mut page, study);
    simulation(&mut page, study, &drawn);
    terms(&mut page, study, &drawn);
    models(&mut page, study, &drawn);
    section(
        &mut page,
        "Colour",
        &of(&drawn, &["saturation", "colour-bleeding"]),
    );
    amplitudes(&mut page, study, &drawn);
    methods(&mut page);
    let _ = write!(
        page,
        "<section>\n<h2>Run</h2>\n<p><code>{}</code></p>\n<p>Greyfield {VERSION}. The same study gives this page again, byte for byte.</p>\n</section>\n",
        escape(command)
    );
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

/// Figures whose names begin like one of these.
fn of<'a>(figures: &'a [Figure], stems: &[&str]) -> Vec<&'a Figure> {
    let is_named = |found: &&Figure| stems.iter().any(|stem| found.stem.starts_with(stem));
    figures.iter().filter(is_named).collect()
}

fn section(page: &mut String, title: &str, figures: &[&Figure]) {
    if figures.is_empty() {
        return;
    }
    let _ = writeln!(page, "<section>\n<h2>{title}</h2>");
    for found in figures {
        figure(page, &found.svg);
    }
    page.push_str("</section>\n");
}

fn result(page: &mut String, study: &Study) {
    let _ = write!(
        page,
        "<header>\n<p class=\"kicker\">Greyfield bounces</p>\n<h1>{TITLE}</h1>\n</header>\n<section class=\"result\">\n"
    );
    let held_out = study.maps.iter().filter(|map| map.held_out).count();
    let fitted = study.maps.len() - held_out;
    let what = match study.fits.is_empty() {
        true => "followed",
        false => "fitted to",
    };
    let others = match held_out {
        0 => String::new(),
        count => format!(", {count} held out"),
    };
    paragraph(
        page,
        &format!(
            "{fitted} height {} {what}{others}: how much light reaches a point directly and after each bounce, as a function of how open it is, and how well formulas of openness and albedo say so.",
            if fitted == 1 { "map" } else { "maps" }
        ),
    );
    if !study.errors.is_empty() {
        tables::summary(page, study);
    }
    page.push_str("</section>\n");
}

fn simulation(page: &mut String, study: &Study, drawn: &[Figure]) {
    page.push_str("<section>\n<h2>Every bounce</h2>\n");
    tables::maps(
        page,
        "Maps that light was followed on (amplitude: share of the width; rays: of each texel; end: why there are no more bounces)",
        &study.maps,
    );
    let curves = of(drawn, &["curves--"]);
    if let Some((first, others)) = curves.split_first() {
        figure(page, &first.svg);
        if !others.is_empty() {
            let count = others.len();
            let _ = writeln!(
                page,
                "<details>\n<summary>The other maps ({count})</summary>"
            );
            others.iter().for_each(|other| figure(page, &other.svg));
            page.push_str("</details>\n");
        }
    }
    of(drawn, &["decay", "sum"])
        .iter()
        .for_each(|found| figure(page, &found.svg));
    page.push_str("</section>\n");
}

fn terms(page: &mut String, study: &Study, drawn: &[Figure]) {
    let found = of(drawn, &["direct", "first-bounce"]);
    if found.is_empty() {
        return;
    }
    page.push_str("<section>\n<h2>Direct light and first bounce</h2>\n");
    found.iter().for_each(|found| figure(page, &found.svg));
    if !study.fits.is_empty() {
        tables::fits(page, &study.fits);
    }
    page.push_str("</section>\n");
}

fn models(page: &mut String, study: &Study, drawn: &[Figure]) {
    section(
        page,
        "Models at every albedo",
        &of(drawn, &["family", "residuals"]),
    );
    if study.errors.is_empty() {
        return;
    }
    let _ = writeln!(page, "<section>\n<h2>What the models miss</h2>");
    paragraph(
        page,
        &format!(
            "The goal is an rmse of {GOAL} on maps that a model was not fitted to. The same numbers with full precision are in errors.csv."
        ),
    );
    tables::errors(page, study);
    page.push_str("<details>\n<summary>By albedo</summary>\n");
    tables::errors_by_albedo(page, study);
    page.push_str("</details>\n</section>\n");
}

fn amplitudes(page: &mut String, study: &Study, drawn: &[Figure]) {
    let found = of(drawn, &["amplitudes"]);
    if found.is_empty() {
        return;
    }
    section(page, "Amplitude", &found);
    page.push_str("<section>\n<details>\n<summary>The maps of the sweep</summary>\n");
    tables::maps(page, "The same map at several amplitudes", &study.sweep);
    page.push_str("</details>\n</section>\n");
}
