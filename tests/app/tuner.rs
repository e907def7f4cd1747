//! The cost panel on a small scene: what is measured arrives, follows the controls, can be pinned,
//! and becomes a stimulus pair that draws the same.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Key, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use greyfield::app::theme;
use greyfield::app::tuner::{Look, Shown, Slot, Tuner, Tuning, Wishes};
use greyfield::render::{Gpu, Renderer};
use greyfield::scene::SceneConfig;
use greyfield::stimulus::StimulusSet;

use crate::wall::{SCENE, Wall};

/// The wall in two lights.
const MORE: &str = r#"
[occlusion]
blur_radius_px = 2

[technique.gtao]
radius_m = 1

[lighting.dim]
ambient = { constant = [0.4, 0.4, 0.4] }
background = { colour = [1, 1, 1] }
"#;

fn scene() -> String {
    format!("{SCENE}{MORE}")
}

const SIZE_PX: (u32, u32) = (64, 36);

struct Tuned {
    harness: Harness<'static, Option<Tuner>>,
    wall: Wall,
}

impl Tuned {
    fn new() -> Self {
        Self::at(&scene())
    }

    fn at(scene: &str) -> Self {
        let wall = Wall::new(scene, &[]);
        let path = wall.path("wall.toml");
        let scene = SceneConfig::load(&path).expect("the scene parses");
        let wishes = Wishes {
            lighting: Some(String::from("low")),
            size_px: SIZE_PX,
            radius_m: None,
            adapter: None,
        };
        let tuning = Tuning::new(scene, wishes).expect("there is such a light");
        let harness = Harness::builder()
            .with_size(Vec2::new(1500.0, 1000.0))
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
                move |ui, tuner: &mut Option<Tuner>| {
                    tuner
                        .get_or_insert_with(|| Tuner::new(ui.ctx(), tuning.clone()))
                        .ui(ui);
                },
                None,
            );
        let mut tuned = Self { harness, wall };
        tuned.frames(2);
        tuned
    }

    /// Waits until everything that was asked for has come.
    #[track_caller]
    fn settle(&mut self) {
        let deadline = Instant::now() + Duration::from_secs(60);
        while self.tuner().is_measuring() {
            assert!(Instant::now() < deadline, "nothing is ever measured");
            std::thread::sleep(Duration::from_millis(5));
            self.frames(1);
        }
        self.frames(3);
    }

    fn frames(&mut self, count: usize) {
        for _ in 0..count {
            self.harness.step();
        }
    }

    fn tuner(&self) -> &Tuner {
        self.harness.state().as_ref().expect("it is open")
    }

    #[track_caller]
    fn shown(&self, slot: Slot) -> &Shown {
        self.tuner().shown(slot).expect("it was measured")
    }

    #[track_caller]
    fn click(&mut self, text: &str) {
        self.harness.get_by_label(text).click();
        self.frames(3);
    }

    /// Chooses an entry of a list of choices.
    #[track_caller]
    fn choose(&mut self, list: &str, entry: &str) {
        self.harness
            .get_by_role_and_label(Role::ComboBox, list)
            .click();
        self.frames(3);
        {
            let mut found = (self.harness.query_all_by_role(Role::Button))
                .filter(|node| node.accesskit_node().label().as_deref() == Some(entry));
            found.next_back().expect("the list has it").click();
        }
        self.frames(3);
        self.settle();
    }

    /// One step of a slider.
    #[track_caller]
    fn step(&mut self, slider: &str, key: Key) {
        self.harness
            .get_by_role_and_label(Role::Slider, slider)
            .focus();
        self.frames(2);
        self.harness.key_press(key);
        self.frames(3);
        self.settle();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.wall.path(name)
    }

    /// A and B: 18 samples and more at another light's sliders.
    fn pin_two(&mut self) {
        self.settle();
        self.click("Pin as A");
        self.step("Samples", Key::ArrowRight);
        self.click("Pin as B");
        self.settle();
    }
}

#[test]
fn the_scene_is_measured_and_the_sliders_are_followed() {
    let mut tuned = Tuned::new();
    tuned.settle();
    let first = tuned.shown(Slot::Now);
    let before = first.numbers.clone();
    assert_eq!(first.request.configuration.settings.label, "gtao-18");
    assert!(before.rmse > 0.0 && before.rmse < 0.5, "{before:?}");
    assert!(before.times.is_some() && before.ssim > 0.5, "{before:?}");
    let label = format!("Now: RMSE {:.4}", before.rmse);
    tuned.harness.get_by_label(&label);
    tuned.harness.get_by_label_contains("reach 1 m");

    tuned.step("Samples", Key::ArrowLeft);
    let fewer = tuned.shown(Slot::Now);
    assert_eq!(fewer.request.configuration.settings.label, "gtao-16");
    assert_ne!(fewer.numbers.rmse, before.rmse);
    let label = format!("Now: RMSE {:.4}", fewer.numbers.rmse);
    tuned.harness.get_by_label(&label);

    tuned.choose("Technique", "none");
    let none = tuned.shown(Slot::Now);
    assert!(none.numbers.times.is_none() && none.numbers.bias > 0.0);
    tuned.harness.get_by_label("Now: ms –");
}

#[test]
fn every_look_is_on_the_stage() {
    let mut tuned = Tuned::new();
    tuned.settle();
    let keys = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5];
    let mut seen = Vec::new();
    for (key, (look, name)) in keys.into_iter().zip(Look::ALL) {
        tuned.harness.key_press(key);
        tuned.frames(3);
        let picture = tuned.shown(Slot::Now).picture(look).clone();
        let screen = tuned.harness.render().expect("a software adapter renders");
        assert!(is_on(&screen, &picture.rgba8), "{name}");
        assert!(!seen.contains(&picture.rgba8), "{name}");
        seen.push(picture.rgba8);
    }
    tuned.harness.get_by_label_contains("100 %");
}

