//! The result, the votes, the tests, and the sections of the statistics.

use super::{Part, TableBlock};
use crate::analysis::Analysis;
use crate::analysis::conditions::{Verdict, main_family};
use crate::analysis::statistic::Section;
use crate::analysis::table::{Group, Status};
use crate::report::study_figures::{CHOICES, TESTS};

/// Section whose columns by condition stand in the wide table of conditions.
const POSITION: &str = "position_bias";

/// The main result, and what must be known about the input beside it: a scripted observer is no
/// person.
pub fn result(analysis: &Analysis) -> Part {
    /// A folder with many damaged lines has a note on each; the JSON report has them all.
    const MOST_NOTES: usize = 8;
    let mut part = Part::default();
    for sentence in &analysis.conclusion {
        part.paragraph(sentence);
    }
    let notes = &analysis.data.notes;
    for note in notes.iter().take(MOST_NOTES) {
        part.note(note);
    }
    if notes.len() > MOST_NOTES {
        let more = notes.len() - MOST_NOTES;
        part.note(format!("… and {more} notes more, in the JSON report."));
    }
    part
}

/// Votes, shares, effect sizes.
pub fn votes(analysis: &Analysis) -> Part {
    let confidence = analysis.settings.alpha.confidence_percent();
    let mut part = Part::new("Choices");
    part.figures(analysis, CHOICES);
    part.table(TableBlock::new(
        format!("Votes, and the share of technique b with {confidence} % intervals"),
        analysis.conditions.only(&[Group::Key, Group::Choices]),
    ));
    part.table(TableBlock::new(
        "Effect size (g is positive towards technique b)",
        analysis.conditions.only(&[Group::Key, Group::Effects]),
    ));
    part
}

/// Tests against an even split, and evidence that is no p-value.
pub fn tests(analysis: &Analysis) -> Part {
    let family = main_family(&analysis.data, &analysis.settings);
    let declared = match analysis.settings.family.is_empty() {
        true => "all conditions with votes",
        false => "the conditions that were declared",
    };
    let mut part = Part::new("Tests against an even split");
    part.paragraph(format!(
        "Null hypothesis of each condition: both images are chosen equally often. The family is {declared}, {} in number; Holm's correction holds the chance of any false finding among them at {}. The verdict rests on the exact p after Holm.",
        family.size(),
        analysis.settings.alpha.get()
    ));
    part.figures(analysis, TESTS);
    let strong = (0..analysis.data.conditions.len())
        .map(|i| family.verdict(i, &analysis.settings) == Verdict::Significant)
        .collect();
    part.table(TableBlock {
        strong,
        ..TableBlock::new(
            "p-values before and after correction for the family (BH: Benjamini–Hochberg)",
            analysis.conditions.only(&[Group::Key, Group::Tests]),
        )
    });
    let evidence = analysis.conditions.only(&[Group::Key, Group::Evidence]);
    if evidence.columns.len() > 1 {
        part.table(TableBlock::new(
            "Evidence without a fixed number of participants: Bayes factor against an even split, and the test that may be looked at after every answer",
            evidence,
        ));
    }
    part
}

/// A statistic of the whole study.
pub fn section(section: &Section, analysis: &Analysis) -> Part {
    let mut part = findings(section);
    part.figures(analysis, section.id);
    if section.id == POSITION {
        part.table(TableBlock::new(
            "Orders shown and positions chosen, by condition",
            analysis.conditions.only(&[Group::Key, Group::Position]),
        ));
    }
    tables(&mut part, section);
    part
}

impl Part {
    /// A section without figures.
    #[must_use]
    pub fn of_section(section: &Section) -> Self {
        let mut part = findings(section);
        tables(&mut part, section);
        part
    }
}

fn findings(section: &Section) -> Part {
    let mut part = Part::new(section.title);
    if section.status != Status::Ok {
        part.note(format!("Status: {}.", section.status.text()));
    }
    for finding in &section.findings {
        part.paragraph(finding);
    }
    part
}

fn tables(part: &mut Part, section: &Section) {
    for table in &section.tables {
        let block = TableBlock::new(table.caption, table.table.clone());
        part.table(block.folded(table.long));
    }
}
