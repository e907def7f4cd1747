//! From a place in a study to a running session: what a window and a scripted
//! observer do alike.

use std::path::Path;

use time::OffsetDateTime;

use super::{Effect, Event, PairHashes, Session, SessionInfo};
use crate::protocol::{Condition, PlanError, Protocol, SessionPlan};
use crate::record::{
    Enrolment, InputDevice, OnsetMethod, RecordError, RowLog, Study, StudyIdentity,
};
use crate::stimulus::Manifest;

/// Where and how a session runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Wall-clock time at [`SessionTime`](super::SessionTime) 0.
    pub started_utc: OffsetDateTime,
    /// How the times of [`Event::Shown`] are obtained.
    pub onset_method: OnsetMethod,
    /// How far they may lie from the light of the display, either way.
    pub onset_uncertainty_ms: Option<f64>,
    /// Time from refresh to refresh, where frames are known to keep to it
    /// (see [`SessionInfo::refresh_period_ns`]).
    pub refresh_period_ns: Option<u64>,
    /// The device answers come from at first.
    pub input_device: InputDevice,
}

/// A session that cannot start.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StartError {
    /// No plan.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The rows on record are not those of this plan.
    #[error(
        "participant {participant}: trial {trial} on record shows {found}, the plan says {expected}; the data file or the protocol has been changed, the session cannot go on"
    )]
    OtherTrial {
        /// The participant.
        participant: String,
        /// Place in the session, from 0.
        trial: usize,
        /// Condition and techniques on record.
        found: String,
        /// Condition and techniques planned.
        expected: String,
    },
}

/// Opens the results folder of a protocol over a rendered set. The protocol's text
/// and the manifest are kept beside the data, and a folder begun with another
/// protocol or other images is refused.
///
/// # Errors
/// [`RecordError`] saying what does not fit, or what the disk said.
pub fn open_study(
    results: &Path,
    protocol: &Protocol,
    protocol_text: &str,
    manifest: &Manifest,
) -> Result<Study, RecordError> {
    let mut identity = StudyIdentity::new(protocol, &conditions(manifest));
    identity.image_sha256 = manifest
        .images()
        .map(|image| image.sha256.clone())
        .collect();
    let study = Study::open(results, identity, protocol_text)?;
    let manifest = serde_json::to_vec_pretty(manifest).unwrap_or_default();
    study.keep("materials/manifest.json", &manifest)?;
    Ok(study)
}

/// The conditions of a rendered set, in its order.
#[must_use]
pub fn conditions(manifest: &Manifest) -> Vec<Condition> {
    manifest
        .pairs
        .iter()
        .map(|pair| Condition {
            id: pair.condition.clone(),
            scene: pair.scene.clone(),
            first_technique: pair.first.technique.clone(),
            second_technique: pair.second.technique.clone(),
            hypothesis: pair.hypothesis.clone(),
        })
        .collect()
}

/// The session of an enrolled participant, standing at its instructions.
///
/// # Errors
/// [`StartError`] if there is no plan, or if the rows on record are not of it.
pub fn start(
    protocol: &Protocol,
    manifest: &Manifest,
    enrolment: &Enrolment,
    setting: &Setting,
) -> Result<Session, StartError> {
    let plan = SessionPlan::new(protocol, &conditions(manifest), enrolment.slot)?;
    check_rows(&plan, enrolment)?;
    let info = SessionInfo {
        participant_id: enrolment.participant.to_string(),
        session: enrolment.session,
        segment: enrolment.segment,
        station_id: enrolment.station.clone(),
        pilot: enrolment.pilot,
        started_utc: setting.started_utc,
        onset_method: setting.onset_method,
        onset_uncertainty_ms: setting.onset_uncertainty_ms,
        refresh_period_ns: setting.refresh_period_ns,
        input_device: setting.input_device,
        images: manifest
            .pairs
            .iter()
            .map(|pair| PairHashes {
                first: pair.first.sha256.clone(),
                second: pair.second.sha256.clone(),
            })
            .collect(),
        answered: enrolment.rows.len(),
        interrupted_utc: enrolment.interrupted_utc,
    };
    Ok(Session::new(plan, protocol, info))
}

fn check_rows(plan: &SessionPlan, enrolment: &Enrolment) -> Result<(), StartError> {
    for (index, row) in enrolment.rows.iter().enumerate() {
        let found = format!(
            "{} ({}, {})",
            row.condition, row.technique_first, row.technique_second
        );
        let expected = plan.trials.get(index).map_or_else(
            || "no such trial".to_owned(),
            |trial| {
                let (first, second) = plan.techniques(trial);
                format!(
                    "{} ({first}, {second})",
                    plan.conditions[trial.condition].id
                )
            },
        );
        if found != expected {
            return Err(StartError::OtherTrial {
                participant: enrolment.participant.to_string(),
                trial: index,
                found,
                expected,
            });
        }
    }
    Ok(())
}

/// Does what an effect asks, and gives the event to answer it with.
#[must_use]
pub fn perform(effect: &Effect, log: &mut RowLog) -> Event {
    match effect {
        Effect::StoreRow(row) => match log.append_row(row) {
            Ok(()) => Event::RowStored,
            Err(error) => Event::StoreFailed(error.to_string()),
        },
    }
}
