//! Each data file against its slot, its plan and the images.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::finding::{Findings, Severity};
use super::materials::Materials;
use super::slots::{Claims, KnownClaim};
use super::{clock, conduct};
use crate::protocol::{SessionPlan, Trial};
use crate::record::read::{Flaw, Rows};
use crate::record::{
    DATA_FOLDER, DATA_SUFFIX, ParticipantId, RecordError, Study, TrialRow, files, read_rows,
};

/// How much there is.
#[derive(Debug, Default)]
pub(super) struct Sessions {
    pub files: usize,
    pub rows: usize,
}

const CHANGED: &str = "the file was changed by hand or copied from elsewhere: put back its backup, or reject the participant";

/// One data file and what belongs to it.
struct Session<'a> {
    study: &'a Study,
    /// Relative to the results folder.
    path: PathBuf,
    rows: Rows,
    /// The participant's claims, the latest last; at least one.
    claims: Vec<&'a KnownClaim>,
}

/// Checks every data file.
pub(super) fn check(
    study: &Study,
    materials: &Materials,
    claims: &Claims,
    findings: &mut Findings,
) -> Result<Sessions, RecordError> {
    let mut told = Sessions::default();
    let folder = study.folder().join(DATA_FOLDER);
    let mut owners: BTreeMap<String, &str> = BTreeMap::new();
    for claim in &claims.0 {
        match ParticipantId::new(&claim.participant) {
            Ok(id) => {
                let path = study.data_path(&id);
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                owners.insert(name.into_owned(), &claim.participant);
            }
            Err(error) => findings.file(
                Severity::Error,
                claim.path.clone(),
                error.to_string(),
                "put back the file's backup",
            ),
        }
    }
    let names = if folder.is_dir() {
        files::names(&folder)?
    } else {
        Vec::new()
    };
    for name in names {
        if !name.ends_with(DATA_SUFFIX) || name.starts_with('.') {
            continue;
        }
        told.files += 1;
        let path = Path::new(DATA_FOLDER).join(&name);
        let rows = match read_rows(&folder.join(&name)) {
            Ok(rows) => rows,
            Err(error) => {
                owners.remove(&name);
                findings.file(Severity::Error, path, error.to_string(), CHANGED);
                continue;
            }
        };
        told.rows += rows.rows.len();
        let Some(participant) = owners.remove(&name) else {
            unclaimed(path, &rows, findings);
            continue;
        };
        let claims: Vec<&KnownClaim> = claims.of(participant).collect();
        let session = Session {
            study,
            path,
            rows,
            claims,
        };
        session.check(materials, findings);
    }
    for (name, participant) in owners {
        let message = format!("participant {participant:?} has a slot but no data file");
        let mend = "the file was removed or renamed: put it back; an empty session has a file too";
        let path = Path::new(DATA_FOLDER).join(name);
        findings.file(Severity::Error, path, message, mend);
    }
    Ok(told)
}

/// A data file that belongs to nobody with a slot.
fn unclaimed(path: PathBuf, rows: &Rows, findings: &mut Findings) {
    match rows.rows.first() {
        None => findings.file(
            Severity::Warning,
            path,
            "a session without a slot: the program was stopped while the participant was being enrolled",
            "resume that participant's session, or leave the file: it holds no trial",
        ),
        Some(row) => findings.file(
            Severity::Error,
            path,
            format!(
                "{} trials of participant {:?}, who has no slot",
                rows.rows.len(),
                row.participant_id
            ),
            "the file was renamed or copied from elsewhere, or its slot's file was removed: put back the folder's backup",
        ),
    }
}

