//! What a results folder belongs to: one protocol over one set of images.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::RecordError;
use crate::protocol::{Condition, Protocol};

/// What a results folder belongs to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StudyIdentity {
    /// Study id.
    pub study_id: String,
    /// SHA-256 of the protocol's file.
    pub protocol_hash: String,
    /// The study's conditions, in the stimulus set's order.
    pub conditions: Vec<Condition>,
    /// SHA-256 of the images, in the set's order, first before second; empty where
    /// they were not known.
    #[serde(default)]
    pub image_sha256: Vec<String>,
}

impl StudyIdentity {
    /// The identity of a protocol over the conditions of its stimulus set.
    #[must_use]
    pub fn new(protocol: &Protocol, conditions: &[Condition]) -> Self {
        Self {
            study_id: protocol.study_id.to_string(),
            protocol_hash: protocol.hash.clone(),
            conditions: conditions.to_vec(),
            image_sha256: Vec::new(),
        }
    }

    /// Trials of a whole session.
    #[must_use]
    pub fn trials(&self) -> usize {
        self.conditions.len()
    }

    /// Whether a folder that belongs to `found` may be opened with this.
    pub(super) fn check_against(&self, folder: &Path, found: &Self) -> Result<(), RecordError> {
        let path = folder.to_owned();
        if found.protocol_hash != self.protocol_hash {
            return Err(RecordError::OtherProtocol {
                path,
                found_study: found.study_id.clone(),
                found_hash: found.protocol_hash.clone(),
                expected_study: self.study_id.clone(),
                expected_hash: self.protocol_hash.clone(),
            });
        }
        if found.conditions != self.conditions {
            return Err(RecordError::OtherConditions {
                path,
                found: found.condition_ids(),
                expected: self.condition_ids(),
            });
        }
        if found.image_sha256 != self.image_sha256 {
            return Err(RecordError::OtherImages { path });
        }
        Ok(())
    }

    fn condition_ids(&self) -> String {
        let ids: Vec<&str> = self.conditions.iter().map(|c| c.id.as_str()).collect();
        ids.join(", ")
    }
}
