//! The sentences that every study says alike, in the languages there are. One file
//! a language in `locales/`, one line in [`LANGUAGES`]. What is a study's own, its
//! instructions and its question, stands in the protocol.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::text::Text;
use crate::config::{self, ConfigError};

/// A language of the participant's screens.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// English.
    #[default]
    En,
    /// German.
    De,
    /// Danish.
    Da,
}

/// Every language, its code, its name in itself, and its file.
pub const LANGUAGES: &[(Language, &str, &str, &str)] = &[
    (
        Language::En,
        "en",
        "English",
        include_str!("../../locales/en.toml"),
    ),
    (
        Language::De,
        "de",
        "Deutsch",
        include_str!("../../locales/de.toml"),
    ),
    (
        Language::Da,
        "da",
        "Dansk",
        include_str!("../../locales/da.toml"),
    ),
];

impl Language {
    /// Two letters, ISO 639-1.
    #[must_use]
    pub fn code(self) -> &'static str {
        self.entry().1
    }

    /// The language's name in itself.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.entry().2
    }

    /// The language of a code.
    #[must_use]
    pub fn of_code(code: &str) -> Option<Self> {
        LANGUAGES
            .iter()
            .find(|known| known.1 == code)
            .map(|known| known.0)
    }

    fn entry(self) -> &'static (Self, &'static str, &'static str, &'static str) {
        // Every variant has its line; a test holds that.
        LANGUAGES
            .iter()
            .find(|known| known.0 == self)
            .unwrap_or(&LANGUAGES[0])
    }
}

