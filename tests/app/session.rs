//! A participant's session in the window, by the texts a person reads: every
//! screen, the rows, and what goes wrong.

use std::time::Duration;

use crate::desk::{Desk, SECOND_NS, SIZE_PX, WINDOW, assert_picture};
use crate::support::Tiny;
use eframe::egui::{self, Key, Modifiers, Vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use greyfield::protocol::Position;
use greyfield::record::{InputDevice, OnsetMethod};
use greyfield::session::Screen;

#[test]
fn a_person_reads_and_clicks_through_a_whole_session() {
    let mut desk = Desk::new(3);
    let plan = desk.study.plan(0);
    desk.harness.get_by_label("You will see pairs of images.");
    desk.click("Begin");
    let choices = [Position::First, Position::Second, Position::Second];
    for (trial, choice) in choices.into_iter().enumerate() {
        desk.look_at_pair(trial + 1);
        desk.harness
            .get_by_label("Which image looked more realistic?");
        desk.pass_time(SECOND_NS / 2);
        match (trial, choice) {
            (0, Position::First) => desk.click("The first image"),
            (1, _) => desk.press(Key::Num2),
            _ => desk.click("The second image"),
        }
    }
    desk.harness
        .get_by_label("That was the last pair. Thank you!");

    let rows = desk.rows.borrow();
    assert_eq!(rows.len(), 3);
    for (trial, row) in rows.iter().enumerate() {
        let [first, second] = desk.study.shown(&plan, trial);
        assert_eq!(row.first_image_sha256, first.sha256);
        assert_eq!(row.second_image_sha256, second.sha256);
        assert_eq!(row.response, Some(choices[trial].into()));
        let grey_ns = row.grey_offset_ns.zip(row.grey_onset_ns);
        let grey_ns = grey_ns.map(|(off, on)| off - on);
        assert_eq!(grey_ns, Some(2 * SECOND_NS), "the grey stood its time");
        assert_eq!(row.response_time_ms, Some(500.0));
    }
    let devices: Vec<InputDevice> = rows.iter().map(|row| row.input_device).collect();
    use InputDevice::{Keyboard, Mouse};
    assert_eq!(devices, [Mouse, Keyboard, Mouse]);
}

#[test]
fn only_the_next_pair_can_be_started_and_the_done_ones_are_ticked() {
    let mut desk = Desk::new(3);
    desk.click("Begin");
    desk.look_at_pair(1);
    desk.press(Key::Num1);
    for (text, ticked) in [("Pair 1", true), ("Pair 3", false)] {
        let button = desk.harness.get_by_label(text).accesskit_node();
        assert!(button.is_disabled());
        assert_eq!(button.toggled(), Some(ticked.into()), "{text}");
        desk.click(text);
        assert_eq!(desk.screen(), Screen::PairMenu { next: 1, total: 3 });
    }
    assert!(
        !desk
            .harness
            .get_by_label("Pair 2")
            .accesskit_node()
            .is_disabled()
    );
}

#[test]
fn an_image_screen_holds_the_files_own_pixels_on_grey_and_no_pointer() {
    let mut desk = Desk::new(1);
    let plan = desk.study.plan(0);
    desk.click("Begin");
    desk.click("Pair 1");
    let images = desk
        .study
        .shown(&plan, 0)
        .map(|image| desk.study.rgba8(image));
    for (expected, position) in images.iter().zip([Position::First, Position::Second]) {
        assert_eq!(
            desk.screen(),
            Screen::Image {
                trial: 0,
                place: position.place()
            }
        );
        assert_eq!(
            desk.harness.output().platform_output.cursor_icon,
            egui::CursorIcon::None
        );
        let screen = desk.harness.render().expect("rendered");
        assert_picture(&screen, expected);
        if position == Position::First {
            desk.press(Key::Space);
            let grey = desk.harness.render().expect("rendered");
            assert!(grey.pixels().all(|pixel| pixel.0 == [128, 128, 128, 255]));
            desk.pass_time(2 * SECOND_NS);
            desk.frame();
            desk.frame();
        }
    }
}

#[test]
fn a_held_space_bar_ends_one_image_and_not_the_next() {
    let mut desk = Desk::new(1);
    desk.click("Begin");
    desk.click("Pair 1");
    desk.harness.key_down(Key::Space);
    desk.frame();
    assert_eq!(desk.screen(), Screen::Grey { trial: 0 });
    // The keyboard repeats the key that is still held, through the grey and on.
    for _ in 0..10 {
        desk.harness.key_down(Key::Space);
        desk.frame();
        desk.pass_time(SECOND_NS / 2);
    }
    let second = Screen::Image { trial: 0, place: 1 };
    assert_eq!(desk.screen(), second);
    desk.harness.key_up(Key::Space);
    desk.frame();
    assert_eq!(desk.screen(), second);
    desk.press(Key::Space);
    assert_eq!(desk.screen(), Screen::Question { trial: 0 });
}

#[test]
fn the_grey_cannot_be_skipped_and_wakes_by_itself() {
    let mut desk = Desk::new(1);
    desk.click("Begin");
    desk.click("Pair 1");
    desk.press(Key::Space);
    for key in [Key::Space, Key::Enter, Key::Escape, Key::Num1] {
        desk.press(key);
        assert_eq!(desk.screen(), Screen::Grey { trial: 0 });
    }
    desk.pass_time(2 * SECOND_NS - 1);
    desk.frame();
    assert_eq!(desk.screen(), Screen::Grey { trial: 0 });
    desk.pass_time(1);
    desk.frame();
    assert!(matches!(desk.screen(), Screen::Image { .. }));
}

#[test]
fn frames_follow_each_other_while_a_picture_stands_and_pages_rest() {
    let mut desk = Desk::new(1);
    assert_at_rest(&mut desk);
    desk.click("Begin");
    assert_at_rest(&mut desk);
    desk.click("Pair 1");
    assert_moving(&mut desk);
    desk.press(Key::Space);
    assert_eq!(desk.screen(), Screen::Grey { trial: 0 });
    assert_moving(&mut desk);
    desk.pass_time(2 * SECOND_NS);
    desk.frame();
    assert_moving(&mut desk);
    desk.press(Key::Space);
    assert_at_rest(&mut desk);
}

/// After every frame the next one is asked for.
fn assert_moving(desk: &mut Desk) {
    for _ in 0..5 {
        desk.frame();
        assert!(desk.harness.ctx.has_requested_repaint());
    }
}

/// No further frame is asked for, once buttons have faded and images are decoded.
fn assert_at_rest(desk: &mut Desk) {
    let rests = (0..200).any(|_| {
        std::thread::sleep(Duration::from_millis(10));
        desk.frame();
        !desk.harness.ctx.has_requested_repaint()
    });
    assert!(rests, "{:?}", desk.screen());
}

const PERIOD_NS: u64 = 16_666_667;

/// One trial at 60 frames a second, of which the frames numbered in `late` come 1.6
/// periods after the one before.
fn frames_missed(late: &[u32]) -> Option<u32> {
    let period = Duration::from_nanos(PERIOD_NS);
    let mut desk = Desk::on_display(Tiny::new(1, SIZE_PX), Some(period));
    desk.click("Begin");
    desk.click("Pair 1");
    for frame in 0..180 {
        desk.pass_time(if late.contains(&frame) {
            PERIOD_NS * 16 / 10
        } else {
            PERIOD_NS
        });
        if frame == 20 || frame == 170 {
            desk.harness.key_press(Key::Space);
        }
        desk.frame();
    }
    assert_eq!(desk.screen(), Screen::Question { trial: 0 });
    // A page of text: nothing is drawn meanwhile, and nothing is missed.
    desk.pass_time(20 * SECOND_NS);
    desk.press(Key::Num1);
    let rows = desk.rows.take();
    rows[0].missed_frames
}

#[test]
fn every_late_frame_of_a_trial_is_on_record_and_no_other() {
    assert_eq!(frames_missed(&[]), Some(0));
    // In the first image, its change to grey, the grey, its end, the last change.
    for late in [10, 20, 60, 140, 150, 170] {
        assert_eq!(frames_missed(&[late]), Some(1), "{late}");
    }
    assert_eq!(frames_missed(&[5, 30, 31, 160]), Some(4));
    // On the page after: no frame is due.
    assert_eq!(frames_missed(&[175]), Some(0));
}

#[test]
fn onsets_that_the_display_system_tells_are_on_record_as_such() {
    let mut desk = Desk::new(2);
    desk.click("Begin");
    desk.told_after_ns = Some(1_000_000);
    desk.look_at_pair(1);
    desk.press(Key::Num1);
    desk.told_after_ns = None;
    desk.look_at_pair(2);
    desk.press(Key::Num1);
    let rows = desk.rows.borrow();
    let methods: Vec<OnsetMethod> = rows.iter().map(|row| row.onset_method).collect();
    assert_eq!(
        methods,
        [OnsetMethod::PresentFeedback, OnsetMethod::PresentCall]
    );
    let told_ms = rows[0].onset_uncertainty_ms.expect("a refresh");
    assert!((told_ms - 16.67).abs() < 0.01, "{told_ms}");
    assert!(rows[0].first_onset_ns < rows[0].grey_onset_ns);
}

#[test]
fn where_the_period_is_unknown_nobody_counts() {
    let mut desk = Desk::new(1);
    desk.click("Begin");
    desk.look_at_pair(1);
    desk.press(Key::Num1);
    assert_eq!(desk.rows.borrow()[0].missed_frames, None);
}

#[test]
fn a_full_disk_is_calm_for_the_participant_and_precise_for_the_experimenter() {
    let mut desk = Desk::new(2);
    desk.click("Begin");
    desk.look_at_pair(1);
    *desk.disk_error.borrow_mut() = Some(String::from("data/x.csv: cannot append: disk full"));
    desk.press(Key::Num1);
    desk.harness.get_by_label("Please call the experimenter.");
    assert!(
        desk.harness.query_by_label_contains("disk full").is_none(),
        "the detail is folded away"
    );
    desk.click("For the experimenter");
    desk.harness.get_by_label_contains("disk full");
    desk.click("Try again");
    assert!(desk.rows.borrow().is_empty());
    assert!(matches!(desk.screen(), Screen::StorageTrouble { .. }));

    *desk.disk_error.borrow_mut() = None;
    desk.click("Try again");
    assert_eq!(desk.rows.borrow().len(), 1);
    assert_eq!(desk.screen(), Screen::PairMenu { next: 1, total: 2 });
}

#[test]
fn a_changed_image_stops_the_trial_until_it_is_mended() {
    let study = Tiny::new(1, SIZE_PX);
    let image = study.shown(&study.plan(0), 0)[1].clone();
    let file = study.path("stimuli").join(&image.file);
    let good = std::fs::read(&file).expect("the image");
    std::fs::write(&file, &good[..good.len() / 2]).expect("the image is cut short");
    let mut desk = Desk::of(study);
    desk.click("Begin");
    desk.click("Pair 1");
    desk.click("For the experimenter");
    desk.harness.get_by_label_contains("damaged");
    std::fs::write(&file, &good).expect("the image is restored");
    desk.click("Try again");
    let screen = desk.harness.render().expect("rendered");
    let plan = desk.study.plan(0);
    assert_picture(&screen, &desk.study.rgba8(desk.study.shown(&plan, 0)[0]));
}

#[test]
fn a_window_smaller_than_the_image_shows_no_image_and_records_no_onset() {
    let mut desk = Desk::new(1);
    desk.click("Begin");
    desk.harness
        .set_size(Vec2::new(SIZE_PX[0] as f32 - 1.0, 600.0));
    desk.frame();
    desk.click("Pair 1");
    desk.harness.get_by_label("Please call the experimenter.");
    desk.press(Key::Space);
    assert!(
        matches!(desk.screen(), Screen::Image { .. }),
        "what was not shown cannot be left"
    );
    desk.harness.set_size(WINDOW);
    desk.frame();
    desk.frame();
    desk.press(Key::Space);
    assert_eq!(desk.screen(), Screen::Grey { trial: 0 });
}

#[test]
fn the_abort_chord_must_be_held() {
    let mut desk = Desk::new(1);
    desk.click("Begin");
    desk.click("Pair 1");
    let chord = Modifiers::CTRL | Modifiers::SHIFT;
    desk.harness.event(egui::Event::ModifiersChanged(chord));
    desk.harness.event(egui::Event::Key {
        key: Key::Q,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: chord,
    });
    desk.frame();
    let commands = &desk.harness.output().viewport_output[&egui::ViewportId::ROOT].commands;
    assert!(
        !commands.contains(&egui::ViewportCommand::Close),
        "the chord must not close the window"
    );
    desk.pass_time(SECOND_NS - 1);
    desk.frame();
    assert!(matches!(desk.screen(), Screen::Image { .. }), "not yet");
    desk.pass_time(1);
    desk.frame();
    desk.frame();
    assert_eq!(desk.screen(), Screen::Aborted);
    desk.harness.get_by_label("The session has ended.");
}

#[test]
fn focus_lost_during_an_image_is_on_record() {
    let mut desk = Desk::new(1);
    desk.click("Begin");
    desk.click("Pair 1");
    for focused in [false, true] {
        desk.harness.event(egui::Event::WindowFocused(focused));
        desk.frame();
    }
    desk.press(Key::Space);
    desk.pass_time(2 * SECOND_NS);
    desk.frame();
    desk.frame();
    desk.press(Key::Space);
    desk.press(Key::Num1);
    assert_eq!(desk.rows.borrow()[0].focus_lost, 1);
}
