use super::*;
use crate::protocol::{Pair, exhibit};
use std::path::Path;

const PROTOCOLS: [(&str, &str); 6] = [
    (
        "thesis-2010",
        include_str!("../../../protocols/thesis-2010.toml"),
    ),
    (
        "sundstedt-2007",
        include_str!("../../../protocols/sundstedt-2007.toml"),
    ),
    (
        "jimenez-2009",
        include_str!("../../../protocols/jimenez-2009.toml"),
    ),
    (
        "kozlowski-kautz-2007",
        include_str!("../../../protocols/kozlowski-kautz-2007.toml"),
    ),
    (
        "yu-2009-reference",
        include_str!("../../../protocols/yu-2009-reference.toml"),
    ),
    (
        "yu-2009-ranking",
        include_str!("../../../protocols/yu-2009-ranking.toml"),
    ),
];

/// Conditions such as the protocol needs: its practice and its checks, and some of its own.
fn conditions(protocol: &Protocol) -> Vec<Condition> {
    let pair = |id: &str, scene: &str, techniques: [&str; 2], hypothesis: &str| Pair {
        id: id.to_owned(),
        scene: scene.to_owned(),
        lighting: "high".to_owned(),
        techniques: techniques.map(str::to_owned),
        image_sha256: techniques.map(|technique| format!("{scene}-{technique}")),
        hypothesis: hypothesis.to_owned(),
    };
    let mut pairs = vec![
        pair("atrium-h1", "atrium", ["none", "gtao18"], "H1"),
        pair("atrium-h2", "atrium", ["crytek24", "gtao18"], "H2"),
        pair("figures-h1", "figures", ["none", "gtao18"], "H1"),
        pair("shapes-none-gtao18", "shapes", ["none", "gtao18"], ""),
        pair("shapes-none-traced", "shapes", ["none", "traced"], ""),
    ];
    for scene in ["atrium", "figures", "figurine"] {
        pairs.push(pair(
            &format!("{scene}-none-traced"),
            scene,
            ["none", "traced"],
            "",
        ));
    }
    let mut conditions: Vec<Condition> = (exhibit::exhibits(protocol, &pairs).unwrap().into_iter())
        .map(|it| it.condition)
        .collect();
    // The ranking's practice is a view of its own name.
    if let Some(view) = conditions.iter_mut().find(|it| it.id == "shapes-high") {
        view.id = "shapes-white".to_owned();
    }
    conditions
}

