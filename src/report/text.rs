//! The report for a terminal.

use std::fmt::Write as _;

use super::document::{Block, Part, document};
use super::number::{align_decimals, reasons, shown, width};
use crate::analysis::Analysis;
use crate::analysis::conclusion::plural;
use crate::analysis::statistic::Section;
use crate::analysis::table::{Style, Table};

/// Sentences are wrapped here; tables are as wide as they need.
const LINE: usize = 96;

/// The whole report.
pub fn render(analysis: &Analysis) -> String {
    parts(document(analysis).parts)
}

/// Sections alone.
pub fn sections(sections: &[Section]) -> String {
    parts(sections.iter().map(Part::of_section))
}

fn parts(parts: impl IntoIterator<Item = Part>) -> String {
    let mut out = String::new();
    for part in parts {
        heading(
            &mut out,
            match part.title.as_str() {
                "" => "Result",
                title => title,
            },
        );
        for block in part.blocks {
            write_block(&mut out, block);
        }
    }
    out
}

fn write_block(out: &mut String, block: Block) {
    match block {
        Block::Paragraph(text) => paragraph(out, &text),
        Block::Note(text) => paragraph(out, &format!("Note: {text}")),
        Block::Quote(paragraphs) => {
            for text in paragraphs {
                out.push('\n');
                paragraph(out, &text);
            }
        }
        // Formulas stand in the page and in the JSON report.
        Block::Figure(_) | Block::Terms(_) => {}
        Block::Table(block) if block.folded => {
            let rows = plural(block.table.rows.len(), "row");
            paragraph(out, &format!("{}: {rows}, in the page.", block.caption));
        }
        Block::Table(block) => {
            out.push('\n');
            paragraph(out, &format!("{}:", block.caption));
            table(out, &block.table);
        }
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
            if matches!(column.style, Style::Text | Style::Code) {
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
