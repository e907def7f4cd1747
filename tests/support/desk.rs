//! A session in the window with a clock moved by hand, rows kept in memory and a
//! disk that can be full.
#![allow(dead_code)] // each test file uses its part

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::time::{Duration, Instant};

use eframe::egui::{self, Key, Vec2};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::{Harness, Node};
use greyfield::app::clock::Clock;
use greyfield::app::pictures::Pictures;
use greyfield::app::present_feedback::Displayed;
use greyfield::app::sitting::Sitting;
use greyfield::app::theme;
use greyfield::protocol::Exhibit;
use greyfield::record::{About, InputDevice, OnsetMethod, TrialRow};
use greyfield::session::{
    DisplayOnRecord, Effect, Event, ImageHashes, Screen, Session, SessionInfo, start,
};

use crate::support::Tiny;

pub const SIZE_PX: [u32; 2] = [160, 90];
pub const WINDOW: Vec2 = Vec2::new(900.0, 700.0);
pub const SECOND_NS: u64 = 1_000_000_000;

/// A session on a screen, with a clock moved by hand and rows kept in memory.
pub struct Desk {
    pub harness: Harness<'static, Sitting>,
    pub clock_ns: Rc<Cell<u64>>,
    pub rows: Rc<RefCell<Vec<TrialRow>>>,
    /// What the participant agreed to and told.
    pub about: Rc<RefCell<Option<About>>>,
    /// What the disk says instead of storing, while it is full.
    pub disk_error: Rc<RefCell<Option<String>>>,
    pub study: Tiny,
    /// Whether the display system tells when a frame was shown: so long after it was
    /// handed over.
    pub told_after_ns: Option<u64>,
}

impl Desk {
    pub fn new(pairs: usize) -> Self {
        Self::of(Tiny::new(pairs, SIZE_PX))
    }

    pub fn of(study: Tiny) -> Self {
        Self::on_display(study, None)
    }

    /// On a display that states its period.
    pub fn on_display(study: Tiny, period: Option<Duration>) -> Self {
        let clock_ns = Rc::new(Cell::new(0));
        let rows: Rc<RefCell<Vec<TrialRow>>> = Rc::default();
        let disk_error: Rc<RefCell<Option<String>>> = Rc::default();
        let about: Rc<RefCell<Option<About>>> = Rc::default();
        let sitting =
            sitting(&study, &clock_ns, &rows, &about, &disk_error).with_refresh_period(period);
        let harness = Harness::builder()
            .with_size(WINDOW)
            .with_theme(egui::Theme::Light)
            .with_context_setup(theme::install)
            .with_render_options(eframe::egui_wgpu::RendererOptions {
                dithering: false,
                predictable_texture_filtering: false,
                ..Default::default()
            })
            .with_render_cursor(false)
            .wgpu()
            .build_ui_state(|ui, sitting: &mut Sitting| sitting.ui(ui), sitting);
        let mut desk = Self {
            harness,
            clock_ns,
            rows,
            about,
            disk_error,
            study,
            told_after_ns: None,
        };
        desk.frame();
        desk
    }

    /// One pass, and its arrival on the display.
    pub fn frame(&mut self) {
        self.harness.step();
        let ctx = self.harness.ctx.clone();
        let handed_over = Instant::now();
        self.harness.state_mut().presented(&ctx, handed_over);
        if let Some(ns) = self.told_after_ns {
            self.pass_time(ns);
            // A clock moved by hand gives its own time for any instant.
            let at = Instant::now();
            let frame = Displayed { handed_over, at };
            self.harness.state_mut().displayed(frame);
        }
    }

    pub fn screen(&self) -> Screen {
        self.harness.state().session().screen().clone()
    }

    pub fn pass_time(&mut self, ns: u64) {
        self.clock_ns.set(self.clock_ns.get() + ns);
    }

    /// Clicks the thing with this text, as a person would.
    #[track_caller]
    pub fn click(&mut self, text: &str) {
        let node: Node<'_> = self.harness.get_by_label(text);
        node.click();
        // Press and release, then the screen that follows.
        for _ in 0..3 {
            self.frame();
        }
    }

    pub fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.frame();
        self.frame();
    }

    /// From the page with the pairs to the question of a pair.
    pub fn look_at_pair(&mut self, n: usize) {
        self.click(&format!("Pair {n}"));
        self.press(Key::Space);
        self.pass_time(2 * SECOND_NS);
        self.frame();
        self.frame();
        self.press(Key::Space);
    }
}

fn sitting(
    study: &Tiny,
    clock_ns: &Rc<Cell<u64>>,
    rows: &Rc<RefCell<Vec<TrialRow>>>,
    about: &Rc<RefCell<Option<About>>>,
    disk_error: &Rc<RefCell<Option<String>>>,
) -> Sitting {
    let protocol = study.protocol();
    let plan = study.plan(0);
    let exhibits = start::exhibits(&protocol, &study.manifest).expect("exhibits");
    let sha256 = |&at: &_| {
        let image = start::image(&study.manifest, at).expect("the image");
        image.sha256.clone()
    };
    let hashes = |exhibit: &Exhibit| ImageHashes {
        images: exhibit.images.iter().map(sha256).collect(),
        reference: exhibit.reference.as_ref().map(sha256),
    };
    let images = exhibits.iter().map(hashes).collect();
    let info = SessionInfo {
        participant_id: String::from("P01"),
        session: 1,
        segment: 1,
        station_id: String::from("desk"),
        pilot: false,
        language: protocol.language,
        started_utc: time::OffsetDateTime::UNIX_EPOCH,
        onset_method: OnsetMethod::PresentCall,
        onset_uncertainty_ms: None,
        display: DisplayOnRecord::default(),
        refresh_period_ns: None,
        input_device: InputDevice::Keyboard,
        images,
        answered: 0,
        has_told: false,
        interrupted_utc: None,
    };
    let session = Session::new(plan, &protocol, info);
    let folder = study.path("stimuli");
    let pictures = Pictures::new(folder, &study.manifest, &exhibits, session.plan());
    let (rows, about, disk_error) = (Rc::clone(rows), Rc::clone(about), Rc::clone(disk_error));
    Sitting::new(
        session,
        Rc::new(protocol),
        Clock::Manual(Rc::clone(clock_ns)),
        Box::new(move |effect| {
            if let Some(detail) = disk_error.borrow().clone() {
                return Event::StoreFailed(detail);
            }
            match effect {
                Effect::StoreRow(row) => rows.borrow_mut().push((**row).clone()),
                Effect::StoreAbout(told) => *about.borrow_mut() = Some((**told).clone()),
            }
            Event::RowStored
        }),
        pictures,
        SIZE_PX,
    )
}

/// The picture stands in the middle of the screen byte for byte, grey round it.
pub fn assert_picture(screen: &image::RgbaImage, expected: &[u8]) {
    let corner = [
        (screen.width() - SIZE_PX[0]) / 2,
        (screen.height() - SIZE_PX[1]) / 2,
    ];
    for (x, y, pixel) in screen.enumerate_pixels() {
        let (u, v) = (x.wrapping_sub(corner[0]), y.wrapping_sub(corner[1]));
        let want = if u < SIZE_PX[0] && v < SIZE_PX[1] {
            let at = 4 * (v * SIZE_PX[0] + u) as usize;
            [expected[at], expected[at + 1], expected[at + 2], 255]
        } else {
            [128, 128, 128, 255]
        };
        assert_eq!(pixel.0, want, "pixel ({x}, {y})");
    }
}
