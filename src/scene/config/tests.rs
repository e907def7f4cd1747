use super::*;
use crate::scene::lighting::Ambient;

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

proptest::proptest! {
    /// Whatever the file, parsing gives a scene or an error, never a panic.
    #[test]
    fn damaged_configs_never_panic(cut in 0..GOOD.len(), insert in "\\PC{0,6}") {
        let cut = (0..=cut).rev().find(|&at| GOOD.is_char_boundary(at)).unwrap_or(0);
        let _ = parse(&format!("{}{insert}{}", &GOOD[..cut], &GOOD[cut..]));
        let _ = parse(&GOOD[..cut]);
    }
}
