//! The bar of time at the lower edge: where the replay stands, and its trials.

use eframe::egui::{
    Align, Area, Button, Color32, Context, Frame, Id, Layout, Margin, Order, Rect, Sense, Ui, pos2,
    vec2,
};

use super::{Replaying, SPEEDS, picture};
use crate::app::theme;
use crate::protocol::procedure::Ask;
use crate::session::replay::{Replay, ReplayScreen, Shown};

/// Height of the bar of time itself, points.
const HEIGHT: f32 = 16.0;

/// What the experimenter clicked.
pub(super) enum Wish {
    PlayOrPause,
    Speed(u64),
    /// To a moment, nanoseconds of the replay.
    Go(u64),
}

pub(super) fn show(ctx: &Context, replaying: &Replaying) -> Option<Wish> {
    let screen = ctx.viewport_rect();
    let area = Area::new(Id::unique("replay bar"))
        .order(Order::Foreground)
        .pivot(eframe::egui::Align2::LEFT_BOTTOM)
        .fixed_pos(screen.left_bottom());
    area.show(ctx, |ui| {
        theme::install_browser(ui);
        let frame = Frame::new()
            .fill(ui.visuals().panel_fill)
            .inner_margin(Margin::symmetric(12, 6));
        frame
            .show(ui, |ui| {
                ui.set_width(screen.width() - 24.0);
                let wish = controls(ui, replaying);
                wish.or(time(ui, &replaying.replay, replaying.at_ns))
            })
            .inner
    })
    .inner
}

fn controls(ui: &mut Ui, replaying: &Replaying) -> Option<Wish> {
    ui.horizontal(|ui| {
        let mut wish = None;
        let text = if replaying.is_playing {
            "Pause"
        } else {
            "Play"
        };
        let play = ui.add(Button::new(text).min_size(vec2(72.0, 0.0)));
        if play.clicked() {
            wish = Some(Wish::PlayOrPause);
        }
        for speed in SPEEDS {
            let chosen = replaying.speed == speed;
            if ui.selectable_label(chosen, format!("×{speed}")).clicked() {
                wish = Some(Wish::Speed(speed));
            }
        }
        let screen = replaying.replay.screen_at(replaying.at_ns);
        ui.label(words(replaying, screen));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let [at, all] = [replaying.at_ns, replaying.replay.duration_ns()].map(clock);
            ui.monospace(format!("{at} of {all}"));
        });
        wish
    })
    .inner
}

/// What stands on the screen, in words.
fn words(replaying: &Replaying, screen: ReplayScreen) -> String {
    let replay = &replaying.replay;
    let trial = screen
        .trial
        .and_then(|index| Some((index, replay.trials.get(index)?)));
    let Some((index, trial)) = trial else {
        return match screen.what {
            Shown::Gap => interruption(replay, replaying.at_ns),
            _ => "before the first image: pages of text".to_owned(),
        };
    };
    let what = match screen.what {
        Shown::Image { place } => {
            let (which, technique) = match (place, trial.ask) {
                (_, Ask::Ratings) => ("image", &trial.row.technique_first),
                (0, _) => ("first image", &trial.row.technique_first),
                _ => ("second image", &trial.row.technique_second),
            };
            format!("{which}: {technique}")
        }
        Shown::Grey => "grey".to_owned(),
        // Already before it is given: where the next trial starts by itself the answer stands
        // for no time at all.
        Shown::Question { .. } => {
            let after = trial.row.response_time_ms.unwrap_or(0.0) / 1000.0;
            let answer = picture::answer(trial, &replaying.protocol);
            format!("question, answer after {after:.2} s: {answer}")
        }
        _ if replaying.at_ns < trial.end_ns => "not on record".to_owned(),
        Shown::Between | Shown::Gap => {
            "over; the pages between trials are not on record".to_owned()
        }
    };
    let (number, all) = (index + 1, replay.trials.len());
    format!("Trial {number} of {all} · {} · {what}", trial.row.condition)
}

fn interruption(replay: &Replay, at_ns: u64) -> String {
    let next = replay.trials.iter().find(|trial| trial.begin_ns >= at_ns);
    let gap_ms = next.and_then(|trial| trial.row.resume_gap_ms);
    gap_ms.map_or_else(
        || "interrupted".to_owned(),
        |gap_ms| {
            let gap = clock(gap_ms.saturating_mul(1_000_000));
            format!("interrupted; the next answer came after {gap}")
        },
    )
}

/// Minutes, seconds and milliseconds.
fn clock(ns: u64) -> String {
    let ms = ns / 1_000_000;
    format!("{}:{:02}.{:03}", ms / 60_000, ms / 1000 % 60, ms % 1000)
}

/// Every trial a lighter stretch, the moment a line; a click or a drag goes there.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a share of the duration
fn time(ui: &mut Ui, replay: &Replay, at_ns: u64) -> Option<Wish> {
    let size = vec2(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let duration_ns = replay.duration_ns().max(1) as f64;
    let x = |ns: u64| rect.left() + rect.width() * (ns as f64 / duration_ns) as f32;
    let painter = ui.painter();
    painter.rect_filled(rect, 0.0, Color32::from_gray(30));
    for trial in &replay.trials {
        let (from, to) = (x(trial.begin_ns), x(trial.end_ns));
        // A trial of a moment is still to be seen.
        let stretch = Rect::from_x_y_ranges(from..=to.max(from + 1.0), rect.y_range().shrink(3.0));
        painter.rect_filled(stretch, 0.0, Color32::from_gray(120));
        // Two trials may follow each other without a moment between them.
        let begin = Rect::from_x_y_ranges(from..=from + 1.0, rect.y_range());
        painter.rect_filled(begin, 0.0, Color32::from_gray(220));
    }
    let now = Rect::from_center_size(pos2(x(at_ns), rect.center().y), vec2(3.0, HEIGHT));
    painter.rect_filled(now, 0.0, Color32::WHITE);
    let pointer = response.interact_pointer_pos()?;
    let share = f64::from((pointer.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
    Some(Wish::Go((share * duration_ns) as u64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_minutes_seconds_and_milliseconds() {
        assert_eq!(clock(0), "0:00.000");
        assert_eq!(clock(61_002_999_999), "1:01.002");
    }
}
