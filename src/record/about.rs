//! What a participant agreed to and chose to tell: one file a participant, made
//! once and never changed.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{ParticipantId, RecordError, files, slots};
use crate::protocol::Language;

/// Folder of these files in a results folder.
pub const ABOUT_FOLDER: &str = "participants";

/// What a participant agreed to and chose to tell.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct About {
    /// Pseudonymous id.
    pub participant: String,
    /// Language of the screens.
    pub language: Language,
    /// SHA-256 of the text agreed to; absent where the protocol has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub consent_sha256: Option<String>,
    /// Wall-clock time of the agreement, UTC, ISO 8601.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub consented_utc: Option<String>,
    /// Answers to the questions about the participant, in the protocol's order; those
    /// left out are not here.
    #[serde(default)]
    pub answers: Vec<AboutAnswer>,
}

/// One answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct AboutAnswer {
    /// The question's id in the protocol.
    pub id: String,
    /// One of its choices as it stands in the protocol, or free text.
    pub answer: String,
}

/// Where the file of a participant stands.
#[must_use]
pub fn path(results: &Path, participant: &ParticipantId) -> PathBuf {
    let name = format!("subject-{}.json", participant.file_value());
    results.join(ABOUT_FOLDER).join(name)
}

/// What is on record about a participant; `None` where nothing is.
///
/// # Errors
/// [`RecordError`] if the file cannot be read.
pub fn load(results: &Path, participant: &ParticipantId) -> Result<Option<About>, RecordError> {
    let path = path(results, participant);
    if path.exists() {
        slots::load(&path).map(Some)
    } else {
        Ok(None)
    }
}

/// Puts it on record and syncs it; what was there first stays.
///
/// # Errors
/// [`RecordError`] saying what the disk said.
pub fn store(
    results: &Path,
    participant: &ParticipantId,
    about: &About,
) -> Result<(), RecordError> {
    files::create_folder(&results.join(ABOUT_FOLDER))?;
    let path = path(results, participant);
    files::create_whole(&path, &slots::json(&path, about)?).map(drop)
}
