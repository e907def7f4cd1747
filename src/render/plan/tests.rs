use super::*;
use crate::render::testing::{brightest, request};
use crate::scene::ModelLights;

const FACTS: GeometryFacts = GeometryFacts {
    triangles: 12,
    has_normal_maps: true,
    emits: true,
    has_baked_occlusion: true,
    uncovered: None,
    lights: ModelLights {
        suns: Vec::new(),
        points: Vec::new(),
    },
};

/// What most models are: no lamps, nothing baked, no normal maps.
const PLAIN: GeometryFacts = GeometryFacts {
    triangles: 12,
    has_normal_maps: false,
    emits: false,
    has_baked_occlusion: false,
    uncovered: None,
    lights: ModelLights {
        suns: Vec::new(),
        points: Vec::new(),
    },
};

fn kinds(request: &FrameRequest, facts: &GeometryFacts) -> Vec<PassKind> {
    let plan = FramePlan::new(request, facts);
    plan.passes.iter().map(|pass| pass.kind).collect()
}

fn reason(plan: &FramePlan, effect: &str) -> Option<String> {
    let left_out = plan.left_out.iter().find(|left| left.effect == effect);
    left_out.map(|left| left.because.clone())
}

#[test]
fn none_in_constant_light_is_two_passes_without_normals() {
    let plan = FramePlan::new(&request("none"), &PLAIN);
    use PassKind::{Geometry, Shade};
    assert_eq!(kinds(&request("none"), &PLAIN), [Geometry, Shade]);
    assert!(!plan.reads_normals && !plan.reads_emission);
    for effect in [
        "occlusion",
        "shadow map",
        "normals target",
        "normal mapping",
        "emission target",
        "direct light",
        "point lights",
        "reflections",
        "skybox",
        "radiance target",
        "tone map",
        "supersampling",
    ] {
        assert!(reason(&plan, effect).is_some(), "{effect}");
    }
}

#[test]
fn a_technique_brings_its_pass_and_its_blur() {
    use PassKind::{BlurColumns, BlurRows, Geometry, Occlusion, Shade};
    let passes = [Geometry, Occlusion, BlurRows, BlurColumns, Shade];
    assert_eq!(kinds(&request("crytek24"), &PLAIN), passes);
    let mut unblurred = request("crytek24");
    unblurred.blur_radius_px = 0;
    assert_eq!(kinds(&unblurred, &PLAIN), [Geometry, Occlusion, Shade]);
}

#[test]
fn everything_asked_for_is_everything_but_the_shortcut() {
    let mut request = brightest("blizzard24");
    request.baked_occlusion = true;
    request.occlusion.set("resolution", "half").unwrap();
    let plan = FramePlan::new(&request, &FACTS);
    assert_eq!(plan.passes.len(), 14);
    // A darkening is no openness that light between surfaces could be told from.
    let left_out: Vec<_> = plan.left_out.iter().map(|left| left.effect).collect();
    assert_eq!(left_out, ["light between surfaces"]);
}

/// All effects run whatever is asked for, and each says that nothing called for it.
#[test]
fn all_effects_are_all_of_them() {
    for technique in ["none", "crytek24"] {
        let mut plain = request(technique);
        plain.all_effects = true;
        let found = kinds(&plain, &PLAIN);
        assert_eq!(found, kinds(&brightest("blizzard24"), &FACTS));
        let plan = FramePlan::new(&plain, &PLAIN);
        let sun = plan.passes.iter().find(|pass| pass.kind == PassKind::Sun);
        assert!(sun.unwrap().because.contains("no directional light"));
    }
}

#[test]
fn a_sun_without_shadows_draws_no_shadow_map() {
    let mut request = brightest("none");
    request.lighting.sun.as_mut().unwrap().casts_shadows = false;
    let found = kinds(&request, &PLAIN);
    assert!(!found.contains(&PassKind::ShadowMap) && !found.contains(&PassKind::ShadowFilter));
    assert!(found.contains(&PassKind::Sun));
}

/// A sky is drawn where it can be seen, which the depth tells.
#[test]
fn a_covered_sky_is_left_out() {
    let sky = |uncovered| {
        let facts = GeometryFacts { uncovered, ..PLAIN };
        kinds(&brightest("none"), &facts).contains(&PassKind::Skybox)
    };
    assert!(sky(None) && sky(Some(true)) && !sky(Some(false)));
}

