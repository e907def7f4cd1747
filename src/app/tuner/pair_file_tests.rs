use super::super::knobs::Knobs;
use super::super::tuning::Wishes;
use super::*;
use crate::scene::SceneConfig;

/// A copy of the atrium in a folder of its own.
fn tuning(folder: &Path) -> Tuning {
    let path = folder.join("hall.toml");
    std::fs::copy("stimuli/scenes/atrium.toml", &path).unwrap();
    let wishes = Wishes {
        lighting: None,
        size_px: (64, 36),
        radius_m: None,
        adapter: None,
    };
    Tuning::new(SceneConfig::load(&path).unwrap(), wishes).unwrap()
}

fn knobs(tuning: &Tuning) -> Knobs {
    Knobs::new(&tuning.scene, "low", tuning.reach_m).unwrap()
}

/// Every technique, far from its own defaults and the scene's, and back at its own defaults
/// where the scene has others.
#[test]
fn what_is_written_draws_what_was_pinned() {
    let folder = tempfile::tempdir().unwrap();
    let tuning = tuning(folder.path());
    let mut first = knobs(&tuning);
    first.set("radius_m", 0.5).unwrap();
    let first = first.configuration();
    for technique in first_to_last() {
        let mut knobs = knobs(&tuning);
        knobs.choose(technique);
        if technique != "none" {
            knobs.set("resolution", "half").unwrap();
            knobs.set_samples(64.0).unwrap();
        }
        knobs.set_reach_m(0.123_456_789_012_3).unwrap();
        let second = knobs.configuration();
        let pair = PairFile {
            tuning: &tuning,
            lighting: "low",
            pinned: [&first, &second],
        };
        let path = pair.write(technique).unwrap();
        let set = StimulusSet::load(&path).unwrap();
        let (condition, found) = set.rendered().next().unwrap();
        assert_eq!(found.first.values(), first.settings.values());
        assert_eq!(found.second.values(), second.settings.values());
        assert_eq!(condition.labels()[1], second.settings.label);
        assert_eq!((set.size_px, set.seed), (Some((64, 36)), 2010));
        assert_eq!(found.lighting, "low");
    }
}

fn first_to_last() -> Vec<&'static str> {
    let techniques = crate::cost::Grid::all_techniques();
    techniques.iter().map(|technique| technique.name).collect()
}

#[test]
fn only_what_differs_is_spelled_out_and_labels_are_two() {
    let folder = tempfile::tempdir().unwrap();
    let tuning = tuning(folder.path());
    let mut knobs = knobs(&tuning);
    let first = knobs.configuration();
    knobs.set("falloff", 0.25).unwrap();
    let second = knobs.configuration();
    let pair = PairFile {
        tuning: &tuning,
        lighting: "high",
        pinned: [&first, &second],
    };
    let text = std::fs::read_to_string(pair.write("two.toml").unwrap()).unwrap();
    let expected = "first = { technique = \"gtao\", label = \"gtao-18-a\", radius_m = 2 }\n\
                    second = { technique = \"gtao\", label = \"gtao-18-b\", radius_m = 2, falloff = 0.25 }";
    assert!(text.contains(expected), "{text}");
    assert!(text.contains("scene = \"hall.toml\""), "{text}");
}

#[test]
fn a_file_that_is_there_stays_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let tuning = tuning(folder.path());
    let mut knobs = knobs(&tuning);
    let first = knobs.configuration();
    knobs.choose("none");
    let second = knobs.configuration();
    let pair = PairFile {
        tuning: &tuning,
        lighting: "low",
        pinned: [&first, &second],
    };
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, "precious").unwrap();
    let message = pair.write("mine.toml").unwrap_err();
    assert!(message.contains("there already"), "{message}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "precious");
    for nonsense in ["", "  ", "..", "sub/", "no such folder/x.toml", "two words"] {
        assert!(pair.write(nonsense).is_err(), "{nonsense:?}");
    }
    let elsewhere = tempfile::tempdir().unwrap();
    let path = elsewhere.path().join("far.toml");
    let written = pair.write(path.to_str().unwrap()).unwrap();
    assert_eq!(written, path);
    assert!(StimulusSet::load(&path).is_ok());
}

#[test]
fn another_blur_than_the_scenes_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let tuning = tuning(folder.path());
    let mut knobs = knobs(&tuning);
    let first = knobs.configuration();
    knobs.blur_radius_px = 0;
    let second = knobs.configuration();
    let pair = PairFile {
        tuning: &tuning,
        lighting: "low",
        pinned: [&first, &second],
    };
    let message = pair.write("blurred.toml").unwrap_err();
    assert!(message.contains("4 px") && message.contains("B is blurred by 0 px"));
    assert!(!folder.path().join("blurred.toml").exists());
    // Nothing is blurred where nothing runs.
    knobs.choose("none");
    assert_eq!(
        blur_trouble(&tuning, [&first, &knobs.configuration()]),
        None
    );
}
