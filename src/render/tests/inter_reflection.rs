//! Light between surfaces: the models on the GPU beside themselves on the processor, and in a picture.

use std::sync::Arc;

use glam::Vec3;

use super::twins::{Source, on_gpu};
use super::*;
use crate::multi_bounce::{MODELS, Openness};
use crate::render::FloatImage;

/// The 8-bit grid of openness and albedo.
fn bytes() -> Vec<[f32; 4]> {
    (0..=255_u8)
        .flat_map(|alpha| {
            (0..=255_u8)
                .map(move |rho| [f32::from(alpha) / 255.0, f32::from(rho) / 255.0, 0.0, 0.0])
        })
        .collect()
}

fn pictured(given: Openness, model: &crate::multi_bounce::Model, inputs: &[[f32; 4]]) -> Vec<f32> {
    let source = Source {
        wgsl: model.wgsl_given(given).into(),
        params: String::new(),
    };
    let statements = "y.x = inter_reflected(x.x, x.y);";
    let found = on_gpu(&source, statements, &[], inputs);
    found.into_iter().map(|[value, ..]| value).collect()
}

/// Every safe model, from either openness: the GPU's numbers are the processor's.
#[test]
fn models_are_the_same_on_the_gpu() {
    let inputs = bytes();
    for model in MODELS.iter().filter(|model| model.is_safe) {
        for given in [Openness::Uniform, Openness::Cosine] {
            let found = pictured(given, model, &inputs);
            for ([alpha, rho, ..], found) in inputs.iter().zip(found) {
                let expected = model.value(given, (*alpha).into(), (*rho).into());
                assert!(
                    (f64::from(found) - expected).abs() < 2e-4 && (0.0..=1.0).contains(&found),
                    "{} {given:?} {alpha} {rho}: {found}, not {expected}",
                    model.name
                );
            }
        }
    }
}

/// As printed, the notes' formula is as broken on the GPU as it is on paper: it is for
/// comparison alone, and no picture can ask for it.
#[test]
fn the_published_form_breaks_on_the_gpu_too() {
    let published = MODELS
        .iter()
        .find(|model| model.name == "published")
        .unwrap();
    let inputs = bytes();
    let found = pictured(Openness::Uniform, published, &inputs);
    let sound = |value: &f32| (0.0..=1.05).contains(value);
    let broken = found.iter().filter(|value| !sound(value)).count();
    assert!(broken > 250, "{broken}");
    let mut settings = Settings::from_label("gtao").unwrap();
    let message = settings
        .set("inter_reflection", "published")
        .unwrap_err()
        .message;
    assert!(message.contains("published-safe"), "{message}");
}

/// The ambient term of a coloured surface is the model's, channel by channel: what is handed in is
/// cosine-weighted, and its direct light is kept.
#[test]
fn colours_take_light_from_their_own_kind() {
    let albedo = [0.9, 0.5, 0.1];
    let geometry = of_one_material(matte(albedo), vec![floor()]);
    let mut request = request("ray-traced");
    request.handed_occlusion = Some(Arc::new(FloatImage {
        width_px: 160,
        height_px: 120,
        values: vec![0.4; 160 * 120],
    }));
    let spot = pixel_of(&request, Vec3::new(0.3, 0.0, 1.0));
    for name in ["published-safe", "jimenez-2016", "greyfield"] {
        request.occlusion.set("inter_reflection", name).unwrap();
        let model = crate::multi_bounce::find(name).unwrap();
        let frame = draw(&geometry, &request);
        for (channel, rho) in albedo.into_iter().enumerate() {
            let received = model.value(Openness::Cosine, 0.4, f64::from(rho)) as f32;
            assert_level([rgb(&frame, spot)[channel]; 3], rho * received);
        }
    }
}

/// In the open there is nothing to reflect: the picture is the same, byte for byte.
#[test]
fn an_open_plane_is_left_alone() {
    let geometry = of_one_material(matte([0.8, 0.4, 0.2]), vec![floor()]);
    let mut request = request("ray-traced");
    request.handed_occlusion = Some(Arc::new(FloatImage {
        width_px: 160,
        height_px: 120,
        values: vec![1.0; 160 * 120],
    }));
    let off = draw(&geometry, &request).picture;
    for name in ["published-safe", "greyfield"] {
        request.occlusion.set("inter_reflection", name).unwrap();
        assert_eq!(draw(&geometry, &request).picture, off, "{name}");
    }
}

/// Only what estimates how open a point is can be asked for it.
#[test]
fn what_is_no_openness_is_refused() {
    for (label, takes) in [
        ("gtao", true),
        ("hbao", true),
        ("vbao", true),
        ("two-band", true),
        ("ray-traced", true),
        ("none", true),
        ("crytek", false),
        ("blizzard", false),
        ("ray-march", false),
        ("alchemy", false),
        ("ssdo", false),
    ] {
        let mut settings = Settings::from_label(label).unwrap();
        let taken = settings.take_inter_reflection("greyfield");
        assert_eq!(taken.is_ok(), takes, "{label}");
        if let Err(error) = taken {
            assert!(error.message.contains("hbao") && error.message.contains(label));
        }
        assert!(settings.take_inter_reflection("radiosity").is_err());
        assert!(settings.take_inter_reflection("none").is_ok());
    }
}
