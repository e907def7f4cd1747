//! A protocol: one TOML file that says what a study's participants go through.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::design::{Design, InnerOrder};
use super::locale::Texts;
use super::options::{Breaks, Catch, ImageTime, MetadataField, Practice, Reference, Scale};
use super::procedure::{Procedure, TrialStart};
use super::text::{StudyId, Text};
use super::{AnalysisPlan, DisplayRequirements, Key, Language, Words, checks};
use crate::config::quantity::{Milliseconds, SrgbLevel, quantity};
use crate::config::{self, ConfigError};
use crate::digest;

/// A protocol as it stands in its file, checked.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Protocol {
    /// Id of the study, as it stands in rows and file names.
    pub study_id: StudyId,
    /// The stimulus set's config, relative to the protocol's file.
    pub stimuli: PathBuf,
    /// What one trial is made of.
    pub procedure: &'static Procedure,
    /// Who sees which order.
    pub design: &'static Design,
    /// Whose pairs are reversed: those of whole participants, or half of everybody's.
    #[serde(default)]
    pub inner_order: InnerOrder,
    /// Seed of everything random in the design.
    pub seed: u64,
    /// How many participants the study is planned for.
    pub planned_participants: Participants,
    /// The screen between the two images of a trial.
    pub grey: Grey,
    /// What the display must be like; without this table, shortfalls are only told.
    #[serde(default = "DisplayRequirements::unasked")]
    pub display: DisplayRequirements,
    /// How long an image stands, where time ends it.
    #[serde(default)]
    pub image: Option<ImageTime>,
    /// How a trial begins; without, as the procedure has it.
    #[serde(default)]
    pub start_trial: Option<TrialStart>,
    /// Whether "I cannot tell" is an answer.
    #[serde(default)]
    pub cannot_tell: bool,
    /// What images are rated on.
    #[serde(default)]
    pub scales: Vec<Scale>,
    /// What images are compared with.
    #[serde(default)]
    pub reference: Option<Reference>,
    /// Trials to learn the procedure.
    #[serde(default)]
    pub practice: Option<Practice>,
    /// Attention checks.
    #[serde(default)]
    pub catch: Option<Catch>,
    /// Rests.
    #[serde(default)]
    pub breaks: Option<Breaks>,
    /// Language of `texts`.
    #[serde(default)]
    pub language: Language,
    /// Every sentence on the participant's screen that is this study's own.
    pub texts: Texts,
    /// The same in other languages.
    #[serde(default)]
    pub translations: BTreeMap<Language, Texts>,
    /// The keys that answer.
    #[serde(default)]
    pub keys: Keys,
    /// How participants see the images, where that is laid down: for metrics that ask what can
    /// be seen.
    #[serde(default)]
    pub viewing: Option<Viewing>,
    /// Optional questions about the participant, in the order asked.
    #[serde(default, rename = "metadata")]
    pub metadata: Vec<MetadataField>,
    /// What the study is to show, by name (`H1`): as conditions of the set name it.
    #[serde(default)]
    pub hypotheses: BTreeMap<String, Text>,
    /// What is laid down of the analysis.
    #[serde(default)]
    pub analysis: Option<AnalysisPlan>,
    /// SHA-256 of the file's bytes: the name of exactly this protocol in rows.
    #[serde(skip)]
    pub hash: String,
    /// What is said in each of its languages, its own first.
    #[serde(skip)]
    words: Vec<Words>,
}

quantity! {
    /// A number of participants.
    Participants: u32, 1, 100_000, "participants"
}

quantity! {
    /// From the eye to the display.
    ViewingDistance: f32, 0.1, 20.0, "m"
}
quantity! {
    /// Width of a display.
    DisplayWidth: f32, 0.05, 20.0, "m"
}
quantity! {
    /// Columns of a display.
    DisplayColumns: u32, 320, 65_536, "px"
}

/// How participants see the images.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Viewing {
    /// From the eye to the display.
    pub distance_m: ViewingDistance,
    /// Width of the whole display.
    pub display_width_m: DisplayWidth,
    /// Columns of the whole display.
    pub display_width_px: DisplayColumns,
}

/// The grey between two images.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grey {
    /// How long it stands at least, from its first frame on the display.
    #[serde(rename = "duration_ms")]
    pub duration: Milliseconds,
    /// Level of all three channels, 8-bit sRGB.
    pub level_srgb: SrgbLevel,
    /// What it covers.
    pub area: GreyArea,
}

