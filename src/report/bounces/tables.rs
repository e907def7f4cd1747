//! The tables of the page, with as many digits as people read.

use super::residuals::GOAL;
use crate::reference::bounce_fit::{ALBEDOS, Fit, MapError, StudiedMap, Study};
use crate::reference::height_field::{Border, Stopped};
use crate::report::figure::numbers::{MISSING, fixed, or_missing, significant};
use crate::report::figure::words::distinct;
use crate::report::markup::{Column, table};

/// Maps: how each was made ready and followed.
pub fn maps(page: &mut String, caption: &str, maps: &[StudiedMap]) {
    let cells = |map: &StudiedMap| {
        let border = match map.border {
            Border::Tiled => "tiled",
            Border::Open => "open",
        };
        let stopped = match map.stopped {
            Stopped::Enough => "all asked for",
            Stopped::Unseen => "too faint",
            Stopped::Dark => "dark",
        };
        let open = map.measured.bins.iter().map(|bin| bin.openness);
        let (least, most) = (open.clone().fold(1.0, f64::min), open.fold(0.0, f64::max));
        vec![
            map.name.clone(),
            String::from(if map.held_out {
                "held out"
            } else {
                "fitted to"
            }),
            format!("{} × {}", map.size_px.0, map.size_px.1),
            (map.size_px.0 * map.size_px.1).to_string(),
            significant(map.amplitude, 3),
            border.to_owned(),
            map.rays.to_string(),
            map.bounces.to_string(),
            stopped.to_owned(),
            map.measured.bins.len().to_string(),
            format!("{} to {}", fixed(least, 2), fixed(most, 2)),
        ]
    };
    table(
        page,
        "",
        caption,
        &[
            Column::Words("map"),
            Column::Words("use"),
            Column::Words("size"),
            Column::Numbers("texels"),
            Column::Numbers("amplitude"),
            Column::Words("border"),
            Column::Numbers("rays"),
            Column::Numbers("bounces"),
            Column::Words("end"),
            Column::Numbers("bins"),
            Column::Words("their α"),
        ],
        &maps.iter().map(cells).collect::<Vec<_>>(),
    );
}

/// What was found for each form, beside what was published.
pub fn fits(page: &mut String, fits: &[Fit]) {
    let cells: Vec<_> = fits.iter().flat_map(fit_cells).collect();
    table(
        page,
        "",
        "Fits, with 95 % intervals where the data determine the number and it is not on its bound",
        &[
            Column::Words("form"),
            Column::Words("unknown"),
            Column::Numbers("published"),
            Column::Numbers("found"),
            Column::Numbers("95 % interval"),
            Column::Numbers("rmse of the fit"),
            Column::Numbers("residuals"),
        ],
        &cells,
    );
}

fn fit_cells(fit: &Fit) -> Vec<Vec<String>> {
    let fitted = &fit.fitted;
    let unknowns = fitted.names.iter().zip(&fitted.values).enumerate();
    unknowns
        .map(|(place, (name, value))| {
            let half = fitted.half_widths.get(place).copied().flatten();
            let is_first = place == 0;
            let once = |text: String| if is_first { text } else { String::new() };
            vec![
                once(fit.form.to_owned()),
                (*name).to_owned(),
                or_missing(fit.published.get(place).copied(), |value| {
                    significant(value, 5)
                }),
                significant(*value, 4),
                or_missing(half, |half| {
                    format!(
                        "[{}, {}]",
                        significant(value - half, 4),
                        significant(value + half, 4)
                    )
                }),
                once(fixed(fitted.rmse, 5)),
                once(fitted.residuals.to_string()),
            ]
        })
        .collect()
}

