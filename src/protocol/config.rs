//! A protocol: one TOML file that says what a study's participants go through.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::Key;
use super::design::{Design, InnerOrder};
use super::procedure::Procedure;
use super::text::{StudyId, Text};
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
    /// Every sentence on the participant's screen.
    pub texts: Texts,
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
    /// SHA-256 of the file's bytes: the name of exactly this protocol in rows.
    #[serde(skip)]
    pub hash: String,
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

/// Every sentence a participant reads. None may say what realism is: it would prime.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Texts {
    /// Heading of the first screen.
    pub title: Text,
    /// The instructions; blank lines part paragraphs.
    pub instructions: Text,
    /// Button under the instructions.
    pub begin: Text,
    /// Heading of the page with the pairs.
    pub menu: Text,
    /// Button of a pair; `{n}` stands for its number from 1.
    pub pair: Text,
    /// The question after the second image.
    pub question: Text,
    /// Button for the image shown first.
    pub answer_first: Text,
    /// Button for the image shown second.
    pub answer_second: Text,
    /// Shown while the answer is written to disk.
    pub saving: Text,
    /// Shown when the answer could not be written: calm, asks to fetch the experimenter.
    pub trouble: Text,
    /// Thanks, at the end.
    pub closing: Text,
    /// Shown after the experimenter has ended the session early.
    pub aborted: Text,
}

impl Texts {
    /// Caption of the button of one pair; `index` counts from 0.
    #[must_use]
    pub fn pair_caption(&self, index: usize) -> String {
        self.pair.replace("{n}", &(index + 1).to_string())
    }
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
    abort_with_ctrl_shift: Key,
}

impl TryFrom<KeysAsWritten> for Keys {
    type Error = String;

    fn try_from(keys: KeysAsWritten) -> Result<Self, String> {
        if keys.answer_first == keys.answer_second {
            return Err(format!(
                "answer_first and answer_second are both \"{}\"; they must differ",
                keys.answer_first
            ));
        }
        Ok(Self {
            go_on: keys.go_on,
            answer_first: keys.answer_first,
            answer_second: keys.answer_second,
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
            abort_with_ctrl_shift: Key::Symbol('Q'),
        }
    }
}

/// One optional question about the participant.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetadataField {
    /// Column name.
    pub id: StudyId,
    /// The question.
    pub label: Text,
    /// Answers to choose from; empty for free text.
    #[serde(default)]
    pub choices: Vec<Text>,
}

impl Protocol {
    /// Parses a protocol's text; `path` is only named in errors.
    ///
    /// # Errors
    /// [`ConfigError`] naming file, line and field.
    pub fn parse(path: &Path, text: &str) -> Result<Self, ConfigError> {
        let mut protocol: Self = config::parse(path, text)?;
        protocol.hash = digest::sha256_hex(text.as_bytes());
        Ok(protocol)
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
        assert_eq!(protocol.texts.pair_caption(6), "Pair 7");
        assert_eq!(
            protocol.stimulus_set(Path::new("protocols/thesis-2010.toml")),
            Path::new("protocols/../stimuli/thesis-2010.toml")
        );
    }

    /// To name what differs between the images would tell people what to look for.
    #[test]
    fn no_text_of_the_thesis_protocol_says_what_realism_is() {
        let texts = parse(THESIS).unwrap().texts;
        let all = [
            &texts.title,
            &texts.instructions,
            &texts.begin,
            &texts.menu,
            &texts.pair,
            &texts.question,
            &texts.answer_first,
            &texts.answer_second,
            &texts.saving,
            &texts.trouble,
            &texts.closing,
            &texts.aborted,
        ];
        for text in all {
            for primer in [
                "light", "shad", "dark", "ambient", "occlu", "corner", "depth", "photo",
            ] {
                assert!(
                    !text.to_lowercase().contains(primer),
                    "{primer:?} in {text:?}"
                );
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
