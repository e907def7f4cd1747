//! The audit: what a careful reviewer would recompute, count and ask before believing the results.

use super::conclusion::plural;
use super::statistic::{About, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Status, Style, Table, Undefined};

mod balance;
mod participants;
mod published;
mod votes;

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "audit",
        name: "audit",
        formula: "a printed number with d decimals is right where it differs from the recomputed one by at most ½ · 10⁻ᵈ; chi-square in whole numbers",
        source: "M. B. Nuijten, C. H. J. Hartgerink, M. A. L. M. van Assen, S. Epskamp, J. M. Wicherts (2016), Behavior Research Methods 48(4), 1205–1226, on recomputing printed tests",
        validity: "a fault is certain; a note is something to explain, not a reason to leave data out",
    },
    section,
};

/// What a check says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    /// As it should be.
    Ok,
    /// To be explained.
    Note,
    /// Wrong.
    Fault,
}

/// One check.
#[derive(Debug, Clone, PartialEq)]
struct Check {
    /// What is checked.
    check: &'static str,
    /// Of which condition or test; empty for the whole study.
    subject: String,
    /// What was found.
    finding: String,
    verdict: Result<Verdict, Undefined>,
}

impl Check {
    fn new(check: &'static str, verdict: Verdict, finding: String) -> Self {
        Self {
            check,
            subject: String::new(),
            finding,
            verdict: Ok(verdict),
        }
    }

    fn undefined(check: &'static str, why: Undefined) -> Self {
        Self {
            check,
            subject: String::new(),
            finding: format!("not checked: {}", why.reason),
            verdict: Err(why),
        }
    }

    fn of(mut self, subject: &str) -> Self {
        subject.clone_into(&mut self.subject);
        self
    }

    /// As a sentence.
    fn sentence(&self) -> String {
        if self.subject.is_empty() {
            format!("{}: {}.", capital(self.check), self.finding)
        } else {
            format!(
                "{}, {}: {}.",
                capital(self.check),
                self.subject,
                self.finding
            )
        }
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map(|first| first.to_uppercase().chain(letters).collect())
        .unwrap_or_default()
}

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    if data.conditions.is_empty() {
        return None;
    }
    let mut checks = published::checks(data, settings.alpha);
    checks.extend(votes::checks(data, settings));
    checks.extend(balance::checks(data));
    checks.extend(participants::checks(data, settings.alpha));
    let with = |wanted: Verdict| {
        checks
            .iter()
            .filter(move |check| check.verdict == Ok(wanted))
    };
    let (faults, notes) = (with(Verdict::Fault).count(), with(Verdict::Note).count());
    let mut findings = vec![format!(
        "{}: {}, {} to explain; {} as they should be, {} not possible with these data.",
        plural(checks.len(), "check"),
        plural(faults, "fault"),
        notes,
        with(Verdict::Ok).count(),
        checks.iter().filter(|check| check.verdict.is_err()).count(),
    )];
    findings.extend(with(Verdict::Fault).map(Check::sentence));
    findings.extend(with(Verdict::Note).map(Check::sentence));
    Some(Section {
        id: "audit",
        title: "Audit",
        status: Status::Ok,
        findings,
        tables: vec![SectionTable {
            id: "checks",
            caption: "Every check; a note is to be explained, a fault is wrong",
            long: true,
            table: table(&checks),
        }],
    })
}

fn table(checks: &[Check]) -> Table {
    let text = |key, title| Column::new(key, title, Style::Text, Group::Tests);
    Table {
        columns: vec![
            Column::new("check", "check", Style::Text, Group::Key),
            Column::new("subject", "of", Style::Text, Group::Key),
            text("verdict", "verdict"),
            text("status", "status"),
            text("finding", "finding"),
        ],
        rows: (checks.iter())
            .map(|check| {
                let verdict = check.verdict.map(|verdict| match verdict {
                    Verdict::Ok => "ok",
                    Verdict::Note => "note",
                    Verdict::Fault => "fault",
                });
                let status = check.verdict.map_or_else(|why| why.status, |_| Status::Ok);
                vec![
                    Cell::Text(check.check.to_owned()),
                    Cell::Text(check.subject.clone()),
                    Cell::or_undefined(verdict, |verdict| Cell::Text(verdict.to_owned())),
                    Cell::Text(status.text().to_owned()),
                    Cell::Text(check.finding.clone()),
                ]
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests;
