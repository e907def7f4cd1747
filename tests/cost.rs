//! What accuracy costs, through the binary: `greyfield cost` and `greyfield advise`.
#![allow(clippy::unwrap_used)]

mod wall;

use std::process::{Output, Stdio};
use std::time::{Duration, Instant};

use greyfield::cost::{Row, Store};
use greyfield::render::Clock;
use greyfield::stimulus::StimulusSet;

use wall::{SCENE, Wall};

/// The wall, with a reach for what is measured.
fn scene() -> String {
    format!("{SCENE}\n[technique.gtao]\nradius_m = 1.0\n")
}

const SET: &str = r#"
id = "walls"
title = "A study"
seed = 7
width_px = 64
height_px = 48

[[condition]]
id = "wall"
scene = "wall.toml"
lighting = "low"
hypothesis = "H1"
first = "none"
second = "crytek24"
"#;

/// A quick sweep: 1 + 2·2 + 2·2 configurations.
const QUICK: [&str; 10] = [
    "--techniques",
    "none,crytek,gtao",
    "--samples",
    "8,16",
    "--resolution",
    "full",
    "--within",
    "0.01",
    "--size",
    "64x48",
];

struct Study(Wall);

impl Study {
    fn new() -> Self {
        Self(Wall::new(&scene(), &[("set.toml", SET)]))
    }

    fn cost(&self, more: &[&str]) -> Output {
        let args: Vec<&str> = ["cost"].iter().chain(&QUICK).chain(more).copied().collect();
        self.run(&args)
    }

    fn rows(&self, folder: &str) -> Vec<Row> {
        Store::load(&self.path(folder)).unwrap().unwrap().rows
    }
}

impl std::ops::Deref for Study {
    type Target = Wall;