/// Nothing beside the constant ambient term may go through the shortcut.
#[test]
fn any_other_light_keeps_radiance() {
    let change: [fn(&mut FrameRequest); 6] = [
        |r| r.lighting.ambient = brightest("none").lighting.ambient,
        |r| r.lighting.background = brightest("none").lighting.background,
        |r| r.lighting.sun = brightest("none").lighting.sun,
        |r| r.lighting.points = brightest("none").lighting.points,
        |r| r.lighting.reflections = true,
        |r| r.lighting.tone_map = brightest("none").lighting.tone_map,
    ];
    for change in change {
        let mut request = request("none");
        change(&mut request);
        let found = kinds(&request, &PLAIN);
        assert!(found.contains(&PassKind::Ambient) && found.contains(&PassKind::Output));
    }
    assert!(kinds(&request("none"), &FACTS).contains(&PassKind::Emission));
}

#[test]
fn baked_occlusion_asks_for_the_emission_target_and_no_more() {
    let baked = GeometryFacts {
        has_baked_occlusion: true,
        ..PLAIN
    };
    let mut asking = request("none");
    asking.baked_occlusion = true;
    assert!(FramePlan::new(&asking, &baked).reads_emission);
    assert!(!FramePlan::new(&request("none"), &baked).reads_emission);
    assert_eq!(
        kinds(&asking, &baked),
        [PassKind::Geometry, PassKind::Shade]
    );
}

/// Everything read was written before it is read.
#[test]
fn passes_run_after_what_they_read() {
    let mut bent = brightest("gtao");
    bent.occlusion.set("bent_cone", "on").unwrap();
    for request in [
        bent,
        request("none"),
        request("blizzard8"),
        brightest("none"),
        brightest("ray-march30"),
        request("two-band"),
        request("ssdo"),
        brightest("ssdo"),
    ] {
        for facts in [PLAIN, FACTS] {
            let mut written = vec!["triangles", "textures", "proxies"];
            for pass in FramePlan::new(&request, &facts).passes {
                for input in &pass.reads {
                    assert!(
                        written.contains(input),
                        "{} reads {input}",
                        pass.kind.name()
                    );
                }
                written.extend(pass.writes);
            }
        }
    }
}

#[test]
fn the_tree_names_each_pass_its_cost_and_each_effect_left_out() {
    let plan = FramePlan::new(&request("none"), &PLAIN);
    let ran = [crate::render::PassRecord {
        pass: String::from("shade"),
        gpu_ms: Some(12.345),
        shared: false,
    }];
    let text = plan.tree(&ran);
    for pass in &plan.passes {
        assert!(text.contains(pass.kind.name()) && text.contains(&pass.because));
    }
    for left_out in &plan.left_out {
        assert!(text.contains(left_out.effect) && text.contains(&left_out.because));
    }
    assert!(
        text.contains("12.35 ms") || text.contains("12.34 ms"),
        "{text}"
    );
    assert!(!plan.to_string().contains("ms"));
}

/// A model's lamp is planned where the lighting asks for it, and dark where it does not.
#[test]
fn a_models_lights_shine_when_asked_for() {
    let facts = GeometryFacts {
        lights: ModelLights {
            suns: Vec::new(),
            points: brightest("none").lighting.points,
        },
        ..PLAIN
    };
    let mut asking = request("none");
    assert!(!kinds(&asking, &facts).contains(&PassKind::PointLights));
    asking.lighting.model_lights = Some(0.01);
    assert!(kinds(&asking, &facts).contains(&PassKind::PointLights));
}

/// The bent cone has a target only where light comes in through it, or a measurement reads it; the plan says why.
#[test]
fn the_bent_cone_is_there_for_an_environment_that_comes_in_through_it() {
    let cone_of = |request: &FrameRequest| {
        let plan = FramePlan::new(request, &PLAIN);
        let occlusion = (plan.passes.iter())
            .find(|pass| pass.kind == PassKind::Occlusion)
            .unwrap();
        let is_written = occlusion.writes.contains(&"bent cone");
        assert_eq!(is_written, occlusion.because.contains("bent cone"));
        let is_read = (plan.passes.iter())
            .any(|pass| pass.kind == PassKind::Ambient && pass.reads.contains(&"bent cone"));
        (is_written, is_read, reason(&plan, "bent cone"))
    };
    for label in ["gtao", "vbao"] {
        let mut off = brightest(label);
        let (is_written, _, because) = cone_of(&off);
        assert!(!is_written && because.unwrap().contains("is off"));
        off.keeps_cone = true;
        assert_eq!(cone_of(&off), (true, false, None));
        let mut on = brightest(label);
        on.occlusion.set("bent_cone", "on").unwrap();
        assert_eq!(cone_of(&on), (true, true, None));
        let mut constant = request(label);
        constant.occlusion.set("bent_cone", "on").unwrap();
        let (is_written, _, because) = cone_of(&constant);
        assert!(!is_written && because.unwrap().contains("constant"));
    }
    let (is_written, _, because) = cone_of(&brightest("ssdo"));
    assert!(!is_written && because.unwrap().contains("by direction"));
    assert_eq!(cone_of(&brightest("hbao")), (false, false, None));
}
