//! `greyfield analyse` as a person runs it: on the 2010 study's counts, on trial tables, on bad input.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

fn greyfield(arguments: &[&str]) -> Output {
    Command::cargo_bin("greyfield")
        .unwrap()
        .arg("analyse")
        .args(arguments)
        .output()
        .unwrap()
}

fn report(arguments: &[&str]) -> String {
    let output = greyfield(arguments);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

fn refusal(arguments: &[&str]) -> String {
    let output = greyfield(arguments);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

fn counts_2010() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("stimuli/thesis-2010-votes.csv");
    path.to_str().unwrap().to_owned()
}

/// Report text as one line: sentences are wrapped for the terminal.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// χ² and its p by hand and scipy 1.17; exact p from whole-number sums; Holm: 7 × the smallest.
#[test]
fn the_2010_counts_have_their_exact_values() {
    let json: Value = serde_json::from_str(&report(&[&counts_2010(), "--format", "json"])).unwrap();
    let conditions = json["conditions"].as_array().unwrap();
    assert_eq!(conditions.len(), 7);
    let of = |id: &str, key: &str| -> f64 {
        let row = conditions
            .iter()
            .find(|row| row["condition"] == id)
            .unwrap();
        row[key].as_f64().unwrap()
    };
    for (id, chi_square, p) in [
        ("dragon-low", 0.0, 1.0),
        ("sponza-moderate-h1", 16.0 / 9.0, 0.182_422_439_451_731_98),
        ("sponza-moderate-h2", 49.0 / 9.0, 0.019_630_657_257_290_702),
        ("characters-moderate", 4.0 / 9.0, 0.504_985_075_093_845_7),
        ("sponza-high-h1", 49.0 / 9.0, 0.019_630_657_257_290_702),
        ("sponza-high-h2", 0.0, 1.0),
        ("characters-high", 1.0, 0.317_310_507_862_911_15),
    ] {
        assert!((of(id, "chi_square") - chi_square).abs() < 1e-12, "{id}");
        assert!((of(id, "p_chi_square") - p).abs() < 1e-12, "{id}");
    }
    for id in ["sponza-moderate-h2", "sponza-high-h1"] {
        let exact = 0.028_816_719_655_878_845;
        assert!((of(id, "p_exact") - exact).abs() < 1e-12);
        assert!((of(id, "p_exact_holm") - 7.0 * exact).abs() < 1e-11);
        assert!((of(id, "p_chi_square_holm") - 7.0 * 0.019_630_657_257_290_702).abs() < 1e-11);
        assert!((of(id, "wilson_low") - 0.531_437_271_494_896_6).abs() < 1e-12);
        assert!((of(id, "wilson_high") - 0.819_955_484_051_700_8).abs() < 1e-12);
    }
    for row in conditions {
        assert_ne!(row["verdict"], "significant");
    }
}

#[test]
fn the_2010_report_says_that_nothing_stays_significant() {
    let text = report(&[&counts_2010()]);
    for part in [
        "5.444444", "0.019631", "0.137415", "0.201717", "1.777778", "0.182422",
    ] {
        assert!(text.contains(part), "{part} not in\n{text}");
    }
    let sentence = "after Holm's correction over the family of 7 none stays significant";
    assert_eq!(unwrapped(&text).matches(sentence).count(), 2, "{text}");
    assert!(
        unwrapped(&text).contains("smallest corrected p 0.137"),
        "{text}"
    );
    assert!(
        unwrapped(&text).contains("smallest corrected p 0.202"),
        "{text}"
    );
}

#[test]
fn every_format_gives_the_same_bytes_again() {
    for format in ["text", "json", "csv", "html"] {
        let arguments = [&counts_2010(), "--format", format];
        assert_eq!(report(&arguments), report(&arguments), "{format}");
    }
}

#[test]
fn the_page_needs_nothing_from_elsewhere() {
    let page = report(&[&counts_2010(), "--format", "html"]);
    for part in ["<link", "<script", "@import", "url(", "src="] {
        assert!(!page.contains(part), "{part}");
    }
    let addresses = page.matches("http").count();
    assert_eq!(
        addresses,
        page.matches("http://www.w3.org/2000/svg").count()
    );
    assert!(page.contains("none stays significant"));
}

#[test]
fn the_csv_opens_as_a_table() {
    let text = report(&[&counts_2010(), "--format", "csv"]);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().clone();
    let at = header.iter().position(|name| name == "p_exact").unwrap();
    let p: Vec<f64> = reader
        .records()
        .map(|row| row.unwrap()[at].parse().unwrap())
        .collect();
    assert_eq!(p.len(), 7);
    assert_eq!(p[0], 1.0);
}

fn written(dir: &Path, name: &str, text: &str) -> PathBuf {
    let path = dir.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn hard_counts_print_no_nonsense() {
    let dir = tempfile::tempdir().unwrap();
    let path = written(
        dir.path(),
        "hard.csv",
        "condition,technique_a,technique_b,votes_a,votes_b\n\
         nobody,x,y,0,0\none,x,y,0,1\nall one way,x,y,36,0\n\
         Ünïcode <b>,x,y,1,2\nbillions,x,y,0,1000000000\nmillion,x,y,499000,501000\n",
    );
    let path = path.to_str().unwrap();
    for format in ["text", "json", "csv", "html"] {
        let text = report(&[path, "--format", format]);
        for part in ["NaN", "Infinity", "inf,", "-inf"] {
            assert!(!text.contains(part), "{part} in {format}:\n{text}");
        }
    }
    let json: Value = serde_json::from_str(&report(&[path, "--format", "json"])).unwrap();
    let rows = json["conditions"].as_array().unwrap();
    assert_eq!(rows[0]["p_exact"], Value::Null);
    assert_eq!(rows[0]["p_exact_status"], "degenerate");
    assert_eq!(rows[0]["p_exact_reason"], "no votes");
    assert_eq!(rows[1]["p_exact"], 1.0);
    // 2 · 2^−10⁹.
    let expected = (1.0 - 1e9) * std::f64::consts::LOG10_2;
    let log10 = rows[4]["p_exact_log10"].as_f64().unwrap();
    assert!((log10 / expected - 1.0).abs() < 1e-14, "{log10} {expected}");
    let page = report(&[path, "--format", "html"]);
    assert!(page.contains("Ünïcode &lt;b&gt;") && !page.contains("<b>"));
}

#[test]
fn trials_are_counted_by_technique_and_by_position() {
    let dir = tempfile::tempdir().unwrap();
    let mut table =
        "participant,condition,first_technique,second_technique,chosen,rt_ms\n".to_owned();
    // 28 participants in both orders; 21 choose crytek24, wherever it stands.
    for i in 0..28 {
        let reversed = i % 2 == 1;
        let (first, second) = if reversed {
            ("crytek24", "none")
        } else {
            ("none", "crytek24")
        };
        let chosen = if (i % 4 != 0) == reversed {
            "first"
        } else {
            "second"
        };
        table += &format!("P{i:02},atrium,{first},{second},{chosen},900\n");
    }
    let path = written(dir.path(), "trials.csv", &table);
    let json = report(&[path.to_str().unwrap(), "--format", "json"]);
    let json: Value = serde_json::from_str(&json).unwrap();
    let row = &json["conditions"][0];
    assert_eq!((&row["votes_a"], &row["votes_b"]), (&7.into(), &21.into()));
    assert_eq!(
        (&row["shown_ab"], &row["shown_ba"]),
        (&14.into(), &14.into())
    );
    assert_eq!(
        (&row["chose_first"], &row["chose_second"]),
        (&21.into(), &7.into())
    );
    // χ² = 14²/28 = 7.
    assert_eq!(row["chi_square"], 7.0);
    assert_eq!(row["verdict"], "significant");
}

#[test]
fn bad_input_is_refused_with_its_place_and_exit_code_2() {
    let dir = tempfile::tempdir().unwrap();
    let header = "participant,condition,first_technique,second_technique,chosen\n";
    let ragged = written(
        dir.path(),
        "ragged.csv",
        &format!("{header}P,c,x,y,first\nQ,c,x\n"),
    );
    let message = refusal(&[ragged.to_str().unwrap()]);
    assert!(message.contains("ragged.csv:3:"), "{message}");
    let twice = written(
        dir.path(),
        "twice.csv",
        &format!("{header}P,c,x,y,first\r\nQ,c,x,y,first\r\nP,c,y,x,second\r\n"),
    );
    let message = refusal(&[twice.to_str().unwrap()]);
    assert!(
        message.contains("twice.csv:4:") && message.contains("twice.csv:2"),
        "{message}"
    );
    assert!(refusal(&["no/such/file.csv"]).contains("no/such/file.csv"));
    let empty = dir.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    assert!(refusal(&[empty.to_str().unwrap()]).contains("no data"));
    assert!(refusal(&[&counts_2010(), "--alpha", "1.5"]).contains("1.5"));
}

#[test]
fn a_report_goes_to_a_file_whole() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("report.json");
    let shown = report(&[&counts_2010(), "-o", out.to_str().unwrap()]);
    assert!(shown.is_empty());
    let json: Value = serde_json::from_str(&std::fs::read_to_string(&out).unwrap()).unwrap();
    assert_eq!(json["inputs"][0]["kind"], "count table");
    assert_eq!(
        json["inputs"][0]["sha256"],
        greyfield::digest::sha256_file(Path::new(&counts_2010())).unwrap()
    );
    let output = greyfield(&[&counts_2010(), "-o", "/no/such/folder/report.html"]);
    assert_eq!(output.status.code(), Some(1));
}
