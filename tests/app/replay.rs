//! A recorded session on the screen again: the participant's pictures pixel for pixel, and the
//! experimenter's keys.

use crate::recorded;
use std::cell::Cell;
use std::rc::Rc;

use crate::desk::{SIZE_PX, WINDOW, assert_picture};
use crate::support::Tiny;
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use greyfield::app::clock::Clock;
use greyfield::app::replay::Replaying;
use greyfield::app::theme;
use greyfield::record::{Response, TrialRow};
use greyfield::session::replay::Replay;

struct Viewing {
    harness: Harness<'static, Replaying>,
    clock_ns: Rc<Cell<u64>>,
    rows: Vec<TrialRow>,
    study: Tiny,
}

/// A scripted observer reads no pages; a person takes this long over each.
const PAGE_NS: u64 = 3_000_000_000;

fn later(row: &mut TrialRow, by_ns: u64) {
    for time in [
        &mut row.first_onset_ns,
        &mut row.first_offset_ns,
        &mut row.grey_onset_ns,
        &mut row.grey_offset_ns,
        &mut row.second_onset_ns,
        &mut row.second_offset_ns,
        &mut row.question_onset_ns,
        &mut row.response_ns,
    ] {
        *time = time.map(|ns| ns + by_ns);
    }
}

impl Viewing {
    fn of(study: Tiny) -> Self {
        let mut rows = recorded::rows(&study, "random:4");
        for (row, pages) in rows.iter_mut().zip(1..) {
            later(row, pages * PAGE_NS);
        }
        let protocol = study.protocol();
        let replay = Replay::new(&rows, &protocol, &study.manifest).expect("a replay");
        let clock_ns = Rc::new(Cell::new(0));
        let clock = Clock::Manual(Rc::clone(&clock_ns));
        let replaying = Replaying::new(replay, protocol, study.path("stimuli"), clock);
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
            .build_ui_state(|ui, replaying: &mut Replaying| replaying.ui(ui), replaying);
        let mut viewing = Self {
            harness,
            clock_ns,
            rows,
            study,
        };
        viewing.harness.step();
        viewing
    }

    fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.harness.step();
        self.harness.step();
    }

    fn at_ns(&self) -> u64 {
        self.harness.state().at_ns()
    }

    fn pass_time(&mut self, ns: u64) {
        self.clock_ns.set(self.clock_ns.get() + ns);
        self.harness.step();
    }

    fn screen(&mut self) -> image::RgbaImage {
        self.harness.render().expect("a software adapter renders")
    }

    fn says(&self, part: &str) -> bool {
        self.harness.query_by_label_contains(part).is_some()
    }
}

/// With the bar hidden, every change by its key: at the row's own times, the images' own bytes.
#[test]
fn it_shows_the_participants_pictures_at_the_times_on_record() {
    let mut viewing = Viewing::of(Tiny::new(2, SIZE_PX));
    viewing.press(Key::H);
    let plan = viewing.study.plan(0);
    for trial in 0..2 {
        let row = viewing.rows[trial].clone();
        let files = viewing.study.shown(&plan, trial);
        let [first, second] = files.map(|image| viewing.study.rgba8(image));
        viewing.press(Key::ArrowRight);
        assert_eq!(Some(viewing.at_ns()), row.first_onset_ns);
        assert_picture(&viewing.screen(), &first);
        viewing.press(Key::ArrowRight);
        assert_eq!(Some(viewing.at_ns()), row.grey_onset_ns);
        let grey = image::Rgba([128, 128, 128, 255]);
        assert!(viewing.screen().pixels().all(|pixel| *pixel == grey));
        viewing.press(Key::ArrowRight);
        assert_eq!(Some(viewing.at_ns()), row.second_onset_ns);
        assert_picture(&viewing.screen(), &second);
        viewing.press(Key::ArrowRight);
        assert_eq!(Some(viewing.at_ns()), row.question_onset_ns);
        assert!(viewing.says("Which image looked more realistic?"));
        viewing.press(Key::ArrowRight);
        assert_eq!(Some(viewing.at_ns()), row.response_ns);
        assert!(!viewing.says("answer after"), "the bar is hidden");
        viewing.press(Key::H);
        let answer = match row.response {
            Some(Response::First) => "s: The first image",
            _ => "s: The second image",
        };
        assert!(viewing.says(answer));
        assert!(viewing.says(&format!("Trial {} of 2", trial + 1)));
        viewing.press(Key::H);
        viewing.press(Key::ArrowRight);
    }
    assert!(
        viewing
            .screen()
            .pixels()
            .all(|pixel| pixel.0 == [128, 128, 128, 255])
    );
    // Backwards to the first image of the last trial.
    for _ in 0..5 {
        viewing.press(Key::ArrowLeft);
    }
    let first = viewing.study.rgba8(viewing.study.shown(&plan, 1)[0]);
    assert_picture(&viewing.screen(), &first);
}

