//! The experimenter's start page over a real results folder: who comes next, what
//! stands in the way, and a session from the first click to the rows on disk.

use std::cell::Cell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use crate::support::Tiny;
use eframe::egui::{self, Key, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use greyfield::app::clock::Clock;
use greyfield::app::window::Content as _;
use greyfield::app::{Application, Setup, theme};
use greyfield::record::read::read_folder;
use greyfield::record::{Response, TrialRow};
use greyfield::session::start;

const SIZE_PX: [u32; 2] = [160, 90];

/// The application at its start page, with a clock moved by hand.
struct Lab {
    harness: Harness<'static, Application>,
    clock_ns: Rc<Cell<u64>>,
}

impl Lab {
    fn open(study: &Tiny, windowed: bool) -> Self {
        let protocol = study.protocol();
        let text = std::fs::read_to_string(study.path("tiny.toml")).expect("the protocol");
        let results = study.path("results");
        let setup = Setup {
            study: start::open_study(&results, &protocol, &text, &study.manifest)
                .expect("the results folder opens"),
            protocol,
            protocol_path: study.path("tiny.toml"),
            manifest: study.manifest.clone(),
            stimuli: study.path("stimuli"),
            station: String::from("desk"),
            pilot: false,
            windowed,
            started: Instant::now(),
        };
        let clock_ns: Rc<Cell<u64>> = Rc::default();
        let clock = Clock::Manual(Rc::clone(&clock_ns));
        let application = Application::new(setup).with_clock(move || clock.clone());
        let harness = Harness::builder()
            .with_size(Vec2::new(1000.0, 800.0))
            .with_theme(egui::Theme::Light)
            .with_context_setup(theme::install)
            .build_ui_state(|ui, app: &mut Application| app.ui(ui), application);
        let mut lab = Self { harness, clock_ns };
        lab.settle();
        lab
    }

    fn frame(&mut self) {
        self.harness.step();
        let ctx = self.harness.ctx.clone();
        self.harness.state_mut().presented(&ctx, Instant::now());
    }

    /// Waits for the check of the images, which runs beside the interface.
    fn settle(&mut self) {
        let deadline = Instant::now() + Duration::from_secs(20);
        loop {
            self.frame();
            let checking = self.harness.query_by_label_contains("being checked");
            if checking.is_none() {
                return;
            }
            assert!(Instant::now() < deadline, "the images are never checked");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn frames(&mut self, count: usize) {
        for _ in 0..count {
            self.frame();
        }
    }

    #[track_caller]
    fn click(&mut self, text: &str) {
        self.harness.get_by_label(text).click();
        self.frames(3);
    }

    fn type_id(&mut self, id: &str) {
        self.harness.get_by_label("Participant id").focus();
        self.frames(2);
        self.harness
            .key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        self.frame();
        self.harness.event(egui::Event::Text(String::from(id)));
        self.frames(2);
    }

    #[track_caller]
    fn is_enabled(&self, text: &str) -> bool {
        !self
            .harness
            .get_by_label(text)
            .accesskit_node()
            .is_disabled()
    }

    fn answer_pair(&mut self, n: usize, answer: Key) {
        self.click(&format!("Pair {n}"));
        self.press(Key::Space);
        self.clock_ns.set(self.clock_ns.get() + 2_000_000_000);
        self.frames(2);
        self.press(Key::Space);
        self.press(answer);
    }

    fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.frames(2);
    }
}

fn rows(study: &Tiny) -> Vec<TrialRow> {
    let rows = read_folder(&study.path("results")).expect("the data is readable");
    assert!(rows.warnings.is_empty());
    rows.rows
}

#[test]
fn from_the_id_to_the_rows_on_disk_and_back() {
    let study = Tiny::new(2, SIZE_PX);
    let mut lab = Lab::open(&study, true);
    lab.harness.get_by_label("Nobody yet");
    lab.type_id("P01");
    lab.click("Start session");
    lab.click("Begin");
    lab.answer_pair(1, Key::Num1);
    // On disk before the next screen, not at the end.
    assert_eq!(rows(&study).len(), 1);
    lab.answer_pair(2, Key::Num2);
    lab.click("Back to the start page");
    lab.settle();
    lab.harness.get_by_label("1 finished");

    let rows = rows(&study);
    let responses: Vec<_> = rows.iter().map(|row| row.response).collect();
    assert_eq!(responses, [Some(Response::First), Some(Response::Second)]);
    let plan = study.plan(0);
    for (trial, row) in rows.iter().enumerate() {
        let [first, second] = study.shown(&plan, trial);
        assert_eq!(row.technique_first, first.technique);
        assert_eq!(row.second_image_sha256, second.sha256);
        assert_eq!(
            (row.participant_id.as_str(), row.station_id.as_str()),
            ("P01", "desk")
        );
    }
}

#[test]
fn an_id_is_checked_while_it_is_typed() {
    let study = Tiny::new(1, SIZE_PX);
    let mut lab = Lab::open(&study, true);
    assert!(!lab.is_enabled("Start session"), "no id yet");
    lab.type_id("=1+1");
    assert!(!lab.is_enabled("Start session"));
    lab.harness
        .get_by_label_contains("allowed is a letter or digit");
    lab.type_id("P-07");
    assert!(lab.is_enabled("Start session"));
}

#[test]
fn an_interrupted_session_goes_on_after_a_confirmation() {
    let study = Tiny::new(2, SIZE_PX);
    let mut lab = Lab::open(&study, true);
    lab.type_id("P01");
    lab.click("Start session");
    lab.click("Begin");
    lab.answer_pair(1, Key::Num1);
    // The window is gone in the middle of the second pair.
    lab.click("Pair 2");
    drop(lab);

    let mut lab = Lab::open(&study, true);
    lab.harness.get_by_label_contains("unfinished: P01");
    lab.type_id("P01");
    lab.harness
        .get_by_label_contains("1 of 2 trials are on record");
    lab.click("Resume session …");
    lab.click("No");
    lab.click("Resume session …");
    lab.click("Yes, resume");
    lab.click("Begin");
    lab.answer_pair(2, Key::Num2);
    let rows = rows(&study);
    let segments: Vec<_> = rows
        .iter()
        .map(|row| (row.trial_index, row.segment))
        .collect();
    assert_eq!(segments, [(0, 1), (1, 2)]);
    assert!(rows[1].resume_gap_ms.is_some(), "the gap is on record");

    lab.click("Back to the start page");
    lab.settle();
    lab.type_id("P01");
    assert!(!lab.is_enabled("Start session"));
    lab.harness.get_by_label_contains("has finished this study");
}

#[test]
fn the_stimuli_are_looked_at_from_the_start_page_and_never_from_a_session() {
    let study = Tiny::new(1, SIZE_PX);
    let mut lab = Lab::open(&study, true);
    lab.click("Look at the stimuli");
    lab.harness.get_by_label("Difference");
    lab.press(Key::Escape);
    lab.type_id("P01");
    lab.click("Start session");
    for key in [Key::Escape, Key::Space, Key::B] {
        lab.press(key);
        assert!(lab.harness.query_by_label("Difference").is_none());
    }
    let technique = &study.manifest.pairs[0].second.technique;
    assert!(lab.harness.query_by_label_contains(technique).is_none());
}

#[test]
fn a_changed_image_keeps_any_session_from_starting() {
    let study = Tiny::new(1, SIZE_PX);
    let image = &study.manifest.pairs[0].second;
    let path = study.path("stimuli").join(&image.file);
    let other = image::RgbImage::new(SIZE_PX[0], SIZE_PX[1]);
    other.save(&path).expect("another image in its place");
    let mut lab = Lab::open(&study, true);
    lab.type_id("P01");
    assert!(!lab.is_enabled("Start session"));
    lab.harness.get_by_label_contains("No session can start: ");
}

#[test]
fn a_window_smaller_than_the_images_is_refused() {
    let study = Tiny::new(1, [1001, 90]);
    let mut lab = Lab::open(&study, true);
    lab.type_id("P01");
    assert!(!lab.is_enabled("Start session"));
    let refusal = lab.harness.get_all_by_label_contains("1001×90").count();
    assert!(refusal >= 1, "both sizes are named");
    lab.harness.set_size(Vec2::new(1001.0, 800.0));
    lab.frames(2);
    assert!(lab.is_enabled("Start session"));
}

#[test]
fn a_running_session_does_not_close_with_the_window() {
    let study = Tiny::new(1, SIZE_PX);
    let mut lab = Lab::open(&study, true);
    lab.type_id("P01");
    lab.click("Start session");
    let viewport = lab
        .harness
        .input_mut()
        .viewports
        .get_mut(&egui::ViewportId::ROOT);
    viewport
        .expect("the window")
        .events
        .push(egui::ViewportEvent::Close);
    lab.harness.step();
    let commands = &lab.harness.output().viewport_output[&egui::ViewportId::ROOT].commands;
    assert!(commands.contains(&egui::ViewportCommand::CancelClose));
}

#[test]
fn the_screen_is_covered_for_a_session_unless_told_otherwise() {
    for windowed in [false, true] {
        let study = Tiny::new(1, SIZE_PX);
        let mut lab = Lab::open(&study, windowed);
        lab.type_id("P01");
        lab.harness.get_by_label("Start session").click();
        let mut covered = false;
        for _ in 0..4 {
            lab.frame();
            let commands = &lab.harness.output().viewport_output[&egui::ViewportId::ROOT].commands;
            covered |= commands.contains(&egui::ViewportCommand::Fullscreen(true));
        }
        assert_eq!(covered, !windowed);
    }
}
