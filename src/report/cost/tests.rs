//! What every figure and the page must hold.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::*;
use crate::cost::configuration::Resolution;
use crate::cost::scaling::Axis;
use crate::cost::store::{About, RunRecord, SceneRecord};
use crate::cost::votes::{Estimate, Side};
use crate::render::{AdapterRecord, Clock};

fn record(is_software: bool) -> SweepRecord {
    let run = |date: &str| RunRecord {
        date: date.to_owned(),
        command: String::from("greyfield cost <set>.toml"),
    };
    let reach = SceneRecord {
        sha256: String::new(),
        reach_m: 2.0,
    };
    SweepRecord {
        about: About {
            schema_version: 1,
            app_version: String::from("0.1.0"),
            adapter: AdapterRecord {
                name: String::from("An & adapter"),
                backend: String::from("vulkan"),
                kind: String::from("discrete GPU"),
                driver: String::from("driver 1"),
            },
            is_software,
            size_px: (320, 180),
            seed: 1,
            truth_error: 0.01,
            pixels_per_degree: 67.0,
        },
        scenes: BTreeMap::from([(String::from("hall"), reach)]),
        runs: vec![run("2010-01-01"), run("2010-01-02")],
    }
}

fn row(technique: &str, samples: u32, (total_ms, rmse): (f64, f64)) -> Row {
    let interval = (total_ms > 0.0).then_some((0.9 * total_ms, 1.1 * total_ms));
    Row {
        scene: String::from("hall"),
        lighting: String::from("low"),
        configuration: format!("{technique}-{samples}-full-b4"),
        technique: technique.to_owned(),
        label: format!("{technique}-{samples}"),
        samples,
        resolution: Resolution::Full,
        blur_px: 4,
        parameters: String::new(),
        total_ms,
        total_low_ms: interval.map(|ends| ends.0),
        total_high_ms: interval.map(|ends| ends.1),
        occlusion_ms: None,
        blur_ms: None,
        upsample_ms: None,
        frames: 10,
        clock: Some(Clock::GpuTimestamps),
        rmse,
        mae: rmse,
        p95: rmse,
        bias: -rmse,
        estimator_rmse: 0.5 * rmse,
        estimator_bias: 0.0,
        information_loss_rmse: 0.05,
        thickness_m: f32::INFINITY,
        truth_error: 0.01,
        flip_mean: 0.5 * rmse,
        flip_p95: rmse,
        ssim: 0.9,
        reach_m: 2.0,
        width_px: 320,
        height_px: 180,
        adapter: String::new(),
        run: 1,
    }
}

fn rows() -> Vec<Row> {
    let mut none = row("none", 0, (0.0, 0.3));
    none.label = String::from("none");
    none.clock = None;
    let mut named = row("b<ao>", 24, (7.0, 0.12));
    named.label = String::from("\"b\" & 24");
    vec![
        none,
        row("alpha", 4, (1.0, 0.25)),
        row("alpha", 16, (2.0, 0.2)),
        row("alpha", 64, (8.0, 0.18)),
        row("b<ao>", 4, (3.0, 0.15)),
        row("b<ao>", 16, (6.0, 0.1)),
        named,
    ]
}

fn growth(technique: &str, axis: Axis, value: f64, ms: f64) -> ScalingRow {
    ScalingRow {
        scene: String::from("hall"),
        technique: technique.to_owned(),
        axis,
        value,
        ms,
        low_ms: None,
        high_ms: None,
        frames: 3,
    }
}

fn preference(ms: (f64, f64), share: f64) -> Preference {
    let side = |label: &str, ms: f64| Side {
        label: label.to_owned(),
        votes: 10,
        ms,
        rmse: 0.1,
        flip_mean: 0.1,
    };
    Preference {
        condition: String::from("hall-low"),
        scene: String::from("hall"),
        validity: String::from("low"),
        hypothesis: String::from("H1"),
        a: side("none", ms.0),
        b: side("alpha-16", ms.1),
        share_b: Estimate {
            value: share,
            low: 0.5 * share,
            high: 0.5 + 0.5 * share,
        },
        jod_b: None,
        points_per_ms: None,
    }
}

