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
    let ahead = environment.radiance(Vec3::NEG_Z);
    assert!(
        (ahead - Vec3::new(0.0, 1.0, 1.0)).length() < 1e-3,
        "{ahead}"
    );
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

/// `GOOD` with its six axes replaced.
fn with_environment(keys: &str) -> String {
    let start = GOOD.find("[environment]").unwrap();
    let end = GOOD.find("[lighting.low]").unwrap();
    format!("{}[environment]\n{keys}\n{}", &GOOD[..start], &GOOD[end..])
}

const SKY: &str = "sky = { sun_elevation_deg = 30, sun_azimuth_deg = 90 }";

#[test]
fn the_sun_may_be_the_skys_own() {
    let text = with_environment(&format!("{SKY}\nrotation_deg = 90\nintensity = 0.5")).replace(
        "towards = [1, 2, 0], irradiance = [3, 3, 3]",
        "towards = \"sky\"",
    );
    let scene = parse(&text).unwrap();
    let sun = scene.lighting("high").unwrap().sun.clone().unwrap();
    // East (+X) at 30°, turned by a quarter about +Y: ahead (−Z).
    let expected = Vec3::new(0.0, 0.5, -(0.75_f32.sqrt()));
    assert!((sun.towards - expected).length() < 1e-5, "{sun:?}");
    let whole = crate::scene::environment::Sky {
        sun_elevation_rad: 30_f32.to_radians(),
        ..Default::default()
    };
    let expected = whole.sunlight().irradiance * 0.5;
    assert!((sun.irradiance - expected).length() < 1e-3, "{sun:?}");
}

#[test]
fn a_variant_may_turn_and_dim_the_environment() {
    let text = GOOD.replace(
        "extends = \"moderate\"",
        "extends = \"moderate\"\nenvironment = { rotation_deg = 90, intensity = 0.5 }",
    );
    let scene = parse(&text).unwrap();
    let of = |name: &str| scene.lighting(name).unwrap().environment.clone().unwrap();
    let ahead = of("moderate").radiance(Vec3::NEG_Z);
    let left = of("high").radiance(Vec3::NEG_X);
    assert!((ahead * 0.5 - left).length() < 1e-3, "{ahead} {left}");
}

#[test]
fn an_environment_is_of_one_kind() {
    for keys in ["", "rotation_deg = 10", &format!("{SKY}\nup = [1, 1, 1]")] {
        let error = parse(&with_environment(keys)).unwrap_err().to_string();
        assert_parts(&error, &[&line_of("[environment]"), "exactly one", "`sky`"]);
    }
    let error = parse(&with_environment("up = [1, 1, 1]"))
        .unwrap_err()
        .to_string();
    assert_parts(&error, &["right, left, down, back, front", "missing"]);
    let message = parse(&with_environment(
        "sky = { sun_elevation_deg = -5, sun_azimuth_deg = 0 }",
    ))
    .unwrap_err()
    .to_string();
    assert_parts(
        &message,
        &["environment.sky.sun_elevation_deg", "1 to 90 degrees"],
    );
}

#[test]
fn a_missing_environment_file_is_named_with_its_line() {
    let error = parse(&with_environment("file = \"no-such.hdr\""))
        .unwrap_err()
        .to_string();
    assert_parts(
        &error,
        &["environment.file", "scenes/no-such.hdr", "cannot be read"],
    );
}

#[test]
fn an_environment_file_is_read_from_beside_the_config() {
    let folder = tempfile::tempdir().unwrap();
    let pixels = [image::Rgb([0.25_f32, 0.5, 1.0]); 16 * 8];
    let mut bytes = Vec::new();
    image::codecs::hdr::HdrEncoder::new(&mut bytes)
        .encode(&pixels, 16, 8)
        .unwrap();
    std::fs::write(folder.path().join("sky.hdr"), &bytes).unwrap();
    let path = folder.path().join("scene.toml");
    let text = with_environment("file = \"sky.hdr\"\nintensity = 2");
    let scene = SceneConfig::parse(&path, &text).unwrap();
    let environment = scene
        .lighting("moderate")
        .unwrap()
        .environment
        .clone()
        .unwrap();
    assert_eq!(environment.radiance(Vec3::Y), Vec3::new(0.5, 1.0, 2.0));
    let digest = crate::digest::sha256_hex(&bytes);
    assert_eq!(environment.file_sha256(), Some(digest.as_str()));
    std::fs::write(folder.path().join("sky.hdr"), &bytes[..bytes.len() / 2]).unwrap();
    let error = SceneConfig::parse(&path, &text).unwrap_err().to_string();
    assert_parts(&error, &["scene.toml:", "environment.file", "damaged"]);
}

#[test]
fn only_a_sky_knows_its_sun() {
    let message = message(
        "towards = [1, 2, 0], irradiance = [3, 3, 3]",
        "towards = \"sky\"",
    );
    assert_parts(&message, &["lighting.high.sun.towards", "`sky`"]);
    let error = parse(&GOOD.replace(", irradiance = [3, 3, 3]", ""))
        .unwrap_err()
        .to_string();
    assert_parts(&error, &["lighting.high.sun.irradiance", "missing"]);
    let error = parse(&GOOD.replace("towards = [1, 2, 0]", "towards = \"moon\""))
        .unwrap_err()
        .to_string();
    assert_parts(&error, &["moon", "sky"]);
}

const LAMPS: &str = r#"
[[lighting.moderate.point]]
position_m = [0, 3, 0]
intensity = [10, 9, 8]

[[lighting.moderate.point]]
position_m = [1, 3, 0]
intensity = [5, 5, 5]
cone = { target_m = [1, 0, 0], inner_deg = 20, outer_deg = 30 }
"#;

#[test]
fn point_and_spot_lights_are_read_and_inherited_as_one_list() {
    let scene = parse(&format!("{GOOD}{LAMPS}")).unwrap();
    let points = &scene.lighting("moderate").unwrap().points;
    assert_eq!(points.len(), 2);
    assert_eq!(points[0].cone, None);
    let cone = points[1].cone.unwrap();
    assert_eq!(cone.along, Vec3::NEG_Y);
    assert!((cone.outer_rad.to_degrees() - 30.0).abs() < 1e-4);
    assert_eq!(&scene.lighting("high").unwrap().points, points);
    assert!(scene.lighting("low").unwrap().points.is_empty());
    let own = format!(
        "{GOOD}{LAMPS}\n[[lighting.high.point]]\nposition_m = [0, 1, 0]\nintensity = [1, 1, 1]\n"
    );
    assert_eq!(
        parse(&own).unwrap().lighting("high").unwrap().points.len(),
        1
    );
}

#[test]
fn cones_need_an_opening_and_a_direction() {
    for (from, to, parts) in [
        (
            "outer_deg = 30",
            "outer_deg = 20",
            ["point[1].cone.outer_deg", "20"],
        ),
        (
            "target_m = [1, 0, 0]",
            "target_m = [1, 3, 0]",
            ["point[1].cone.target_m", "move"],
        ),
        (
            "outer_deg = 30",
            "outer_deg = 120",
            ["outer_deg", "0 to 90 degrees"],
        ),
    ] {
        let error = parse(&format!("{GOOD}{}", LAMPS.replace(from, to))).unwrap_err();
        assert_parts(&error.to_string(), &parts);
    }
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
