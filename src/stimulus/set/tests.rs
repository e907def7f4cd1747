use super::*;

/// A set file and a scene file, on disk as a user would have them.
struct Files {
    dir: tempfile::TempDir,
}

const SET: &str = r#"
id = "test"
title = "A test"
seed = 4
width_px = 64
height_px = 48

[[condition]]
id = "one"
scene = "scenes/room.toml"
lighting = "low"
first = "none"
second = "blizzard24"

[[condition]]
id = "two"
scene = "scenes/room.toml"
lighting = "low"
hypothesis = "H2"
first = "crytek24"
second = { technique = "blizzard24", label = "blizzard24-wide", radius_m = 2 }
"#;

const SCENE: &str = r#"
title = "Room"

[geometry]
generator = "atrium"

[camera]
position_m = [0, 1.7, 5]
target_m = [0, 1, 0]
vertical_fov_deg = 50
near_m = 0.1
far_m = 60

[technique.blizzard]
radius_m = 0.25
samples = 12

[lighting.low]
ambient = { constant = [1, 1, 1] }
background = { colour = [1, 1, 1] }
"#;

impl Files {
    fn new(scene: &str) -> Self {
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("scenes")).unwrap();
        std::fs::write(dir.path().join("scenes/room.toml"), scene).unwrap();
        Self { dir }
    }

    fn parse(&self, set: &str) -> Result<StimulusSet, SetError> {
        StimulusSet::parse(&self.dir.path().join("set.toml"), set)
    }
}

fn message(from: &str, to: &str) -> String {
    assert!(SET.contains(from));
    Files::new(SCENE)
        .parse(&SET.replacen(from, to, 1))
        .unwrap_err()
        .to_string()
}

fn scene_message(from: &str, to: &str) -> String {
    assert!(SCENE.contains(from));
    Files::new(&SCENE.replacen(from, to, 1))
        .parse(SET)
        .unwrap_err()
        .to_string()
}

fn assert_parts(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in {message:?}");
    }
}

#[test]
fn parameters_come_from_default_scene_label_and_set_in_that_order() {
    let set = Files::new(SCENE).parse(SET).unwrap();
    assert_eq!(set.scenes.len(), 1);
    let (one, two) = (&set.conditions[0], &set.conditions[1]);
    // The label's samples stand against the scene's; the scene's radius against the default.
    assert_eq!(one.second.get("samples"), 24.0);
    assert_eq!(one.second.get("radius_m"), 0.25);
    assert_eq!(two.second.get("radius_m"), 2.0);
    assert_eq!(two.second.label, "blizzard24-wide");
    assert_eq!(
        (one.validity.as_str(), two.hypothesis.as_str()),
        ("low", "H2")
    );
}

#[test]
fn the_hash_covers_the_scenes() {
    let files = Files::new(SCENE);
    let changed = Files::new(&SCENE.replace("Room", "Rooms"));
    assert_eq!(
        files.parse(SET).unwrap().sha256,
        files.parse(SET).unwrap().sha256
    );
    assert_ne!(
        files.parse(SET).unwrap().sha256,
        changed.parse(SET).unwrap().sha256
    );
}

#[test]
fn wrong_sets_are_refused_with_line_and_field() {
    assert_parts(
        &message("\"none\"", "\"nonne\""),
        &["set.toml:12", "condition[0].first", "nonne", "blizzard"],
    );
    assert_parts(
        &message("id = \"two\"", "id = \"one\""),
        &["set.toml:16", "already"],
    );
    assert_parts(
        &message("id = \"two\"", "id = \"../two\""),
        &["set.toml:16", "letters"],
    );
    assert_parts(
        &message("scenes/room", "scenes/rom"),
        &["set.toml:10", "rom.toml"],
    );
    assert_parts(
        &message("\"low\"", "\"lou\""),
        &["set.toml:11", "lou", "low"],
    );
    assert_parts(
        &message("radius_m = 2", "radius_m = -2"),
        &["set.toml:21", "radius_m", "-2"],
    );
    assert_parts(
        &message("radius_m = 2", "radius = 2"),
        &["set.toml:21", "radius_m"],
    );
    assert_parts(
        &message("width_px = 64", "width = 64"),
        &["set.toml:5", "width_px"],
    );
    assert_parts(
        &message("width_px = 64", "width_px = 0"),
        &["width_px", "1 to 8192 px"],
    );
    assert_parts(
        &message("\"crytek24\"", "\"blizzard24-wide\""),
        &["condition[1].first"],
    );
    assert_parts(
        &message("\"none\"", "\"blizzard24\""),
        &["condition[0].second", "label"],
    );
}

#[test]
fn wrong_technique_tables_of_a_scene_are_refused_in_the_scene_file() {
    assert_parts(
        &scene_message("radius_m = 0.25", "radius_m = -1"),
        &["room.toml:15", "technique.blizzard.radius_m"],
    );
    assert_parts(
        &scene_message("samples = 12", "sample = 12"),
        &["room.toml:16", "samples"],
    );
    assert_parts(
        &scene_message("[technique.blizzard]", "[technique.blizard]"),
        &["room.toml", "blizard"],
    );
}