impl Session<'_> {
    fn check(&self, materials: &Materials, findings: &mut Findings) {
        let Some(claim) = self.claims.last() else {
            return;
        };
        self.flaws(findings);
        let plan = materials.plan(self.study.identity(), claim.claim.slot);
        for (row, &line) in self.rows.rows.iter().zip(&self.rows.lines) {
            self.belongs(row, line, claim, findings);
            if let Some(plan) = &plan {
                self.follows(plan, row, line, findings);
            }
        }
        self.order(findings);
        self.length(plan.as_ref(), claim, findings);
        let grey_ns = materials.protocol.as_ref().map(|p| p.grey.duration_ns());
        clock::check(&self.path, &self.rows, grey_ns, findings);
        let segments = self.claims.iter().flat_map(|claim| claim.segments.keys());
        let segments: Vec<u32> = segments.copied().collect();
        conduct::check(&self.path, &self.rows, &segments, findings);
        if let Some(catch) = materials.protocol.as_ref().and_then(|p| p.catch.as_ref()) {
            conduct::attention(&self.path, &self.rows, catch, findings);
        }
    }

    /// Lines that are no rows.
    fn flaws(&self, findings: &mut Findings) {
        let mut known = self
            .claims
            .iter()
            .flat_map(|claim| claim.segments.values())
            .flat_map(|segment| &segment.damaged_lines);
        for flaw in &self.rows.warnings {
            let at = (self.path.clone(), flaw.line);
            match flaw.flaw {
                Flaw::Repeated => findings.line(
                    Severity::Warning,
                    at,
                    "this row_id stands further up already; the first one counts",
                    "nothing to do if the disk reported an error during this session; otherwise a row was copied",
                ),
                Flaw::CutOff => findings.line(
                    Severity::Warning,
                    at,
                    "the line was cut off by a crash; it does not count",
                    "resume the session: the line is ended, and the trial is asked again",
                ),
                Flaw::Damaged if known.any(|&line| line == flaw.line) => findings.line(
                    Severity::Note,
                    at,
                    "the line was cut off by a crash; the session went on after it",
                    "nothing to do: the trial was asked again",
                ),
                Flaw::Damaged => findings.line(
                    Severity::Warning,
                    at,
                    "the checksum does not fit, and no resume tells of it: cut off while the disk was full, or changed since",
                    "if it was changed by hand, put back the file's backup; the line does not count",
                ),
            }
        }
    }

    /// The row is of this study, this participant and this slot.
    fn belongs(&self, row: &TrialRow, line: u64, claim: &KnownClaim, findings: &mut Findings) {
        let identity = self.study.identity();
        let told = [
            ("study_id", &row.study_id, &identity.study_id),
            ("protocol_hash", &row.protocol_hash, &identity.protocol_hash),
            ("participant_id", &row.participant_id, &claim.participant),
            ("slot", &row.slot.to_string(), &claim.claim.slot.to_string()),
            ("pilot", &row.pilot.to_string(), &claim.pilot.to_string()),
        ]
        .map(|(column, found, expected)| {
            (found != expected).then(|| format!("{column} is {found}, expected {expected}"))
        });
        for message in told.into_iter().flatten() {
            let at = (self.path.clone(), line);
            findings.line(Severity::Error, at, message, CHANGED);
        }
    }

    /// The row is the trial that the plan has in its place, with the study's images.
    fn follows(&self, plan: &SessionPlan, row: &TrialRow, line: u64, findings: &mut Findings) {
        let at = (self.path.clone(), line);
        let index = row.trial_index as usize;
        let Some(trial) = plan.trials.iter().find(|trial| trial.index == index) else {
            let message = format!(
                "trial {index}, but the plan has {} from 0",
                plan.trials.len()
            );
            findings.line(Severity::Error, at, message, CHANGED);
            return;
        };
        let (first, second) = plan.techniques(trial);
        let planned = (plan.conditions[trial.condition].id.as_str(), first, second);
        let found = (
            row.condition.as_str(),
            row.technique_first.as_str(),
            row.technique_second.as_str(),
        );
        if found != planned || row.phase != trial.phase {
            let message = format!(
                "trial {index} shows {} ({}, {}), the plan of slot {} says {} ({first}, {second})",
                found.0, found.1, found.2, plan.slot, planned.0
            );
            findings.line(Severity::Error, at, message, CHANGED);
        } else if let Some(message) = self.other_image(trial, row) {
            let mend = "the session showed other pictures than the study's: reject the participant, and find out how";
            findings.line(Severity::Error, at, message, mend);
        }
    }

    /// Trials are on record in the order they were shown, and none before the last is missing.
    fn order(&self, findings: &mut Findings) {
        let mut expected = 0;
        for (row, &line) in self.rows.rows.iter().zip(&self.rows.lines) {
            let at = (self.path.clone(), line);
            if row.trial_index > expected {
                let missing = match row.trial_index - expected {
                    1 => format!("trial {expected} is missing"),
                    _ => format!("trials {expected} to {} are missing", row.trial_index - 1),
                };
                let message = format!("{missing}, though later ones are on record");
                findings.line(Severity::Error, at, message, CHANGED);
            } else if row.trial_index < expected {
                let message = format!(
                    "trial {} stands after trial {}: out of order",
                    row.trial_index,
                    expected - 1
                );
                findings.line(Severity::Error, at, message, CHANGED);
            }
            expected = row.trial_index.saturating_add(1);
        }
    }

    /// Image hashes that are not those of the study, where these are known.
    fn other_image(&self, trial: &Trial, row: &TrialRow) -> Option<String> {
        let identity = self.study.identity();
        let hashes = &identity.image_sha256;
        if hashes.is_empty() {
            return None;
        }
        let in_pairs = hashes.len() == 2 * identity.conditions.len()
            && (identity.conditions.iter()).all(|it| it.techniques.len() == 2);
        let shown = [
            ("first", &row.first_image_sha256),
            ("second", &row.second_image_sha256),
            ("reference", &row.reference_image_sha256),
        ];
        for (place, (which, found)) in shown.into_iter().enumerate() {
            let known: Vec<&String> = match trial.places.get(place) {
                Some(&image) if in_pairs => hashes
                    .get(2 * trial.condition + image)
                    .into_iter()
                    .collect(),
                _ => hashes.iter().collect(),
            };
            if !found.is_empty() && !known.contains(&found) {
                let expected = match known[..] {
                    [expected] => format!("study.json says {expected}"),
                    _ => "which is none of the study's images".to_owned(),
                };
                return Some(format!(
                    "the {which} image shown has SHA-256 {found}, {expected}"
                ));
            }
        }
        None
    }

    /// Trials that are not on record yet.
    fn length(&self, plan: Option<&SessionPlan>, claim: &KnownClaim, findings: &mut Findings) {
        let planned = plan.map_or(self.study.identity().trials(), |plan| plan.trials.len());
        let found = self.rows.rows.len();
        if found >= planned {
            return;
        }
        let message = format!("unfinished: {found} of {planned} trials");
        if claim.released {
            let mend = "nothing to do: the slot was given to the next participant";
            findings.file(Severity::Note, self.path.clone(), message, mend);
        } else {
            let mend = format!(
                "resume participant {0:?}, or release the slot: greyfield participants RESULTS --release {0} --reason TEXT",
                claim.participant
            );
            findings.file(Severity::Warning, self.path.clone(), message, mend);
        }
    }
}
