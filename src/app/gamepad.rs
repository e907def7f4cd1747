//! Answers from a game-pad. A thread waits for its buttons, so that each press has the
//! time it was received, and wakes the window.
//!
//! | button | does |
//! |---|---|
//! | lower one (A, cross) | goes on: ends an image, presses the button of a page |
//! | left one (X, square), direction pad left, left shoulder | the first or left image |
//! | right one (B, circle), direction pad right, right shoulder | the second or right image |
//! | upper one (Y, triangle) | cannot tell |
//!
//! Forms, consent, ratings and rankings need a keyboard or a mouse.

use std::sync::mpsc::{self, Receiver};
use std::time::Instant;

use eframe::egui::Context;

use crate::protocol::Position;
use crate::record::InputDevice;
use crate::session::{Answer, Event, Screen};

/// What a button means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pad {
    /// The lower button.
    GoOn,
    /// To the left.
    First,
    /// To the right.
    Second,
    /// The upper button.
    Neither,
}

/// A button that went down.
#[derive(Debug, Clone, Copy)]
pub struct Press {
    /// Which.
    pub pad: Pad,
    /// When that was received.
    pub at: Instant,
}

/// Every game-pad of this computer, also those plugged in later.
#[derive(Debug)]
pub struct Gamepads(Receiver<Press>);

impl Gamepads {
    /// Listens from now on; `None` where the system has no way to.
    #[must_use]
    pub fn listen(ctx: &Context) -> Option<Self> {
        let (sender, receiver) = mpsc::channel();
        listen_on_a_thread(ctx.clone(), sender)?;
        Some(Self(receiver))
    }

    /// Presses handed in by hand: how tests play a game-pad.
    #[must_use]
    pub fn of(presses: Receiver<Press>) -> Self {
        Self(presses)
    }

    /// The earliest press that was not taken yet.
    #[must_use]
    pub fn next(&self) -> Option<Press> {
        self.0.try_recv().ok()
    }
}

#[cfg(feature = "gamepad")]
fn listen_on_a_thread(ctx: Context, sender: mpsc::Sender<Press>) -> Option<()> {
    let mut gilrs = gilrs::Gilrs::new()
        .inspect_err(|error| tracing::info!(%error, "no game-pads"))
        .ok()?;
    std::thread::Builder::new()
        .name("game-pads".to_owned())
        .spawn(move || {
            loop {
                let Some(event) = gilrs.next_event_blocking(None) else {
                    continue;
                };
                let at = Instant::now();
                // Repeats are events of another kind, and pass by.
                let gilrs::EventType::ButtonPressed(button, _) = event.event else {
                    continue;
                };
                let Some(pad) = meaning(button) else { continue };
                if sender.send(Press { pad, at }).is_err() {
                    return;
                }
                ctx.request_repaint();
            }
        })
        .ok()
        .map(drop)
}

#[cfg(feature = "gamepad")]
fn meaning(button: gilrs::Button) -> Option<Pad> {
    use gilrs::Button;
    Some(match button {
        Button::South => Pad::GoOn,
        Button::West | Button::DPadLeft | Button::LeftTrigger => Pad::First,
        Button::East | Button::DPadRight | Button::RightTrigger => Pad::Second,
        Button::North => Pad::Neither,
        _ => return None,
    })
}

#[cfg(not(feature = "gamepad"))]
fn listen_on_a_thread(_ctx: Context, _sender: mpsc::Sender<Press>) -> Option<()> {
    None
}

/// What a press means on a screen; `None` where it means nothing.
#[must_use]
pub fn given(pad: Pad, screen: &Screen) -> Option<(Event, InputDevice)> {
    let event = match (screen, pad) {
        (Screen::Instructions | Screen::Pause(_), Pad::GoOn) => Event::Begin,
        (Screen::PairMenu { next, .. } | Screen::Ready { next, .. }, Pad::GoOn) => {
            Event::StartPair(*next)
        }
        (Screen::Image { .. }, Pad::GoOn) => Event::Continue,
        (Screen::Question { .. } | Screen::Comparison { .. }, pad) => Event::Answer(match pad {
            Pad::First => Answer::Choice(Position::First),
            Pad::Second => Answer::Choice(Position::Second),
            // Where the protocol does not allow it, the session passes over it.
            Pad::Neither => Answer::CannotTell,
            Pad::GoOn => return None,
        }),
        _ => return None,
    };
    Some((event, InputDevice::Gamepad))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_answer_questions_and_nothing_else() {
        let question = Screen::Question { trial: 0 };
        let first = given(Pad::First, &question);
        let answer = Event::Answer(Answer::Choice(Position::First));
        assert_eq!(first, Some((answer, InputDevice::Gamepad)));
        assert_eq!(given(Pad::GoOn, &question), None);
        let image = Screen::Image { trial: 0, place: 0 };
        assert_eq!(given(Pad::First, &image), None);
        assert!(matches!(
            given(Pad::GoOn, &image),
            Some((Event::Continue, _))
        ));
        let grey = Screen::Grey { trial: 0 };
        for pad in [Pad::GoOn, Pad::First, Pad::Second, Pad::Neither] {
            assert_eq!(given(pad, &grey), None, "the grey takes no input");
            assert_eq!(given(pad, &Screen::Consent), None, "consent is not a slip");
        }
    }
}