/// Whether the picture stands somewhere on the screen, every pixel of it.
fn is_on(screen: &image::RgbaImage, rgba8: &[u8]) -> bool {
    let (width, height) = SIZE_PX;
    let row = |y: u32| &rgba8[(4 * y * width) as usize..(4 * (y + 1) * width) as usize];
    let on_screen = |x: u32, y: u32| {
        let at = 4 * (y * screen.width() + x) as usize;
        &screen.as_raw()[at..at + 4 * width as usize]
    };
    (0..=screen.height() - height).any(|y| {
        (0..=screen.width() - width)
            .any(|x| (0..height).all(|line| on_screen(x, y + line) == row(line)))
    })
}

#[test]
fn pins_stay_while_the_sliders_move_and_become_a_pair() {
    let mut tuned = Tuned::new();
    tuned.pin_two();
    tuned.step("Samples", Key::ArrowRight);
    let labels = Slot::ALL.map(|slot| {
        let settings = &tuned.shown(slot).request.configuration.settings;
        settings.label.clone()
    });
    assert_eq!(labels[1..], ["gtao-18", "gtao-24"]);
    assert_ne!(labels[0], labels[2]);
    tuned.harness.get_by_label_contains("B : A: ms ");
    tuned.click("Split A | B");

    tuned.click("Make a stimulus pair");
    tuned.harness.get_by_label_contains("Written");
    let path = tuned.path("wall-tuned.toml");
    let set = StimulusSet::load(&path).expect("the set parses");
    let (_, pair) = set.rendered().next().expect("it has a pair");
    let pairs = [(Slot::A, &pair.first), (Slot::B, &pair.second)];
    let renderer = Renderer::new(Gpu::open(None).expect("an adapter"));
    let geometry = set.scenes[0].geometry.load().expect("the model");
    let surfaces = renderer.upload(&geometry).expect("it is small");
    for (slot, settings) in pairs {
        let shown = tuned.shown(slot);
        let pinned = &shown.request.configuration.settings;
        assert_eq!(settings.values(), pinned.values());
        let drawn = renderer.render(&surfaces, &set.request(pair, settings));
        let picture = drawn.expect("it is drawn").picture;
        assert!(picture == *shown.picture(Look::Image), "{slot:?}");
    }

    // A second time the file is there.
    let text = std::fs::read_to_string(&path).expect("it was written");
    tuned.click("Make a stimulus pair");
    tuned.harness.get_by_label_contains("there already");
    assert_eq!(std::fs::read_to_string(&path).expect("still"), text);
}

#[test]
fn a_pair_is_not_made_of_another_blur_than_the_scenes() {
    let mut tuned = Tuned::new();
    tuned.pin_two();
    tuned.step("Blur radius", Key::ArrowRight);
    tuned.click("Pin as B");
    tuned.settle();
    tuned.harness.get_by_label_contains("B is blurred by 3 px");
    tuned.click("Make a stimulus pair");
    assert!(!tuned.path("wall-tuned.toml").exists());
    tuned.click("Blur A and B by 2 px");
    tuned.settle();
    let configuration = &tuned.shown(Slot::B).request.configuration;
    assert_eq!(configuration.blur_radius_px, 2);
    tuned.click("Make a stimulus pair");
    assert!(tuned.path("wall-tuned.toml").exists());
}

#[test]
fn another_light_or_truth_measures_the_pins_again() {
    let mut tuned = Tuned::new();
    tuned.pin_two();
    let before = tuned.shown(Slot::A).picture(Look::Image).clone();
    tuned.choose("Lighting", "dim");
    for slot in Slot::ALL {
        assert_eq!(tuned.shown(slot).request.lighting, "dim");
    }
    assert!(before != *tuned.shown(Slot::A).picture(Look::Image));

    let before = tuned.shown(Slot::A).numbers.clone();
    tuned.step("Radius", Key::ArrowRight);
    let reach_m = tuned.shown(Slot::Now).request.reach_m;
    assert_eq!(reach_m, 1.0, "the truth stays");
    tuned.click("Trace the truth at this radius");
    tuned.settle();
    let after = tuned.shown(Slot::A);
    assert!(after.request.reach_m > 1.0);
    assert_ne!(after.numbers.rmse, before.rmse);
    tuned.click("Back to the scene's 1 m");
    tuned.settle();
    let back = tuned.shown(Slot::A).numbers.rmse;
    assert_eq!(back, before.rmse);
}

#[test]
fn a_scene_without_a_surface_in_view_is_said_in_place() {
    let away = scene().replace("target_m = [0, 0.5, 0]", "target_m = [0, 9, 9]");
    let mut tuned = Tuned::at(&away);
    let deadline = Instant::now() + Duration::from_secs(60);
    while tuned
        .harness
        .query_all_by_label_contains("sees no surface")
        .next()
        .is_none()
    {
        assert!(Instant::now() < deadline, "nothing is ever said");
        std::thread::sleep(Duration::from_millis(5));
        tuned.frames(1);
    }
}

#[test]
fn wrong_input_ends_before_there_is_a_window() {
    let wall = Wall::new(&scene(), &[("broken.toml", "title = ")]);
    let run = |file: &str, more: &[&str]| {
        let output = wall.run(&[&["tune", file], more].concat());
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{message}");
        message
    };
    assert!(run("broken.toml", &[]).contains("broken.toml"));
    assert!(run("wall.toml", &["--lighting", "dusk"]).contains("dim, low"));
    assert!(run("wall.toml", &["--radius", "0"]).contains("radius"));
    assert!(run("wall.toml", &["--size", "12"]).contains("1280x720"));
}
