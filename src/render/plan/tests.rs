use glam::Vec3;

use super::*;
use crate::render::{Precision, technique::Settings};
use crate::scene::{Camera, Environment, Lighting, Sun};

fn request(technique: &str) -> FrameRequest {
    FrameRequest {
        width_px: 64,
        height_px: 32,
        supersampling: 1,
        camera: Camera {
            position_m: Vec3::Z,
            target_m: Vec3::ZERO,
            vertical_fov_rad: 1.0,
            near_m: 0.1,
            far_m: 10.0,
        },
        lighting: Lighting {
            ambient: Ambient::Constant(Vec3::ONE),
            background: Background::Colour(Vec3::ONE),
            sun: None,
            points: Vec::new(),
            model_lights: None,
            environment: None,
            exposure_ev: 0.0,
            tone_map: ToneMap::None,
        },
        occlusion: Settings::from_label(technique).unwrap(),
        blur_radius_px: 4,
        blur_plane_m: 0.05,
        precision: Precision::Full,
        seed: 1,
    }
}

fn high(technique: &str) -> FrameRequest {
    let mut request = request(technique);
    request.supersampling = 2;
    request.lighting.ambient = Ambient::Environment;
    request.lighting.background = Background::Environment;
    request.lighting.environment = Some(Environment {
        axes: [Vec3::ONE; 6],
    });
    request.lighting.tone_map = ToneMap::Aces;
    request.lighting.sun = Some(Sun {
        towards: Vec3::Y,
        irradiance: Vec3::ONE,
        casts_shadows: true,
    });
    request
}

const FACTS: GeometryFacts = GeometryFacts {
    triangles: 12,
    has_normal_maps: true,
};

fn kinds(request: &FrameRequest) -> Vec<PassKind> {
    FramePlan::new(request, FACTS)
        .passes
        .iter()
        .map(|pass| pass.kind)
        .collect()
}

#[test]
fn none_in_constant_light_is_three_passes_without_normals() {
    let plan = FramePlan::new(&request("none"), FACTS);
    use PassKind::{Geometry, Lighting, Output};
    assert_eq!(kinds(&request("none")), [Geometry, Lighting, Output]);
    assert!(!plan.reads_normals);
    for effect in [
        "occlusion",
        "shadow map",
        "normals target",
        "normal mapping",
        "tone map",
    ] {
        assert!(
            plan.left_out.iter().any(|left| left.effect == effect),
            "{effect}"
        );
    }
}

#[test]
fn a_technique_brings_its_pass_and_its_blur() {
    use PassKind::{BlurColumns, BlurRows, Geometry, Lighting, Occlusion, Output};
    let passes = [Geometry, Occlusion, BlurRows, BlurColumns, Lighting, Output];
    assert_eq!(kinds(&request("crytek24")), passes);
    let mut unblurred = request("crytek24");
    unblurred.blur_radius_px = 0;
    assert_eq!(kinds(&unblurred), [Geometry, Occlusion, Lighting, Output]);
}

#[test]
fn everything_asked_for_is_everything() {
    assert_eq!(kinds(&high("blizzard24")).len(), 8);
    assert!(
        FramePlan::new(&high("blizzard24"), FACTS)
            .left_out
            .is_empty()
    );
}

#[test]
fn a_sun_without_shadows_draws_no_shadow_map() {
    let mut request = high("none");
    request.lighting.sun.as_mut().unwrap().casts_shadows = false;
    assert!(!kinds(&request).contains(&PassKind::ShadowMap));
}

/// Everything read was written before it is read.
#[test]
fn passes_run_after_what_they_read() {
    for request in [
        request("none"),
        request("blizzard8"),
        high("none"),
        high("ray-march30"),
    ] {
        let plan = FramePlan::new(&request, FACTS);
        let mut written = vec!["triangles", "textures"];
        if !plan.has(PassKind::OcclusionGeometry) {
            // At one sample a pixel the occlusion reads the shaded targets themselves.
            written.extend(["occlusion depth", "occlusion normals"]);
        }
        for pass in &plan.passes {
            for input in &pass.reads {
                assert!(
                    written.contains(input),
                    "{} reads {input}",
                    pass.kind.name()
                );
            }
            written.extend(&pass.writes);
        }
    }
}

#[test]
fn the_text_names_each_pass_and_each_effect_left_out() {
    let plan = FramePlan::new(&request("none"), FACTS);
    let text = plan.to_string();
    for pass in &plan.passes {
        assert!(text.contains(pass.kind.name()));
    }
    for left_out in &plan.left_out {
        assert!(text.contains(&left_out.because));
    }
}
