//! What the kinds of exhibits make of a set's pairs.

use std::path::Path;

use super::*;

fn protocol(text: &str) -> Protocol {
    Protocol::parse(Path::new("p.toml"), text).unwrap()
}

fn pair(id: &str, scene: &str, lighting: &str, techniques: [&str; 2]) -> Pair {
    Pair {
        id: id.to_owned(),
        scene: scene.to_owned(),
        lighting: lighting.to_owned(),
        techniques: techniques.map(str::to_owned),
        image_sha256: techniques.map(|technique| format!("{scene}-{lighting}-{technique}")),
        hypothesis: String::new(),
    }
}

fn set() -> Vec<Pair> {
    vec![
        pair("a", "atrium", "low", ["none", "gtao"]),
        pair("b", "atrium", "low", ["crytek", "gtao"]),
        pair("c", "atrium", "high", ["none", "gtao"]),
        pair("truth-low", "atrium", "low", ["none", "traced"]),
        pair("truth-high", "atrium", "high", ["none", "traced"]),
    ]
}

fn ids(exhibits: &[Exhibit]) -> Vec<&str> {
    exhibits.iter().map(|it| it.condition.id.as_str()).collect()
}

const RATING: &str = include_str!("../../../protocols/kozlowski-kautz-2007.toml");
const REFERENCE: &str = include_str!("../../../protocols/yu-2009-reference.toml");
const RANKING: &str = include_str!("../../../protocols/yu-2009-ranking.toml");

#[test]
fn singles_are_every_different_image_once() {
    let exhibits = exhibits(&protocol(RATING), &set()).unwrap();
    assert_eq!(
        ids(&exhibits),
        [
            "atrium-low-none",
            "atrium-low-gtao",
            "atrium-low-crytek",
            "atrium-low-traced",
            "atrium-high-none",
            "atrium-high-gtao",
            "atrium-high-traced"
        ]
    );
    for exhibit in &exhibits {
        let [image] = exhibit.images[..] else {
            panic!()
        };
        let pair = &set()[image.pair];
        let place = image.position.place();
        assert_eq!(pair.techniques[place], exhibit.condition.techniques[0]);
    }
}

#[test]
fn two_images_of_one_name_that_differ_make_no_plan() {
    let mut set = set();
    set[1].image_sha256[1] = "another".to_owned();
    let exhibits = exhibits(&protocol(RATING), &set).unwrap();
    let conditions: Vec<Condition> = exhibits.into_iter().map(|it| it.condition).collect();
    assert_eq!(
        crate::protocol::SessionPlan::new(&protocol(RATING), &conditions, 0),
        Err(PlanError::DuplicateCondition("atrium-low-gtao".to_owned()))
    );
}

#[test]
fn a_pair_is_compared_with_the_reference_of_its_own_view() {
    // Neither practice nor catch trials of this set are named.
    let plain: String = REFERENCE
        .split("[practice]")
        .next()
        .into_iter()
        .chain(["[texts]"])
        .chain(REFERENCE.split("[texts]").nth(1))
        .collect();
    let exhibits = exhibits(&protocol(&plain), &set()).unwrap();
    assert_eq!(ids(&exhibits), ["a", "b", "c"]);
    let references: Vec<usize> = exhibits
        .iter()
        .filter_map(|it| it.reference.map(|image| image.pair))
        .collect();
    assert_eq!(references, [3, 3, 4], "of the same lighting");
    let without = &set()[..4];
    assert_eq!(
        super::exhibits(&protocol(&plain), without),
        Err(PlanError::NoReference {
            pair: "c".to_owned(),
            technique: "traced".to_owned()
        })
    );
}

#[test]
fn versions_are_all_different_images_of_a_view() {
    let exhibits = exhibits(&protocol(RANKING), &set()).unwrap();
    assert_eq!(ids(&exhibits), ["atrium-low", "atrium-high"]);
    assert_eq!(
        exhibits[0].condition.techniques,
        ["none", "gtao", "crytek", "traced"]
    );
}

#[test]
fn two_images_of_one_name_cannot_be_ranked() {
    let mut set = set();
    set[1].image_sha256[1] = "another".to_owned();
    assert_eq!(
        exhibits(&protocol(RANKING), &set),
        Err(PlanError::TwoImages {
            view: "atrium-low".to_owned(),
            technique: "gtao".to_owned()
        })
    );
}

#[test]
fn conditions_of_older_results_folders_are_still_read() {
    let old = r#"{"id":"a","scene":"atrium","first_technique":"none","second_technique":"gtao","hypothesis":"H1"}"#;
    let condition: Condition = serde_json::from_str(old).unwrap();
    assert_eq!(condition.techniques, ["none", "gtao"]);
    let again: Condition =
        serde_json::from_str(&serde_json::to_string(&condition).unwrap()).unwrap();
    assert_eq!(again, condition);
}
