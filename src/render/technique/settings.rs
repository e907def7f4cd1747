//! A technique with a value for each of its parameters.

use std::collections::BTreeMap;

use super::{INTER_REFLECTING, INTER_REFLECTION, Parameter, Range, TECHNIQUES, Technique, find};
use crate::config::{ParameterValue, quantity};
use crate::multi_bounce::{self, Model, Openness};

/// A technique, fully set.
#[derive(Debug, Clone)]
pub struct Settings {
    /// As it stands in configs, file names and trial rows (`blizzard24`).
    pub label: String,
    /// The technique.
    pub technique: &'static Technique,
    values: BTreeMap<&'static str, f64>,
    /// Parameters that the label says, and that a scene's own defaults leave alone.
    fixed_by_label: Vec<&'static str>,
}

/// A technique or a value that does not exist or is out of range. `parameter` is what it is
/// about, if it is about one.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct SettingsError {
    /// The parameter.
    pub parameter: Option<String>,
    /// What was found and what is allowed.
    pub message: String,
}

impl Settings {
    /// Settings of a label: a technique's name (`blizzard`), a preset, or a name followed by
    /// its number of samples (`blizzard48`).
    ///
    /// # Errors
    /// [`SettingsError`] that lists the techniques, or names the range of the samples.
    pub fn from_label(label: &str) -> Result<Self, SettingsError> {
        if let Some(technique) = find(label) {
            return Ok(Self::defaults(technique, label));
        }
        for technique in TECHNIQUES {
            if let Some(preset) = technique
                .presets
                .iter()
                .find(|preset| preset.label == label)
            {
                let mut settings = Self::defaults(technique, label);
                for (name, value) in preset.values {
                    settings.set(name, *value)?;
                    settings.fixed_by_label.push(name);
                }
                return Ok(settings);
            }
        }
        let digits = label.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        let named = find(&label[..digits]).and_then(|t| Some((t, t.samples?)));
        match (named, label[digits..].parse::<f64>()) {
            (Some((technique, samples)), Ok(count)) => {
                let mut settings = Self::defaults(technique, label);
                settings.set(samples, count)?;
                settings.fixed_by_label.push(samples);
                Ok(settings)
            }
            _ => Err(unknown(label)),
        }
    }

    /// A technique as it declares itself.
    pub(in crate::render) fn defaults(technique: &'static Technique, label: &str) -> Self {
        Self {
            label: label.to_owned(),
            technique,
            values: technique
                .all_parameters()
                .map(|p| match p.range {
                    Range::Number { default, .. } => (p.name, default),
                    Range::Choice(_) => (p.name, 0.0),
                })
                .collect(),
            fixed_by_label: Vec::new(),
        }
    }

    /// Sets one parameter.
    ///
    /// # Errors
    /// [`SettingsError`] if the technique has no such parameter, or the value is not allowed.
    pub fn set(
        &mut self,
        name: &str,
        value: impl Into<ParameterValue>,
    ) -> Result<(), SettingsError> {
        let error = |message: String| SettingsError {
            parameter: Some(name.to_owned()),
            message: format!(
                "technique `{}`, parameter `{name}`: {message}",
                self.technique.name
            ),
        };
        let Some(parameter) = self.technique.parameter(name) else {
            let known: Vec<&str> = self.technique.all_parameters().map(|p| p.name).collect();
            return Err(error(format!(
                "there is no such parameter; there are: {}",
                if known.is_empty() {
                    String::from("none")
                } else {
                    known.join(", ")
                }
            )));
        };
        let number = number_of(parameter.range, &value.into()).map_err(error)?;
        self.values.insert(parameter.name, number);
        Ok(())
    }

    /// Sets one parameter to what a scene uses, unless the label says it (`blizzard24` keeps its
    /// 24 samples everywhere).
    ///
    /// # Errors
    /// As [`set`](Self::set).
    pub fn set_scene_default(
        &mut self,
        name: &str,
        value: impl Into<ParameterValue>,
    ) -> Result<(), SettingsError> {
        let mut probe = self.clone();
        probe.set(name, value)?;
        if !self.fixed_by_label.contains(&name) {
            *self = probe;
        }
        Ok(())
    }

