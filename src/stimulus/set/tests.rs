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
    let pairs: Vec<_> = set.rendered().collect();
    let ((_, one), (_, two)) = (pairs[0], pairs[1]);
    // The label's samples stand against the scene's; the scene's radius against the default.
    assert_eq!(one.second.get("samples"), 24.0);
    assert_eq!(one.second.get("radius_m"), 0.25);
    assert_eq!(two.second.get("radius_m"), 2.0);
    assert_eq!(two.second.label, "blizzard24-wide");
    assert_eq!(
        (pairs[0].0.validity.as_str(), pairs[1].0.hypothesis.as_str()),
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

/// A condition of images made elsewhere, to follow [`SET`] or to stand alone.
const LOADED: &str = r#"
[[condition]]
id = "three"
scene = "hall"
validity = "high"
first = { file = "pictures/a.png", technique = "none" }
second = { file = "pictures/b.exr", technique = "path-traced", exposure_ev = 1, tone_map = "aces", metadata = { renderer = "Mitsuba 3" } }
"#;

const LOADED_HEAD: &str = "id = \"made\"\ntitle = \"Made elsewhere\"\n";

/// The files need only be there for a set to be read.
fn with_pictures() -> Files {
    let files = Files::new(SCENE);
    let pictures = files.dir.path().join("pictures");
    std::fs::create_dir(&pictures).unwrap();
    for name in ["a.png", "b.exr"] {
        std::fs::write(pictures.join(name), "").unwrap();
    }
    files
}

fn loaded_message(from: &str, to: &str) -> String {
    assert!(LOADED.contains(from));
    let set = LOADED_HEAD.to_owned() + &LOADED.replacen(from, to, 1);
    with_pictures().parse(&set).unwrap_err().to_string()
}

#[test]
fn rendered_and_loaded_conditions_stand_side_by_side() {
    let files = with_pictures();
    let set = files.parse(&(SET.to_owned() + LOADED)).unwrap();
    assert_eq!(set.rendered().count(), 2);
    let condition = &set.conditions[2];
    assert_eq!(condition.labels(), ["none", "path-traced"]);
    assert_eq!(condition.scene_id(&set), "hall");
    let ImageSource::Loaded(pair) = &condition.images else {
        panic!("made elsewhere");
    };
    assert_eq!(pair.second.path, files.dir.path().join("pictures/b.exr"));
    assert_eq!(pair.second.exposure_ev, Some(1.0));
    assert_eq!(pair.second.metadata["renderer"], "Mitsuba 3");
}

#[test]
fn a_set_of_files_needs_no_seed_and_no_size() {
    let set = with_pictures()
        .parse(&(LOADED_HEAD.to_owned() + LOADED))
        .unwrap();
    assert_eq!((set.seed, set.size_px), (0, None));
    for key in ["seed = 4\n", "width_px = 64\n", "height_px = 48\n"] {
        assert_parts(&message(key, ""), &[&key[..4], "renders"]);
    }
}

#[test]
fn wrong_loaded_conditions_are_refused_with_line_and_field() {
    for (from, to, parts) in [
        (
            "a.png",
            "c.png",
            ["set.toml:8", "condition[0].first.file", "c.png"],
        ),
        (
            "\"hall\"",
            "\"a hall\"",
            ["set.toml:6", "condition[0].scene", "letters"],
        ),
        (
            "validity = \"high\"",
            "lighting = \"high\"",
            ["set.toml:7", "lighting", "validity"],
        ),
        (
            "validity = \"high\"",
            "",
            ["set.toml:5", "condition[0].validity", "missing"],
        ),
        (
            "\"none\"",
            "\"path-traced\"",
            ["set.toml:9", "both images", "path-traced"],
        ),
        (
            "\"none\"",
            "\"no ne\"",
            ["set.toml:8", "condition[0].first.technique", "letters"],
        ),
        (
            "exposure_ev = 1",
            "exposure = 1",
            ["set.toml:9", "`exposure`", "metadata"],
        ),
        (
            "exposure_ev = 1",
            "exposure_ev = 99",
            ["set.toml:9", "exposure_ev", "-20 to 20"],
        ),
        (
            "file = \"pictures/a.png\", ",
            "",
            [
                "set.toml:9",
                "condition[0].second",
                "more than the occlusion",
            ],
        ),
        (
            "file = \"pictures/b.exr\", ",
            "",
            ["set.toml:9", "metadata", "file"],
        ),
    ] {
        assert_parts(&loaded_message(from, to), &parts);
    }
}

/// A model that has changed, or a texture of it, makes other images.
#[test]
fn a_changed_model_is_a_changed_set() {
    let files = Files::new(&SCENE.replace("generator = \"atrium\"", "file = \"m.obj\""));
    let model = files.dir.path().join("scenes/m.obj");
    std::fs::write(&model, "mtllib m.mtl\nv 0 0 0").unwrap();
    let first = files.parse(SET).unwrap().sha256;
    assert_eq!(files.parse(SET).unwrap().sha256, first);
    std::fs::write(files.dir.path().join("scenes/m.mtl"), "newmtl a").unwrap();
    let second = files.parse(SET).unwrap().sha256;
    assert_ne!(second, first);
    std::fs::write(&model, "mtllib m.mtl\nv 0 0 1").unwrap();
    assert_ne!(files.parse(SET).unwrap().sha256, second);
}

/// A scene may ask for light between surfaces in all its pictures; what estimates no openness is
/// refused there, and a single image may say otherwise.
#[test]
fn light_between_surfaces_is_asked_for_by_scene_or_image() {
    let model = |settings: &Settings| settings.inter_reflection().map(|(model, _)| model.name);
    let asked = format!("{SCENE}\n[occlusion]\ninter_reflection = \"greyfield\"\n");
    let set = SET
        .replace("\"blizzard24\"", "\"gtao\"")
        .replace("\"crytek24\"", "\"hbao\"");
    let able = set.replace(
        "{ technique = \"gtao\", label = \"blizzard24-wide\", radius_m = 2 }",
        "{ technique = \"gtao\", label = \"direct\", inter_reflection = \"none\" }",
    );
    let set = Files::new(&asked).parse(&able).unwrap();
    let pairs: Vec<_> = set.rendered().map(|(_, pair)| pair).collect();
    assert_eq!(model(&pairs[0].first), None, "there is no occlusion");
    assert_eq!(model(&pairs[0].second), Some("greyfield"));
    assert_eq!(model(&pairs[1].first), Some("greyfield"));
    assert_eq!(model(&pairs[1].second), None);
    // The scene alone says nothing for a technique that is an empirical darkening.
    let message = Files::new(&asked).parse(SET).unwrap_err().to_string();
    assert_parts(
        &message,
        &[
            "room.toml:23",
            "occlusion.inter_reflection",
            "`blizzard`",
            "hbao, gtao",
        ],
    );
    let unknown = asked.replace("\"greyfield\"", "\"radiosity\"");
    let message = Files::new(&unknown).parse(&able).unwrap_err().to_string();
    assert_parts(
        &message,
        &["room.toml:23", "radiosity", "jimenez-2016, greyfield"],
    );
}
