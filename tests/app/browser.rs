//! The stimulus browser over a real folder: the pixels it shows, in every look.

use std::time::{Duration, Instant};

use crate::support::Tiny;
use eframe::egui::{self, Event, Key, MouseWheelUnit, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use greyfield::app::browser::Browser;
use greyfield::app::theme;
use image::{Rgba, RgbaImage};

const SIZE_PX: [u32; 2] = [160, 90];

struct Looking {
    harness: Harness<'static, Option<Browser>>,
    study: Tiny,
}

impl Looking {
    fn at(study: Tiny) -> Self {
        let path = study.path("stimuli");
        let harness = Harness::builder()
            .with_size(Vec2::new(1100.0, 700.0))
            .with_theme(egui::Theme::Light)
            .with_context_setup(theme::install)
            .with_render_options(eframe::egui_wgpu::RendererOptions {
                dithering: false,
                predictable_texture_filtering: false,
                ..Default::default()
            })
            .with_render_cursor(false)
            .wgpu()
            .build_ui_state(
                move |ui, browser: &mut Option<Browser>| {
                    browser
                        .get_or_insert_with(|| Browser::open(ui.ctx(), &path))
                        .ui(ui);
                },
                None,
            );
        let mut looking = Self { harness, study };
        looking.settle();
        looking
    }

    /// Waits for the images, which are read beside the interface.
    fn settle(&mut self) {
        let deadline = Instant::now() + Duration::from_secs(20);
        loop {
            self.frames(2);
            if self.harness.query_by_label_contains("Reading").is_none() {
                self.frames(2);
                return;
            }
            assert!(Instant::now() < deadline, "the images never arrive");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn frames(&mut self, count: usize) {
        for _ in 0..count {
            self.harness.step();
        }
    }

    fn press(&mut self, key: Key) {
        self.harness.key_press(key);
        self.frames(3);
    }

    fn click(&mut self, text: &str) {
        self.harness.get_by_label(text).click();
        self.frames(3);
    }

    fn screen(&mut self) -> RgbaImage {
        self.harness.render().expect("a software adapter renders")
    }

    /// The first or second image of a pair, from its file.
    fn image(&self, pair: usize, second: bool) -> RgbaImage {
        let pair = &self.study.manifest.pairs[pair];
        let record = if second { &pair.second } else { &pair.first };
        let bytes = self.study.rgba8(record);
        RgbaImage::from_raw(SIZE_PX[0], SIZE_PX[1], bytes).expect("of that size")
    }
}

/// Where a picture stands on the screen, every pixel of it.
fn find(screen: &RgbaImage, picture: &RgbaImage) -> Option<[u32; 2]> {
    let (width, height) = picture.dimensions();
    let is_at = |x: u32, y: u32| {
        picture
            .enumerate_pixels()
            .all(|(column, row, pixel)| screen.get_pixel(x + column, y + row) == pixel)
    };
    (0..=screen.height() - height)
        .flat_map(|y| (0..=screen.width() - width).map(move |x| [x, y]))
        .find(|&[x, y]| is_at(x, y))
}

#[test]
fn a_flip_shows_the_other_image_in_the_same_place() {
    let mut looking = Looking::at(Tiny::new(2, SIZE_PX));
    let [first, second] = [false, true].map(|second| looking.image(0, second));
    let place = find(&looking.screen(), &first).expect("the first image is on the screen");
    assert_eq!(find(&looking.screen(), &second), None);
    looking.press(Key::Space);
    assert_eq!(find(&looking.screen(), &second), Some(place));
    looking.click("Flip");
    assert_eq!(find(&looking.screen(), &first), Some(place));
    looking.press(Key::B);
    assert_eq!(find(&looking.screen(), &second), Some(place));

    // Another condition, at the same place, from the keyboard and from the list.
    looking.press(Key::ArrowDown);
    looking.settle();
    let next = looking.image(1, true);
    assert_eq!(find(&looking.screen(), &next), Some(place));
    looking.click("condition0");
    looking.settle();
    assert_eq!(find(&looking.screen(), &second), Some(place));
}

#[test]
fn split_shows_the_first_on_the_left_and_the_second_on_the_right() {
    let mut looking = Looking::at(Tiny::new(1, SIZE_PX));
    let [first, second] = [false, true].map(|second| looking.image(0, second));
    let [x, y] = find(&looking.screen(), &first).expect("on the screen");
    looking.press(Key::S);
    let screen = looking.screen();
    let middle = SIZE_PX[0] / 2;
    let (mut left, mut right) = (0, 0);
    for row in 0..SIZE_PX[1] {
        for column in 0..SIZE_PX[0] {
            let shown = screen.get_pixel(x + column, y + row);
            // The divider covers a pixel or two in the middle.
            if column < middle - 2 {
                assert_eq!(shown, first.get_pixel(column, row));
                left += 1;
            } else if column > middle + 2 {
                assert_eq!(shown, second.get_pixel(column, row));
                right += 1;
            }
        }
    }
    assert!(left > 6000 && right > 6000);
}

#[test]
fn the_difference_is_shown_amplified_with_its_numbers() {
    let mut looking = Looking::at(Tiny::new(1, SIZE_PX));
    let [first, second] = [false, true].map(|second| looking.image(0, second));
    for gain in [1_u32, 16] {
        looking.press(Key::D);
        looking.click(&format!("×{gain}"));
        let expected = RgbaImage::from_fn(SIZE_PX[0], SIZE_PX[1], |x, y| {
            let (a, b) = (first.get_pixel(x, y), second.get_pixel(x, y));
            let apart = |c: usize| (u32::from(a[c].abs_diff(b[c])) * gain).min(255) as u8;
            Rgba([apart(0), apart(1), apart(2), 255])
        });
        assert!(find(&looking.screen(), &expected).is_some(), "×{gain}");
    }
    looking.harness.get_by_label("RMSE");
}

#[test]
fn the_wheel_magnifies_at_the_pointer_and_the_line_names_its_pixel() {
    let mut looking = Looking::at(Tiny::new(1, SIZE_PX));
    let first = looking.image(0, false);
    let [x, y] = find(&looking.screen(), &first).expect("on the screen");
    let at = Pos2::new(x as f32 + 37.5, y as f32 + 21.5);
    looking.harness.event(Event::PointerMoved(at));
    looking.frames(3);
    looking.harness.get_by_label_contains("column 37, row 21");
    for _ in 0..6 {
        looking.harness.event(Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta: Vec2::new(0.0, 100.0),
            modifiers: egui::Modifiers::NONE,
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Unknown,
        });
        looking.frames(12);
    }
    // Still the same pixel, now many screen pixels large, each of its own colour.
    looking.harness.get_by_label_contains("column 37, row 21");
    let screen = looking.screen();
    let [x, y] = [at.x as u32, at.y as u32];
    for [x, y] in [[x, y], [x + 1, y], [x, y + 1]] {
        assert_eq!(screen.get_pixel(x, y), first.get_pixel(37, 21));
    }
    assert_eq!(find(&screen, &first), None, "it is magnified");
    looking.press(Key::Num0);
    assert!(find(&looking.screen(), &first).is_some(), "it fits again");
}

#[test]
fn provenance_and_passes_are_there_to_be_read() {
    let mut looking = Looking::at(Tiny::new(1, SIZE_PX));
    looking.click("Provenance");
    let hash = looking.study.manifest.pairs[0].second.sha256.clone();
    looking.harness.get_by_label(&hash);
    looking.click("Frame plan");
    looking
        .harness
        .get_by_label_contains("The set is not known");
    looking.click("Albedo");
    assert!(
        looking
            .harness
            .get_all_by_label_contains("The set is not known")
            .count()
            > 1
    );
}

#[test]
fn a_changed_image_is_said_in_its_place_and_the_others_still_show() {
    let study = Tiny::new(2, SIZE_PX);
    let image = &study.manifest.pairs[0].second;
    let path = study.path("stimuli").join(&image.file);
    let other = image::RgbImage::new(SIZE_PX[0], SIZE_PX[1]);
    other.save(&path).expect("another image in its place");
    let mut looking = Looking::at(study);
    looking
        .harness
        .get_by_label_contains("This pair cannot be shown");
    looking.press(Key::ArrowDown);
    looking.settle();
    let shown = looking.image(1, false);
    assert!(find(&looking.screen(), &shown).is_some());
}

#[test]
fn a_folder_without_images_is_said_in_place() {
    let study = Tiny::new(1, SIZE_PX);
    std::fs::remove_file(study.path("stimuli/manifest.json")).expect("it was there");
    let looking = Looking::at(study);
    looking.harness.get_by_label_contains("manifest.json");
}
