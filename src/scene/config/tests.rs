use super::*;
use crate::scene::lighting::Ambient;
use crate::scene::model::{AnimationChoice, ModelOptions, Up};

const GOOD: &str = r#"
title = "A test"
seed = 3

[geometry]
generator = "atrium"

[camera]
position_m = [0, 1.7, 5]
target_m = [0, 1, 0]
vertical_fov_deg = 50
near_m = 0.1
far_m = 60

[technique.blizzard]
radius_m = 0.5

[environment]
right = [1, 0, 0]
left = [0, 1, 0]
up = [0, 0, 1]
down = [1, 1, 0]
front = [0, 1, 1]
back = [1, 0, 1]

[lighting.low]
ambient = { constant = [1, 1, 1] }
background = { colour = [1, 1, 1] }

[lighting.moderate]
ambient = "environment"
background = "environment"
tone_map = { reinhard-extended = { white = 4 } }

[lighting.high]
extends = "moderate"
sun = { towards = [1, 2, 0], irradiance = [3, 3, 3] }
"#;

fn parse(text: &str) -> Result<SceneConfig, SceneError> {
    SceneConfig::parse(Path::new("scenes/test.toml"), text)
}

/// The message for `GOOD` with one piece replaced.
fn message(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "the test's own config lacks {from:?}");
    parse(&GOOD.replacen(from, to, 1)).unwrap_err().to_string()
}

fn assert_parts(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in {message:?}");
    }
}

fn line_of(text: &str) -> String {
    let before = &GOOD[..GOOD.find(text).unwrap()];
    format!("scenes/test.toml:{}", before.matches('\n').count() + 1)
}

#[test]
fn variants_inherit_what_they_do_not_say() {
    let scene = parse(GOOD).unwrap();
    assert_eq!(scene.id, "test");
    let high = scene.lighting("high").unwrap();
    let moderate = scene.lighting("moderate").unwrap();
    assert_eq!(high.ambient, Ambient::Environment);
    assert_eq!(high.tone_map, moderate.tone_map);
    assert!(moderate.sun.is_none());
    let sun = high.sun.as_ref().unwrap();
    assert!((sun.towards.length() - 1.0).abs() < 1e-6);
    assert!(sun.casts_shadows);
    // Front is what the default camera looks at: −Z.
    let environment = moderate.environment.as_ref().unwrap();
    assert_eq!(environment.radiance(Vec3::NEG_Z), Vec3::new(0.0, 1.0, 1.0));
    assert!(scene.lighting("low").unwrap().environment.is_none());
}

#[test]
fn unknown_keys_are_named_with_the_allowed_ones() {
    let message = message("near_m = 0.1", "near_cm = 10");
    assert_parts(&message, &[&line_of("near_m"), "near_cm", "near_m"]);
}

#[test]
fn out_of_range_values_name_line_field_and_range() {
    let message = message("vertical_fov_deg = 50", "vertical_fov_deg = 5000");
    let parts = [
        &line_of("vertical_fov"),
        "camera.vertical_fov_deg",
        "5000",
        "5 to 150 degrees",
    ];
    assert_parts(&message, &parts.map(|part| part as &str));
}

#[test]
fn wrong_types_are_errors() {
    assert_parts(
        &message("far_m = 60", "far_m = \"60 m\""),
        &["camera.far_m", &line_of("far_m")],
    );
}

#[test]
fn far_must_lie_beyond_near() {
    assert_parts(
        &message("far_m = 60", "far_m = 0.05"),
        &["camera.far_m", "near_m", &line_of("far_m")],
    );
}

#[test]
fn a_camera_needs_somewhere_to_look() {
    assert_parts(
        &message("target_m = [0, 1, 0]", "target_m = [0, 1.7, 5]"),
        &["camera.target_m"],
    );
}

#[test]
fn unknown_generators_list_the_known_ones() {
    assert_parts(
        &message("\"atrium\"", "\"palace\""),
        &["palace", "atrium", &line_of("generator")],
    );
}

#[test]
fn a_loop_of_extends_is_found() {
    let message = message(
        "[lighting.moderate]\n",
        "[lighting.moderate]\nextends = \"high\"\n",
    );
    assert_parts(&message, &["extends itself"]);
}

#[test]
fn an_unknown_parent_is_found() {
    assert_parts(
        &message("extends = \"moderate\"", "extends = \"dawn\""),
        &["dawn", &line_of("extends")],
    );
}

