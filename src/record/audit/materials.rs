//! What the folder belongs to: `study.json`, the protocol and the manifest beside it.

use serde_json::Value;

use super::finding::{Findings, Severity};
use crate::config;
use crate::digest;
use crate::protocol::{Protocol, SessionPlan};
use crate::record::study::PROTOCOL_FILE;
use crate::record::{Study, StudyIdentity};

/// The rendered set's manifest as it was.
const MANIFEST_FILE: &str = "materials/manifest.json";

/// What rows are compared with.
pub(super) struct Materials {
    /// The protocol, if it can be trusted.
    pub protocol: Option<Protocol>,
}

impl Materials {
    /// The plan of a slot, if the protocol can be trusted.
    pub fn plan(&self, identity: &StudyIdentity, slot: u32) -> Option<SessionPlan> {
        SessionPlan::new(self.protocol.as_ref()?, &identity.conditions, slot).ok()
    }
}

/// Checks the materials and gives what there is of them.
pub(super) fn check(study: &Study, findings: &mut Findings) -> Materials {
    manifest(study, findings);
    if !study.folder().join("dataset_description.json").is_file() {
        findings.file(
            Severity::Warning,
            "dataset_description.json",
            "it is not there: nothing says what the columns mean",
            "open the folder once with `greyfield run`, which makes it, or use `greyfield export`",
        );
    }
    Materials {
        protocol: protocol(study, findings),
    }
}

fn protocol(study: &Study, findings: &mut Findings) -> Option<Protocol> {
    let mend = "put back the protocol's file that the study was begun with";
    let path = study.folder().join(PROTOCOL_FILE);
    let text = match config::read(&path) {
        Ok(text) => text,
        Err(error) => {
            findings.file(Severity::Error, PROTOCOL_FILE, error.to_string(), mend);
            return None;
        }
    };
    let expected = &study.identity().protocol_hash;
    let found = digest::sha256_hex(text.as_bytes());
    if &found != expected {
        findings.file(
            Severity::Error,
            PROTOCOL_FILE,
            format!(
                "its SHA-256 is {found}, study.json says {expected}: it has been changed, and rows cannot be compared with the plan"
            ),
            mend,
        );
        return None;
    }
    Protocol::parse(&path, &text)
        .map_err(|error| {
            let mend = "use the version of Greyfield that the study was begun with";
            findings.file(Severity::Error, PROTOCOL_FILE, error.to_string(), mend);
        })
        .ok()
}

/// The manifest's image hashes are those of `study.json`.
fn manifest(study: &Study, findings: &mut Findings) {
    let expected = &study.identity().image_sha256;
    if expected.is_empty() {
        return;
    }
    let mend = "put back the manifest of the images the study was begun with";
    let path = study.folder().join(MANIFEST_FILE);
    let text = match std::fs::read(&path) {
        Ok(text) => text,
        Err(error) => {
            let message = format!("cannot be read: {error}");
            findings.file(Severity::Warning, MANIFEST_FILE, message, mend);
            return;
        }
    };
    let found = match serde_json::from_slice::<Value>(&text) {
        Ok(manifest) => hashes(&manifest),
        Err(error) => {
            let message = format!("not a manifest: {error}");
            findings.file(Severity::Error, MANIFEST_FILE, message, mend);
            return;
        }
    };
    let differs = |(n, (a, b)): (usize, (&String, &String))| (a != b).then_some(n);
    if found.len() != expected.len() {
        let message = format!(
            "it has {} images, study.json has {}",
            found.len(),
            expected.len()
        );
        findings.file(Severity::Error, MANIFEST_FILE, message, mend);
    } else if let Some(n) = expected.iter().zip(&found).enumerate().find_map(differs) {
        let message = format!(
            "image {} has SHA-256 {}, study.json says {}",
            n + 1,
            found[n],
            expected[n]
        );
        findings.file(Severity::Error, MANIFEST_FILE, message, mend);
    }
}

/// Hashes of a manifest's images, first before second. Read as plain JSON: this room
/// knows nothing of stimuli.
fn hashes(manifest: &Value) -> Vec<String> {
    let pairs = manifest["pairs"].as_array().map_or(&[][..], Vec::as_slice);
    pairs
        .iter()
        .flat_map(|pair| [&pair["first"], &pair["second"]])
        .map(|image| image["sha256"].as_str().unwrap_or_default().to_owned())
        .collect()
}
