//! Sessions in a window one after another, each answered by a script that presses
//! keys inside the window's process; rows go to a real study on disk.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Context, FocusDirection, Key, Modifiers, Ui};
use greyfield::app::clock::Clock;
use greyfield::app::pictures::Pictures;
use greyfield::app::sitting::Sitting;
use greyfield::app::{theme, window};
use greyfield::protocol::Language;
use greyfield::record::{InputDevice, OnsetMethod, ParticipantId, Study, TrialRow};
use greyfield::session::start::{self, Setting};
use greyfield::session::{DisplayOnRecord, Effect, Event, FrameFigures, Screen};
use time::OffsetDateTime;
use winit::window::Window;

use crate::support::Tiny;

/// Of the display that the X server pretends to be.
pub const PERIOD: Duration = Duration::from_nanos(16_666_667);

/// A participant who looks at every image for a time and answers at once.
pub struct Booth {
    tiny: Tiny,
    study: Study,
    look: Duration,
    /// In the grey of this trial, a frame that takes so long.
    stall: Option<(usize, Duration)>,
    sessions_left: usize,
    window_points: [u32; 2],
    period: Duration,
    sitting: Option<Sitting>,
    /// Since when the screen stands, and how many frames of it there were.
    standing: (Screen, Instant, u32),
    /// A key to press in the next pass.
    key: Option<Key>,
    /// Frames since the key that ends the first image.
    since_key: Option<u32>,
    rows: Rc<RefCell<Vec<TrialRow>>>,
    outcome: Outcome,
}

/// What came of it.
#[derive(Debug, Default)]
pub struct Outcome {
    pub rows: Vec<TrialRow>,
    /// Of each session.
    pub figures: Vec<FrameFigures>,
    /// Memory of the process after each session.
    pub resident_kib: Vec<u64>,
    /// From the key to the grey, of each trial.
    pub frames_to_grey: Vec<u32>,
}

impl Booth {
    pub fn new(tiny: Tiny, sessions: usize, look: Duration) -> Self {
        let text = std::fs::read_to_string(tiny.path("tiny.toml")).expect("the protocol");
        let results = tiny.path("results");
        let study = start::open_study(&results, &tiny.protocol(), &text, &tiny.manifest)
            .expect("a results folder");
        Self {
            tiny,
            study,
            look,
            stall: None,
            sessions_left: sessions,
            window_points: [800, 600],
            period: PERIOD,
            sitting: None,
            standing: (Screen::Closing, Instant::now(), 0),
            key: None,
            since_key: None,
            rows: Rc::default(),
            outcome: Outcome::default(),
        }
    }

    pub fn with_stall(mut self, trial: usize, length: Duration) -> Self {
        self.stall = Some((trial, length));
        self
    }

    /// In a small window, and at as many frames a second as it draws.
    pub fn hurried(mut self) -> Self {
        self.window_points = [480, 360];
        self.period = Duration::from_millis(1);
        self
    }

    /// Opens the window and runs every session.
    pub fn run(self) -> Outcome {
        let size = self.window_points;
        let booth = Rc::new(RefCell::new(self));
        window::run("Greyfield: booth", size, &(Rc::clone(&booth) as _)).expect("a window");
        let mut booth = booth.borrow_mut();
        booth.outcome.rows = booth.rows.take();
        std::mem::take(&mut booth.outcome)
    }

    fn sit_down(&mut self) {
        self.sessions_left -= 1;
        let now = OffsetDateTime::now_utc();
        let id = ParticipantId::new(&format!("P{}", self.sessions_left)).expect("an id");
        let mut enrolment = self.study.enrol(&id, "booth", now).expect("a slot");
        let setting = Setting {
            started_utc: now,
            onset_method: OnsetMethod::PresentCall,
            onset_uncertainty_ms: None,
            display: DisplayOnRecord::default(),
            refresh_period_ns: None,
            input_device: InputDevice::Keyboard,
            language: Language::En,
        };
        let (protocol, manifest) = (self.tiny.protocol(), &self.tiny.manifest);
        let session = start::start(&protocol, manifest, &enrolment, &setting).expect("a plan");
        let exhibits = start::exhibits(&protocol, manifest).expect("exhibits");
        let folder = self.tiny.path("stimuli");
        let pictures = Pictures::new(folder, manifest, &exhibits, session.plan());
        let rows = Rc::clone(&self.rows);
        let store = Box::new(move |effect: &Effect| {
            let done = start::perform(effect, &mut enrolment);
            if let (Event::RowStored, Effect::StoreRow(row)) = (&done, effect) {
                rows.borrow_mut().push((**row).clone());
            }
            done
        });
        let size_px = self.tiny.size_px();
        let sitting = Sitting::new(
            session,
            Rc::new(protocol),
            Clock::start(),
            store,
            pictures,
            size_px,
        );
        self.sitting = Some(sitting.with_refresh_period(Some(self.period)));
    }

