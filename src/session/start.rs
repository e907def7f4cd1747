//! From a place in a study to a running session: what a window and a scripted
//! observer do alike.

use std::path::Path;

use time::OffsetDateTime;

use super::{DisplayOnRecord, Effect, Event, ImageHashes, Session, SessionInfo};
use crate::protocol::exhibit::{self, Exhibit, ImageOf};
use crate::protocol::{Condition, Language, Pair, PlanError, Position, Protocol, SessionPlan};
use crate::record::row::LIST_SEPARATOR;
use crate::record::{
    Enrolment, InputDevice, OnsetMethod, RecordError, Study, StudyIdentity, about,
};
use crate::stimulus::{ImageRecord, Manifest};

/// Where and how a session runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Wall-clock time at [`SessionTime`](super::SessionTime) 0.
    pub started_utc: OffsetDateTime,
    /// How the times of [`Event::Shown`] are obtained.
    pub onset_method: OnsetMethod,
    /// How far they may lie from the light of the display, either way.
    pub onset_uncertainty_ms: Option<f64>,
    /// The display as it was measured.
    pub display: DisplayOnRecord,
    /// Time from refresh to refresh, where frames are known to keep to it
    /// (see [`SessionInfo::refresh_period_ns`]).
    pub refresh_period_ns: Option<u64>,
    /// The device answers come from at first.
    pub input_device: InputDevice,
    /// Language of the participant's screens.
    pub language: Language,
}

/// A results folder that cannot be opened for a protocol and its images.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// No session can be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The folder does not fit, or the disk said no.
    #[error(transparent)]
    Record(#[from] RecordError),
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
/// [`OpenError`] saying what does not fit, or what the disk said.
pub fn open_study(
    results: &Path,
    protocol: &Protocol,
    protocol_text: &str,
    manifest: &Manifest,
) -> Result<Study, OpenError> {
    let conditions = conditions(protocol, manifest)?;
    // A protocol that makes no plan is refused before anything is written.
    SessionPlan::new(protocol, &conditions, 0)?;
    let mut identity = StudyIdentity::new(protocol, &conditions);
    identity.image_sha256 = manifest
        .images()
        .map(|image| image.sha256.clone())
        .collect();
    let study = Study::open(results, identity, protocol_text)?;
    let manifest = serde_json::to_vec_pretty(manifest).unwrap_or_default();
    study.keep("materials/manifest.json", &manifest)?;
    Ok(study)
}

/// The pairs of a rendered set, in its order.
#[must_use]
pub fn pairs(manifest: &Manifest) -> Vec<Pair> {
    let pairs = manifest.pairs.iter();
    pairs
        .map(|pair| Pair {
            id: pair.condition.clone(),
            scene: pair.scene.clone(),
            lighting: pair.validity.clone(),
            techniques: [&pair.first, &pair.second].map(|image| image.technique.clone()),
            image_sha256: [&pair.first, &pair.second].map(|image| image.sha256.clone()),
            hypothesis: pair.hypothesis.clone(),
        })
        .collect()
}

/// What the trials of a protocol show of a rendered set, in the set's order.
///
/// # Errors
/// [`PlanError`] if the set lacks what the procedure shows.
pub fn exhibits(protocol: &Protocol, manifest: &Manifest) -> Result<Vec<Exhibit>, PlanError> {
    exhibit::exhibits(protocol, &pairs(manifest))
}

/// The conditions of a protocol over a rendered set, in the set's order.
///
/// # Errors
/// As [`exhibits`].
pub fn conditions(protocol: &Protocol, manifest: &Manifest) -> Result<Vec<Condition>, PlanError> {
    let exhibits = exhibits(protocol, manifest)?;
    Ok(exhibits.into_iter().map(|it| it.condition).collect())
}

/// An exhibit's image in the manifest it was made from.
#[must_use]
pub fn image(manifest: &Manifest, at: ImageOf) -> Option<&ImageRecord> {
    let pair = manifest.pairs.get(at.pair)?;
    Some(match at.position {
        Position::First => &pair.first,
        Position::Second => &pair.second,
    })
}

fn hashes(manifest: &Manifest, exhibit: &Exhibit) -> ImageHashes {
    let sha256 = |&at: &ImageOf| {
        image(manifest, at).map_or_else(String::new, |record| record.sha256.clone())
    };
    ImageHashes {
        images: exhibit.images.iter().map(sha256).collect(),
        reference: exhibit.reference.as_ref().map(sha256),
    }
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
    let exhibits = exhibits(protocol, manifest)?;
    let images = exhibits.iter().map(|it| hashes(manifest, it)).collect();
    let conditions: Vec<Condition> = exhibits.into_iter().map(|it| it.condition).collect();
    let plan = SessionPlan::new(protocol, &conditions, enrolment.slot)?;
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
        display: setting.display,
        refresh_period_ns: setting.refresh_period_ns,
        input_device: setting.input_device,
        // Whoever was asked in one language goes on in it.
        language: (enrolment.about.as_ref()).map_or(setting.language, |about| about.language),
        images,
        has_told: enrolment.about.is_some(),
        answered: enrolment.rows.len(),
        interrupted_utc: enrolment.interrupted_utc,
    };
    Ok(Session::new(plan, protocol, info))
}

fn check_rows(plan: &SessionPlan, enrolment: &Enrolment) -> Result<(), StartError> {
    for (index, row) in enrolment.rows.iter().enumerate() {
        let shown = |condition: &str, techniques: &[&str]| {
            let there = techniques.iter().filter(|technique| !technique.is_empty());
            let there: Vec<&str> = there.copied().collect();
            format!("{condition} ({})", there.join(", "))
        };
        let found = if row.techniques_shown.is_empty() {
            shown(
                &row.condition,
                &[&row.technique_first, &row.technique_second],
            )
        } else {
            let ranked: Vec<&str> = row.techniques_shown.split(LIST_SEPARATOR).collect();
            shown(&row.condition, &ranked)
        };
        let expected = plan.trials.get(index).map_or_else(
            || "no such trial".to_owned(),
            |trial| {
                let planned: Vec<&str> = plan.shown(trial).collect();
                shown(&plan.conditions[trial.condition].id, &planned)
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
pub fn perform(effect: &Effect, enrolment: &mut Enrolment) -> Event {
    let stored = match effect {
        Effect::StoreRow(row) => enrolment.log.append_row(row),
        Effect::StoreAbout(told) => about::store(&enrolment.results, &enrolment.participant, told),
    };
    match stored {
        Ok(()) => Event::RowStored,
        Err(error) => Event::StoreFailed(error.to_string()),
    }
}
