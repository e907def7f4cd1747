//! The report as one page: no script, no font, no picture from elsewhere.

mod elements;
mod provenance;
mod study;

use std::fmt::Write as _;

use self::elements::{capitalised, figure, paragraph, section_table, table};
use super::methods;
use super::study_figures::{self, CHOICES, TESTS};
use super::svg::escape;
use crate::analysis::Analysis;
use crate::analysis::conditions::{Verdict, main_family};
use crate::analysis::registry;
use crate::analysis::statistic::Section;
use crate::analysis::table::{Group, Status, Table};

/// Section whose by-condition columns stand in the wide table of conditions.
const POSITION: &str = "position_bias";

const STYLE: &str = include_str!("page.css");

/// The whole page.
pub fn render(analysis: &Analysis) -> String {
    let mut page = String::new();
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n",
        escape(&study::title(analysis))
    );
    study::head(&mut page, analysis);
    result(&mut page, analysis);
    study::asked(&mut page, analysis);
    study::who(&mut page, analysis);
    if !analysis.data.conditions.is_empty() {
        choices(&mut page, analysis);
        tests(&mut page, analysis);
    }
    for section in &analysis.sections {
        whole_section(&mut page, section, analysis);
    }
    methods_section(&mut page, analysis);
    provenance::section(&mut page, analysis);
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

fn result(page: &mut String, analysis: &Analysis) {
    page.push_str("<section class=\"result\">\n");
    for sentence in &analysis.conclusion {
        paragraph(page, sentence);
    }
    notes(page, &analysis.data.notes);
    page.push_str("</section>\n");
}

/// What the reader must know about the input, beside the result: a scripted observer is no person.
fn notes(page: &mut String, notes: &[String]) {
    /// A folder with many damaged lines has a note on each; the JSON report has them all.
    const MOST: usize = 8;
    for note in notes.iter().take(MOST) {
        let _ = writeln!(page, "<p class=\"reason\">{}</p>", escape(note));
    }
    if notes.len() > MOST {
        let _ = writeln!(
            page,
            "<p class=\"reason\">… and {} notes more, in the JSON report.</p>",
            notes.len() - MOST
        );
    }
}

fn figures(page: &mut String, analysis: &Analysis, section: &str) {
    for drawing in study_figures::of_section(analysis, section) {
        figure(page, drawing);
    }
}

fn choices(page: &mut String, analysis: &Analysis) {
    let confidence = analysis.settings.alpha.confidence_percent();
    page.push_str("<section>\n<h2>Choices</h2>\n");
    figures(page, analysis, CHOICES);
    table(
        page,
        &analysis
            .conditions
            .only(&[Group::Key, Group::Choices, Group::Effects]),
        &format!(
            "Votes, share of technique b with {confidence} % intervals, effect size (g is positive towards technique b)"
        ),
        None,
    );
    page.push_str("</section>\n");
}

fn tests(page: &mut String, analysis: &Analysis) {
    let family = main_family(&analysis.data, &analysis.settings);
    let strong: Vec<bool> = (0..analysis.data.conditions.len())
        .map(|i| family.verdict(i, &analysis.settings) == Verdict::Significant)
        .collect();
    page.push_str("<section>\n<h2>Tests against an even split</h2>\n");
    let declared = match analysis.settings.family.is_empty() {
        true => "all conditions with votes",
        false => "the conditions that were declared",
    };
    paragraph(
        page,
        &format!(
            "Null hypothesis of each condition: both images are chosen equally often. The family is {declared}, {} in number; Holm's correction holds the chance of any false finding among them at {}. The verdict rests on the exact p after Holm.",
            family.size(),
            analysis.settings.alpha.get()
        ),
    );
    figures(page, analysis, TESTS);
    table(
        page,
        &analysis.conditions.only(&[Group::Key, Group::Tests]),
        "p-values before and after correction for the family (BH: Benjamini–Hochberg)",
        Some(&strong),
    );
    let evidence = analysis.conditions.only(&[Group::Key, Group::Evidence]);
    if has_numbers(&evidence) {
        table(page, &evidence, EVIDENCE, None);
    }
    page.push_str("</section>\n");
}

/// Caption of the columns that weigh evidence without a p-value.
pub const EVIDENCE: &str = "Evidence: Bayes factor for a preference against an even split, and the test that may be looked at after every answer";

/// Whether a table of the conditions has anything besides their names.
fn has_numbers(table: &Table) -> bool {
    table.columns.len() > 1
}

fn whole_section(page: &mut String, section: &Section, analysis: &Analysis) {
    let _ = writeln!(page, "<section>\n<h2>{}</h2>", escape(section.title));
    if section.status != Status::Ok {
        let status = section.status.text();
        let _ = writeln!(page, "<p class=\"status\">Status: {status}</p>");
    }
    for finding in &section.findings {
        paragraph(page, finding);
    }
    figures(page, analysis, section.id);
    if section.id == POSITION {
        table(
            page,
            &analysis.conditions.only(&[Group::Key, Group::Position]),
            "Orders shown and positions chosen, by condition",
            None,
        );
    }
    for part in &section.tables {
        section_table(page, part);
    }
    page.push_str("</section>\n");
}

fn methods_section(page: &mut String, analysis: &Analysis) {
    page.push_str("<section>\n<h2>Methods</h2>\n<p>To paste into a paper:</p>\n<blockquote>\n");
    for text in methods::paragraphs(analysis) {
        paragraph(page, &text);
    }
    page.push_str("</blockquote>\n<details>\n<summary>Formulas, sources, and where each holds</summary>\n<dl>\n");
    for about in registry::abouts() {
        let _ = writeln!(
            page,
            "<dt>{}</dt>\n<dd>{}<br>{}. <span class=\"source\">{}.</span></dd>",
            escape(about.name),
            escape(about.formula),
            escape(&capitalised(about.validity)),
            escape(about.source),
        );
    }
    page.push_str("</dl>\n</details>\n</section>\n");
}
