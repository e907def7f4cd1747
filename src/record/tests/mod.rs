//! The promises of the results folder.

mod audits;
pub(crate) mod lines;
mod standings;
mod studies;

use super::row::SCHEMA_VERSION;
use super::{InputDevice, OnsetMethod, Outcome, TrialRow};
use crate::protocol::{Phase, Position};

/// An answered trial.
pub(crate) fn row(participant: &str, trial_index: u32) -> TrialRow {
    TrialRow {
        row_id: format!("{participant}:1:main:{trial_index}"),
        schema_version: SCHEMA_VERSION,
        app_version: "0.1.0".to_owned(),
        study_id: "s".to_owned(),
        protocol_hash: "ab".repeat(32),
        station_id: "lab".to_owned(),
        participant_id: participant.to_owned(),
        slot: 0,
        session: 1,
        segment: 1,
        pilot: false,
        phase: Phase::Main,
        trial_index,
        condition: format!("c{trial_index}"),
        scene: "atrium".to_owned(),
        technique_first: "none".to_owned(),
        technique_second: "blizzard24".to_owned(),
        first_image_sha256: "cd".repeat(32),
        second_image_sha256: "ef".repeat(32),
        first_onset_ns: Some(1_000_000_000),
        first_offset_ns: Some(4_000_000_000),
        grey_onset_ns: Some(4_000_000_000),
        grey_offset_ns: Some(6_000_000_000),
        second_onset_ns: Some(6_000_000_000),
        second_offset_ns: Some(9_000_000_000),
        question_onset_ns: Some(9_000_000_000),
        response_ns: Some(10_234_500_000),
        onset_method: OnsetMethod::PresentCall,
        onset_uncertainty_ms: Some(16.7),
        missed_frames: None,
        response: Some(Position::Second),
        chosen_technique: Some("blizzard24".to_owned()),
        response_time_ms: Some(1234.5),
        input_device: InputDevice::Keyboard,
        focus_lost: 0,
        outcome: Outcome::Answered,
        resume_gap_ms: None,
        answered_utc: "2026-03-01T10:00:11.2345Z".to_owned(),
    }
}
