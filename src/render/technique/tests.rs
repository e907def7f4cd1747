use super::*;

#[test]
fn names_and_labels_are_unique() {
    let mut names: Vec<&str> = TECHNIQUES.iter().map(|t| t.name).collect();
    names.extend(
        TECHNIQUES
            .iter()
            .flat_map(|t| t.presets)
            .map(|preset| preset.label),
    );
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn every_default_and_preset_is_allowed() {
    for technique in TECHNIQUES {
        let mut settings = Settings::from_label(technique.name).unwrap();
        for parameter in technique.all_parameters() {
            match parameter.range {
                Range::Number { default, .. } => settings.set(parameter.name, default).unwrap(),
                Range::Choice(words) => {
                    for word in words {
                        settings.set(parameter.name, *word).unwrap();
                        assert!(settings.is(parameter.name, word));
                    }
                }
            }
        }
        for preset in technique.presets {
            assert_eq!(
                Settings::from_label(preset.label).unwrap().technique.name,
                technique.name
            );
        }
    }
}

#[test]
fn the_thesis_labels_mean_what_they_say() {
    assert_eq!(
        Settings::from_label("blizzard8").unwrap().get("samples"),
        8.0
    );
    assert_eq!(
        Settings::from_label("crytek24").unwrap().get("samples"),
        24.0
    );
    let march = Settings::from_label("ray-march30").unwrap();
    assert_eq!((march.get("directions"), march.get("steps")), (30.0, 4.0));
    assert_eq!(
        Settings::from_label("blizzard48").unwrap().get("samples"),
        48.0
    );
}

#[test]
fn what_is_not_there_is_said_with_what_is() {
    let message = |label| Settings::from_label(label).unwrap_err().to_string();
    assert!(message("hbbao").contains("blizzard"));
    assert!(message("").contains("crytek"));
    assert!(message("24").contains("crytek"));
    assert!(message("blizzard0").contains("1 to 256"));
    assert!(message("crytek12").contains("multiples of 8"));
    assert!(message("none4").contains("none"));
    let mut settings = Settings::from_label("crytek").unwrap();
    assert!(
        settings
            .set("radius_m", 1.0)
            .unwrap_err()
            .to_string()
            .contains("radius_uv")
    );
    assert!(settings.set("radius_uv", f64::NAN).is_err());
}

/// Each parameter is in the WGSL with exactly its value, and each that a shader reads is declared.
#[test]
fn the_wgsl_params_are_the_declared_parameters() {
    for technique in TECHNIQUES {
        let Some(source) = technique.shader else {
            continue;
        };
        let mut settings = Settings::defaults(technique, technique.name);
        for parameter in technique.parameters {
            if parameter.name.ends_with("_m") {
                settings.set(parameter.name, 0.1 + 0.2).unwrap();
            }
        }
        let wgsl = settings.wgsl();
        let within = |open: &str, close: char| -> Vec<String> {
            let from = wgsl.find(open).unwrap() + open.len();
            let text = &wgsl[from..from + wgsl[from..].find(close).unwrap()];
            text.split(',').map(|item| item.trim().to_owned()).collect()
        };
        let fields = within("struct Params {", '}');
        let values = within("const params = Params(", ')');
        assert_eq!(fields.len(), technique.parameters.len());
        for ((parameter, field), value) in technique.parameters.iter().zip(fields).zip(values) {
            assert_eq!(field, format!("{}: f32", parameter.name));
            let value: f32 = value.strip_suffix('f').unwrap().parse().unwrap();
            assert_eq!(value, settings.get(parameter.name) as f32);
        }
        for read in source.split("params.").skip(1) {
            let name = read
                .split(|c: char| !c.is_alphanumeric() && c != '_')
                .next()
                .unwrap();
            assert!(
                technique.parameters.iter().any(|p| p.name == name),
                "{name}"
            );
        }
    }
}

#[test]
fn the_noise_tile_is_unit_vectors_from_its_seed() {
    for cell in noise_tile(7) {
        let length = cell[..3].iter().map(|c| c * c).sum::<f32>().sqrt();
        assert!((length - 1.0).abs() < 1e-5);
    }
    assert_eq!(noise_tile(7), noise_tile(7));
    assert_ne!(noise_tile(7), noise_tile(8));
}

/// Points that favour a side would shade walls by which way they face: the mean of the
/// directions of an even set is near 0.
#[test]
fn kernels_favour_no_side() {
    let settings = Settings::from_label("blizzard64").unwrap();
    let points = (settings.technique.kernel)(&settings, 2010);
    assert_eq!(points.len(), 64);
    let mut mean = glam::Vec3::ZERO;
    for point in &points {
        let point = glam::Vec3::new(point[0], point[1], point[2]);
        assert!(point.length() > 0.0 && point.length() <= 1.0);
        mean += point.normalize() / 64.0;
    }
    assert!(mean.length() < 0.1, "{mean}");
}
