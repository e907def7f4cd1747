//! `greyfield check RESULTS`: the audit of a results folder.

use std::path::Path;

use anyhow::anyhow;
use clap::ValueEnum;

use super::run::failure_of_folder;
use super::{Failure, output};
use crate::record::audit::{Audit, Finding, Severity, audit};

/// How findings are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// One paragraph a finding.
    Text,
    /// One JSON object.
    Json,
}

/// Whether this is a results folder.
pub fn is_results(folder: &Path) -> bool {
    folder.join("study.json").is_file()
}

/// Audits a folder and prints what was found.
///
/// # Errors
/// Exit code 1 if a finding is an error.
pub fn run(results: &Path, format: Format) -> Result<(), Failure> {
    let audit = audit(results).map_err(failure_of_folder)?;
    let printed = match format {
        Format::Text => text(results, &audit),
        Format::Json => serde_json::to_string_pretty(&audit)? + "\n",
    };
    output::write(None, printed.as_bytes())?;
    match audit.count(Severity::Error) {
        0 => Ok(()),
        errors => Err(anyhow!(
            "{}: {errors} {}; do not analyse this data before they are understood",
            results.display(),
            if errors == 1 { "error" } else { "errors" }
        )
        .into()),
    }
}

fn text(results: &Path, audit: &Audit) -> String {
    let mut text: String = audit
        .findings
        .iter()
        .map(|finding| paragraph(results, finding))
        .collect();
    text += &format!(
        "{}: study {}, {} participants, {} rows in {} data files: {} errors, {} warnings, {} notes\n",
        results.display(),
        audit.study_id,
        audit.participants,
        audit.rows,
        audit.data_files,
        audit.count(Severity::Error),
        audit.count(Severity::Warning),
        audit.count(Severity::Note),
    );
    text
}

fn paragraph(results: &Path, finding: &Finding) -> String {
    let severity = match finding.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let line = finding
        .line
        .map_or(String::new(), |line| format!(":{line}"));
    format!(
        "{severity}: {}{line}: {}\n    {}\n",
        results.join(&finding.path).display(),
        finding.message,
        finding.mend
    )
}
