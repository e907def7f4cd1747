//! A scene config as it is recommended: the scene's own text, with what was found put in.

use toml_edit::{DocumentMut, Item, Table, value};

use super::CostError;
use super::effects::EffectCost;
use super::row::Row;
use crate::config::ParameterValue;
use crate::render::technique::Settings;
use crate::scene::{Ambient, SceneConfig};

/// What is recommended for one lighting variant.
#[derive(Debug, Clone)]
pub struct Recommended<'a> {
    /// The lighting variant.
    pub lighting: &'a str,
    /// Effects that change less than can be seen.
    pub unseen: Vec<&'a EffectCost>,
}

/// The scene's config with a technique's settings, the blur, and without effects that change
/// too little; comments and order stay.
///
/// # Errors
/// [`CostError::Input`] if the config is no TOML.
pub fn scene_config(
    scene: &SceneConfig,
    row: &Row,
    settings: &Settings,
    lightings: &[Recommended<'_>],
) -> Result<String, CostError> {
    let mut document: DocumentMut = (scene.text.parse())
        .map_err(|error| CostError::Input(format!("{}: {error}", scene.path.display())))?;
    if settings.technique.shader.is_some() {
        table(&mut document, &["occlusion"])["blur_radius_px"] = value(i64::from(row.blur_px));
        let own = table(&mut document, &["technique", settings.technique.name]);
        for (name, parameter) in settings.values() {
            own[&name] = match parameter {
                ParameterValue::Word(word) => value(word),
                ParameterValue::Number(number) => value(number),
            };
        }
    }
    let is_unseen = |in_lighting: &Recommended<'_>, name: &str| {
        in_lighting
            .unseen
            .iter()
            .any(|effect| effect.effect == name)
    };
    let is_everywhere = lightings
        .iter()
        .all(|each| is_unseen(each, "supersampling"));
    if is_everywhere && !lightings.is_empty() {
        table(&mut document, &["image"])["supersampling"] = value(1);
    }
    for each in lightings {
        if is_unseen(each, "reflections") {
            table(&mut document, &["lighting", each.lighting])["reflections"] = value(false);
        }
        if is_unseen(each, "shadows") {
            without_shadows(&mut document, each.lighting);
        }
        if is_unseen(each, "ambient light by direction") {
            constant_ambient(&mut document, scene, each.lighting);
        }
    }
    Ok(document.to_string())
}

/// The table of that path, made where it is not there.
fn table<'d>(document: &'d mut DocumentMut, path: &[&str]) -> &'d mut Item {
    let mut item = document.as_item_mut();
    for (depth, name) in path.iter().enumerate() {
        let is_last = depth + 1 == path.len();
        item = &mut item[*name];
        if item.is_none() {
            let mut new = Table::new();
            new.set_implicit(!is_last);
            *item = Item::Table(new);
        }
    }
    item
}

/// A variant inherits its sun as a whole, so that one without shadows is said as a whole, too.
fn without_shadows(document: &mut DocumentMut, lighting: &str) {
    let mut from = lighting.to_owned();
    let mut sun = Item::None;
    // A chain of variants is no longer than there are variants; a ring was refused on reading.
    for _ in 0..64 {
        let variant = &document["lighting"][from.as_str()];
        if let Some(found) = variant.get("sun") {
            sun = found.clone();
            break;
        }
        match variant.get("extends").and_then(Item::as_str) {
            Some(parent) => from = parent.to_owned(),
            None => break,
        }
    }
    if let Some(fields) = sun.as_table_like_mut() {
        fields.insert("casts_shadows", value(false));
        table(document, &["lighting", lighting])["sun"] = sun;
    }
}

fn constant_ambient(document: &mut DocumentMut, scene: &SceneConfig, lighting: &str) {
    let Some(found) = scene.lightings.get(lighting) else {
        return;
    };
    let (Ambient::Environment, Some(environment)) = (&found.ambient, &found.environment) else {
        return;
    };
    let mean = environment.map().mean() * environment.intensity();
    let colour: toml_edit::Array = mean.to_array().into_iter().map(f64::from).collect();
    let mut ambient = toml_edit::InlineTable::new();
    ambient.insert("constant", toml_edit::Value::Array(colour));
    table(document, &["lighting", lighting])["ambient"] = value(ambient);
}

/// A stimulus set that shows the recommended technique beside the truth, lighting by lighting.
#[must_use]
pub fn check_set(
    scene: &SceneConfig,
    row: &Row,
    lightings: &[&str],
    reach_m: f64,
    scene_file: &str,
) -> String {
    let mut set = format!(
        "# What `greyfield advise` recommends for {}, each beside the true occlusion.\n\nid = \"{}-advised\"\ntitle = \"Advised\"\nseed = 2010\nwidth_px = {}\nheight_px = {}\n",
        scene.id, scene.id, row.width_px, row.height_px
    );
    for lighting in lightings {
        set += &format!(
            "\n[[condition]]\nid = \"{lighting}\"\nscene = \"{scene_file}\"\nlighting = \"{lighting}\"\nfirst = \"{}\"\nsecond = {{ technique = \"ray-traced\", d_max_m = {reach_m}, error = 0.01 }}\n",
            row.technique
        );
    }
    set
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::advise::tests::row;
    use super::*;
    use crate::embedded;

    fn scene(name: &str) -> SceneConfig {
        let path = format!("stimuli/scenes/{name}.toml");
        let (_, text) = embedded::FILES
            .iter()
            .find(|(file, _)| *file == path)
            .unwrap();
        SceneConfig::parse(Path::new(&path), text).unwrap()
    }

    fn effect(name: &str) -> EffectCost {
        EffectCost {
            effect: name.to_owned(),
            instead: String::new(),
            saves_ms: None,
            saves_range_ms: None,
            frame_ms: None,
            flip_mean: 0.0,
            flip_p95: 0.0,
        }
    }

    /// The atrium's variant `high` inherits its environment and has a sun of its own.
    #[test]
    fn the_recommended_config_is_a_scene_with_what_was_found() {
        let scene = scene("atrium");
        let mut settings = Settings::from_label("gtao18").unwrap();
        settings.set("resolution", "half").unwrap();
        let effects = ["shadows", "supersampling", "ambient light by direction"].map(effect);
        let recommended = Recommended {
            lighting: "high",
            unseen: effects.iter().collect(),
        };
        let text = scene_config(
            &scene,
            &row("gtao", 18, 1.0, 0.1),
            &settings,
            &[recommended],
        )
        .unwrap();
        let back = SceneConfig::parse(Path::new("advised.toml"), &text).unwrap();
        assert_eq!(back.occlusion.blur_radius_px, 4);
        assert_eq!(back.supersampling, 1);
        let high = &back.lightings["high"];
        assert!(!high.sun.as_ref().unwrap().casts_shadows);
        assert!(matches!(high.ambient, Ambient::Constant(_)));
        assert_eq!(back.lightings["moderate"], scene.lightings["moderate"]);
        assert!(text.contains("# A clear morning"), "comments stay");
        let gtao = &back.occlusion.techniques["gtao"];
        assert_eq!(*gtao["resolution"].get_ref(), ParameterValue::from("half"));
        assert_eq!(*gtao["slices"].get_ref(), ParameterValue::Number(3.0));
    }
}