/// Every number in a coordinate of a figure lies inside its view box.
fn assert_inside(svg: &str) {
    let quoted = |text: &str| text.split('"').next().unwrap().to_owned();
    let size: Vec<f64> = (quoted(svg.split("viewBox=\"").nth(1).unwrap()).split(' '))
        .map(|number| number.parse().unwrap())
        .collect();
    let check = |name: &str, most: f64| {
        for part in svg.split(&format!(" {name}=\"")).skip(1) {
            let value: f64 = quoted(part).parse().unwrap();
            assert!((-0.01..=most + 0.01).contains(&value), "{name} {value}");
        }
    };
    for name in ["x", "x1", "x2", "cx"] {
        check(name, size[2]);
    }
    for name in ["y", "y1", "y2", "cy"] {
        check(name, size[3]);
    }
    for part in svg.split(" points=\"").skip(1) {
        for pair in quoted(part).split(' ') {
            let (x, y) = pair.split_once(',').unwrap();
            let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
            assert!((-0.01..=size[2] + 0.01).contains(&x), "x {x}");
            assert!((-0.01..=size[3] + 0.01).contains(&y), "y {y}");
        }
    }
}

#[test]
fn a_plane_names_each_technique_once_and_what_it_is_measured_against() {
    let (record, rows) = (record(true), rows());
    let svg = plane(&CostReport::of(&record, &rows), "hall");
    assert_inside(&svg);
    assert_eq!(svg.matches(">alpha<").count(), 1, "{svg}");
    assert_eq!(svg.matches(">b&lt;ao&gt;<").count(), 1);
    assert!(svg.contains("&quot;b&quot; &amp; 24") && !svg.contains("<ao>"));
    for said in [
        "no occlusion",
        "the most that depths tell",
        "class=\"front\"",
        "ratios only",
        "2010-01-01: greyfield",
    ] {
        assert!(svg.contains(said), "{said}");
    }
    assert!(
        !svg.contains("2010-01-02"),
        "a run without rows is not named"
    );
}

#[test]
fn rows_of_two_runs_are_warned_of() {
    let (record, mut rows) = (record(false), rows());
    let before = plane(&CostReport::of(&record, &rows), "hall");
    assert!(!before.contains("within a run only") && !before.contains("ratios only"));
    rows[2].run = 2;
    let after = plane(&CostReport::of(&record, &rows), "hall");
    assert!(after.contains("Rows of 2 runs") && after.contains("2010-01-02"));
}

#[test]
fn a_technique_looks_the_same_in_every_figure() {
    let (record, rows) = (record(false), rows());
    let report = CostReport::of(&record, &rows);
    let palette = palette::Palette::of(&report);
    let looks: Vec<_> = palette
        .names()
        .iter()
        .map(|name| palette.look(name))
        .collect();
    assert_eq!(palette.names(), ["alpha", "b<ao>"]);
    assert_ne!(looks[0], looks[1]);
    let drawn = [
        plane(&report, "hall"),
        flip_plane(&report, "hall"),
        estimator(&report),
    ];
    assert!(
        drawn
            .iter()
            .all(|svg| svg.contains("mark t0") && svg.contains("mark t1"))
    );
    drawn.iter().for_each(|svg| assert_inside(svg));
}

/// A browser loads by these; a name space of SVG is a name, and loads nothing.
#[test]
fn the_page_loads_nothing_and_holds_everything() {
    let (record, rows) = (record(false), rows());
    let scaling = [1.0, 2.0].map(|value| growth("alpha", Axis::Pixels, value, value));
    let preferences = [preference((0.0, 2.0), 0.8)];
    let pictures = [PagePicture {
        scene: String::from("hall"),
        subject: String::from("alpha"),
        caption: String::from("alpha < truth"),
        mime: "image/png",
        bytes: vec![1, 2, 3],
    }];
    let report = CostReport {
        scaling: &scaling,
        preferences: &preferences,
        votes_source: "votes of 20 people",
        pictures: &pictures,
        ..CostReport::of(&record, &rows)
    };
    let text = page(&report);
    let links = text.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    assert!(!links.contains("http:") && !links.contains("https:"));
    assert!(!text.contains("<script") && !text.contains("url(") && !text.contains("@import"));
    assert!(
        text.contains("src=\"data:image/png;base64,AQID\"") && text.contains("alpha &lt; truth")
    );
    for said in [
        "the front bends here",
        "How time grows",
        "Votes of 20 people",
        "Raghavan",
    ] {
        assert!(text.contains(said), "{said}");
    }
    assert_eq!(text, page(&report));
    let names: Vec<String> = report
        .figures()
        .into_iter()
        .map(|figure| figure.0)
        .collect();
    assert_eq!(
        names,
        [
            "plane--hall",
            "flip--hall",
            "estimator",
            "scaling--hall",
            "preferences"
        ]
    );
}

