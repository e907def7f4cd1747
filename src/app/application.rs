//! The application: the experimenter's start page, and from it one session after
//! another.

use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{Context, Ui, ViewportCommand};
use time::OffsetDateTime;
use winit::window::Window;

use super::browser::{Browser, Folder};
use super::clock::Clock;
use super::display::DisplayFacts;
use super::full_screen::FullScreen;
use super::pictures::Pictures;
use super::present_feedback::PresentFeedback;
use super::sitting::Sitting;
use super::start_page::{self, Enrolling, Facts, Next, OnRecord, Request};
use super::stimuli_check::StimuliCheck;
use super::stimulus_view::SizePx;
use super::theme;
use super::window::Content;
use crate::protocol::Protocol;
use crate::record::{Enrolment, InputDevice, OnsetMethod, ParticipantId, Study};
use crate::session::start::{self, Setting};
use crate::stimulus::{Manifest, StimulusSet};

/// A study, ready to run.
#[derive(Debug)]
pub struct Setup {
    /// The protocol.
    pub protocol: Protocol,
    /// Its file, to be named on the start page.
    pub protocol_path: PathBuf,
    /// The stimulus set.
    pub manifest: Manifest,
    /// The folder it lies in.
    pub stimuli: PathBuf,
    /// The open results folder.
    pub study: Study,
    /// This computer's name in the rows.
    pub station: String,
    /// Mark rows as pilot data.
    pub pilot: bool,
    /// Stay in a window instead of covering the screen during a session.
    pub windowed: bool,
    /// When the program started, for the time to the first frame.
    pub started: Instant,
}

/// What the window shows.
pub struct Application {
    setup: Setup,
    protocol: Rc<Protocol>,
    window: Option<Arc<Window>>,
    stimuli: StimuliCheck,
    participants: Result<Vec<String>, String>,
    enrolling: Enrolling,
    sitting: Option<Box<Sitting>>,
    /// The stimulus browser, opened from the start page; never during a session.
    browser: Option<Box<Browser>>,
    full_screen: FullScreen,
    first_frame_seen: bool,
    /// What the display system tells about the window's frames.
    feedback: Option<PresentFeedback>,
    /// When the last pass began, until its frame is handed over; a hidden window
    /// has no passes, and no frames.
    begun: Option<Instant>,
    /// Frames handed to the display so far.
    frames: u64,
    make_clock: Box<dyn Fn() -> Clock>,
}

impl Application {
    /// The application at its start page.
    #[must_use]
    pub fn new(setup: Setup) -> Self {
        let setup = Setup {
            study: setup.study.pilot(setup.pilot),
            ..setup
        };
        let mut application = Self {
            protocol: Rc::new(setup.protocol.clone()),
            setup,
            window: None,
            stimuli: StimuliCheck::Waiting,
            participants: Ok(Vec::new()),
            enrolling: Enrolling::default(),
            sitting: None,
            browser: None,
            full_screen: FullScreen::default(),
            first_frame_seen: false,
            feedback: None,
            begun: None,
            frames: 0,
            make_clock: Box::new(Clock::start),
        };
        application.count_participants();
        application
    }

    /// The same, but sessions run on clocks made by `make_clock` (tests move them
    /// by hand).
    #[must_use]
    pub fn with_clock(mut self, make_clock: impl Fn() -> Clock + 'static) -> Self {
        self.make_clock = Box::new(make_clock);
        self
    }

    /// The session on the screen, if one is.
    #[must_use]
    pub fn sitting(&self) -> Option<&Sitting> {
        self.sitting.as_deref()
    }

    /// Frames handed to the display so far.
    #[must_use]
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Columns and rows that every image of the set fits in, pixels.
    #[must_use]
    pub fn image_px(&self) -> SizePx {
        image_px(&self.setup.manifest)
    }

    /// Reads who has taken part; the folder changes only between sessions.
    fn count_participants(&mut self) {
        let conditions = start::conditions(&self.setup.manifest);
        self.participants =
            start_page::participants(&self.setup.study, &self.setup.protocol, &conditions)
                .map_err(|error| error.to_string());
    }

