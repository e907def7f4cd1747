//! What the page is made of: paragraphs, tables, figures.

use std::fmt::Write as _;

use crate::analysis::table::{Column, Style};
use crate::report::document::TableBlock;
use crate::report::number::{align_decimals, reasons, shown};
use crate::report::study_figures::Drawing;
use crate::report::svg::escape;

/// Spaces as wide as a digit and as a point, to align decimals in a proportional font.
const FIGURE_SPACE: char = '\u{2007}';
const PUNCTUATION_SPACE: char = '\u{2008}';

/// A paragraph.
pub fn paragraph(page: &mut String, text: &str) {
    let _ = writeln!(page, "<p>{}</p>", escape(text));
}

/// A figure with its caption below.
pub fn figure(page: &mut String, drawing: Drawing) {
    let caption = escape(&drawing.caption);
    let svg = drawing.in_page();
    let _ = writeln!(
        page,
        "<figure>\n{svg}<figcaption>{caption}</figcaption>\n</figure>"
    );
}

/// A table that scrolls where it is too wide; the first cell of each row names it.
pub fn table(page: &mut String, block: &TableBlock) {
    let class = if block.wraps {
        "scroll wraps"
    } else {
        "scroll"
    };
    let _ = write!(
        page,
        "<div class=\"{class}\"><table>\n<caption>{}</caption>\n<thead><tr>",
        escape(&block.caption)
    );
    let table = &block.table;
    for column in &table.columns {
        let class = class_of(column);
        let _ = write!(page, "<th{class}>{}</th>", escape(&column.title));
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    let columns: Vec<Vec<String>> = (0..table.columns.len())
        .map(|i| cells_of(block, i))
        .collect();
    for row in 0..table.rows.len() {
        page.push_str(match block.is_strong(row) {
            true => "<tr class=\"strong\">",
            false => "<tr>",
        });
        for (i, (cells, column)) in columns.iter().zip(&table.columns).enumerate() {
            let cell = escape(&cells[row]);
            let _ = match (i, column.style) {
                (0, _) => write!(page, "<th scope=\"row\"{}>{cell}</th>", class_of(column)),
                (_, Style::Code) => write!(page, "<td><code>{cell}</code></td>"),
                _ => write!(page, "<td{}>{cell}</td>", class_of(column)),
            };
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody>\n</table></div>\n");
    for reason in reasons(table) {
        let _ = writeln!(page, "<p class=\"reason\">– {}</p>", escape(reason));
    }
}

fn class_of(column: &Column) -> &'static str {
    match column.style {
        Style::Text => " class=\"t\"",
        Style::Code => "",
        _ => " class=\"n\"",
    }
}

/// The cells of one column as they are shown.
fn cells_of(block: &TableBlock, i: usize) -> Vec<String> {
    let style = block.table.columns[i].style;
    let rows = block.table.rows.iter();
    let mut cells: Vec<String> = rows.map(|row| shown(&row[i], style)).collect();
    if matches!(style, Style::P | Style::UpTo(_)) {
        align_decimals(&mut cells, FIGURE_SPACE, PUNCTUATION_SPACE);
    }
    cells
}

/// With a capital first letter.
pub fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars
        .next()
        .map(|first| first.to_uppercase().chain(chars).collect())
        .unwrap_or_default()
}
