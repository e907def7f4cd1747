//! `greyfield analyse` beyond the terminal: everything as files, the declared family, the bootstrap,
//! the audit of 2010, ratings and rankings.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

fn greyfield(arguments: &[&str]) -> Output {
    Command::cargo_bin("greyfield")
        .unwrap()
        .args(arguments)
        .output()
        .unwrap()
}

fn done(arguments: &[&str]) -> String {
    let output = greyfield(arguments);
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{complaint}");
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&done(arguments)).unwrap()
}

fn counts_2010() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("stimuli/thesis-2010-votes.csv");
    path.to_str().unwrap().to_owned()
}

/// Twelve people who judge three pairs of three techniques, the first shown turned round for half
/// of them; no coin is tossed.
fn trials() -> String {
    let mut text =
        "participant,condition,first_technique,second_technique,chosen,rt_ms,scene\n".to_owned();
    let pairs = [
        ("none", "crytek24"),
        ("crytek24", "blizzard24"),
        ("none", "blizzard24"),
    ];
    for person in 0..12_usize {
        for (at, (a, b)) in pairs.into_iter().enumerate() {
            let (first, second) = if person % 2 == 0 { (a, b) } else { (b, a) };
            let wants_b = (person * 5 + at * 7) % 12 < 8;
            let chosen = if wants_b == (second == b) {
                "second"
            } else {
                "first"
            };
            let rt_ms = 700 + 90 * ((person * 7 + at * 3) % 11);
            let _ = writeln!(
                text,
                "p{person:02},{a}-{b},{first},{second},{chosen},{rt_ms},atrium"
            );
        }
    }
    text
}

fn written(dir: &Path, name: &str, text: &str) -> String {
    let path = dir.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// Every file below a folder, by its path from there.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_owned();
                found.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    found
}

#[test]
fn a_folder_holds_the_whole_report_and_the_same_bytes_again() {
    let dir = tempfile::tempdir().unwrap();
    let input = written(dir.path(), "trials.csv", &trials());
    let out = |name: &str| {
        let folder = dir.path().join(name);
        let said = done(&[
            "analyse",
            &input,
            "--bootstrap",
            "200",
            "--seed",
            "7",
            "--out",
            folder.to_str().unwrap(),
        ]);
        assert!(said.contains("files written to"), "{said}");
        files(&folder)
    };
    let first = out("one");
    assert_eq!(first, out("two"));
    for name in [
        "report.html",
        "report.txt",
        "report.json",
        "tables/conditions.csv",
        "tables/scaling--jod.csv",
        "tables/audit--checks.csv",
        "tables/response_times--by_condition.csv",
        "figures/forest.svg",
    ] {
        assert!(first.contains_key(Path::new(name)), "{name} is missing");
    }
    for figure in [
        "votes",
        "forest",
        "position-bias",
        "orders",
        "anytime",
        "response-times",
        "jod",
    ] {
        let png = &first[&PathBuf::from(format!("figures/{figure}.png"))];
        let picture = image::load_from_memory(png).unwrap().to_luma8();
        assert!(picture.width() >= 1700, "{figure}: {}", picture.width());
        let dark = picture.pixels().filter(|pixel| pixel.0[0] < 90).count();
        assert!(dark > 300, "{figure}: {dark} dark pixels");
    }
    for (name, bytes) in &first {
        if name.extension().is_some_and(|ending| ending == "csv") {
            let mut reader = csv::Reader::from_reader(&bytes[..]);
            let width = reader.headers().unwrap().len();
            for row in reader.records() {
                assert_eq!(row.unwrap().len(), width, "{}", name.display());
            }
        }
    }
}

#[test]
fn the_bootstrap_has_its_seed_on_record_and_another_seed_gives_other_intervals() {
    let dir = tempfile::tempdir().unwrap();
    let input = written(dir.path(), "trials.csv", &trials());
    let run = |seed: &str| {
        json(&[
            "analyse",
            &input,
            "--format",
            "json",
            "--bootstrap",
            "300",
            "--seed",
            seed,
        ])
    };
    let interval = |report: &Value| {
        let scaling = section(report, "scaling");
        let row = &scaling["tables"]["jod"][2];
        assert_eq!(row["status"], "ok", "{row}");
        let ends =
            ["jod_bootstrap_low", "jod_bootstrap_high"].map(|key| row[key].as_f64().unwrap());
        assert!(ends[0] < row["jod"].as_f64().unwrap() && row["jod"].as_f64().unwrap() < ends[1]);
        ends
    };
    let (one, two) = (run("1"), run("2"));
    assert_eq!(one["settings"]["seed"], 1);
    assert_eq!(one["settings"]["bootstrap"], 300);
    assert_ne!(interval(&one), interval(&two));
}