#[test]
fn an_environment_must_be_there_when_asked_for() {
    let start = GOOD.find("[environment]").unwrap();
    let end = GOOD.find("[lighting.low]").unwrap();
    let text = format!("{}{}", &GOOD[..start], &GOOD[end..]);
    assert_parts(
        &parse(&text).unwrap_err().to_string(),
        &["[environment]", "ambient"],
    );
}

#[test]
fn a_missing_ambient_names_the_variant() {
    let message = message("ambient = { constant = [1, 1, 1] }", "");
    assert_parts(&message, &["lighting.low.ambient", "missing"]);
}

#[test]
fn a_sun_without_direction_is_refused() {
    assert_parts(
        &message("[1, 2, 0], irr", "[0, 0, 0], irr"),
        &["lighting.high.sun.towards"],
    );
}

/// A model's file beside the scene's, and a scene that uses it.
fn parse_with_model(geometry: &str) -> Result<SceneConfig, SceneError> {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("fox.glb"), "any").unwrap();
    let text = GOOD.replacen("generator = \"atrium\"", geometry, 1);
    SceneConfig::parse(&dir.path().join("test.toml"), &text)
}

#[test]
fn a_model_is_read_beside_the_scene() {
    let geometry = "file = \"fox.glb\"\nscale = 0.01\nup = \"z\"\nground = true\n\
                    animation = \"Walk\"\ntime_s = 0.3\ncrease_deg = 90\n\
                    albedo = [0.1, 0.2, 0.3]\nroughness = 0.4";
    let scene = parse_with_model(geometry).unwrap();
    let GeometrySource::File { path, options } = scene.geometry else {
        panic!("{:?}", scene.geometry);
    };
    assert!(path.ends_with("fox.glb"));
    let expected = ModelOptions {
        scale: 0.01,
        up: Up::Z,
        ground: true,
        animation: Some(AnimationChoice::Name(String::from("Walk"))),
        time_s: 0.3,
        crease_rad: Some(90.0_f32.to_radians()),
        albedo: Some([0.1, 0.2, 0.3]),
        roughness: Some(0.4),
        ..ModelOptions::default()
    };
    assert_eq!(options, expected);
    let by_number = parse_with_model("file = \"fox.glb\"\nanimation = 2").unwrap();
    let GeometrySource::File { options, .. } = by_number.geometry else {
        panic!("{:?}", by_number.geometry);
    };
    assert_eq!(options.animation, Some(AnimationChoice::Index(2)));
}

#[test]
fn geometry_is_a_file_or_a_generator() {
    let message = |geometry: &str| parse_with_model(geometry).unwrap_err().to_string();
    assert_parts(
        &message("file = \"no.glb\""),
        &["test.toml:6", "geometry.file", "no.glb"],
    );
    assert_parts(
        &message("file = \"fox.glb\"\ngenerator = \"atrium\""),
        &["geometry.file", "one of them"],
    );
    assert_parts(&message(""), &["`geometry`", "generator", "file"]);
    assert_parts(
        &message("generator = \"atrium\"\nscale = 2"),
        &["test.toml:7", "geometry.scale", "generator"],
    );
    assert_parts(
        &message("file = \"fox.glb\"\nscale = 0"),
        &["geometry.scale", "m per unit"],
    );
    assert_parts(
        &message("file = \"fox.glb\"\nup = \"w\""),
        &["geometry.up", "`x`", "`y`", "`z`"],
    );
}

#[test]
fn model_lights_are_inherited_like_everything_else() {
    let text = GOOD.replacen(
        "[lighting.high]\n",
        "[lighting.high]\nmodel_lights = 0.01\n",
        1,
    );
    let text = format!("{text}\n[lighting.higher]\nextends = \"high\"\n");
    let scene = parse(&text).unwrap();
    for (name, factor) in [
        ("moderate", None),
        ("high", Some(0.01)),
        ("higher", Some(0.01)),
    ] {
        assert_eq!(scene.lighting(name).unwrap().model_lights, factor, "{name}");
    }
    assert!(!scene.occlusion.baked);
    let text = format!("{GOOD}\n[occlusion]\nbaked = true\n");
    assert!(parse(&text).unwrap().occlusion.baked);
}

proptest::proptest! {
    /// Whatever the file, parsing gives a scene or an error, never a panic.
    #[test]
    fn damaged_configs_never_panic(cut in 0..GOOD.len(), insert in "\\PC{0,6}") {
        let cut = (0..=cut).rev().find(|&at| GOOD.is_char_boundary(at)).unwrap_or(0);
        let _ = parse(&format!("{}{insert}{}", &GOOD[..cut], &GOOD[cut..]));
        let _ = parse(&GOOD[..cut]);
    }
}
