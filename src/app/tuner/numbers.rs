//! The table below the stage: times, errors, and what can be seen of them.

use eframe::egui::{Grid, Response, RichText, Role, ScrollArea, Ui, WidgetInfo};

use super::Tuner;
use super::result::{Numbers, Request, Slot};
use crate::cost::Times;

/// Where there is no number.
const NONE: &str = "–";

/// Draws the table.
pub(super) fn show(tuner: &Tuner, ui: &mut Ui) {
    ScrollArea::horizontal().id_salt("numbers").show(ui, |ui| {
        Grid::new("numbers")
            .num_columns(COLUMNS.len() + 3)
            .spacing([12.0, 3.0])
            .min_col_width(44.0)
            .min_row_height(0.0)
            .show(ui, |ui| {
                ui.spacing_mut().interact_size.y = 0.0;
                ui.label("");
                ui.weak("settings");
                for (name, meaning, _) in COLUMNS {
                    ui.weak(name).on_hover_text(meaning);
                }
                ui.end_row();
                for slot in Slot::ALL {
                    row(tuner, ui, slot);
                    ui.end_row();
                }
                ratios(tuner, ui);
                ui.end_row();
            });
    });
    ui.weak(about(tuner));
}

type Cell = fn(&Numbers) -> String;

/// What the columns are called, what they mean, and how they read.
const COLUMNS: [(&str, &str, Cell); 11] = [
    (
        "ms",
        "all passes of the technique together: itself, its blur, its upsampling; the median",
        |n| ms(n.times.as_ref().map(|times| times.total_ms.median)),
    ),
    ("occlusion", "the technique's own pass, ms", |n| {
        ms(part(n, |times| times.occlusion_ms))
    }),
    ("blur", "the blur, ms", |n| {
        ms(part(n, |times| times.blur_ms))
    }),
    ("upsample", "from half to full resolution, ms", |n| {
        ms(part(n, |times| times.upsample_ms))
    }),
    (
        "RMSE",
        "of the occlusion, 0 to 1, against the ray-traced truth",
        |n| format!("{:.4}", n.rmse),
    ),
    ("bias", "mean error; above 0 it is too open", |n| {
        format!("{:+.4}", n.bias)
    }),
    (
        "estimator",
        "RMSE against the depth buffer's own answer, which takes all behind it for solid",
        |n| format!("{:.4}", n.estimator_rmse),
    ),
    (
        "information",
        "RMSE of the depth buffer's own answer against the truth",
        |n| format!("{:.4}", n.information_loss),
    ),
    (
        "FLIP",
        "what can be seen of it in the image, 0 to 1, on average",
        |n| format!("{:.4}", n.flip_mean),
    ),
    ("FLIP 95 %", "which 95 % of the pixels do not exceed", |n| {
        format!("{:.4}", n.flip_p95)
    }),
    ("SSIM", "structural similarity, 1 for the same image", |n| {
        format!("{:.4}", n.ssim)
    }),
];

/// A time among others, milliseconds.
type Part = fn(&Times) -> Option<f64>;

fn part(numbers: &Numbers, part: Part) -> Option<f64> {
    numbers.times.as_ref().and_then(part)
}

/// Milliseconds with three digits that count.
fn ms(ms: Option<f64>) -> String {
    match ms {
        None => NONE.to_owned(),
        Some(ms) if ms >= 100.0 => format!("{ms:.0}"),
        Some(ms) if ms >= 10.0 => format!("{ms:.1}"),
        Some(ms) if ms >= 1.0 => format!("{ms:.2}"),
        Some(ms) => format!("{ms:.3}"),
    }
}

