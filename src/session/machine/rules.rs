//! What a running session needs of its protocol.

use crate::digest;
use crate::protocol::Protocol;
use crate::protocol::options::Scale;
use crate::protocol::procedure::{Ask, Step, TrialStart};
use crate::session::SessionInfo;

/// What the protocol says, as far as a running session needs it.
#[derive(Debug, Clone)]
pub struct Rules {
    pub study_id: String,
    pub protocol_hash: String,
    pub procedure: &'static str,
    pub cannot_tell: bool,
    pub scales: Vec<Scale>,
    pub steps: Vec<Step>,
    pub trial_start: TrialStart,
    /// SHA-256 of the text to agree to, in the session's language.
    pub consent_sha256: Option<String>,
    pub asks_about: bool,
}

impl Rules {
    pub fn new(protocol: &Protocol, info: &SessionInfo) -> Self {
        let translated = protocol.translations.get(&info.language);
        let consent = translated.unwrap_or(&protocol.texts).consent.as_ref();
        Self {
            study_id: protocol.study_id.to_string(),
            protocol_hash: protocol.hash.clone(),
            procedure: protocol.procedure.name,
            cannot_tell: protocol.cannot_tell,
            scales: protocol.scales.clone(),
            steps: (protocol.procedure.steps)(protocol),
            trial_start: protocol.trial_start(),
            consent_sha256: consent.map(|text| digest::sha256_hex(text.as_bytes())),
            asks_about: !protocol.metadata.is_empty(),
        }
    }

    /// Whether this is what a trial asks.
    pub fn asks(&self, ask: Ask) -> bool {
        self.steps.last() == Some(&Step::Ask(ask))
    }
}
