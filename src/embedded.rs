//! The study that is inside the program, so that it runs anywhere: the configs of the
//! repository, byte for byte.

use std::io;
use std::path::{Path, PathBuf};

/// Paths and contents of the embedded configs.
pub const FILES: &[(&str, &str)] = &[
    (
        "protocols/thesis-2010.toml",
        include_str!("../protocols/thesis-2010.toml"),
    ),
    (
        "stimuli/thesis-2010.toml",
        include_str!("../stimuli/thesis-2010.toml"),
    ),
    (VOTES, include_str!("../stimuli/thesis-2010-votes.csv")),
    (
        "stimuli/validity.toml",
        include_str!("../stimuli/validity.toml"),
    ),
    (
        "stimuli/techniques.toml",
        include_str!("../stimuli/techniques.toml"),
    ),
    (
        "stimuli/scenes/atrium.toml",
        include_str!("../stimuli/scenes/atrium.toml"),
    ),
    (
        "stimuli/scenes/figurine.toml",
        include_str!("../stimuli/scenes/figurine.toml"),
    ),
    (
        "stimuli/scenes/figures.toml",
        include_str!("../stimuli/scenes/figures.toml"),
    ),
    (
        "stimuli/scenes/shapes.toml",
        include_str!("../stimuli/scenes/shapes.toml"),
    ),
];

/// The protocol of the embedded study, among [`FILES`].
pub const PROTOCOL: &str = "protocols/thesis-2010.toml";

/// Its stimulus set, among [`FILES`].
pub const STIMULI: &str = "stimuli/thesis-2010.toml";

/// The votes of the 36 participants of 2010, by condition of [`STIMULI`] (thesis, table 4), among
/// [`FILES`]. They saw the images of 2010, not Greyfield's.
pub const VOTES: &str = "stimuli/thesis-2010-votes.csv";