#[test]
fn it_plays_at_its_speeds_and_stands_at_the_end() {
    let mut viewing = Viewing::of(Tiny::new(1, SIZE_PX));
    viewing.pass_time(5_000_000_000);
    assert_eq!(viewing.at_ns(), 0, "it does not start by itself");
    viewing.press(Key::Space);
    viewing.pass_time(1_000_000_000);
    assert_eq!(viewing.at_ns(), 1_000_000_000);
    viewing.press(Key::ArrowUp);
    viewing.pass_time(1_000_000);
    assert_eq!(viewing.at_ns(), 1_004_000_000);
    viewing.press(Key::ArrowUp);
    viewing.press(Key::ArrowUp);
    viewing.pass_time(1_000_000);
    assert_eq!(viewing.at_ns(), 1_020_000_000, "×16 is the fastest");
    viewing.press(Key::Space);
    viewing.pass_time(1_000_000_000);
    assert_eq!(viewing.at_ns(), 1_020_000_000, "it pauses");
    let duration_ns = viewing.harness.state().replay().duration_ns();
    viewing.press(Key::Space);
    viewing.pass_time(duration_ns);
    assert_eq!(viewing.at_ns(), duration_ns);
    assert!(viewing.says("Play"), "it stands");
    viewing.press(Key::Home);
    assert_eq!(viewing.at_ns(), 0);
}

#[test]
fn shift_goes_by_frames_and_buttons_do_what_keys_do() {
    let mut viewing = Viewing::of(Tiny::new(1, SIZE_PX));
    viewing.press(Key::End);
    let end_ns = viewing.at_ns();
    viewing
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::ArrowLeft);
    viewing.harness.step();
    viewing.harness.step();
    assert_eq!(
        end_ns - viewing.at_ns(),
        16_666_666,
        "a frame of a usual display"
    );
    viewing.press(Key::Home);
    for button in ["×4", "Play"] {
        viewing.harness.get_by_label(button).click();
        viewing.harness.step();
        viewing.harness.step();
    }
    viewing.pass_time(1_000_000);
    assert_eq!(viewing.at_ns(), 4_000_000);
    // The space bar pauses, and does not press the button that was clicked last.
    viewing.press(Key::Space);
    viewing.pass_time(1_000_000);
    assert_eq!(viewing.at_ns(), 4_000_000);
}

#[test]
fn an_image_that_is_not_the_one_shown_is_not_shown() {
    let study = Tiny::new(1, SIZE_PX);
    for image in study.manifest.images() {
        let other = image::RgbImage::new(SIZE_PX[0], SIZE_PX[1]);
        let path = study.path("stimuli").join(&image.file);
        other.save(path).expect("another image in its place");
    }
    let mut viewing = Viewing::of(study);
    viewing.press(Key::ArrowRight);
    assert!(viewing.says("cannot be shown as the participant saw it"));
    assert!(viewing.says("has changed since it was made"));
}

/// The study with the text of another protocol, without what it says of its own images.
fn under(pairs: usize, protocol: &str) -> Tiny {
    let study = Tiny::new(pairs, SIZE_PX);
    let text = protocol.replace("[practice]\nconditions = [\"shapes-white\"]", "");
    std::fs::write(study.path("tiny.toml"), text).expect("the protocol is written");
    study
}

/// Both versions at once and whole, first without numbers, then with those that were given.
#[test]
fn a_ranking_shows_all_its_images_and_then_their_order() {
    let protocol = include_str!("../../protocols/yu-2009-ranking.toml");
    let mut viewing = Viewing::of(under(1, protocol));
    viewing.press(Key::ArrowRight);
    assert_eq!(Some(viewing.at_ns()), viewing.rows[0].question_onset_ns);
    let screen = viewing.screen();
    let shown: Vec<_> = viewing.study.manifest.images().collect();
    assert_eq!(shown.len(), 2);
    for image in shown {
        let picture = viewing.study.rgba8(image);
        let row = 4 * SIZE_PX[0] as usize;
        let is_at = |x: u32, y: u32| {
            (0..SIZE_PX[1]).all(|line| {
                let from = 4 * ((y + line) * screen.width() + x) as usize;
                let expected = &picture[line as usize * row..][..row];
                &screen.as_raw()[from..][..row] == expected
            })
        };
        let (width, height) = (screen.width() - SIZE_PX[0], screen.height() - SIZE_PX[1]);
        let found = (0..height).any(|y| (0..width).any(|x| is_at(x, y)));
        assert!(found, "{}", image.technique);
    }
    assert!(viewing.says("1: –") && viewing.says("2: –"));
    viewing.press(Key::ArrowRight);
    let row = &viewing.rows[0];
    let is_as_shown = row.ranking == format!("{};{}", row.technique_first, row.technique_second);
    let numbers = if is_as_shown {
        ["1: 1", "2: 2"]
    } else {
        ["1: 2", "2: 1"]
    };
    assert!(
        numbers.iter().all(|number| viewing.says(number)),
        "{numbers:?}"
    );
}

#[test]
fn a_rating_shows_the_image_and_then_the_scales_with_their_points() {
    let protocol = include_str!("../../protocols/kozlowski-kautz-2007.toml");
    let mut viewing = Viewing::of(under(1, protocol));
    viewing.press(Key::H);
    viewing.press(Key::ArrowRight);
    assert_eq!(Some(viewing.at_ns()), viewing.rows[0].grey_onset_ns);
    viewing.press(Key::ArrowRight);
    let hash = viewing.rows[0].first_image_sha256.clone();
    let pair = &viewing.study.manifest.pairs[0];
    let image = [&pair.first, &pair.second]
        .into_iter()
        .find(|image| image.sha256 == hash)
        .expect("the image");
    let picture = viewing.study.rgba8(image);
    assert_picture(&viewing.screen(), &picture);
    viewing.press(Key::ArrowRight);
    assert!(viewing.says("How realistic did it look?"));
    let open = viewing.screen();
    viewing.press(Key::ArrowRight);
    assert_ne!(viewing.screen(), open, "the points are marked");
    viewing.press(Key::H);
    assert!(viewing.says(&viewing.rows[0].ratings.clone()));
}
