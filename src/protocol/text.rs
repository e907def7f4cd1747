//! Words of a protocol, checked when they are read: sentences and short names.

use serde::{Deserialize, Serialize};

/// A sentence; never empty.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Text(String);

impl TryFrom<String> for Text {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        if text.trim().is_empty() {
            return Err("found an empty text, something to read is needed".to_owned());
        }
        Ok(Self(text.trim().to_owned()))
    }
}

impl From<Text> for String {
    fn from(text: Text) -> Self {
        text.0
    }
}

impl std::ops::Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

/// A short name for files and columns: starts with a letter, then letters,
/// digits, `-` and `_`, 64 at most.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct StudyId(String);

impl TryFrom<String> for StudyId {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if text.starts_with(|c: char| c.is_ascii_alphabetic())
            && text.chars().all(allowed)
            && text.len() <= 64
        {
            return Ok(Self(text));
        }
        Err(format!(
            "found {text:?}, allowed is a letter, then letters, digits, - and _, 64 at most"
        ))
    }
}

impl From<StudyId> for String {
    fn from(id: StudyId) -> Self {
        id.0
    }
}

impl std::ops::Deref for StudyId {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}
