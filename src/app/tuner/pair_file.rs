//! A stimulus set of two pinned settings, written so that its images are the ones that were shown.

use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use toml_edit::{InlineTable, Value};

use super::tuning::Tuning;
use crate::config::ParameterValue;
use crate::cost::Configuration;
use crate::cost::configuration::of_scene;
use crate::render::technique::{Settings, SettingsError};
use crate::stimulus::StimulusSet;

/// Two settings of one scene under one lighting.
pub struct PairFile<'a> {
    /// The scene, with size and seed of the images.
    pub tuning: &'a Tuning,
    /// The lighting variant.
    pub lighting: &'a str,
    /// The pinned A and B.
    pub pinned: [&'a Configuration; 2],
}

/// The name that is offered.
#[must_use]
pub fn default_name(tuning: &Tuning) -> String {
    format!("{}-tuned.toml", tuning.scene.id)
}

/// Why a pair of these would not be drawn as they were shown, if so: both images of a pair have
/// their scene's blur.
#[must_use]
pub fn blur_trouble(tuning: &Tuning, pinned: [&Configuration; 2]) -> Option<String> {
    let scene_px = tuning.scene.occlusion.blur_radius_px;
    let is_other =
        |c: &&Configuration| c.settings.technique.shader.is_some() && c.blur_radius_px != scene_px;
    let others: Vec<String> = ["A", "B"]
        .into_iter()
        .zip(pinned)
        .filter(|(_, configuration)| is_other(configuration))
        .map(|(name, configuration)| {
            format!("{name} is blurred by {} px", configuration.blur_radius_px)
        })
        .collect();
    (!others.is_empty()).then(|| {
        format!(
            "The images of a pair share their scene's blur of {scene_px} px, and {}.",
            others.join(" and ")
        )
    })
}

impl PairFile<'_> {
    /// Writes the set beside its scene, or where the name says; where it went.
    ///
    /// # Errors
    /// Why not, and what would help. A file that is there is never overwritten.
    pub fn write(&self, name: &str) -> Result<PathBuf, String> {
        let path = self.path(name)?;
        let text = self.text(&path)?;
        if path.exists() {
            return Err(is_there(&path));
        }
        self.check(&path, &text)?;
        let written = File::create_new(&path).and_then(|mut file| {
            file.write_all(text.as_bytes())
                .and_then(|()| file.sync_all())
        });
        match written {
            Ok(()) => Ok(path),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(is_there(&path)),
            Err(error) => Err(format!("{} cannot be written: {error}", path.display())),
        }
    }

    fn path(&self, name: &str) -> Result<PathBuf, String> {
        let name = name.trim();
        let mut file = PathBuf::from(name);
        if file.file_stem().is_none() || name.ends_with(['/', '\\']) {
            return Err(format!(
                "Give the set a file name, such as {}.",
                default_name(self.tuning)
            ));
        }
        if file.extension().is_none_or(|extension| extension != "toml") {
            file.as_mut_os_string().push(".toml");
        }
        Ok(folder_of(&self.tuning.scene.path).join(file))
    }

    /// The set as text.
    ///
    /// # Errors
    /// Both are the same; otherwise a name that is not text.
    fn text(&self, path: &Path) -> Result<String, String> {
        if let Some(trouble) = blur_trouble(self.tuning, self.pinned) {
            return Err(trouble);
        }
        let [first, second] = self.images()?;
        let scene = &self.tuning.scene;
        let id = path.file_stem().unwrap_or_default().to_string_lossy();
        let (width_px, height_px) = self.tuning.size_px;
        let lighting = quoted(self.lighting);
        Ok(format!(
            "# Two settings of one scene, pinned in the cost panel (greyfield tune).\n\n\
             id = {id}\ntitle = {title}\nseed = {seed}\nwidth_px = {width_px}\nheight_px = {height_px}\n\n\
             [[condition]]\nid = \"tuned\"\nscene = {scene_file}\nlighting = {lighting}\nfirst = {first}\nsecond = {second}\n",
            id = quoted(&id),
            title = quoted(&format!("{}: two settings", scene.title)),
            seed = self.tuning.seed,
            scene_file = quoted(&self.scene_file(path)?),
        ))
    }

    /// The scene as the set names it: by its file name beside it, else by its whole path.
    fn scene_file(&self, path: &Path) -> Result<String, String> {
        let scene = &self.tuning.scene.path;
        let whole = |path: &Path| {
            path.canonicalize()
                .map_err(|error| format!("{}: {error}", path.display()))
        };
        let is_beside = whole(folder_of(path))? == whole(folder_of(scene))?;
        let named = match is_beside {
            true => scene.file_name().map(PathBuf::from).unwrap_or_default(),
            false => whole(scene)?,
        };
        (named.to_str().map(str::to_owned))
            .ok_or_else(|| format!("{} cannot be written into a set", named.display()))
    }

    /// Both techniques as inline tables, with labels of their own.
    fn images(&self) -> Result<[InlineTable; 2], String> {
        let [a, b] = self.pinned.map(|configuration| &configuration.settings);
        if a.technique.name == b.technique.name && a.values() == b.values() {
            return Err(String::from(
                "A and B are the same settings; pin another one.",
            ));
        }
        let labels = match a.label == b.label {
            true => [format!("{}-a", a.label), format!("{}-b", b.label)],
            false => [a.label.clone(), b.label.clone()],
        };
        let [first, second] = labels;
        let image = |settings: &Settings, label: String| {
            self.image(settings, label).map_err(|error| error.message)
        };
        Ok([image(a, first)?, image(b, second)?])
    }

    /// One technique: whatever its own defaults or the scene's would make something else of.
    fn image(&self, settings: &Settings, label: String) -> Result<InlineTable, SettingsError> {
        let name = settings.technique.name;
        let defaults = Settings::from_label(name)?.values();
        let of_scene = of_scene(&self.tuning.scene, settings.technique)?.values();
        let mut table = InlineTable::new();
        table.insert("technique", Value::from(name));
        table.insert("label", Value::from(label));
        let values = settings.values();
        for parameter in settings.technique.all_parameters() {
            let name = parameter.name;
            let value = &values[name];
            if value != &defaults[name] || value != &of_scene[name] {
                table.insert(name, toml(value));
            }
        }
        Ok(table)
    }

    /// Reads the text as `greyfield render` will, and compares what it would draw.
    fn check(&self, path: &Path, text: &str) -> Result<(), String> {
        let set = StimulusSet::parse(path, text).map_err(|error| error.to_string())?;
        let found = set.rendered().next().map(|(_, pair)| pair);
        let is_pinned = |found: &Settings, pinned: &Configuration| {
            found.technique.name == pinned.settings.technique.name
                && found.values() == pinned.settings.values()
        };
        let [a, b] = self.pinned;
        if found.is_some_and(|pair| is_pinned(&pair.first, a) && is_pinned(&pair.second, b)) {
            return Ok(());
        }
        Err(String::from(
            "The set would draw other images than these, so it was not written.",
        ))
    }
}

fn is_there(path: &Path) -> String {
    format!(
        "{} is there already and was left as it is; give another name.",
        path.display()
    )
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}

fn toml(value: &ParameterValue) -> Value {
    match value {
        ParameterValue::Word(word) => Value::from(word.as_str()),
        // Whole numbers without a point, as a person writes them.
        ParameterValue::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
            Value::from(*number as i64)
        }
        ParameterValue::Number(number) => Value::from(*number),
    }
}

#[cfg(test)]
#[path = "pair_file_tests.rs"]
mod tests;