    fn start_page(&mut self, ui: &mut Ui) {
        let setup = &self.setup;
        let stimuli = &mut self.stimuli;
        if self.frames == 0 {
            // The first frame has both processor cores for itself.
            ui.ctx().request_repaint();
        } else if matches!(stimuli, StimuliCheck::Waiting) {
            *stimuli = StimuliCheck::start(ui.ctx(), setup.manifest.clone(), setup.stimuli.clone());
        }
        stimuli.poll();
        let image_px = image_px(&setup.manifest);
        let display = DisplayFacts::read(ui.ctx(), self.window.as_deref());
        let facts = Facts {
            protocol: &self.protocol,
            protocol_path: &setup.protocol_path,
            results: setup.study.folder(),
            station: &setup.station,
            pilot: setup.pilot,
            pairs: setup.manifest.pairs.len(),
            images: (setup.manifest.images().count(), image_px),
            stimuli,
            participants: &self.participants,
            display_check: &display.check(image_px, setup.windowed),
            display: &display,
            on_record: &|id| match setup.study.answered(id) {
                Ok(None) => OnRecord::New,
                Ok(Some(trials)) => OnRecord::Trials(trials),
                Err(error) => OnRecord::Unreadable(error.to_string()),
            },
        };
        match start_page::show(ui, &facts, &mut self.enrolling) {
            Some(Next::Stimuli) => self.browse(ui.ctx()),
            Some(Next::Session(request)) => self.begin(ui.ctx(), &request, &display),
            None => {}
        }
    }

    /// Puts the stimulus browser on the screen, on the folder that sessions show.
    fn browse(&mut self, ctx: &Context) {
        let setup = &self.setup;
        let set = StimulusSet::load(&setup.protocol.stimulus_set(&setup.protocol_path)).ok();
        let folder = Folder::with(&setup.stimuli, set).map_err(|error| error.to_string());
        self.browser = Some(Box::new(Browser::of(ctx, folder).with_way_back()));
        ctx.request_repaint();
    }

    /// Puts the session asked for on the screen, or says why not.
    fn begin(&mut self, ctx: &Context, request: &Request, display: &DisplayFacts) {
        match self.sit_down(request, display) {
            Ok(sitting) => {
                self.sitting = Some(Box::new(sitting));
                self.enrolling = Enrolling::default();
                if !self.setup.windowed {
                    self.full_screen.enter(ctx);
                }
            }
            Err(message) => {
                tracing::error!(message, "no session was started");
                self.enrolling.failure = Some(message);
            }
        }
        ctx.request_repaint();
    }

    fn sit_down(&self, request: &Request, display: &DisplayFacts) -> Result<Sitting, String> {
        let setup = &self.setup;
        let started_utc = OffsetDateTime::now_utc();
        let mut enrolment = self
            .enrol(request, started_utc)
            .map_err(|error| error.to_string())?;
        for warning in &enrolment.warnings {
            tracing::warn!(warning, "damage in the data of this participant");
        }
        let setting = Setting {
            started_utc,
            onset_method: OnsetMethod::PresentCall,
            // With one frame in flight and vertical sync, light follows the call
            // within the refresh it waited for and the one that scans it out.
            onset_uncertainty_ms: display.refresh_hz.map(|hz| 2000.0 / hz),
            refresh_period_ns: None,
            input_device: InputDevice::Keyboard,
        };
        let clock = (self.make_clock)();
        let session = start::start(&setup.protocol, &setup.manifest, &enrolment, &setting)
            .map_err(|error| error.to_string())?;
        let pictures = Pictures::new(setup.stimuli.clone(), &setup.manifest, session.plan());
        Ok(Sitting::new(
            session,
            Rc::clone(&self.protocol),
            clock,
            Box::new(move |effect| start::perform(effect, &mut enrolment.log)),
            pictures,
            self.image_px(),
        )
        .with_refresh_period(
            display
                .refresh_hz
                .and_then(|hz| Duration::try_from_secs_f64(1.0 / hz).ok()),
        ))
    }