fn section(report: &Value, id: &str) -> Value {
    let sections = report["sections"].as_array().unwrap();
    let found = sections.iter().find(|section| section["id"] == id);
    found.unwrap_or_else(|| panic!("no section {id}")).clone()
}

/// Of the two conditions that are significant alone, one in a family of two: its exact p is
/// doubled, the others' are left alone.
#[test]
fn a_declared_family_is_what_is_corrected_for() {
    let report = json(&[
        "analyse",
        &counts_2010(),
        "--format",
        "json",
        "--family",
        "sponza-high-h1,dragon-low",
    ]);
    let row = |id: &str| {
        let rows = report["conditions"].as_array().unwrap();
        rows.iter()
            .find(|row| row["condition"] == id)
            .unwrap()
            .clone()
    };
    let inside = row("sponza-high-h1");
    let [p, holm] = ["p_exact", "p_exact_holm"].map(|key| inside[key].as_f64().unwrap());
    assert!((holm - 2.0 * p).abs() < 1e-15, "{holm} {p}");
    assert_eq!(inside["verdict"], "only uncorrected");
    let outside = row("sponza-moderate-h2");
    assert_eq!(outside["verdict"], "outside the family");
    assert_eq!(outside["p_exact_holm"], Value::Null);
    assert_eq!(outside["p_exact_holm_status"], "not available");
    let output = greyfield(&["analyse", &counts_2010(), "--family", "sponza"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.contains("`sponza`") && said.contains("sponza-high-h1"),
        "{said}"
    );
}

/// What table 4 of the thesis prints, recomputed: three χ² and two p are rounded wrongly.
#[test]
fn the_audit_of_2010_names_what_was_rounded_wrongly() {
    let report = json(&["analyse", &counts_2010(), "--format", "json"]);
    let audit = section(&report, "audit");
    let checks = audit["tables"]["checks"].as_array().unwrap();
    let faults: Vec<(&str, &str)> = (checks.iter())
        .filter(|check| check["verdict"] == "fault")
        .map(|check| {
            let text = |key: &str| check[key].as_str().unwrap();
            (text("subject"), text("check"))
        })
        .collect();
    let of = |id: &str| faults.iter().filter(|(subject, _)| *subject == id).count();
    assert_eq!(faults.len(), 5, "{faults:?}");
    assert_eq!(
        [
            of("sponza-moderate-h2"),
            of("sponza-high-h1"),
            of("characters-moderate")
        ],
        [2, 2, 1]
    );
    let findings = audit["findings"].to_string();
    assert!(
        findings.contains("21 times in one order and 15 times"),
        "{findings}"
    );
    assert_eq!(section(&report, "scaling")["status"], "disconnected");
}

#[test]
fn ratings_and_rankings_are_analysed_too() {
    let dir = tempfile::tempdir().unwrap();
    let mut ratings = "participant,condition,technique,scale,rating\n".to_owned();
    let mut ranks = "participant,condition,technique,rank\n".to_owned();
    for person in 0..8 {
        for (at, technique) in ["none", "crytek24", "blizzard24"].into_iter().enumerate() {
            let rating = 2 + at + (person * at) % 2;
            let _ = writeln!(ratings, "p{person},atrium,{technique},realism,{rating}");
            let rank = if person == 0 { at + 1 } else { 3 - at };
            let _ = writeln!(ranks, "p{person},atrium,{technique},{rank}");
        }
    }
    let ratings = written(dir.path(), "ratings.csv", &ratings);
    let ranks = written(dir.path(), "ranks.csv", &ranks);
    let report = json(&["analyse", &ranks, "--format", "json"]);
    let test = &section(&report, "rankings")["tables"]["rank_tests"][0];
    // Rank sums 22, 16, 10 of 8 blocks: 12/(8·3·4) (22² + 16² + 10²) − 3·8·4.
    assert!(
        (test["chi_square"].as_f64().unwrap() - 9.0).abs() < 1e-12,
        "{test}"
    );
    assert!((test["kendall_w"].as_f64().unwrap() - 9.0 / 16.0).abs() < 1e-12);
    let report = json(&["analyse", &ratings, "--format", "json"]);
    let row = &section(&report, "ratings")["tables"]["ratings"][0];
    assert_eq!(
        (&row["technique"], &row["mean"]),
        (&"none".into(), &2.0.into())
    );
    let table = done(&["analyse", &ranks, "--format", "csv"]);
    assert!(
        table.starts_with("condition,technique,n,mean_rank"),
        "{table}"
    );
    for format in ["text", "html"] {
        for input in [&ratings, &ranks] {
            let text = done(&["analyse", input, "--format", format]);
            assert!(
                text.contains("Friedman") && !text.contains("NaN"),
                "{format}"
            );
        }
    }
    let output = greyfield(&["analyse", &ratings, &ranks]);
    assert_eq!(output.status.code(), Some(2), "kinds are not mixed");
}
