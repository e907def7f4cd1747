//! The truth through the binary: `greyfield truth`, and `ray-traced` as a technique of a set.
#![allow(clippy::unwrap_used)]

mod wall;

use std::path::PathBuf;
use std::process::Output;

use wall::{SCENE, Wall};

const SET: &str = r#"
id = "walls"
title = "Against the truth"
seed = 7
width_px = 64
height_px = 48

[[condition]]
id = "wall"
scene = "wall.toml"
lighting = "low"
hypothesis = "H1"
first = "gtao18"
second = { technique = "ray-traced", error = 0.01 }
"#;

struct Study(Wall);

impl Study {
    fn new() -> Self {
        Self(Wall::new(SCENE, &[("set.toml", SET)]))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path(name)
    }

    fn greyfield(&self, args: &[&str]) -> Output {
        self.0.run(args)
    }

    fn succeed(&self, args: &[&str]) {
        let output = self.greyfield(args);
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{args:?}: {message}");
    }

    /// The occlusion image of a run, levels of 16 bits.
    fn occlusion(
        &self,
        folder: &str,
        kind: &str,
    ) -> image::ImageBuffer<image::Luma<u16>, Vec<u16>> {
        let path = self.path(folder).join(format!("wall--{kind}.png"));
        image::open(path).unwrap().into_luma16()
    }
}

/// Both answers are on disk with their record, and agree where the picture shows all that
/// hides: at the foot of the wall half the light is gone, on its upper part next to none.
#[test]
fn the_truth_is_what_a_wall_beside_a_floor_must_be() {
    let study = Study::new();
    study.succeed(&[
        "truth",
        "set.toml",
        "--error",
        "0.01",
        "--screen-space",
        "--out",
        "truth",
    ]);
    let record = std::fs::read_to_string(study.path("truth/truth.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    let images = record["images"].as_array().unwrap();
    assert_eq!(images.len(), 2);
    for image in images {
        // At the limit of rays a pixel may stay above; the mean does not.
        assert!(image["mean_standard_error"].as_f64().unwrap() <= 0.01);
    }
    for kind in ["ray-traced", "screen-space"] {
        let occlusion = study.occlusion("truth", kind);
        assert_eq!(occlusion.dimensions(), (64, 48));
        let column = |y: u32| f64::from(occlusion.get_pixel(32, y)[0]) / 65535.0;
        // The wall's foot, seen along the middle column: the darkest is about one half.
        let darkest = (0..48).map(column).fold(1.0, f64::min);
        assert!((0.45..0.62).contains(&darkest), "{kind}: {darkest}");
        // The lowest row shows the floor 2 m before the wall: (1 + cos β)/2 = 0.947.
        let near = column(47);
        assert!((near - 0.95).abs() < 0.04, "{kind}: {near}");
    }
}

/// A ball of radius 1 in facets.
fn ball() -> String {
    const COLUMNS: usize = 96;
    const ROWS: usize = 48;
    let mut model = String::new();
    for row in 0..=ROWS {
        for column in 0..COLUMNS {
            let (polar, turn) = (
                std::f64::consts::PI * row as f64 / ROWS as f64,
                std::f64::consts::TAU * column as f64 / COLUMNS as f64,
            );
            let (x, z) = (polar.sin() * turn.sin(), polar.sin() * turn.cos());
            model += &format!("v {x} {} {z}\n", polar.cos() + 0.5);
        }
    }
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let at = |row: usize, column: usize| 1 + row * COLUMNS + column % COLUMNS;
            let [a, b] = [at(row, column), at(row + 1, column)];
            let [c, d] = [at(row + 1, column + 1), at(row, column + 1)];
            model += &format!("f {a} {b} {c} {d}\n");
        }
    }
    model
}

/// A plate, askew, whose faces each have their own normal.
fn plate() -> String {
    let mut model = String::new();
    for (face, (axis, sign)) in (0..3).flat_map(|a| [(a, -1.0), (a, 1.0)]).enumerate() {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(u, v)| {
            let mut corner = [0.0; 3];
            corner[axis] = sign;
            corner[(axis + 1) % 3] = u * sign;
            corner[(axis + 2) % 3] = v;
            let [x, y, z] = [corner[0], 0.05 * corner[1], corner[2]];
            let (x, z) = (0.9 * x - 0.4 * z, 0.4 * x + 0.9 * z);
            glam::DVec3::new(x, y + 0.3 * x + 0.5, z)
        });
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let normal = normal.normalize();
        for corner in corners {
            model += &format!("v {} {} {}\n", corner.x, corner.y, corner.z);
        }
        model += &format!("vn {} {} {}\nf", normal.x, normal.y, normal.z);
        for corner in 1..=4 {
            model += &format!(" {}//{}", 4 * face + corner, face + 1);
        }
        model.push('\n');
    }
    model
}