#[test]
fn a_sweep_that_has_found_nothing_has_a_page() {
    let record = record(false);
    let report = CostReport::of(&record, &[]);
    assert!(report.figures().is_empty() && page(&report).ends_with("</html>\n"));
    assert_inside(&plane(&report, "nowhere"));
    assert_inside(&flip_plane(&report, "nowhere"));
    assert_inside(&estimator(&report));
    assert_inside(&scaling(&report, "nowhere"));
    assert_inside(&preferences(&report));
}

#[test]
fn tables_have_a_column_a_number() {
    let lines = preferences_csv(&[preference((0.0, 2.0), 0.8)]).unwrap();
    assert!(lines.starts_with("condition,scene,validity,hypothesis,technique_a,technique_b,votes_a,votes_b,a_ms,b_ms,extra_ms"));
    assert!(lines.contains("hall-low,hall,low,H1,none,alpha-16,10,10,0.0,2.0,2.0"));
    let lines = scaling_csv(&[growth("alpha", Axis::Radius, 0.5, 3.0)]).unwrap();
    assert_eq!(lines.lines().nth(1), Some("hall,alpha,radius,0.5,3.0,,,3"));
    assert_eq!(exponents_csv(&[]).unwrap(), "");
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        1e-9_f64..1e-3,
        0.0_f64..1.0,
        1.0_f64..1e9,
        Just(f64::NAN),
        Just(f64::INFINITY)
    ]
}

prop_compose! {
    fn any_row()(
        technique in "[a-c<&]{1,12}",
        samples in 0_u32..300,
        numbers in (any_number(), any_number(), any_number(), any_number()),
        low in prop::option::of(any_number()),
        high in prop::option::of(any_number()),
        half in any::<bool>(),
        is_named in any::<bool>(),
        blur_px in 0_u32..3,
    ) -> Row {
        let mut row = row(&technique, samples, (numbers.0, numbers.1));
        row.flip_mean = numbers.2;
        row.information_loss_rmse = numbers.3;
        (row.total_low_ms, row.total_high_ms) = (low, high);
        row.blur_px = blur_px;
        if half { row.resolution = Resolution::Half; }
        if is_named { row.label = String::from("named"); }
        row
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn all_that_is_drawn_is_inside(rows in prop::collection::vec(any_row(), 0..30)) {
        let record = record(true);
        let report = CostReport::of(&record, &rows);
        for (_, svg) in report.figures() {
            assert_inside(&svg);
        }
    }

    #[test]
    fn so_are_growth_and_choices(
        values in prop::collection::vec((any_number(), any_number()), 0..12),
        shares in prop::collection::vec((any_number(), any_number(), 0.0_f64..=1.0), 0..8),
    ) {
        let record = record(false);
        let axis = |k: usize| Axis::ALL[k % 4];
        let scaling: Vec<_> = (values.iter().enumerate())
            .map(|(k, (value, ms))| growth("alpha", axis(k), *value, *ms))
            .collect();
        let preferences: Vec<_> = (shares.iter())
            .map(|(a, b, share)| preference((*a, *b), *share))
            .collect();
        let report = CostReport {
            scaling: &scaling,
            preferences: &preferences,
            ..CostReport::of(&record, &[])
        };
        for (_, svg) in report.figures() {
            assert_inside(&svg);
        }
    }
}
