//! The report for a terminal.

use std::fmt::Write as _;

use super::VERSION;
use super::number::{align_decimals, shown, width};
use crate::analysis::Analysis;
use crate::analysis::statistic::Section;
use crate::analysis::table::{Cell, Group, Style, Table};

/// Sentences are wrapped here; tables are as wide as they need.
const LINE: usize = 96;

/// The whole report.
pub fn render(analysis: &Analysis) -> String {
    let mut out = String::new();
    heading(&mut out, "Result");
    for sentence in &analysis.conclusion {
        paragraph(&mut out, sentence);
    }
    let confidence = analysis.settings.alpha.confidence_percent();
    let has_answers = analysis.data.has_answers();
    for (title, groups) in [
        (
            format!("Choices (share of technique b, {confidence} % intervals)"),
            &[Group::Key, Group::Choices][..],
        ),
        (
            format!(
                "Tests against an even split (alpha = {}, verdict from exact p after Holm)",
                analysis.settings.alpha.get()
            ),
            &[Group::Key, Group::Tests],
        ),
        (
            "Effect size (g > 0: towards technique b)".to_owned(),
            &[Group::Key, Group::Effects],
        ),
        (
            "Order shown and position chosen".to_owned(),
            &[Group::Key, Group::Position],
        ),
    ] {
        if groups.contains(&Group::Position) && !has_answers {
            continue;
        }
        heading(&mut out, &title);
        table(&mut out, &analysis.conditions.only(groups));
    }
    for part in &analysis.sections {
        section(&mut out, part);
    }
    inputs(&mut out, analysis);
    out
}

/// Sections alone.
pub fn sections(sections: &[Section]) -> String {
    let mut out = String::new();
    for part in sections {
        section(&mut out, part);
    }
    out
}

fn section(out: &mut String, section: &Section) {
    heading(out, section.title);
    for finding in &section.findings {
        paragraph(out, finding);
    }
    for part in section.tables.iter().filter(|part| !part.long) {
        paragraph(out, &format!("{}:", part.caption));
        table(out, &part.table);
    }
}

fn heading(out: &mut String, title: &str) {
    if !out.is_empty() {
        out.push('\n');
    }
    let _ = writeln!(out, "{title}\n{}", "─".repeat(width(title)));
}

/// A sentence wrapped between words, later lines indented.
fn paragraph(out: &mut String, text: &str) {
    let mut column = 0;
    for word in text.split(' ') {
        let needed = width(word);
        if column > 0 && column + 1 + needed > LINE {
            out.push_str("\n  ");
            column = 2;
        } else if column > 0 {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += needed;
    }
    out.push('\n');
}

fn table(out: &mut String, table: &Table) {
    let columns: Vec<Vec<String>> = table
        .columns
        .iter()
        .enumerate()
        .map(|(i, column)| {
            let mut cells: Vec<String> = table
                .rows
                .iter()
                .map(|row| shown(&row[i], column.style))
                .collect();
            if matches!(column.style, Style::P | Style::UpTo(_)) {
                align_decimals(&mut cells, ' ', ' ');
            }
            cells.insert(0, column.title.to_string());
            cells
        })
        .collect();
    let widths: Vec<usize> = columns
        .iter()
        .map(|cells| cells.iter().map(|cell| width(cell)).max().unwrap_or(0))
        .collect();
    for row in 0..=table.rows.len() {
        let mut line = String::new();
        for ((cells, column), &wide) in columns.iter().zip(&table.columns).zip(&widths) {
            if !line.is_empty() {
                line.push_str("  ");
            }
            let padding = " ".repeat(wide - width(&cells[row]));
            if column.style == Style::Text {
                let _ = write!(line, "{}{padding}", cells[row]);
            } else {
                let _ = write!(line, "{padding}{}", cells[row]);
            }
        }
        let _ = writeln!(out, "{}", line.trim_end());
    }
    for reason in reasons(table) {
        let _ = writeln!(out, "– {reason}");
    }
}

/// Why values are missing, each reason once.
pub fn reasons(table: &Table) -> Vec<&'static str> {
    let mut reasons: Vec<&'static str> = Vec::new();
    for cell in table.rows.iter().flatten() {
        if let Cell::Undefined(why) = cell
            && !reasons.contains(&why.reason)
        {
            reasons.push(why.reason);
        }
    }
    reasons
}

fn inputs(out: &mut String, analysis: &Analysis) {
    /// A folder of a thousand sessions is summed up; JSON and HTML list every file.
    const MOST: usize = 8;
    heading(out, "Input");
    let sources = &analysis.data.sources;
    for source in sources.iter().take(MOST) {
        let _ = writeln!(
            out,
            "{}: {}, {} rows, sha256 {}…",
            source.path,
            source.kind,
            source.rows_used,
            &source.sha256[..source.sha256.len().min(16)]
        );
    }
    if sources.len() > MOST {
        let _ = writeln!(
            out,
            "… and {} files more, {} rows in all",
            sources.len() - MOST,
            sources.iter().map(|source| source.rows_used).sum::<u64>()
        );
    }
    for note in &analysis.data.notes {
        paragraph(out, &format!("Note: {note}"));
    }
    let _ = writeln!(out, "Greyfield {VERSION}");
}
