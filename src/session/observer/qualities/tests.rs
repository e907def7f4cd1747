use std::cell::RefCell;
use std::path::Path;

use super::*;
use crate::config::ParameterValue;
use crate::stimulus::manifest::SCHEMA_VERSION;

const THESIS: &str = include_str!("../../../../protocols/thesis-2010.toml");
const RATING: &str = include_str!("../../../../protocols/kozlowski-kautz-2007.toml");

/// An image is its label and a number; the number alone tells images apart.
pub type Image = (&'static str, u32);

/// Pairs of a lighting and two images, all of one scene.
pub fn manifest(pairs: &[(&str, Image, Image)]) -> Manifest {
    let image = |(label, number): Image| ImageRecord {
        file: format!("{number}.png").into(),
        sha256: number.to_string(),
        width_px: 1,
        height_px: 1,
        technique: label.to_owned(),
        parameters: BTreeMap::new(),
        passes: Vec::new(),
        source: None,
    };
    let pair = |(index, &(lighting, first, second)): (usize, &(&str, Image, Image))| PairRecord {
        condition: format!("c{index}"),
        scene: "hall".to_owned(),
        validity: lighting.to_owned(),
        hypothesis: String::new(),
        first: image(first),
        second: image(second),
    };
    Manifest {
        schema_version: SCHEMA_VERSION,
        set_id: "set".to_owned(),
        config_sha256: String::new(),
        seed: 0,
        app_version: String::new(),
        adapter: None,
        pairs: pairs.iter().enumerate().map(pair).collect(),
    }
}

/// Images are as far apart as their numbers; gives also what was compared.
fn measured(
    protocol: &str,
    manifest: &Manifest,
    truth: Option<&str>,
) -> (Result<Qualities, String>, Vec<[String; 2]>) {
    let protocol = Protocol::parse(Path::new("p.toml"), protocol).unwrap();
    let asked = RefCell::new(Vec::new());
    let distances = |_, pairs: &[[&ImageRecord; 2]]| {
        let numbers = pairs.iter().map(sha256).map(|hashes| {
            asked.borrow_mut().push(hashes.map(str::to_owned));
            hashes.map(|hash| hash.parse::<f64>().unwrap())
        });
        Ok(numbers.map(|[a, b]| (a - b).abs()).collect())
    };
    let needs = Needs {
        protocol: &protocol,
        manifest,
        distances: &distances,
    };
    let found = Qualities::measure(&needs, Metric::Flip, truth);
    (found, asked.into_inner())
}

#[test]
fn without_a_truth_the_second_of_each_pair_stands_for_it() {
    let set = manifest(&[
        ("low", ("none", 10), ("fine", 17)),
        ("low", ("coarse", 12), ("finest", 30)),
    ]);
    let (found, asked) = measured(THESIS, &set, None);
    let found = found.unwrap();
    assert_eq!(
        (found.of("c0", "none"), found.of("c0", "fine")),
        (-7.0, 0.0)
    );
    assert_eq!(
        (found.of("c1", "coarse"), found.of("c1", "finest")),
        (-18.0, 0.0)
    );
    assert_eq!(found.range(), (-18.0, 0.0));
    assert_eq!(asked.len(), 2, "an image and itself are not compared");
}

/// One truth serves every pair of its view, and none of another view.
#[test]
fn a_ray_traced_image_is_the_truth_of_its_view() {
    let set = manifest(&[
        ("low", ("none", 10), ("fine", 17)),
        ("low", ("fine", 17), ("ray-traced", 20)),
        ("high", ("none", 40), ("fine", 41)),
    ]);
    let (found, asked) = measured(THESIS, &set, None);
    let found = found.unwrap();
    assert_eq!(
        (found.of("c0", "none"), found.of("c0", "fine")),
        (-10.0, -3.0)
    );
    assert_eq!(
        (found.of("c1", "fine"), found.of("c1", "ray-traced")),
        (-3.0, 0.0)
    );
    assert_eq!(
        (found.of("c2", "none"), found.of("c2", "fine")),
        (-1.0, 0.0)
    );
    assert_eq!(asked.len(), 3, "the same two images once: {asked:?}");
}

#[test]
fn a_traced_image_of_another_label_is_known_by_its_parameters() {
    let mut set = manifest(&[
        ("low", ("none", 10), ("fine", 17)),
        ("low", ("truth", 20), ("fine", 17)),
    ]);
    let rays = |image: &mut ImageRecord| {
        let rays = ParameterValue::Number(64.0);
        image.parameters.insert(TRUTH_PARAMETER.to_owned(), rays);
    };
    rays(&mut set.pairs[1].first);
    let (found, _) = measured(THESIS, &set, None);
    assert_eq!(found.unwrap().of("c0", "none"), -10.0);
    // Two of them: nobody can say which is meant.
    rays(&mut set.pairs[0].first);
    let (found, _) = measured(THESIS, &set, None);
    assert_eq!(found.unwrap().of("c0", "none"), -7.0);
}

#[test]
fn a_named_truth_goes_first_and_must_exist() {
    let set = manifest(&[("low", ("none", 10), ("ray-traced", 20))]);
    let (found, _) = measured(THESIS, &set, Some("none"));
    assert_eq!(found.unwrap().of("c0", "ray-traced"), -10.0);
    let message = measured(THESIS, &set, Some("nobody")).0.unwrap_err();
    for part in ["truth=nobody", "none, ray-traced"] {
        assert!(message.contains(part), "{message}");
    }
}

/// Images shown alone have no pair: one image of the view stands for the truth of all.
#[test]
fn single_images_are_compared_with_the_last_of_their_view() {
    let set = manifest(&[
        ("low", ("none", 10), ("fine", 17)),
        ("low", ("coarse", 12), ("finest", 30)),
    ]);
    let found = measured(RATING, &set, None).0.unwrap();
    let quality = |technique: &str| found.of(&format!("hall-low-{technique}"), technique);
    let qualities = ["none", "fine", "coarse", "finest"].map(quality);
    assert_eq!(qualities, [-20.0, -13.0, -18.0, 0.0]);
}

#[test]
fn where_there_is_a_reference_it_is_what_counts() {
    let text = include_str!("../../../../protocols/yu-2009-reference.toml");
    let start = text.find("[practice]").unwrap();
    let end = text.find("[texts]").unwrap();
    let protocol = format!("{}{}", &text[..start], &text[end..]);
    let set = manifest(&[
        ("low", ("none", 10), ("fine", 17)),
        ("low", ("ray-traced", 100), ("traced", 15)),
    ]);
    let found = measured(&protocol, &set, None).0.unwrap();
    assert_eq!(
        (found.of("c0", "none"), found.of("c0", "fine")),
        (-5.0, -2.0)
    );
}

#[test]
fn what_cannot_be_compared_is_said() {
    let protocol = Protocol::parse(Path::new("p.toml"), THESIS).unwrap();
    let set = manifest(&[("low", ("none", 10), ("fine", 17))]);
    let with = |distances: &Distances<'_>| {
        let needs = Needs {
            protocol: &protocol,
            manifest: &set,
            distances,
        };
        Qualities::measure(&needs, Metric::Flip, None).unwrap_err()
    };
    assert_eq!(with(&|_, _| Err("it is gone".to_owned())), "it is gone");
    assert!(with(&|_, _| Ok(vec![f64::NAN])).contains("every image"));
    assert!(with(&|_, _| Ok(Vec::new())).contains("every image"));
}