    fn stand_up(&mut self, sitting: &Sitting) {
        self.outcome.figures.extend(sitting.frame_figures());
        let statm = std::fs::read_to_string("/proc/self/statm").expect("on Linux");
        let pages = statm.split_whitespace().nth(1).expect("resident pages");
        let pages: u64 = pages.parse().expect("a number");
        self.outcome.resident_kib.push(4 * pages);
    }

    /// What the participant does now that a frame was presented.
    fn act(&mut self, ctx: &Context, screen: &Screen) {
        if self.standing.0 != *screen {
            if let (Screen::Grey { .. }, Some(frames)) = (screen, self.since_key.take()) {
                self.outcome.frames_to_grey.push(frames);
            }
            self.standing = (screen.clone(), Instant::now(), 0);
        }
        self.standing.2 += 1;
        let looked = self.standing.1.elapsed() >= self.look;
        self.key = match screen {
            // A frame for the button to be there, another to have the focus.
            Screen::Instructions | Screen::PairMenu { .. } => match self.standing.2 {
                1 => None,
                2 => Some(Key::Tab),
                _ => Some(Key::Enter),
            },
            Screen::Image { .. } if looked => Some(Key::Space),
            Screen::Question { .. } => Some(Key::Num1),
            _ => None,
        };
        let first = Screen::Image {
            trial: self.rows.borrow().len() % self.tiny.manifest.pairs.len(),
            place: 0,
        };
        if self.key.is_some() && *screen == first {
            self.since_key = Some(0);
        }
        if self.key.is_some() || !matches!(screen, Screen::Image { .. } | Screen::Grey { .. }) {
            // As the event of a real key or the pointer would.
            ctx.request_repaint_after(Duration::from_nanos(1));
        }
    }
}

impl window::Content for Booth {
    fn ui(&mut self, ui: &mut Ui) {
        if self.sitting.is_none() && self.sessions_left > 0 {
            self.sit_down();
        }
        let Some(sitting) = &mut self.sitting else {
            return;
        };
        if let Some(key) = self.key.take() {
            sitting.pressed(Instant::now());
            let event = |pressed| egui::Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            };
            if key == Key::Tab {
                // egui moves the focus before a pass; in one, this is how.
                let next = FocusDirection::Next;
                ui.ctx().memory_mut(|memory| memory.move_focus(next));
            }
            let events = [event(true), event(false)];
            ui.ctx().input_mut(|input| input.events.extend(events));
        }
        if let (Some((trial, length)), Screen::Grey { trial: now }) =
            (self.stall, sitting.session().screen())
            && trial == *now
            && self.standing.2 == 30
        {
            std::thread::sleep(length);
            self.stall = None;
        }
        sitting.ui(ui);
    }

    fn opened(&mut self, ctx: &Context, _window: Option<Arc<Window>>) {
        theme::install(ctx);
    }

    fn pressed(&mut self, _at: Instant) {}

    fn presented(&mut self, ctx: &Context, at: Instant) {
        let Some(mut sitting) = self.sitting.take() else {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            ctx.request_repaint();
            return;
        };
        sitting.presented(ctx, at);
        if let Some(frames) = &mut self.since_key {
            *frames += 1;
        }
        if sitting.session().is_over() {
            self.stand_up(&sitting);
            ctx.request_repaint();
            return;
        }
        if sitting.session().is_shown() {
            self.act(ctx, &sitting.session().screen().clone());
        } else {
            ctx.request_repaint_after(Duration::from_nanos(1));
        }
        self.sitting = Some(sitting);
    }

    fn clear_level(&self) -> u8 {
        128
    }
}
