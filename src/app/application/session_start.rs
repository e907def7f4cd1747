//! From the start page into a session, and back.

use std::rc::Rc;
use std::time::Duration;

use eframe::egui::Context;
use time::OffsetDateTime;

use super::Application;
use crate::app::display::DisplayFacts;
use crate::app::participant::{comparison, ranking};
use crate::app::pictures::Pictures;
use crate::app::readiness::{Checked, Outcome, Readiness};
use crate::app::sitting::Sitting;
use crate::app::start_page::{Enrolling, Request};
use crate::app::stimuli_check::StimuliCheck;
use crate::app::stimulus_view::SizePx;
use crate::protocol::exhibit::Exhibits;
use crate::record::{Enrolment, InputDevice, OnsetMethod, ParticipantId, RecordError, display};
use crate::session::Screen;
use crate::session::start::{self, Setting};

impl Application {
    /// Begins with the display; in a window, which is for trying things out, at once.
    pub(super) fn begin(&mut self, ctx: &Context, request: Request) {
        if self.setup.windowed {
            self.sit_or_say(ctx, &request, &Checked::default());
            return;
        }
        self.full_screen.enter(ctx);
        self.waiting = Some(request);
        ctx.request_repaint();
    }

    /// Once the window covers the screen, the display is checked.
    pub(super) fn check_display_when_settled(&mut self, ctx: &Context) {
        if self.full_screen.is_settled()
            && let Some(request) = self.waiting.take()
        {
            self.readiness = Some(Box::new(Readiness::new(request, &self.protocol)));
            ctx.request_repaint();
        }
    }

    /// Does what became of the check.
    pub(super) fn after_check(&mut self, ctx: &Context, outcome: Outcome) {
        self.readiness = None;
        match outcome {
            Outcome::Begin(request, checked) => self.sit_or_say(ctx, &request, &checked),
            Outcome::Back(why) => {
                self.full_screen.leave(ctx);
                if !why.is_empty() {
                    tracing::error!(why, "no session was started");
                    self.enrolling.failure = Some(why);
                }
                ctx.request_repaint();
            }
        }
    }

    /// Puts the session asked for on the screen, or says why not.
    fn sit_or_say(&mut self, ctx: &Context, request: &Request, checked: &Checked) {
        let display = DisplayFacts::read(ctx, self.window.as_deref());
        match self.sit_down(request, &display, checked) {
            Ok(sitting) => {
                self.sitting = Some(Box::new(sitting));
                self.enrolling = Enrolling::default();
            }
            Err(message) => {
                tracing::error!(message, "no session was started");
                self.enrolling.failure = Some(message);
                if !self.setup.windowed {
                    self.full_screen.leave(ctx);
                }
            }
        }
        ctx.request_repaint();
    }

    fn sit_down(
        &mut self,
        request: &Request,
        display: &DisplayFacts,
        checked: &Checked,
    ) -> Result<Sitting, String> {
        let started_utc = OffsetDateTime::now_utc();
        let said = |error: RecordError| error.to_string();
        let mut enrolment = self.enrol(request, started_utc).map_err(said)?;
        self.sitting_of = Some(enrolment.participant.clone());
        for warning in &enrolment.warnings {
            tracing::warn!(warning, "damage in the data of this participant");
        }
        if let Some(figures) = &checked.figures {
            let (who, segment) = (&enrolment.participant, enrolment.segment);
            display::store(&enrolment.results, who, segment, figures).map_err(said)?;
        }
        let setup = &self.setup;
        let period_ns = checked.figures.as_ref().and_then(|it| it.period_ns());
        let period = period_ns.map(Duration::from_nanos).or(display
            .refresh_hz
            .and_then(|hz| Duration::try_from_secs_f64(1.0 / hz).ok()));
        let setting = Setting {
            started_utc,
            onset_method: OnsetMethod::PresentCall,
            // With one frame in flight and vertical sync, light follows the call
            // within the refresh it waited for and the one that scans it out.
            onset_uncertainty_ms: period.map(|period| 2000.0 * period.as_secs_f64()),
            display: checked.on_record(),
            refresh_period_ns: checked
                .figures
                .as_ref()
                .and_then(|it| it.counted_period_ns()),
            input_device: InputDevice::Keyboard,
            language: (self.enrolling.screens.language).unwrap_or(setup.protocol.language),
        };
        let clock = (self.make_clock)();
        let (protocol, manifest) = (&setup.protocol, &setup.manifest);
        let session = start::start(protocol, manifest, &enrolment, &setting)
            .map_err(|error| error.to_string())?;
        let exhibits = start::exhibits(protocol, manifest).map_err(|error| error.to_string())?;
        let folder = setup.stimuli.clone();
        let pictures = Pictures::new(folder, manifest, &exhibits, session.plan());
        let screens = self.enrolling.screens;
        Ok(Sitting::new(
            session,
            Rc::clone(&self.protocol),
            clock,
            Box::new(move |effect| start::perform(effect, &mut enrolment)),
            pictures,
            self.image_px(),
        )
        .with_type(screens.text_scale, screens.high_contrast)
        .with_refresh_period(period))
    }

    fn enrol(&self, request: &Request, now: OffsetDateTime) -> Result<Enrolment, RecordError> {
        let (study, station) = (&self.setup.study, self.setup.station.as_str());
        let enrol = |id: &ParticipantId| study.enrol(id, station, now);
        match request {
            Request::Begin(id) => enrol(id),
            Request::Resume(id) => study.resume(id, station, now),
        }
    }

    /// Back to the start page once the experimenter has left the last screen.
    pub(super) fn stand_up(&mut self, ctx: &Context) {
        let left = self.sitting.take_if(|sitting| sitting.is_left());
        let Some(sitting) = left else {
            return;
        };
        let declined = matches!(sitting.session().screen(), Screen::Declined);
        // Closes the data file, which giving a slot up needs.
        drop(sitting);
        if let Some(participant) = self.sitting_of.take().filter(|_| declined) {
            self.give_slot_up(&participant);
        }
        self.count_participants();
        // An image may have changed meanwhile.
        self.stimuli = StimuliCheck::Waiting;
        if !self.setup.windowed {
            self.full_screen.leave(ctx);
        }
        ctx.request_repaint();
    }

    /// Somebody who does not take part leaves no hole in the design.
    fn give_slot_up(&mut self, participant: &ParticipantId) {
        let now = OffsetDateTime::now_utc();
        let released = self
            .setup
            .study
            .release(participant, "declined to take part", now);
        match released {
            Ok(slot) => tracing::info!(%participant, slot, "declined; the slot is open again"),
            Err(error) => {
                self.enrolling.failure = Some(format!(
                    "{participant} declined to take part, but the slot could not be given up: {error}"
                ));
            }
        }
    }

    /// Size that the largest screen of a session needs on a display, pixels.
    pub(super) fn needed_px(&self, display: &DisplayFacts) -> SizePx {
        let image_px = self.image_px();
        let monitor = display.monitor_px.unwrap_or(display.window_px);
        let arranged = match self.protocol.procedure.exhibits {
            Exhibits::Pairs | Exhibits::Singles => return image_px,
            Exhibits::PairsWithReference => {
                comparison::arrange(monitor, image_px, display.scale_factor)
            }
            Exhibits::Versions => {
                ranking::arrange(monitor, image_px, self.most_versions, display.scale_factor)
            }
        };
        match arranged {
            Ok(arranged) => arranged.whole_px,
            Err(too_small) => too_small.picture_px,
        }
    }
}
