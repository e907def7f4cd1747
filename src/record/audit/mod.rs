//! Is a results folder what it should be? Reads everything in it and changes nothing.
//!
//! One file a subject: `materials` (what the folder belongs to), `slots`, `sessions`
//! (each data file against its slot and its plan), `clock` (the times in the rows),
//! `conduct` (what happened during a session that an analyst should know of).

mod clock;
mod conduct;
mod finding;
mod materials;
mod sessions;
mod slots;

use std::path::Path;

use serde::Serialize;

use finding::Findings;
pub use finding::{Finding, Severity};

use super::{RecordError, Study};

/// What an audit found.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Audit {
    /// The study.
    pub study_id: String,
    /// Participants with a slot, try-outs included.
    pub participants: usize,
    /// Data files.
    pub data_files: usize,
    /// Whole rows in them.
    pub rows: usize,
    /// The worst first, then by file and line.
    pub findings: Vec<Finding>,
}

impl Audit {
    /// How many findings there are of a severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        let of_it = |finding: &&Finding| finding.severity == severity;
        self.findings.iter().filter(of_it).count()
    }
}

/// Audits a results folder.
///
/// # Errors
/// [`RecordError`] if there is no `study.json` or the disk says no. Everything else is
/// a finding.
pub fn audit(results: &Path) -> Result<Audit, RecordError> {
    let study = Study::open_existing(results)?;
    let mut findings = Findings::default();
    let materials = materials::check(&study, &mut findings);
    let claims = slots::check(results, &mut findings)?;
    let sessions = sessions::check(&study, &materials, &claims, &mut findings)?;
    let mut findings = findings.0;
    findings.sort();
    Ok(Audit {
        study_id: study.identity().study_id.clone(),
        participants: claims.participants(),
        data_files: sessions.files,
        rows: sessions.rows,
        findings,
    })
}
