//! The promises of the results folder.

mod audits;
pub(crate) mod lines;
mod standings;
mod studies;

use super::row::SCHEMA_VERSION;
use super::{DisplayVerdict, InputDevice, OnsetMethod, Outcome, Response, TrialRow};
use crate::protocol::{Language, Phase};

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
        procedure: "no-reference".to_owned(),
        language: Language::En,
        phase: Phase::Main,
        trial_index,
        condition: format!("c{trial_index}"),
        scene: "atrium".to_owned(),
        technique_first: "none".to_owned(),
        technique_second: "blizzard24".to_owned(),
        technique_reference: String::new(),
        techniques_shown: String::new(),
        first_image_sha256: "cd".repeat(32),
        second_image_sha256: "ef".repeat(32),
        reference_image_sha256: String::new(),
        images_sha256: String::new(),
        first_onset_ns: Some(1_000_000_000),
        first_offset_ns: Some(4_000_000_000),
        grey_onset_ns: Some(4_000_000_000),
        grey_offset_ns: Some(6_000_000_000),
        second_onset_ns: Some(6_000_000_000),
        second_offset_ns: Some(9_000_000_000),
        question_onset_ns: Some(9_000_000_000),
        response_ns: Some(10_234_500_000),
        grey_frames: Some(120),
        onset_method: OnsetMethod::PresentCall,
        onset_uncertainty_ms: Some(16.7),
        missed_frames: None,
        refresh_period_ms: Some(16.67),
        refresh_jitter_sd_ms: Some(0.04),
        display_check: DisplayVerdict::Passed,
        response: Some(Response::Second),
        chosen_technique: Some("blizzard24".to_owned()),
        correct: None,
        ratings: String::new(),
        ranking: String::new(),
        response_time_ms: Some(1234.5),
        input_device: InputDevice::Keyboard,
        focus_lost: 0,
        outcome: Outcome::Answered,
        resume_gap_ms: None,
        answered_utc: "2026-03-01T10:00:11.2345Z".to_owned(),
    }
}