    /// Takes the model of light between surfaces that a scene asks for in all its pictures, unless the
    /// scene or the label says otherwise of this technique. Without any occlusion there is none.
    ///
    /// # Errors
    /// [`SettingsError`] for a technique that estimates no openness, and for a model that there
    /// is not.
    pub fn take_inter_reflection(&mut self, model: &str) -> Result<(), SettingsError> {
        let technique = self.technique;
        number_of(INTER_REFLECTING[0].range, &model.into()).map_err(|message| SettingsError {
            parameter: Some(INTER_REFLECTION.to_owned()),
            message,
        })?;
        if !technique.occludes() || model == "none" {
            return Ok(());
        }
        if technique.openness().is_none() {
            let able: Vec<&str> = TECHNIQUES
                .iter()
                .filter(|technique| technique.openness().is_some())
                .map(|technique| technique.name)
                .collect();
            return Err(SettingsError {
                parameter: Some(INTER_REFLECTION.to_owned()),
                message: format!(
                    "a model of light between surfaces starts from how open a point is, which technique `{}` does not \
                     estimate; {} do. Leave `inter_reflection` out of the scene and say it of single images or under \
                     [technique.NAME]",
                    technique.name,
                    able.join(", ")
                ),
            });
        }
        self.set_scene_default(INTER_REFLECTION, model)
    }

    /// The model of light between surfaces that is asked for, and what the technique gives it.
    #[must_use]
    pub fn inter_reflection(&self) -> Option<(&'static Model, Openness)> {
        let openness = self.technique.openness()?;
        let parameter = self.technique.parameter(INTER_REFLECTION)?;
        match self.value(parameter) {
            ParameterValue::Word(word) if word != "none" => {
                Some((multi_bounce::find(&word)?, openness))
            }
            _ => None,
        }
    }

    /// The value of a parameter; of a choice, its place among the words.
    ///
    /// # Panics
    /// If the technique declares no such parameter: only its own file asks.
    #[must_use]
    pub fn get(&self, name: &str) -> f64 {
        self.values[name]
    }

    /// Whether the technique has a parameter that is set to this word.
    #[must_use]
    pub fn is(&self, name: &str, word: &str) -> bool {
        self.technique
            .parameter(name)
            .is_some_and(|parameter| self.value(parameter) == ParameterValue::from(word))
    }

    fn value(&self, parameter: &Parameter) -> ParameterValue {
        let number = self.values[parameter.name];
        match parameter.range {
            Range::Number { .. } => ParameterValue::Number(number),
            Range::Choice(words) => words[number as usize].into(),
        }
    }

    /// Every parameter with its value, by name.
    #[must_use]
    pub fn values(&self) -> BTreeMap<String, ParameterValue> {
        self.technique
            .all_parameters()
            .map(|parameter| (parameter.name.to_owned(), self.value(parameter)))
            .collect()
    }

    /// The WGSL part `params`: the technique's own parameters by name, as constants. Loops of a known
    /// length unroll, and what many samples have in common is computed once.
    #[must_use]
    pub fn wgsl(&self) -> String {
        let parameters = self.technique.parameters;
        let fields = parameters.iter().map(|p| format!("{}: f32", p.name));
        // Rust's shortest decimals come back as the same f32.
        let values = (parameters.iter()).map(|p| format!("{:?}f", self.values[p.name] as f32));
        format!(
            "struct Params {{ {} }}\nconst params = Params({});\n",
            fields.collect::<Vec<_>>().join(", "),
            values.collect::<Vec<_>>().join(", ")
        )
    }
}

/// A value as the number that WGSL gets.
fn number_of(range: Range, value: &ParameterValue) -> Result<f64, String> {
    match (range, value) {
        (
            Range::Number {
                unit,
                low,
                high,
                multiple_of,
                ..
            },
            ParameterValue::Number(number),
        ) => {
            quantity::check(*number, low, high, unit)?;
            if multiple_of > 0.0 && number % multiple_of != 0.0 {
                return Err(format!(
                    "found {number}, allowed are multiples of {multiple_of}"
                ));
            }
            Ok(*number)
        }
        (Range::Choice(words), ParameterValue::Word(found)) => words
            .iter()
            .position(|word| word == found)
            .map(|place| place as f64)
            .ok_or_else(|| format!("found \"{found}\", allowed are {}", words.join(", "))),
        (Range::Number { .. }, ParameterValue::Word(found)) => {
            Err(format!("found \"{found}\", a number is needed"))
        }
        (Range::Choice(words), ParameterValue::Number(number)) => {
            Err(format!("found {number}, allowed are {}", words.join(", ")))
        }
    }
}

fn unknown(label: &str) -> SettingsError {
    let names: Vec<&str> = TECHNIQUES.iter().map(|t| t.name).collect();
    let presets: Vec<&str> = TECHNIQUES
        .iter()
        .flat_map(|t| t.presets)
        .map(|preset| preset.label)
        .collect();
    SettingsError {
        parameter: None,
        message: format!(
            "there is no technique \"{label}\"; there are {} (a number after the name is its samples a pixel, \
             as in {})",
            names.join(", "),
            presets.join(", ")
        ),
    }
}
