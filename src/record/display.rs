//! What the display was found to be before a session: one file a segment, made once
//! and never changed. Every row has the most important of it.

use std::path::Path;

use serde::Serialize;

use super::{ParticipantId, RecordError, files, slots};

/// Folder of these files in a results folder.
pub const DISPLAY_FOLDER: &str = "displays";

/// Puts the figures of the display on record and syncs them; what was there first stays.
///
/// # Errors
/// [`RecordError`] saying what the disk said.
pub fn store(
    results: &Path,
    participant: &ParticipantId,
    segment: u32,
    figures: &impl Serialize,
) -> Result<(), RecordError> {
    let folder = results.join(DISPLAY_FOLDER);
    files::create_folder(&folder)?;
    let subject = participant.file_value();
    let path = folder.join(format!("subject-{subject}_segment-{segment}.json"));
    files::create_whole(&path, &slots::json(&path, figures)?).map(drop)
}