/// Writes the configs under `folder`. A file that is there already stays as it is, because
/// somebody may have edited it; those that differ from the embedded ones are returned.
///
/// # Errors
/// The file that could not be written or read, and why.
pub fn unpack(folder: &Path) -> Result<Vec<PathBuf>, (PathBuf, io::Error)> {
    let mut kept = Vec::new();
    for (name, content) in FILES {
        let path = folder.join(name);
        let failed = |error| (path.clone(), error);
        match std::fs::read(&path) {
            Ok(found) if found == content.as_bytes() => {}
            Ok(_) => kept.push(path),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let parent = path.parent().unwrap_or(folder);
                std::fs::create_dir_all(parent).map_err(failed)?;
                std::fs::write(&path, content).map_err(failed)?;
            }
            Err(error) => return Err((path, error)),
        }
    }
    Ok(kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::Protocol;
    use crate::render::plan::{FramePlan, GeometryFacts};
    use crate::render::technique::{Settings, TECHNIQUES};
    use crate::scene::ModelLights;
    use crate::stimulus::StimulusSet;
    use crate::stimulus::set::RenderedPair;

    /// What the shipped scenes are: normal maps, no lamps, nothing baked, sky in view.
    const FACTS: GeometryFacts = GeometryFacts {
        triangles: 1,
        has_normal_maps: true,
        emits: false,
        has_baked_occlusion: false,
        uncovered: Some(true),
        lights: ModelLights {
            suns: Vec::new(),
            points: Vec::new(),
        },
    };

    #[test]
    fn the_embedded_study_is_whole() {
        let dir = tempfile::tempdir().unwrap();
        assert!(unpack(dir.path()).unwrap().is_empty());
        let set = StimulusSet::load(&dir.path().join(STIMULI)).unwrap();
        let path = dir.path().join(PROTOCOL);
        let text = std::fs::read_to_string(&path).unwrap();
        let protocol = Protocol::parse(&path, &text).unwrap();
        let named = protocol.stimulus_set(&path);
        assert_eq!(
            named.canonicalize().unwrap(),
            dir.path().join(STIMULI).canonicalize().unwrap()
        );
        assert_eq!(set.size_px, Some((1280, 720)));
    }

    /// The seven conditions, as the thesis' chapter 5.3 and table 4 have them.
    #[test]
    fn the_conditions_are_those_of_2010() {
        let dir = tempfile::tempdir().unwrap();
        unpack(dir.path()).unwrap();
        let set = StimulusSet::load(&dir.path().join(STIMULI)).unwrap();
        let found: Vec<[&str; 5]> = set
            .conditions
            .iter()
            .map(|c| {
                let [first, second] = c.labels();
                [&c.id, &c.validity, first, second, &c.hypothesis]
            })
            .collect();
        let expected = [
            ["dragon-low", "low", "crytek24", "blizzard24", "H2"],
            ["sponza-moderate-h1", "moderate", "none", "blizzard24", "H1"],
            [
                "sponza-moderate-h2",
                "moderate",
                "crytek24",
                "blizzard24",
                "H2",
            ],
            [
                "characters-moderate",
                "moderate",
                "blizzard8",
                "ray-march30",
                "H2",
            ],
            ["sponza-high-h1", "high", "none", "blizzard24", "H1"],
            ["sponza-high-h2", "high", "crytek24", "blizzard24", "H2"],
            ["characters-high", "high", "none", "blizzard24", "H1"],
        ];
        assert_eq!(found, expected);
    }

    fn passes_of(
        set: &StimulusSet,
        pair: &RenderedPair,
        technique: &Settings,
    ) -> Vec<&'static str> {
        let plan = FramePlan::new(&set.request(pair, technique), &FACTS);
        plan.passes.iter().map(|pass| pass.kind.name()).collect()
    }

    /// Each lighting brings its passes, each technique its own, and nothing else runs: in every
    /// scene at every level of validity.
    #[test]
    fn every_picture_runs_what_it_calls_for() {
        let dir = tempfile::tempdir().unwrap();
        unpack(dir.path()).unwrap();
        for (name, pictures) in [(STIMULI, 7), ("stimuli/validity.toml", 9)] {
            let set = StimulusSet::load(&dir.path().join(name)).unwrap();
            assert_eq!(set.rendered().count(), pictures);
            hold_plans(&set);
        }
    }

    fn hold_plans(set: &StimulusSet) {
        for (condition, pair) in set.rendered() {
            for technique in [&pair.first, &pair.second] {
                let mut expected = vec!["geometry"];
                if condition.validity == "high" {
                    expected.extend(["shadow-map", "shadow-filter"]);
                }
                if technique.label != "none" {
                    expected.extend(["occlusion", "blur-rows", "blur-columns"]);
                }
                expected.extend(match condition.validity.as_str() {
                    "low" => vec!["shade"],
                    "moderate" => vec!["ambient", "skybox", "output"],
                    _ => vec!["ambient", "sun", "skybox", "output"],
                });
                let found = passes_of(set, pair, technique);
                assert_eq!(found, expected, "{} {}", condition.id, technique.label);
            }
        }
    }

    /// So that a new technique is not left out of the set that shows them all, nor one of the
    /// two readings of the thesis' techniques; and each stands beside the same truth.
    #[test]
    fn the_set_of_techniques_has_every_technique() {
        let dir = tempfile::tempdir().unwrap();
        unpack(dir.path()).unwrap();
        let set = StimulusSet::load(&dir.path().join("stimuli/techniques.toml")).unwrap();
        let firsts = || set.rendered().map(|(_, pair)| &pair.first);
        for technique in TECHNIQUES.iter().filter(|t| !t.is_handed_in()) {
            let shown = firsts().filter(|first| first.technique.name == technique.name);
            let modes = technique.parameter("mode").map_or(1, |_| 2);
            assert_eq!(shown.count(), modes, "{}", technique.name);
        }
        for (condition, pair) in set.rendered() {
            assert_eq!(pair.second.label, "ray-traced", "{}", condition.id);
            assert_eq!(pair.second.get("d_max_m"), 1.0, "{}", condition.id);
            // No technique looks farther than the truth does.
            for reach in ["radius_m", "reach_m"] {
                if pair.first.technique.parameter(reach).is_some() {
                    assert!(pair.first.get(reach) <= 1.0, "{} {reach}", condition.id);
                }
            }
        }
    }

    #[test]
    fn the_dragon_runs_at_most_half_the_passes_of_the_atrium_in_full_light() {
        let dir = tempfile::tempdir().unwrap();
        unpack(dir.path()).unwrap();
        let set = StimulusSet::load(&dir.path().join(STIMULI)).unwrap();
        let of = |id: &str| set.rendered().find(|(c, _)| c.id == id).unwrap().1;
        let dragon = passes_of(&set, of("dragon-low"), &of("dragon-low").second);
        let atrium = passes_of(&set, of("sponza-high-h2"), &of("sponza-high-h2").second);
        assert!(2 * dragon.len() <= atrium.len(), "{dragon:?} {atrium:?}");
    }

    #[test]
    fn an_edited_file_stays() {
        let dir = tempfile::tempdir().unwrap();
        unpack(dir.path()).unwrap();
        let path = dir.path().join(STIMULI);
        std::fs::write(&path, "mine").unwrap();
        assert_eq!(unpack(dir.path()).unwrap(), std::slice::from_ref(&path));
        assert_eq!(std::fs::read_to_string(path).unwrap(), "mine");
    }
}