/// One measurement. Pins have their rows before there are any, so that the stage never moves.
fn row(tuner: &Tuner, ui: &mut Ui, slot: Slot) {
    ui.strong(slot.name());
    let Some(asked) = tuner.bench.request(slot) else {
        ui.weak("nothing is pinned");
        return;
    };
    ui.label(settings(asked));
    let waits = tuner.bench.is_waiting(slot);
    let numbers = tuner.bench.shown(slot).map(|shown| &shown.numbers);
    for (name, _, cell) in COLUMNS {
        let value = numbers.map_or_else(|| NONE.to_owned(), cell);
        let text = RichText::new(&value);
        // What is shown is still of other settings.
        let text = if waits { text.weak() } else { text };
        let response = said(ui, text, &format!("{}: {name} {value}", slot.name()));
        if name == "ms"
            && let Some(times) = numbers.and_then(|numbers| numbers.times.as_ref())
        {
            response.on_hover_text(spread(times));
        }
    }
    // In a column of its own, so that nothing moves when it goes.
    let comes = waits && tuner.bench.trouble.is_none();
    ui.weak(if comes { "measuring …" } else { "" });
}

/// A cell, which says more to who hears it than it shows to who sees its place.
fn said(ui: &mut Ui, text: RichText, aloud: &str) -> Response {
    let response = ui.label(text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, aloud));
    response
}

/// How many times as long B takes as A.
fn ratios(tuner: &Tuner, ui: &mut Ui) {
    let of = |slot| {
        let is_there = !tuner.bench.is_waiting(slot);
        let shown = tuner.bench.shown(slot).filter(|_| is_there)?;
        shown.numbers.times.as_ref()
    };
    ui.strong("B : A");
    let (Some(a), Some(b)) = (of(Slot::A), of(Slot::B)) else {
        ui.label("");
        return;
    };
    ui.label("times the time of A");
    let parts: [(&str, Part); 4] = [
        ("ms", |times| Some(times.total_ms.median)),
        ("occlusion", |times| times.occlusion_ms),
        ("blur", |times| times.blur_ms),
        ("upsample", |times| times.upsample_ms),
    ];
    for (name, part) in parts {
        let ratio = match (part(a), part(b)) {
            (Some(a), Some(b)) if a > 0.0 => format!("{:.2} ×", b / a),
            _ => NONE.to_owned(),
        };
        said(ui, RichText::new(&ratio), &format!("B : A: {name} {ratio}"));
    }
}

/// What a row is of, in few words.
fn settings(asked: &Request) -> String {
    let settings = &asked.configuration.settings;
    let mut text = settings.label.clone();
    if let Some(reach) = settings.technique.reach {
        text += &format!(", {} m", short(settings.get(reach)));
    }
    if settings.technique.shader.is_some() {
        text += &format!(", blur {} px", asked.configuration.blur_radius_px);
    }
    text
}

/// A length with three digits that count.
pub(super) fn short(value: f64) -> String {
    let digits = match value.abs() {
        0.0 => 0.0,
        size => (2.0 - size.log10().floor()).clamp(0.0, 6.0),
    } as usize;
    let text = format!("{value:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn spread(times: &Times) -> String {
    let spread = &times.total_ms;
    let count = spread.count;
    match spread.interval {
        Some((low, high)) => format!(
            "median of {count} frames, 95 % interval {} to {} ms",
            ms(Some(low)),
            ms(Some(high))
        ),
        None => format!("median of {count} frames"),
    }
}

/// What the times and errors are worth.
fn about(tuner: &Tuner) -> String {
    let mut text = String::new();
    let Some(shown) = (Slot::ALL.into_iter()).find_map(|slot| tuner.bench.shown(slot)) else {
        return text;
    };
    if let Some((name, is_software)) = &tuner.bench.adapter {
        let timed = Slot::ALL
            .into_iter()
            .filter_map(|slot| tuner.bench.shown(slot)?.numbers.times.as_ref())
            .next();
        let clock = timed.map_or("no pass was timed", |times| times.clock.name());
        text += &format!("Times: {clock}, {name}");
        if *is_software {
            text += " (software adapter: ratios only)";
        }
        text += ".";
    }
    text += &format!(
        "   Truth: reach {} m, standard error {:.3}.",
        short(shown.request.reach_m),
        shown.numbers.truth_error
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let times = [0.01234, 1.234, 12.34, 123.4].map(|time| ms(Some(time)));
        assert_eq!(times, ["0.012", "1.23", "12.3", "123"]);
        assert_eq!(ms(None), NONE);
        let lengths = [0.0, 2.0, 0.123_456, 12.345, 1234.5].map(short);
        assert_eq!(lengths, ["0", "2", "0.123", "12.3", "1234"]);
    }
}
