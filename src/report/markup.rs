//! The few elements that the page is made of.

use std::fmt::Write as _;

use crate::report::svg::escape;

/// How a column stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Words, at the left.
    Words(&'static str),
    /// Numbers, at the right.
    Numbers(&'static str),
}

/// A paragraph.
pub fn paragraph(page: &mut String, text: &str) {
    let _ = writeln!(page, "<p>{}</p>", escape(text));
}

/// A figure that is its own caption.
pub fn figure(page: &mut String, svg: &str) {
    let _ = writeln!(page, "<figure>\n{svg}</figure>");
}

/// A table that scrolls where it is too wide; the first cell of each row names it.
pub fn table(
    page: &mut String,
    class: &str,
    caption: &str,
    columns: &[Column],
    rows: &[Vec<String>],
) {
    let _ = write!(
        page,
        "<div class=\"scroll {class}\"><table>\n<caption>{}</caption>\n<thead><tr>",
        escape(caption)
    );
    for column in columns {
        let (class, title) = match column {
            Column::Words(title) => ("", title),
            Column::Numbers(title) => (" class=\"n\"", title),
        };
        let _ = write!(page, "<th{class}>{}</th>", escape(title));
    }
    page.push_str("</tr></thead>\n<tbody>\n");
    for row in rows {
        page.push_str("<tr>");
        for (index, (cell, column)) in row.iter().zip(columns).enumerate() {
            let cell = escape(cell);
            let _ = match (index, column) {
                (0, _) => write!(page, "<th scope=\"row\">{cell}</th>"),
                (_, Column::Words(_)) => write!(page, "<td>{cell}</td>"),
                (_, Column::Numbers(_)) => write!(page, "<td class=\"n\">{cell}</td>"),
            };
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody>\n</table></div>\n");
}

/// Terms with what they mean.
pub fn terms(page: &mut String, terms: &[(&str, &str)]) {
    page.push_str("<dl>\n");
    for (term, meaning) in terms {
        let _ = writeln!(
            page,
            "<dt>{}</dt>\n<dd>{}</dd>",
            escape(term),
            escape(meaning)
        );
    }
    page.push_str("</dl>\n");
}