impl Grey {
    /// How long it stands at least, nanoseconds.
    #[must_use]
    pub fn duration_ns(self) -> u64 {
        u64::from(self.duration.get()) * 1_000_000
    }
}

/// What the grey covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GreyArea {
    /// The rectangle of the images; around it the colour that stands around the images.
    Image,
    /// The whole screen.
    Screen,
}

/// The participant's keys and the experimenter's chord.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "KeysAsWritten")]
pub struct Keys {
    /// Ends an image.
    pub go_on: Key,
    /// Chooses the image shown first.
    pub answer_first: Key,
    /// Chooses the image shown second.
    pub answer_second: Key,
    /// Says that there is no telling, where the protocol allows it.
    pub cannot_tell: Key,
    /// Ends the session, together with Ctrl and Shift.
    pub abort_with_ctrl_shift: Key,
}

/// The keys before they are compared with each other.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KeysAsWritten {
    #[serde(rename = "continue")]
    go_on: Key,
    answer_first: Key,
    answer_second: Key,
    #[serde(default = "default_cannot_tell")]
    cannot_tell: Key,
    abort_with_ctrl_shift: Key,
}

fn default_cannot_tell() -> Key {
    Key::Symbol('0')
}

impl TryFrom<KeysAsWritten> for Keys {
    type Error = String;

    fn try_from(keys: KeysAsWritten) -> Result<Self, String> {
        for (one, other, names) in [
            (
                keys.answer_first,
                keys.answer_second,
                "answer_first and answer_second",
            ),
            (
                keys.answer_first,
                keys.cannot_tell,
                "answer_first and cannot_tell",
            ),
            (
                keys.answer_second,
                keys.cannot_tell,
                "answer_second and cannot_tell",
            ),
        ] {
            if one == other {
                return Err(format!("{names} are both \"{one}\"; they must differ"));
            }
        }
        Ok(Self {
            go_on: keys.go_on,
            answer_first: keys.answer_first,
            answer_second: keys.answer_second,
            cannot_tell: keys.cannot_tell,
            abort_with_ctrl_shift: keys.abort_with_ctrl_shift,
        })
    }
}

impl Default for Keys {
    fn default() -> Self {
        Self {
            go_on: Key::Space,
            answer_first: Key::Symbol('1'),
            answer_second: Key::Symbol('2'),
            cannot_tell: default_cannot_tell(),
            abort_with_ctrl_shift: Key::Symbol('Q'),
        }
    }
}

impl Protocol {
    /// Parses a protocol's text; `path` is only named in errors.
    ///
    /// # Errors
    /// [`ConfigError`] naming file, line and field.
    pub fn parse(path: &Path, text: &str) -> Result<Self, ConfigError> {
        let mut protocol: Self = config::parse(path, text)?;
        protocol.hash = digest::sha256_hex(text.as_bytes());
        if let Some(flaw) = checks::flaw(&protocol) {
            return Err(ConfigError::whole_file(path, &flaw));
        }
        protocol.words = std::iter::once((&protocol.language, &protocol.texts))
            .chain(&protocol.translations)
            .map(|(&language, texts)| Words::new(texts, language))
            .collect::<Result<_, _>>()?;
        Ok(protocol)
    }

    /// The languages a session can be held in, the protocol's own first.
    pub fn languages(&self) -> impl Iterator<Item = Language> {
        let others = self.translations.keys().copied();
        std::iter::once(self.language).chain(others)
    }

    /// Every sentence of a session in one of the protocol's languages; in its own where it
    /// has no translation.
    #[must_use]
    pub fn words(&self, language: Language) -> Words {
        let known = self.words.iter().find(|words| words.language == language);
        // A parsed protocol has the words of its own language.
        known.or(self.words.first()).cloned().unwrap_or_default()
    }

    /// Whether a condition is named for practice or as a catch trial, and so not of the
    /// main part.
    #[must_use]
    pub fn names(&self, condition: &str) -> bool {
        let practice = self.practice.iter().flat_map(|it| &it.conditions);
        let catch = self.catch.iter().flat_map(|it| &it.trials);
        practice
            .chain(catch.map(|trial| &trial.condition))
            .any(|named| named == condition)
    }

    /// How a trial begins.
    #[must_use]
    pub fn trial_start(&self) -> TrialStart {
        self.start_trial.unwrap_or(self.procedure.trial_start)
    }