/// A model a row: root mean squares on both kinds of maps, each map alike.
pub fn summary(page: &mut String, study: &Study) {
    let cells = |model: &str| {
        let of_model = || {
            study
                .errors
                .iter()
                .filter(move |error| error.model == model)
        };
        let over = |held_out: bool| {
            let is_here = |error: &&MapError| error.held_out == held_out && error.albedo.is_none();
            let squares: Vec<f64> = (of_model().filter(is_here))
                .map(|error| error.rmse * error.rmse)
                .filter(|square| square.is_finite())
                .collect();
            let count = squares.len();
            (count > 0).then(|| (squares.iter().sum::<f64>() / count as f64).sqrt())
        };
        let lost: usize = of_model()
            .filter(|error| error.albedo.is_some())
            .map(|error| error.not_finite)
            .sum();
        let four = |value| fixed(value, 4);
        vec![
            model.to_owned(),
            or_missing(over(false), four),
            or_missing(over(true), four),
            lost.to_string(),
        ]
    };
    let models = distinct(study.errors.iter().map(|error| error.model.as_str()));
    table(
        page,
        "",
        "Root mean square of what each model misses of E/π over the albedos 0 to 0.9, every map and every bin of openness alike",
        &[
            Column::Words("model"),
            Column::Numbers("maps fitted to"),
            Column::Numbers("maps held out"),
            Column::Numbers("bins and albedos without a number"),
        ],
        &models.into_iter().map(cells).collect::<Vec<_>>(),
    );
}

/// What models miss on each map over all albedos below 1.
pub fn errors(page: &mut String, study: &Study) {
    let over_all = study.errors.iter().filter(|error| error.albedo.is_none());
    let cells: Vec<_> = over_all
        .map(|error| {
            let is_met = error.rmse <= GOAL && error.not_finite == 0;
            vec![
                error.model.clone(),
                error.map.clone(),
                String::from(if error.held_out {
                    "held out"
                } else {
                    "fitted to"
                }),
                fixed(error.rmse, 4),
                String::from(if is_met { "met" } else { "" }),
                fixed(error.rmse_by_texel, 4),
                fixed(error.worst, 3),
                fixed(error.worst_openness, 2),
                error.not_finite.to_string(),
            ]
        })
        .collect();
    table(
        page,
        "tall",
        "What each model misses of E/π, over the albedos 0 to 0.9; the goal is an rmse of 0.005",
        &[
            Column::Words("model"),
            Column::Words("map"),
            Column::Words("use"),
            Column::Numbers("rmse by bin"),
            Column::Words("goal"),
            Column::Numbers("rmse by texel"),
            Column::Numbers("worst bin"),
            Column::Numbers("at α"),
            Column::Numbers("not finite"),
        ],
        &cells,
    );
}

/// The same at every albedo: a row a model and map.
pub fn errors_by_albedo(page: &mut String, study: &Study) {
    let names = |of: fn(&MapError) -> &str| distinct(study.errors.iter().map(of));
    let (models, maps) = (names(|error| &error.model), names(|error| &error.map));
    let pairs = models
        .iter()
        .flat_map(|model| maps.iter().map(move |map| (*model, *map)));
    let cells = pairs.filter_map(|(model, map)| {
        let is_here = |error: &&MapError| error.model == model && error.map == map;
        let found: Vec<&MapError> = study.errors.iter().filter(is_here).collect();
        let held_out = found.first()?.held_out;
        let by_albedo = ALBEDOS.iter().map(|rho| {
            let at = found.iter().find(|error| error.albedo == Some(*rho));
            at.map_or(MISSING.to_owned(), |error| shown(error))
        });
        let marked = if held_out {
            format!("{map} (held out)")
        } else {
            map.to_owned()
        };
        Some(
            [model.to_owned(), marked]
                .into_iter()
                .chain(by_albedo)
                .collect(),
        )
    });
    table(
        page,
        "tall",
        "Root mean square of what each model misses, by albedo ρ; * where it is no finite number in some bins, which are left out",
        &[
            Column::Words("model"),
            Column::Words("map"),
            Column::Numbers("ρ = 0"),
            Column::Numbers("0.1"),
            Column::Numbers("0.2"),
            Column::Numbers("0.3"),
            Column::Numbers("0.4"),
            Column::Numbers("0.5"),
            Column::Numbers("0.6"),
            Column::Numbers("0.7"),
            Column::Numbers("0.8"),
            Column::Numbers("0.9"),
            Column::Numbers("1"),
        ],
        &cells.collect::<Vec<Vec<String>>>(),
    );
}

fn shown(error: &MapError) -> String {
    let mark = if error.not_finite > 0 { "*" } else { "" };
    format!("{}{mark}", fixed(error.rmse, 4))
}