    fn deref(&self) -> &Wall {
        &self.0
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[track_caller]
fn refused(output: &Output, what: &[&str]) {
    let message = said(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.starts_with("error: ") || message.contains("\nerror: "),
        "{message}"
    );
    for what in what {
        assert!(message.contains(what), "{what} is missing in: {message}");
    }
}

/// Every configuration has its time and its errors, and the errors tell what is known of the
/// techniques: beside a wall without occlusion the picture is too open, and gtao is nearer to the
/// truth than nothing and than crytek.
#[test]
fn a_sweep_times_every_configuration_and_says_how_wrong_it_is() {
    let study = Study::new();
    let output = study.cost(&["wall.toml", "--out", "out"]);
    assert!(output.status.success(), "{}", said(&output));
    let rows = study.rows("out");
    assert_eq!(rows.len(), 9);
    let of = |name: &str| rows.iter().find(|row| row.configuration == name).unwrap();
    let (none, gtao) = (of("none"), of("gtao-16-full-b4"));
    assert_eq!((none.total_ms, none.frames, none.clock), (0.0, 0, None));
    assert!(
        none.bias > 0.0 && (none.bias - none.mae).abs() < 1e-9,
        "too open, everywhere"
    );
    assert!(gtao.rmse < none.rmse && gtao.rmse < of("crytek-16-full-b4").rmse);
    assert!(gtao.flip_mean < none.flip_mean && gtao.ssim > none.ssim);
    for row in rows.iter().filter(|row| row.technique != "none") {
        assert_eq!(row.clock, Some(Clock::GpuTimestamps));
        assert!(row.frames >= 6 && row.total_ms > 0.0, "{row:?}");
        let (low, high) = (row.total_low_ms.unwrap(), row.total_high_ms.unwrap());
        assert!(low <= row.total_ms && row.total_ms <= high);
        assert_eq!(row.blur_ms.is_some(), row.blur_px > 0);
        assert!(row.reach_m == 1.0 && (row.width_px, row.height_px) == (64, 48));
    }
    for file in ["cost.csv", "cost.json", "sweep.json", "cost.html"] {
        assert!(study.path("out").join(file).is_file(), "{file}");
    }
}

/// What is there is not measured again; what is asked for beyond it is.
#[test]
fn a_sweep_goes_on_where_it_stopped() {
    let study = Study::new();
    assert!(
        study
            .cost(&["wall.toml", "--out", "out", "--pictures", "none"])
            .status
            .success()
    );
    let before = study.rows("out");
    let args = [
        "wall.toml",
        "--out",
        "out",
        "--pictures",
        "none",
        "--blur",
        "4,0,2",
    ];
    assert!(study.cost(&args).status.success());
    let after = study.rows("out");
    assert_eq!(after[..before.len()], before[..]);
    assert_eq!(after.len(), before.len() + 4);
    assert!(
        after[before.len()..]
            .iter()
            .all(|row| row.run == 2 && row.blur_px == 2)
    );
}

/// Killed at any moment, the table on disk is whole and the next run needs no other.
#[test]
fn a_killed_sweep_loses_nothing_that_was_measured() {
    let study = Study::new();
    let more = ["cost", "wall.toml", "--out", "out", "--pictures", "none"];
    let quick = QUICK.map(|arg| if arg == "8,16" { "8,16,24,32" } else { arg });
    let args: Vec<&str> = more.into_iter().chain(quick).collect();
    let mut child = study
        .command(&args)
        .stderr(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let started = Instant::now();
    let table = study.path("out").join("cost.csv");
    while !table.exists() && started.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(150));
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = study.rows("out");
    assert!(!kept.is_empty());
    assert!(study.run(&args).status.success());
    let rows = study.rows("out");
    assert_eq!(rows[..kept.len()], kept[..]);
    assert_eq!(rows.len(), 1 + 2 * 2 * 4);
}

#[test]
fn a_folder_of_another_sweep_is_refused_and_stays() {
    let study = Study::new();
    let args = ["wall.toml", "--out", "out", "--pictures", "none"];
    assert!(study.cost(&args).status.success());
    let before = study.rows("out");
    let other = [&args[..], &["--seed", "5"]].concat();
    refused(
        &study.cost(&other),
        &["another sweep", "seed was 2010 and is 5", "--out"],
    );
    study.write(
        "wall.toml",
        &scene().replace("vertical_fov_deg = 40", "vertical_fov_deg = 50"),
    );
    refused(&study.cost(&args), &["scene wall has changed"]);
    assert_eq!(study.rows("out"), before);
}

#[test]
fn the_wall_clock_is_said() {
    let study = Study::new();
    let args = [
        "wall.toml",
        "--out",
        "out",
        "--pictures",
        "none",
        "--wall-clock",
    ];
    assert!(study.cost(&args).status.success());
    let rows = study.rows("out");
    let timed = || rows.iter().filter(|row| row.technique != "none");
    assert!(timed().all(|row| row.clock == Some(Clock::WallClock) && row.total_ms > 0.0));
    assert!(timed().all(|row| row.occlusion_ms.is_none() && row.blur_ms.is_none()));
}

/// Votes meet the costs of the very images that they are about.
#[test]
fn votes_stand_beside_what_the_images_cost() {
    let study = Study::new();
    study.write(
        "votes.csv",
        "condition,technique_a,technique_b,votes_a,votes_b\nwall,none,crytek24,9,27\n",
    );
    let args = [
        "cost",
        "set.toml",
        "--techniques",
        "none",
        "--within",
        "0.01",
        "--votes",
        "votes.csv",
        "--out",
        "out",
    ];
    let output = study.run(&args);
    assert!(output.status.success(), "{}", said(&output));
    let text = std::fs::read_to_string(study.path("out").join("votes.csv")).unwrap();
    // 27 of 36 are three of four: 1 JOD.
    assert!(text.contains("wall") && text.contains("0.75"), "{text}");
    let votes = "condition,technique_a,technique_b,votes_a,votes_b\nroof,none,crytek24,9,27\n";
    study.write("votes.csv", votes);
    refused(
        &study.run(&args),
        &["roof", "renders no such condition", "wall"],
    );
    study.write(
        "votes.csv",
        &votes.replace("roof", "wall").replace("crytek24", "gtao18"),
    );
    refused(&study.run(&args), &["none and gtao18", "none and crytek24"]);
}

#[test]
fn what_cannot_be_measured_is_said_in_one_message() {
    let study = Study::new();
    refused(&study.cost(&["nowhere.toml"]), &["nowhere.toml"]);
    refused(
        &study.cost(&["wall.toml", "--lighting", "noon"]),
        &["noon", "low"],
    );
    refused(
        &study.run(&["cost", "wall.toml", "--techniques", "hbao+"]),
        &["hbao+", "hbao", "gtao"],
    );
    refused(
        &study.cost(&["wall.toml", "--radius", "-1"]),
        &["--radius", "-1"],
    );
    refused(
        &study.cost(&["wall.toml", "--votes", "votes.csv"]),
        &["stimulus set"],
    );
    study.write(
        "wall.toml",
        &scene()
            .replace("position_m = [0, 1.5, 4]", "position_m = [0, 900, 4]")
            .replace("target_m = [0, 0.5, 0]", "target_m = [0, 990, 0]"),
    );
    refused(
        &study.cost(&["wall.toml", "--out", "out"]),
        &["sees no surface", "camera"],
    );
    assert!(!study.path("out").join("cost.csv").exists());
}

/// What is advised is a scene and a set that can be rendered.
#[test]
fn advice_is_written_as_configs_that_render() {
    let study = Study::new();
    let args: Vec<&str> = ["advise", "wall.toml", "--out", "out"]
        .iter()
        .chain(&QUICK)
        .copied()
        .collect();
    let output = study.run(&args);
    assert!(output.status.success(), "{}", said(&output));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for what in [
        "FLIP",
        "earns its time",
        "supersampling",
        "wall-advised.toml",
    ] {
        assert!(text.contains(what), "{what} is missing in: {text}");
    }
    let set = StimulusSet::load(&study.path("wall-advised-set.toml")).unwrap();
    assert_eq!(set.conditions.len(), 1);
    let output = study.run(&["render", "wall-advised-set.toml"]);
    assert!(output.status.success(), "{}", said(&output));
}