/// Declares the common sentences once: as they may stand in a protocol, as they
/// must stand in a locale, and as they are said in the end.
macro_rules! sentences {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {
        /// The texts of a protocol in one language. A sentence that is left out is
        /// said as the locale says it. None may say what realism is: it would prime.
        #[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct Texts {
            /// The instructions; blank lines part paragraphs.
            pub instructions: Text,
            /// What is asked.
            pub question: Text,
            /// What the participant agrees to, before anything else; no such screen without.
            #[serde(default)]
            pub consent: Option<Text>,
            /// Words of the scales, by id.
            #[serde(default)]
            pub scales: BTreeMap<String, ScaleWords>,
            /// Words of the questions about the participant, by id.
            #[serde(default)]
            pub metadata: BTreeMap<String, FieldWords>,
            $($(#[$doc])* #[serde(default)] pub $name: Option<Text>,)*
        }

        /// A locale file: every common sentence in one language.
        #[derive(Debug, Clone, Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Locale {
            $($name: Text,)*
        }

        /// Every sentence of one session, in its language.
        #[derive(Debug, Clone, PartialEq, Eq, Default)]
        pub struct Words {
            /// The language.
            pub language: Language,
            /// The instructions; blank lines part paragraphs.
            pub instructions: String,
            /// What is asked.
            pub question: String,
            /// What the participant agrees to.
            pub consent: Option<String>,
            /// Words of the scales, by id.
            pub scales: BTreeMap<String, ScaleWords>,
            /// Words of the questions about the participant, by id.
            pub metadata: BTreeMap<String, FieldWords>,
            $($(#[$doc])* pub $name: String,)*
        }

        impl Words {
            /// The protocol's texts, and the locale's where the protocol is silent.
            ///
            /// # Errors
            /// [`ConfigError`] if the embedded locale is not whole; a test holds that it is.
            pub fn new(texts: &Texts, language: Language) -> Result<Self, ConfigError> {
                let locale = locale(language)?;
                Ok(Self {
                    language,
                    instructions: texts.instructions.to_string(),
                    question: texts.question.to_string(),
                    consent: texts.consent.as_ref().map(|text| text.to_string()),
                    scales: texts.scales.clone(),
                    metadata: texts.metadata.clone(),
                    $($name: texts.$name.as_ref().unwrap_or(&locale.$name).to_string(),)*
                })
            }

            /// Every sentence, for checks on what participants read.
            #[must_use]
            pub fn all(&self) -> Vec<&str> {
                let own = [self.instructions.as_str(), self.question.as_str()];
                let common = [$(self.$name.as_str(),)*];
                let scales = self.scales.values();
                let fields = self.metadata.values();
                own.into_iter()
                    .chain(common)
                    .chain(self.consent.as_deref())
                    .chain(scales.flat_map(|it| [&*it.question, &*it.low, &*it.high]))
                    .chain(fields.flat_map(|it| {
                        it.choices.iter().map(|text| &**text).chain([&*it.label])
                    }))
                    .collect()
            }
        }
    };
}

sentences! {
    /// Heading of the first screen.
    title,
    /// Button under the instructions.
    begin,
    /// Heading of the page with one button a trial.
    menu,
    /// Button of a trial; `{n}` stands for its number from 1.
    pair,
    /// Page before a trial that one button begins; `{n}` and `{total}` stand for numbers.
    ready,
    /// Button that leads on.
    next,
    /// Button for the image shown first.
    answer_first,
    /// Button for the image shown second.
    answer_second,
    /// Button for the image on the left.
    answer_left,
    /// Button for the image on the right.
    answer_right,
    /// Over the reference.
    reference,
    /// Button for no choice, where the protocol allows it.
    cannot_tell,
    /// How images are ranked.
    rank_hint,
    /// Heading of the consent.
    consent_title,
    /// Button that agrees.
    agree,
    /// Button that does not.
    decline,
    /// Said to somebody who does not take part.
    declined,
    /// Heading of the questions about the participant.
    form_title,
    /// Under it: every answer is optional.
    form_hint,
    /// After the practice.
    practice_over,
    /// Between two stretches of trials.
    pause,
    /// Shown while the answer is written to disk.
    saving,
    /// Shown when the answer could not be written: calm, asks to fetch the experimenter.
    trouble,
    /// Thanks, at the end.
    closing,
    /// Shown after the experimenter has ended the session early.
    aborted,
    /// Heading of what is for the experimenter on a participant's screen.
    for_experimenter,
    /// Button that tries again.
    try_again,
    /// Button that leaves the last screen.
    back,
}

/// Words of one scale.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScaleWords {
    /// The question.
    pub question: Text,
    /// What the lowest point means.
    pub low: Text,
    /// What the highest point means.
    pub high: Text,
}

/// Words of one question about the participant.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FieldWords {
    /// The question.
    pub label: Text,
    /// The answers to choose from, in the order of the field's own.
    #[serde(default)]
    pub choices: Vec<Text>,
}

impl Words {
    /// Caption of the button of one trial; `index` counts from 0.
    #[must_use]
    pub fn pair_caption(&self, index: usize) -> String {
        self.pair.replace("{n}", &(index + 1).to_string())
    }

    /// The page before a trial; `index` counts from 0.
    #[must_use]
    pub fn ready_for(&self, index: usize, total: usize) -> String {
        self.ready
            .replace("{n}", &(index + 1).to_string())
            .replace("{total}", &total.to_string())
    }
}

fn locale(language: Language) -> Result<Locale, ConfigError> {
    let (_, code, _, text) = language.entry();
    config::parse(Path::new(&format!("locales/{code}.toml")), text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_locale_is_whole_and_its_placeholders_stand() {
        for &(language, code, _, _) in LANGUAGES {
            let locale = locale(language).unwrap();
            assert!(locale.pair.contains("{n}"), "{code}");
            assert!(locale.ready.contains("{n}"), "{code}");
            assert!(locale.ready.contains("{total}"), "{code}");
            assert_eq!(Language::of_code(code), Some(language));
            assert_eq!(language.code(), code);
        }
    }

    /// A file that was copied and not translated.
    #[test]
    fn no_two_languages_say_it_alike() {
        let closing = |language| locale(language).unwrap().closing.to_string();
        assert_ne!(closing(Language::En), closing(Language::De));
        assert_ne!(closing(Language::En), closing(Language::Da));
        assert_ne!(closing(Language::De), closing(Language::Da));
    }
}
