//! A stimulus in a real window is the file's own pixels, bit for bit, at every
//! scale factor a desktop may ask for: read back from the X server's screen.
#![allow(clippy::expect_used)] // a test ends where something is missing

mod support;
#[path = "support/window.rs"]
mod window;
#[path = "support/xvfb.rs"]
mod xvfb;

use support::{PROTOCOL, Tiny};
use window::Window;

/// Odd, so that the middle lies between two pixels in any even window.
const SIZE_PX: [u32; 2] = [641, 363];

#[test]
fn every_pixel_of_a_picture_and_of_the_grey_arrives_at_every_scale() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: pictures in a real window ({missing})");
        return;
    }
    for (scale, screen_px) in [
        (1.0, [1400, 900]),
        (1.25, [1800, 1100]),
        (1.5, [2000, 1300]),
        (2.0, [2700, 1700]),
    ] {
        assert_pixels(scale, screen_px);
    }
}

fn assert_pixels(scale: f32, screen_px: [u32; 2]) {
    let study = Tiny::new(1, SIZE_PX);
    let long_grey = PROTOCOL.replace("duration_ms = 2000", "duration_ms = 3000");
    std::fs::write(study.path("tiny.toml"), long_grey).expect("the protocol");
    let plan = study.plan(0);
    let [first, second] = study.shown(&plan, 0).map(|image| study.rgba8(image));
    let window = Window::open_at(&study, scale, screen_px);
    // The start page's size in points: the factor is in force.
    let expected_px = [1280.0, 800.0].map(|points: f32| (points * scale).round() as u32);
    assert_eq!(window.size_px, expected_px, "at scale {scale}");
    window.enrol(&study);
    // Each waits until all pixels of the window are as they should be.
    window.start_pair(&first);
    window.key("space");
    window.wait_for_grey();
    window.wait_for_picture("the second image", &second);
}
