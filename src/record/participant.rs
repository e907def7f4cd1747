//! Pseudonymous ids that are safe as file names and in spreadsheets.

use std::fmt;

use super::RecordError;

/// A participant's pseudonymous id: a letter or digit, then letters, digits,
/// `-` and `_`, 64 at most. Nothing else is kept of a person.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ParticipantId(String);

impl ParticipantId {
    /// Checks an id.
    ///
    /// # Errors
    /// [`RecordError::ParticipantId`] saying what is allowed.
    pub fn new(text: &str) -> Result<Self, RecordError> {
        let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if text.starts_with(|c: char| c.is_ascii_alphanumeric())
            && text.chars().all(allowed)
            && text.len() <= 64
        {
            return Ok(Self(text.to_owned()));
        }
        Err(RecordError::ParticipantId {
            found: text.to_owned(),
        })
    }

    /// The id.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The id as the value of a Psych-DS file name, which may hold letters and
    /// digits only. An id with other characters gets its CRC-32 behind it, so that
    /// `P-01`, `P_01` and `P01` stay three files.
    #[must_use]
    pub fn file_value(&self) -> String {
        let plain: String = self.0.chars().filter(char::is_ascii_alphanumeric).collect();
        if plain == self.0 {
            plain
        } else {
            format!("{plain}x{:08x}", crc32fast::hash(self.0.as_bytes()))
        }
    }
}

impl fmt::Display for ParticipantId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
