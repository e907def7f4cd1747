//! The application: the experimenter's start page, and from it one session after
//! another.

mod session_start;

use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

use eframe::egui::{Context, Ui, ViewportCommand};
use winit::window::Window;

use super::browser::{Browser, Folder};
use super::clock::Clock;
use super::display::DisplayFacts;
use super::full_screen::FullScreen;
use super::gamepad::Gamepads;
use super::present_feedback::PresentFeedback;
use super::readiness::Readiness;
use super::sitting::Sitting;
use super::start_page::{self, Enrolling, Facts, Next, OnRecord, Request};
use super::stimuli_check::StimuliCheck;
use super::stimulus_view::{self, SizePx};
use super::study_page::StudyPage;
use super::theme;
use super::window::Content;
use crate::protocol::Protocol;
use crate::record::{ParticipantId, Study};
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
    /// A session asked for, until the window covers the screen.
    waiting: Option<Request>,
    /// The check of its display, then.
    readiness: Option<Box<Readiness>>,
    sitting: Option<Box<Sitting>>,
    /// Whose session it is.
    sitting_of: Option<ParticipantId>,
    gamepads: Option<Gamepads>,
    /// Images of the trial that shows most of them at once.
    most_versions: usize,
    /// The study's page, opened from the start page; never during a session.
    study_page: Option<Box<StudyPage>>,
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
            waiting: None,
            readiness: None,
            sitting: None,
            sitting_of: None,
            gamepads: None,
            most_versions: 0,
            study_page: None,
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
        let setup = &self.setup;
        let conditions = &setup.study.identity().conditions;
        self.most_versions = (conditions.iter().map(|it| it.techniques.len()))
            .max()
            .unwrap_or(0);
        self.participants = start_page::participants(&setup.study, &setup.protocol, conditions)
            .map_err(|error| error.to_string());
    }

    fn start_page(&mut self, ui: &mut Ui) {
        let display = DisplayFacts::read(ui.ctx(), self.window.as_deref());
        let needed_px = self.needed_px(&display);
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
        let facts = Facts {
            protocol: &self.protocol,
            protocol_path: &setup.protocol_path,
            results: setup.study.folder(),
            station: &setup.station,
            pilot: setup.pilot,
            trials: setup.study.identity().trials(),
            images: (setup.manifest.images().count(), image_px),
            stimuli,
            participants: &self.participants,
            display_check: &display.check(needed_px, setup.windowed),
            display: &display,
            on_record: &|id| match setup.study.answered(id) {
                Ok(None) => OnRecord::New,
                Ok(Some(trials)) => OnRecord::Trials(trials),
                Err(error) => OnRecord::Unreadable(error.to_string()),
            },
        };
        match start_page::show(ui, &facts, &mut self.enrolling) {
            Some(Next::Stimuli) => self.browse(ui.ctx()),
            Some(Next::Study) => {
                let page = StudyPage::new(self.setup.study.folder(), false);
                self.study_page = Some(Box::new(page.with_way_back()));
                ui.ctx().request_repaint();
            }
            Some(Next::Watch) => self.watch(),
            Some(Next::Session(request)) => self.begin(ui.ctx(), request),
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

    /// Starts this program once more, to watch the study in a window of its own: a
    /// second window of this process would make a session's frames wait for its own.
    fn watch(&mut self) {
        let started = std::env::current_exe().and_then(|program| {
            std::process::Command::new(program)
                .arg("watch")
                .arg(self.setup.study.folder())
                .spawn()
        });
        if let Err(error) = started {
            let folder = self.setup.study.folder().display();
            self.enrolling.failure = Some(format!(
                "no second window: {error}; start it by hand with `greyfield watch {folder}`"
            ));
        }
    }

    /// Hands on the buttons of game-pads; outside of a session they mean nothing.
    fn take_gamepads(&mut self) {
        let Some(gamepads) = &self.gamepads else {
            return;
        };
        while let Some(press) = gamepads.next() {
            if let Some(sitting) = &mut self.sitting {
                sitting.pad(press);
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
        self.check_display_when_settled(ui.ctx());
        self.take_gamepads();
        if let Some(sitting) = &mut self.sitting {
            sitting.ui(ui);
        } else if let Some(readiness) = &mut self.readiness {
            if let Some(outcome) = readiness.ui(ui) {
                self.after_check(ui.ctx(), outcome);
            }
        } else if self.waiting.is_some() {
            stimulus_view::paint_grey(ui.ctx(), self.protocol.grey.level_srgb.get());
        } else if let Some(page) = &mut self.study_page {
            page.ui(ui);
        } else if let Some(browser) = &mut self.browser {
            browser.ui(ui);
        } else {
            self.start_page(ui);
        }
        if self
            .browser
            .as_ref()
            .is_some_and(|browser| browser.is_left())
        {
            self.browser = None;
            ui.ctx().request_repaint();
        }
        if self.study_page.take_if(|page| page.is_left()).is_some() {
            self.count_participants();
            ui.ctx().request_repaint();
        }
        self.stand_up(ui.ctx());
    }

    fn opened(&mut self, ctx: &Context, window: Option<Arc<Window>>) {
        let elapsed = self.setup.started.elapsed();
        tracing::debug!(ms = elapsed.as_millis(), "window and adapter ready");
        theme::install(ctx);
        self.feedback = window.as_deref().and_then(PresentFeedback::listen);
        self.gamepads = window.as_ref().and_then(|_| Gamepads::listen(ctx));
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
        } else if let Some(readiness) = &mut self.readiness {
            let window = self.window.as_deref();
            readiness.presented(ctx, window, self.feedback.as_mut(), at);
        }
        self.take_feedback();
    }

    fn clear_level(&self) -> u8 {
        match &self.sitting {
            Some(sitting) => sitting.surround(),
            None if self.waiting.is_some() || self.readiness.is_some() => {
                self.protocol.grey.level_srgb.get()
            }
            None => theme::PAGE,
        }
    }
}
