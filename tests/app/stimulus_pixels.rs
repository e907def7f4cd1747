//! A stimulus on the screen is the file's own pixels, bit for bit, at every
//! scale factor; grey is the level the protocol asks for.

use eframe::egui::{self, Vec2};
use egui_kittest::Harness;
use greyfield::app::stimulus_view::{self, TooSmall};
use greyfield::seed;
use greyfield::stimulus::manifest::Picture;
use image::RgbaImage;

const GREY: u8 = 128;

/// A picture in which any shift, blend or change of level shows: every pixel random.
fn noise(width_px: u32, height_px: u32) -> Picture {
    let mut rng = seed::generator(7, "test-noise", 0);
    let rgba8 = (0..width_px * height_px)
        .flat_map(|_| {
            let mut level = || seed::below(&mut rng, 256) as u8;
            [level(), level(), level(), 255]
        })
        .collect();
    Picture {
        width_px,
        height_px,
        rgba8,
    }
}

/// Renders what the view draws on a surface of the given physical size.
fn render(picture: Picture, surface_px: [u32; 2], scale: f32) -> (RgbaImage, Result<(), TooSmall>) {
    let size = Vec2::new(surface_px[0] as f32, surface_px[1] as f32) / scale;
    let mut harness = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(scale)
        .with_render_cursor(false)
        // As the application's own window has it: no dithering, the real sampler.
        .with_render_options(eframe::egui_wgpu::RendererOptions {
            dithering: false,
            predictable_texture_filtering: false,
            ..Default::default()
        })
        .wgpu()
        .build_ui_state(
            move |ui: &mut egui::Ui, state: &mut (Option<_>, Result<(), TooSmall>)| {
                let texture = state
                    .0
                    .get_or_insert_with(|| stimulus_view::upload(ui.ctx(), "test", &picture));
                state.1 = stimulus_view::paint_picture(ui.ctx(), texture, GREY);
            },
            (None, Ok(())),
        );
    harness.run();
    let image = harness.render().expect("a software adapter renders");
    (image, harness.state().1)
}

#[test]
fn every_pixel_of_the_picture_arrives_unchanged_at_every_scale() {
    for scale in [1.0, 1.25, 1.5, 1.75, 2.0] {
        for (surface_px, picture_px) in [
            ([400, 300], [320, 180]),
            ([401, 303], [320, 180]),
            ([320, 180], [320, 180]),
        ] {
            let picture = noise(picture_px[0], picture_px[1]);
            let expected = picture.rgba8.clone();
            let (image, drawn) = render(picture, surface_px, scale);
            assert_eq!(drawn, Ok(()));
            assert_eq!(image.dimensions(), (surface_px[0], surface_px[1]));
            let corner = stimulus_view::centred_px(surface_px, picture_px).expect("fits");
            for (x, y, pixel) in image.enumerate_pixels() {
                let inside = (corner[0]..corner[0] + picture_px[0]).contains(&x)
                    && (corner[1]..corner[1] + picture_px[1]).contains(&y);
                let want = if inside {
                    let at = 4 * ((y - corner[1]) * picture_px[0] + x - corner[0]) as usize;
                    [expected[at], expected[at + 1], expected[at + 2], 255]
                } else {
                    [GREY, GREY, GREY, 255]
                };
                assert_eq!(
                    pixel.0, want,
                    "pixel ({x}, {y}) at scale {scale}, surface {surface_px:?}"
                );
            }
        }
    }
}

#[test]
fn a_surface_too_small_shows_grey_and_says_so() {
    let (image, drawn) = render(noise(320, 180), [319, 400], 1.0);
    let error = drawn.expect_err("one column is missing").to_string();
    assert!(
        error.contains("320×180") && error.contains("319×400"),
        "{error}"
    );
    assert!(image.pixels().all(|p| p.0 == [GREY, GREY, GREY, 255]));
}
