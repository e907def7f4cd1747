//! What the page is made of: paragraphs, tables, figures.

use std::fmt::Write as _;

use crate::analysis::statistic::SectionTable;
use crate::analysis::table::{Style, Table};
use crate::report::number::{align_decimals, shown};
use crate::report::study_figures::Drawing;
use crate::report::svg::escape;
use crate::report::text::reasons;

/// Spaces as wide as a digit and as a point, to align decimals in a proportional font.
const FIGURE_SPACE: char = '\u{2007}';
const PUNCTUATION_SPACE: char = '\u{2008}';

/// A table with a row a participant is folded away, and left to the JSON report if it is huge.
pub fn section_table(page: &mut String, part: &SectionTable) {
    const MOST_ROWS: usize = 500;
    if part.table.rows.len() > MOST_ROWS {
        paragraph(
            page,
            &format!(
                "{}: {} rows, in the JSON report.",
                part.caption,
                part.table.rows.len()
            ),
        );
        return;
    }
    if part.long {
        let _ = writeln!(
            page,
            "<details>\n<summary>{}</summary>",
            escape(part.caption)
        );
    }
    table(page, &part.table, part.caption, None);
    if part.long {
        page.push_str("</details>\n");
    }
}

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

/// A table; rows that are `strong` stand out.
pub fn table(page: &mut String, table: &Table, caption: &str, strong: Option<&[bool]>) {
    let _ = write!(
        page,
        "<div class=\"scroll\"><table>\n<caption>{}</caption>\n<thead><tr>",
        escape(caption)
    );
    let class = |style: Style| {
        if style == Style::Text {
            ""
        } else {
            " class=\"n\""
        }
    };
    let mut columns = Vec::new();
    for (i, column) in table.columns.iter().enumerate() {
        let _ = write!(
            page,
            "<th{}>{}</th>",
            class(column.style),
            escape(&column.title)
        );
        let mut cells: Vec<String> = table
            .rows
            .iter()
            .map(|row| shown(&row[i], column.style))
            .collect();
        if matches!(column.style, Style::P | Style::UpTo(_)) {
            align_decimals(&mut cells, FIGURE_SPACE, PUNCTUATION_SPACE);
        }
        columns.push(cells);
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    for row in 0..table.rows.len() {
        let is_strong = strong.is_some_and(|strong| strong[row]);
        page.push_str(if is_strong {
            "<tr class=\"strong\">"
        } else {
            "<tr>"
        });
        for (i, (cells, column)) in columns.iter().zip(&table.columns).enumerate() {
            let cell = escape(&cells[row]);
            if i == 0 {
                let _ = write!(page, "<th scope=\"row\">{cell}</th>");
            } else {
                let _ = write!(page, "<td{}>{cell}</td>", class(column.style));
            }
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody>\n</table></div>\n");
    for reason in reasons(table) {
        let _ = writeln!(page, "<p class=\"reason\">– {}</p>", escape(reason));
    }
}

/// With a capital first letter.
pub fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars
        .next()
        .map(|first| first.to_uppercase().chain(chars).collect())
        .unwrap_or_default()
}