/// Nothing of a convex body hides anything of it, its edges included, where a pixel's ray may pass
/// the body by or meet the face round the corner of the one that was drawn.
#[test]
fn a_convex_body_is_open_to_its_very_edges() {
    for (name, model) in [("ball", ball()), ("plate", plate())] {
        let study = Study::new();
        std::fs::write(study.path("wall.obj"), model).unwrap();
        let set = (SET.replace("= 64", "= 640")).replace("= 48", "= 480");
        std::fs::write(study.path("set.toml"), set).unwrap();
        study.succeed(&["truth", "set.toml", "--error", "0.02", "--out", "truth"]);
        let occlusion = study.occlusion("truth", "ray-traced");
        // Smooth normals lean over facets, which costs a ray or two of 64. The wrong face costs half.
        let dark = (occlusion.enumerate_pixels()).filter(|(_, _, value)| value[0] < 60_000);
        let dark: Vec<_> = dark.map(|(x, y, value)| (x, y, value[0])).collect();
        assert!(dark.is_empty(), "{name}: {dark:?}");
    }
}

/// Same config, seed and adapter: same bytes, whatever the number of threads; and the image of
/// the technique differs from another's.
#[test]
fn ray_traced_stimuli_are_the_same_every_time() {
    let study = Study::new();
    let images = |folder: &str| {
        ["gtao18", "ray-traced"].map(|label| {
            std::fs::read(study.path(folder).join(format!("wall--{label}.png"))).unwrap()
        })
    };
    study.succeed(&["render", "set.toml", "--out", "first"]);
    let second = study
        .0
        .command(&["render", "set.toml", "--out", "second"])
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    assert!(second.status.success());
    assert_eq!(images("first"), images("second"));
    let [gtao, traced] = images("first");
    assert_ne!(gtao, traced);
}

#[test]
fn bad_settings_are_one_message() {
    let study = Study::new();
    for (args, named) in [
        (["--error", "7"], "error"),
        (["--distance-m", "0"], "distance"),
        (["--only", "nowhere"], "nowhere"),
    ] {
        let output = study.greyfield(&["truth", "set.toml", "--out", "truth", args[0], args[1]]);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(named), "{message}");
        assert!(!message.contains("panicked"), "{message}");
        assert!(!study.path("truth").exists(), "{args:?} left something");
    }
}

/// `render --occlusion` writes what each image is shaded with, under the image's name: of the truth
/// what `truth` finds.
#[test]
fn the_occlusion_of_each_image_can_be_had() {
    let study = Study::new();
    let render = ["render", "set.toml", "--out", "images", "--occlusion"];
    study.succeed(&[&render[..], &["occlusion"]].concat());
    // At this size the blur takes most of gtao's crease away.
    for (label, expected) in [("gtao18", 0.5..0.95), ("ray-traced", 0.45..0.65)] {
        let occlusion = study.occlusion("occlusion", label);
        assert_eq!(occlusion.dimensions(), (64, 48));
        let grey = |y: u32| f64::from(occlusion.get_pixel(32, y)[0]) / 65535.0;
        let darkest = (0..48).map(grey).fold(1.0, f64::min);
        assert!(expected.contains(&darkest), "{label}: {darkest}");
    }
    study.succeed(&["truth", "set.toml", "--error", "0.01", "--out", "truth"]);
    let [handed, traced] = ["occlusion", "truth"].map(|f| study.occlusion(f, "ray-traced"));
    for (handed, traced) in handed.pixels().zip(traced.pixels()) {
        // The renderer stores it as a half float.
        assert!(handed[0].abs_diff(traced[0]) <= 32, "{handed:?} {traced:?}");
    }
    // The images' own folder is refused before anything is drawn.
    let refused = study.greyfield(&[&render[..], &["images"]].concat());
    assert_eq!(refused.status.code(), Some(2));
}