    /// The stimulus set's config, given where the protocol's own file is.
    #[must_use]
    pub fn stimulus_set(&self, protocol_path: &Path) -> PathBuf {
        protocol_path
            .parent()
            .unwrap_or_else(|| Path::new(""))
            .join(&self.stimuli)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const THESIS: &str = include_str!("../../protocols/thesis-2010.toml");

    /// Parts of words, English, German and Danish, that say what to look for.
    const PRIMERS: &[&str] = &[
        "light", "shad", "dark", "ambient", "occlu", "corner", "depth", "photo", "licht", "schatt",
        "dunkel", "ecke", "tiefe", "foto", "lys", "skygge", "mørk", "hjørne", "dybde",
    ];

    fn parse(text: &str) -> Result<Protocol, String> {
        Protocol::parse(Path::new("p.toml"), text).map_err(|error| error.to_string())
    }

    #[test]
    fn the_thesis_protocol_is_the_thesis_procedure() {
        let protocol = parse(THESIS).unwrap();
        assert_eq!(protocol.procedure.name, "no-reference");
        assert_eq!(protocol.design.name, "latin");
        assert_eq!(protocol.inner_order, InnerOrder::Block);
        assert_eq!(protocol.grey.duration_ns(), 2_000_000_000);
        assert_eq!(protocol.grey.level_srgb.get(), 128);
        assert_eq!(protocol.planned_participants.get(), 36);
        let words = protocol.words(Language::En);
        assert_eq!(words.pair_caption(6), "Pair 7");
        assert_eq!(
            protocol.stimulus_set(Path::new("protocols/thesis-2010.toml")),
            Path::new("protocols/../stimuli/thesis-2010.toml")
        );
    }

    /// To name what differs between the images would tell people what to look for.
    #[test]
    fn no_text_of_the_thesis_protocol_says_what_realism_is() {
        let protocol = parse(THESIS).unwrap();
        for language in protocol.languages() {
            for text in protocol.words(language).all() {
                for primer in PRIMERS {
                    assert!(
                        !text.to_lowercase().contains(primer),
                        "{primer:?} in {text:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_hash_is_the_one_sha256sum_gives() {
        assert_eq!(
            parse(THESIS).unwrap().hash,
            digest::sha256_hex(THESIS.as_bytes())
        );
    }

    /// The text of the thesis protocol with one line replaced, and the message.
    fn refused(line: &str, replacement: &str) -> String {
        assert!(THESIS.contains(line), "{line:?}");
        parse(&THESIS.replace(line, replacement)).unwrap_err()
    }

    #[test]
    fn wrong_values_name_their_line_and_what_is_allowed() {
        for (line, replacement, parts) in [
            (
                "design = \"latin\"",
                "design = \"greek\"",
                ["p.toml:8", "design", "\"greek\"", "latin, williams, random"],
            ),
            (
                "inner_order = \"block\"",
                "inner_order = \"inside\"",
                ["p.toml:9", "inner_order", "inside", "`block` or `within`"],
            ),
            (
                "procedure = \"no-reference\"",
                "procedure = \"side-by-side\"",
                ["p.toml:7", "procedure", "side-by-side", "no-reference"],
            ),
            (
                "duration_ms = 2000",
                "duration_ms = -1",
                ["p.toml:16", "grey.duration_ms", "-1", "0 to 600000 ms"],
            ),
            (
                "level_srgb = 128",
                "level_srgb = 256",
                ["p.toml:17", "grey.level_srgb", "256", "0 to 255"],
            ),
            (
                "planned_participants = 36",
                "planned_participants = 0",
                ["p.toml:11", "planned_participants", "found 0", "1 to"],
            ),
            (
                "study_id = \"thesis-2010\"",
                "study_id = \"../x\"",
                ["p.toml:3", "study_id", "../x", "letters, digits"],
            ),
            (
                "begin = \"Begin\"",
                "begin = \" \"",
                ["p.toml:", "texts.begin", "empty", "needed"],
            ),
            (
                "continue = \"Space\"",
                "continue = \"Spacebar\"",
                ["p.toml:", "keys.continue", "Spacebar", "Space"],
            ),
            (
                "answer_first = \"1\"",
                "answer_first = \"2\"",
                ["p.toml:", "keys", "\"2\"", "differ"],
            ),
            (
                "seed = 2010",
                "sead = 2010",
                ["p.toml:10", "sead", "unknown field", "seed"],
            ),
        ] {
            let message = refused(line, replacement);
            for part in parts {
                assert!(message.contains(part), "{part:?} not in {message:?}");
            }
        }
    }
}
