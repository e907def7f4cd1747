//! The columns of a data file: what each means, in which unit, with which values.
//! This is the `variableMeasured` of `dataset_description.json`.

/// One column.
#[derive(Debug)]
pub struct Column {
    /// Its name in the header.
    pub name: &'static str,
    /// What it means.
    pub description: &'static str,
    /// Its unit; empty for none.
    pub unit: &'static str,
    /// The values it may have; empty where any.
    pub values: &'static [&'static str],
}

const fn plain(name: &'static str, description: &'static str) -> Column {
    measured(name, description, "")
}

const fn measured(name: &'static str, description: &'static str, unit: &'static str) -> Column {
    Column {
        name,
        description,
        unit,
        values: &[],
    }
}

const fn one_of(
    name: &'static str,
    description: &'static str,
    values: &'static [&'static str],
) -> Column {
    Column {
        name,
        description,
        unit: "",
        values,
    }
}

/// Every column, in the order of the file.
#[rustfmt::skip]
pub const COLUMNS: &[Column] = &[
    plain("row_id", "Names the row; unique in the study: participant, session, phase and trial. Should it stand twice, the first counts."),
    plain("schema_version", "Version of this layout of columns."),
    plain("app_version", "Version of Greyfield that wrote the row."),
    plain("study_id", "The study, as its protocol names it."),
    plain("protocol_hash", "SHA-256 of the protocol's file, which is kept as materials/protocol.toml."),
    plain("station_id", "The computer the session ran on, as the experimenter named it."),
    plain("participant_id", "Pseudonymous id of the participant."),
    plain("slot", "Participant number in the counterbalancing design, from 0; the order of trials follows from it, the protocol and its seed."),
    plain("session", "Which session of this participant, from 1."),
    plain("segment", "Which uninterrupted run of the session, from 1; 2 after the first resume."),
    one_of("pilot", "Whether the row was recorded to try the study out and is not data.", &["true", "false"]),
    plain("procedure", "What a trial is made of, as the protocol names it: no-reference, no-reference-timed, rating, reference or rank-order; empty in rows of schema version 1, which are no-reference."),
    plain("language", "Language of the participant's screens, ISO 639-1."),
    one_of("phase", "What the trial counts for: practice (never analysed), catch (attention check) or main.", &["practice", "catch", "main"]),
    plain("trial_index", "Place of the trial in the session, from 0."),
    plain("condition", "The pair of images shown."),
    plain("scene", "The scene both images show."),
    plain("technique_first", "Ambient-occlusion technique of the image shown first, or on the left, or alone."),
    plain("technique_second", "Ambient-occlusion technique of the image shown second, or on the right; empty where one image was shown alone."),
    plain("technique_reference", "Technique of the image the two were compared with; empty where there was none."),
    plain("techniques_shown", "Techniques of all images of a ranking, by place on the screen row by row, with ; between them; empty otherwise."),
    plain("first_image_sha256", "SHA-256 of the file of the image shown first."),
    plain("second_image_sha256", "SHA-256 of the file of the image shown second."),
    plain("reference_image_sha256", "SHA-256 of the file of the reference; empty where there was none."),
    plain("images_sha256", "SHA-256 of the files of all images of a ranking, in the order of techniques_shown; empty otherwise."),
    measured("first_onset_ns", "First frame with the first image. All times of this kind are on one monotonic clock that starts at 0 with each segment; how they were obtained stands in onset_method.", "ns"),
    measured("first_offset_ns", "First frame without the first image.", "ns"),
    measured("grey_onset_ns", "First frame with the grey between the images, or before the first.", "ns"),
    measured("grey_offset_ns", "First frame without that grey.", "ns"),
    measured("second_onset_ns", "First frame with the second image.", "ns"),
    measured("second_offset_ns", "First frame without the second image.", "ns"),
    measured("question_onset_ns", "First frame with the question.", "ns"),
    measured("response_ns", "When the answer was received.", "ns"),
    plain("grey_frames", "Number of frames the grey stood for; empty where nobody counted."),
    one_of("onset_method", "How the times of frames were obtained: present-feedback (the display system reported them), present-call (when the frame was handed over, an estimate) or virtual (a scripted observer, nothing was displayed).", &["virtual", "present-call", "present-feedback"]),
    measured("onset_uncertainty_ms", "How far the times of frames may lie from the light of the display, either way; empty if unknown.", "ms"),
    plain("missed_frames", "Number of frames of the trial that came late; empty where nobody counted."),
    measured("refresh_period_ms", "Mean time between two frames of the display, measured before the session; empty where nobody measured.", "ms"),
    measured("refresh_jitter_sd_ms", "Standard deviation of the times between two frames, measured before the session.", "ms"),
    one_of("display_check", "What the check of the display before the session said: passed, warned (it was not as the protocol asks, and the protocol only warns) or unchecked.", &["unchecked", "passed", "warned"]),
    one_of("response", "Which image the participant chose, by time or from left to right; cannot-tell where the protocol allows that; empty where images were rated or ranked.", &["first", "second", "cannot-tell"]),
    plain("chosen_technique", "Technique of the image chosen; empty where none was."),
    one_of("correct", "Whether a catch trial was passed; empty in all other trials.", &["true", "false"]),
    plain("ratings", "Ratings of an image, scale=points with ; between them; 1 is the low end. Empty where nothing was rated."),
    plain("ranking", "Techniques of a ranking, the best first, with ; between them; empty where nothing was ranked."),
    measured("response_time_ms", "From the first frame of the question to the answer: response_ns minus question_onset_ns. The time spent looking at the images is not in it.", "ms"),
    one_of("input_device", "What the answer was given with.", &["keyboard", "mouse", "gamepad", "scripted"]),
    plain("focus_lost", "How often the window was without the keyboard focus during the trial."),
    one_of("outcome", "How the trial ended.", &["answered"]),
    measured("resume_gap_ms", "In the first row after a resume: wall-clock time between what came last on record (a row, a resume or the claim of the slot) and this answer. Empty in all other rows.", "ms"),
    plain("answered_utc", "Wall-clock time of the answer, UTC, ISO 8601."),
    plain(super::line::CHECKSUM_COLUMN, "The letter x and the CRC-32 of the line before its last comma: tells a whole row from one that a crash has cut off."),
];
