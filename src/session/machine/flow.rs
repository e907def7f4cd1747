//! Which screen follows which.

use super::{Session, State};
use crate::protocol::procedure::{Ask, Step, TrialStart};
use crate::protocol::{Pause, Trial};
use crate::record::AboutAnswer;
use crate::session::{Effect, Event, Screen};

impl Session {
    /// Consent and questions about the participant.
    pub(super) fn preliminary(&mut self, event: Event) -> Vec<Effect> {
        match (self.state, event) {
            (State::Consent, Event::Decline) => {
                self.enter(State::Declined, Screen::Declined);
                Vec::new()
            }
            (State::Consent, Event::Agree) => {
                self.about.consent_sha256 = self.rules.consent_sha256.clone();
                self.about.consented_utc = Some(self.info.wall_clock_text(self.now));
                if self.rules.asks_about {
                    self.enter(State::Form, Screen::Form);
                    return Vec::new();
                }
                self.tell(Vec::new())
            }
            (State::Form, Event::Told(answers)) => self.tell(answers),
            _ => Vec::new(),
        }
    }

    fn tell(&mut self, answers: Vec<AboutAnswer>) -> Vec<Effect> {
        self.about.answers = answers;
        self.unsaved = Some(Effect::StoreAbout(Box::new(self.about.clone())));
        self.store()
    }

    /// The button under a page of text.
    pub(super) fn begin(&mut self) {
        match self.state {
            State::Instructions => self.next_trial(true),
            State::Pause => self.offer_trial(),
            _ => {}
        }
    }

    /// The page before the next trial, if it has one; or the end. Nobody needs a rest
    /// right after the instructions.
    pub(super) fn next_trial(&mut self, from_instructions: bool) {
        let pause = self.next().map(|trial| trial.pause);
        match pause {
            None => self.enter(State::Closing, Screen::Closing),
            Some(Some(Pause::Break)) if from_instructions => self.offer_trial(),
            Some(Some(pause)) => self.enter(State::Pause, Screen::Pause(pause)),
            Some(None) => self.offer_trial(),
        }
    }

    fn next(&self) -> Option<&Trial> {
        self.plan.trials.get(self.stored)
    }

    fn offer_trial(&mut self) {
        let (next, total) = (self.stored, self.plan.trials.len());
        match self.rules.trial_start {
            TrialStart::Menu => self.enter(State::Start, Screen::PairMenu { next, total }),
            TrialStart::Button => self.enter(State::Start, Screen::Ready { next, total }),
            TrialStart::Itself => self.start_trial(),
        }
    }

    pub(super) fn start_trial(&mut self) {
        self.trial_log.start();
        self.enter_step(0);
    }

    pub(super) fn next_step(&mut self) {
        if let State::Step(step) = self.state {
            self.enter_step(step + 1);
        }
    }

    fn enter_step(&mut self, step: usize) {
        let trial = self.stored;
        let screen = match self.rules.steps[step] {
            Step::Image { place, .. } => Screen::Image { trial, place },
            Step::Grey { .. } => Screen::Grey { trial },
            Step::Ask(Ask::Choice) => Screen::Question { trial },
            Step::Ask(Ask::CloserToReference) => Screen::Comparison { trial },
            Step::Ask(Ask::Ratings) => Screen::Rating { trial },
            Step::Ask(Ask::Ranking) => Screen::Ranking { trial },
        };
        self.enter(State::Step(step), screen);
    }
}