    fn enrol(
        &self,
        request: &Request,
        now: OffsetDateTime,
    ) -> Result<Enrolment, crate::record::RecordError> {
        let (study, station) = (&self.setup.study, self.setup.station.as_str());
        let enrol = |id: &ParticipantId| study.enrol(id, station, now);
        match request {
            Request::Begin(id) => enrol(id),
            Request::Resume(id) => study.resume(id, station, now),
        }
    }

    /// Back to the start page once the experimenter has left the last screen.
    fn stand_up(&mut self, ctx: &Context) {
        if !self
            .sitting
            .as_ref()
            .is_some_and(|sitting| sitting.is_left())
        {
            return;
        }
        self.sitting = None;
        self.count_participants();
        // An image may have changed meanwhile.
        self.stimuli = StimuliCheck::Waiting;
        if !self.setup.windowed {
            self.full_screen.leave(ctx);
        }
        ctx.request_repaint();
    }

    /// Hands on what the display system has told about earlier frames.
    fn take_feedback(&mut self) {
        let Some(feedback) = &mut self.feedback else {
            return;
        };
        for frame in feedback.displayed() {
            if let Some(sitting) = &mut self.sitting {
                sitting.displayed(frame);
            }
        }
    }

    /// A running session does not end because somebody hit the key that closes
    /// windows; the abort chord ends it.
    fn refuse_to_close(&self, ctx: &Context) {
        let running = self
            .sitting
            .as_ref()
            .is_some_and(|sitting| !sitting.session().is_over());
        if running && ctx.input(|input| input.viewport().close_requested()) {
            tracing::warn!("the window was asked to close during a session; it stays open");
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
        }
    }
}

fn image_px(manifest: &Manifest) -> SizePx {
    let images = || manifest.images();
    [
        images().map(|image| image.width_px).max().unwrap_or(0),
        images().map(|image| image.height_px).max().unwrap_or(0),
    ]
}

impl Content for Application {
    fn ui(&mut self, ui: &mut Ui) {
        self.begun = Some(Instant::now());
        self.refuse_to_close(ui.ctx());
        self.take_feedback();
        self.full_screen.keep(ui.ctx(), self.window.as_deref());
        match (&mut self.sitting, &mut self.browser) {
            (Some(sitting), _) => sitting.ui(ui),
            (None, Some(browser)) => browser.ui(ui),
            (None, None) => self.start_page(ui),
        }
        if self
            .browser
            .as_ref()
            .is_some_and(|browser| browser.is_left())
        {
            self.browser = None;
            ui.ctx().request_repaint();
        }
        self.stand_up(ui.ctx());
    }

    fn opened(&mut self, ctx: &Context, window: Option<Arc<Window>>) {
        let elapsed = self.setup.started.elapsed();
        tracing::debug!(ms = elapsed.as_millis(), "window and adapter ready");
        theme::install(ctx);
        self.feedback = window.as_deref().and_then(PresentFeedback::listen);
        self.window = window;
    }

    fn pressed(&mut self, at: Instant) {
        if let Some(sitting) = &mut self.sitting {
            sitting.pressed(at);
        }
    }

    fn presented(&mut self, ctx: &Context, at: Instant) {
        self.frames += 1;
        tracing::trace!(frames = self.frames, "presented");
        if !std::mem::replace(&mut self.first_frame_seen, true) {
            let elapsed = at.saturating_duration_since(self.setup.started);
            tracing::info!(ms = elapsed.as_millis(), "first frame");
        }
        if let (Some(feedback), Some(begun)) = (&mut self.feedback, self.begun.take()) {
            feedback.handed_over(begun, at);
        }
        if let Some(sitting) = &mut self.sitting {
            sitting.presented(ctx, at);
        }
        self.take_feedback();
    }

    fn clear_level(&self) -> u8 {
        self.sitting
            .as_ref()
            .map_or(theme::PAGE, |sitting| sitting.surround())
    }
}