fn written(text: &str, change: impl FnOnce(&mut Facts<'_>)) -> String {
    let protocol = Protocol::parse(Path::new("p.toml"), text).unwrap();
    let conditions = conditions(&protocol);
    let mut facts = Facts {
        protocol: &protocol,
        set: SetFacts {
            id: "the-set".into(),
            title: "The set".into(),
            sha256: "5e7".into(),
            size_px: Some((1280, 720)),
        },
        conditions: &conditions,
        hypotheses: BTreeMap::new(),
        analysis: AnalysisPlan::default(),
    };
    change(&mut facts);
    super::text(&facts).unwrap()
}

const HEADINGS: [&str; 24] = [
    "# Preregistration: ",
    "## Study information",
    "### Description",
    "### Hypotheses",
    "## Design plan",
    "### Study type",
    "### Blinding",
    "### Study design",
    "### Randomization",
    "## Sampling plan",
    "### Existing data",
    "### Sample size",
    "### Sample size rationale",
    "### Stopping rule",
    "## Variables",
    "### Manipulated variables",
    "### Measured variables",
    "## Analysis plan",
    "### Statistical models",
    "### Inference criteria",
    "### Data exclusion",
    "### Missing data",
    "### Exploratory and secondary analyses",
    "## Other",
];

#[test]
fn every_shipped_protocol_has_every_part_in_order() {
    for (id, protocol) in PROTOCOLS {
        let text = written(protocol, |_| {});
        let mut at = 0;
        for heading in HEADINGS {
            let found = text[at..]
                .find(heading)
                .unwrap_or_else(|| panic!("{id}: {heading}"));
            at += found;
        }
        assert_eq!(text, written(protocol, |_| {}), "{id}: not the same again");
        for empty in [
            "TODO", "TBD", "XXX", "NaN", "inf ", "{", "}", "[]", "  \n", "\n\n\n",
        ] {
            assert!(!text.contains(empty), "{id}: {empty:?} in\n{text}");
        }
        // No heading without a word under it.
        let lines: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
        for pair in lines.windows(2).filter(|pair| pair[0].starts_with("### ")) {
            assert!(!pair[1].starts_with('#'), "{id}: nothing under {}", pair[0]);
        }
    }
}

#[test]
fn what_is_laid_down_is_said_word_for_word() {
    for (id, protocol) in PROTOCOLS {
        let parsed = Protocol::parse(Path::new("p.toml"), protocol).unwrap();
        let words = parsed.words(parsed.language);
        let text = written(protocol, |_| {});
        let planned = parsed.planned_participants.get();
        for part in [
            words.question.clone(),
            parsed.hash.clone(),
            format!("seed {}", parsed.seed),
            format!("`{}`", parsed.design.name),
            format!("`{}`", parsed.procedure.name),
            format!("{planned} participants"),
            format!("{} ms", parsed.grey.duration.get()),
            format!("level {}", parsed.grey.level_srgb.get()),
            crate::seed::GENERATOR.to_owned(),
            env!("CARGO_PKG_VERSION").to_owned(),
        ] {
            assert!(text.contains(&part), "{id}: {part:?}");
        }
        for line in words
            .instructions
            .lines()
            .filter(|line| !line.trim().is_empty())
        {
            assert!(text.contains(line.trim()), "{id}: {line:?}");
        }
    }
}

/// Eight conditions here: a block of 16.
#[test]
fn power_and_blocks_are_those_of_the_planned_number() {
    let text = written(PROTOCOLS[0].1, |_| {});
    assert!(text.contains("| 0.65 | 0.356 |"), "{text}");
    // 32 in two blocks; the four more are all in base order.
    for part in [
        "no multiple of a full block of 16",
        "after 2 full blocks 4 are left over, and 48 would fill the next",
        "each pair is reversed 16 times and in its base order 20 times",
    ] {
        assert!(text.contains(part), "{part:?} in\n{text}");
    }
    let full = PROTOCOLS[0]
        .1
        .replace("planned_participants = 36", "planned_participants = 32");
    let text = written(&full, |_| {});
    assert!(
        text.contains("2 full blocks of 16: every condition"),
        "{text}"
    );
}

/// Four scenes on two scales.
#[test]
fn ratings_are_tested_once_a_scene_and_scale() {
    let text = written(PROTOCOLS[3].1, |_| {});
    assert!(text.contains("all scenes and scales (8 tests)"), "{text}");
    assert!(text.contains("family of 8,"), "{text}");
}

/// The protocol's own tables are what the text is made from.
#[test]
fn the_tables_of_a_protocol_are_read() {
    let text = format!(
        "{}\n[hypotheses]\nH9 = \"Something else.\"\n[analysis]\nalpha = 0.01\nminimum_response_ms = 250\n",
        PROTOCOLS[1].1
    );
    let protocol = Protocol::parse(Path::new("p.toml"), &text).unwrap();
    assert_eq!(hypotheses(&protocol)["H9"], "Something else.");
    let plan = AnalysisPlan::of(&protocol);
    assert!((plan.alpha.get() - 0.01).abs() < 1e-15);
    assert_eq!(plan.minimum_response_ms, Some(250.0));
    assert_eq!(plan.maximum_response_ms, None);
    let thesis = Protocol::parse(Path::new("t.toml"), PROTOCOLS[0].1).unwrap();
    let names: Vec<String> = hypotheses(&thesis).into_keys().collect();
    assert_eq!(names, ["H1", "H2", "H3"]);
}

#[test]
fn hypotheses_and_rules_of_the_protocol_are_taken_over() {
    let text = written(PROTOCOLS[4].1, |facts| {
        facts
            .hypotheses
            .insert("H1".into(), "Occlusion is seen".into());
        facts
            .hypotheses
            .insert("H3".into(), "It depends on the scene.".into());
        facts.analysis = AnalysisPlan {
            alpha: Alpha::try_from(0.01).unwrap(),
            family: vec!["atrium-h1".into(), "figures-h1".into()],
            minimum_response_ms: Some(250.0),
            maximum_response_ms: Some(60_000.0),
            exclude_failed_catch: true,
            minimum_main_trials: Some(2),
        };
    });
    for part in [
        "**H1.** Occlusion is seen. Asked by atrium-h1 and figures-h1.",
        "**H2.** One of the two techniques",
        "**H3.** It depends on the scene.\n",
        "alpha = 0.01",
        "the 2 conditions atrium-h1 and figures-h1",
        "faster than 250 ms",
        "slower than 60000 ms",
        "fewer than 2 of the 3 attention checks",
        "fewer than 2 answered main trials",
        "confidence of 99 %",
    ] {
        assert!(text.contains(part), "{part:?} in\n{text}");
    }
}
