//! A recorded session on the screen again, for the experimenter: exactly the participant's
//! pictures, at one's own pace, and a bar of time that can be hidden.
//!
//! ```text
//! Space            play and pause
//! Right, Left      to the next and the previous change of the screen
//! with Shift       one frame of the participant's display
//! Up, Down         faster and slower: ×1, ×4, ×16
//! Home, End        to the start and the end
//! H                hide and show the bar: without it, the picture is the participant's alone
//! ```

mod bar;
mod picture;

use std::path::PathBuf;

use eframe::egui::{Context, InputState, Key, Ui};

use super::clock::Clock;
use crate::protocol::Protocol;
use crate::session::SessionTime;
use crate::session::replay::Replay;

/// How much faster than the session a replay can run.
pub const SPEEDS: [u64; 3] = [1, 4, 16];

/// A frame of a display nobody measured.
const USUAL_FRAME_MS: f64 = 1000.0 / 60.0;

/// A replay on the screen.
pub struct Replaying {
    replay: Replay,
    protocol: Protocol,
    pictures: picture::Pictures,
    clock: Clock,
    /// The moment that is shown, nanoseconds of the replay.
    at_ns: u64,
    /// The clock in the last pass.
    seen: SessionTime,
    is_playing: bool,
    speed: u64,
    bar_hidden: bool,
}

impl Replaying {
    /// A replay at its start, standing. The images lie in `folder`; `clock` moves it.
    #[must_use]
    pub fn new(replay: Replay, protocol: Protocol, folder: PathBuf, clock: Clock) -> Self {
        Self {
            pictures: picture::Pictures::new(folder),
            seen: clock.now(),
            replay,
            protocol,
            clock,
            at_ns: 0,
            is_playing: false,
            speed: SPEEDS[0],
            bar_hidden: false,
        }
    }

    /// The moment that is shown, nanoseconds of the replay.
    #[must_use]
    pub fn at_ns(&self) -> u64 {
        self.at_ns
    }

    /// The session that is shown.
    #[must_use]
    pub fn replay(&self) -> &Replay {
        &self.replay
    }

    /// One pass.
    pub fn ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.advance();
        // The space bar is play and pause, whatever was clicked last.
        ctx.memory_mut(|memory| {
            if let Some(focused) = memory.focused() {
                memory.surrender_focus(focused);
            }
        });
        ctx.input(|input| self.keys(input));
        self.draw(ui);
        if !self.bar_hidden {
            self.bar(&ctx);
        }
        if self.is_playing {
            ctx.request_repaint();
        }
    }

    fn advance(&mut self) {
        let now = self.clock.now();
        let passed_ns = now.ns.saturating_sub(self.seen.ns);
        self.seen = now;
        if !self.is_playing {
            return;
        }
        let ahead_ns = passed_ns.saturating_mul(self.speed);
        self.at_ns = self.at_ns.saturating_add(ahead_ns);
        if self.at_ns >= self.replay.duration_ns() {
            self.stand_at(self.replay.duration_ns());
        }
    }

    fn keys(&mut self, input: &InputState) {
        let shift = input.modifiers.shift;
        let frame_ns = self.frame_ns();
        if input.key_pressed(Key::Space) {
            self.play_or_pause();
        }
        if input.key_pressed(Key::ArrowRight) {
            let next = self.replay.next_change(self.at_ns).unwrap_or(self.at_ns);
            let next_frame = self.at_ns.saturating_add(frame_ns);
            self.stand_at(if shift { next_frame } else { next });
        }
        if input.key_pressed(Key::ArrowLeft) {
            let previous = self.replay.previous_change(self.at_ns).unwrap_or(0);
            let last_frame = self.at_ns.saturating_sub(frame_ns);
            self.stand_at(if shift { last_frame } else { previous });
        }
        let at_speed = SPEEDS.iter().position(|&speed| speed == self.speed);
        let at_speed = at_speed.unwrap_or(0);
        if input.key_pressed(Key::ArrowUp) {
            self.speed = SPEEDS[(at_speed + 1).min(SPEEDS.len() - 1)];
        }
        if input.key_pressed(Key::ArrowDown) {
            self.speed = SPEEDS[at_speed.saturating_sub(1)];
        }
        if input.key_pressed(Key::Home) {
            self.stand_at(0);
        }
        if input.key_pressed(Key::End) {
            self.stand_at(self.replay.duration_ns());
        }
        if input.key_pressed(Key::H) {
            self.bar_hidden = !self.bar_hidden;
        }
    }

    fn play_or_pause(&mut self) {
        if !self.is_playing && self.at_ns >= self.replay.duration_ns() {
            self.at_ns = 0;
        }
        self.is_playing = !self.is_playing;
    }

    fn stand_at(&mut self, at_ns: u64) {
        self.at_ns = at_ns.min(self.replay.duration_ns());
        self.is_playing = false;
    }

    /// A frame of the display of the trial that is on.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // some milliseconds
    fn frame_ns(&self) -> u64 {
        let trial = self.replay.screen_at(self.at_ns).trial;
        let row = trial.and_then(|trial| self.replay.trials.get(trial));
        let period_ms = row.and_then(|trial| trial.row.refresh_period_ms);
        (period_ms.unwrap_or(USUAL_FRAME_MS) * 1e6) as u64
    }

    fn draw(&mut self, ui: &mut Ui) {
        let screen = self.replay.screen_at(self.at_ns);
        let trial = screen
            .trial
            .and_then(|index| Some((index, self.replay.trials.get(index)?)));
        let drawn = self.pictures.draw(ui, &self.protocol, screen.what, trial);
        if let Err(detail) = drawn {
            picture::cannot(ui, &detail);
        }
    }

    fn bar(&mut self, ctx: &Context) {
        match bar::show(ctx, self) {
            Some(bar::Wish::PlayOrPause) => self.play_or_pause(),
            Some(bar::Wish::Speed(speed)) => self.speed = speed,
            Some(bar::Wish::Go(at_ns)) => self.stand_at(at_ns),
            None => return,
        }
        ctx.request_repaint();
    }
}
