//! The report as one page: no script, no font, no picture from elsewhere.

mod figures;

use std::fmt::Write as _;

use super::number::{align_decimals, shown};
use super::svg::escape;
use super::text::reasons;
use super::{VERSION, methods};
use crate::analysis::Analysis;
use crate::analysis::conditions::{Verdict, main_family};
use crate::analysis::registry;
use crate::analysis::statistic::SectionTable;
use crate::analysis::table::{Group, Style, Table};

/// Id of the section that is drawn with its figure.
const POSITION: &str = "position_bias";

const STYLE: &str = include_str!("page.css");

/// Spaces as wide as a digit and as a point, to align decimals in a proportional font.
const FIGURE_SPACE: char = '\u{2007}';
const PUNCTUATION_SPACE: char = '\u{2008}';

/// The whole page.
pub fn render(analysis: &Analysis) -> String {
    let mut page = String::new();
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Greyfield: analysis of choices</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n"
    );
    result(&mut page, analysis);
    // Ratings and rankings have no conditions of choices.
    if !analysis.data.conditions.is_empty() {
        choices(&mut page, analysis);
        tests(&mut page, analysis);
        position(&mut page, analysis);
    }
    sections(&mut page, analysis);
    methods_section(&mut page, analysis);
    provenance(&mut page, analysis);
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

fn result(page: &mut String, analysis: &Analysis) {
    page.push_str("<header>\n<p class=\"kicker\">Greyfield analysis</p>\n<h1>Which image looked more realistic?</h1>\n</header>\n<section class=\"result\">\n");
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

fn choices(page: &mut String, analysis: &Analysis) {
    let confidence = analysis.settings.alpha.confidence_percent();
    page.push_str("<section>\n<h2>Choices</h2>\n");
    figure(
        page,
        &figures::votes(analysis),
        &format!(
            "Votes for the two techniques of each condition. The bar across the border of the two colours is the {confidence} % Wilson interval; where it crosses the dashed line an even split is not ruled out before correction.",
        ),
    );
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
    paragraph(
        page,
        &format!(
            "Null hypothesis of each condition: both images are chosen equally often. The family is the {} conditions with votes; Holm's correction holds the chance of any false finding among them at {}. The verdict rests on the exact p after Holm.",
            family.size(),
            analysis.settings.alpha.get()
        ),
    );
    table(
        page,
        &analysis.conditions.only(&[Group::Key, Group::Tests]),
        "p-values before and after correction for the family (BH: Benjamini–Hochberg)",
        Some(&strong),
    );
    page.push_str("</section>\n");
}

fn position(page: &mut String, analysis: &Analysis) {
    page.push_str("<section>\n<h2>Position bias</h2>\n");
    if !analysis.data.has_answers() {
        paragraph(
            page,
            "Counts do not say which image was shown first; position bias needs single answers.",
        );
        page.push_str("</section>\n");
        return;
    }
    let section = analysis
        .sections
        .iter()
        .find(|section| section.id == POSITION);
    for finding in section.iter().flat_map(|section| &section.findings) {
        paragraph(page, finding);
    }
    figure(
        page,
        &figures::positions(analysis),
        &format!(
            "Share of trials in which the image shown first was chosen, with {} % Wilson intervals.",
            analysis.settings.alpha.confidence_percent()
        ),
    );
    table(
        page,
        &analysis.conditions.only(&[Group::Key, Group::Position]),
        "Orders shown and positions chosen, by condition",
        None,
    );
    for part in section.iter().flat_map(|section| &section.tables) {
        section_table(page, part);
    }
    page.push_str("</section>\n");
}

fn sections(page: &mut String, analysis: &Analysis) {
    // Position bias has its figure and stands above.
    for section in analysis
        .sections
        .iter()
        .filter(|section| section.id != POSITION)
    {
        let _ = writeln!(page, "<section>\n<h2>{}</h2>", escape(section.title));
        for finding in &section.findings {
            paragraph(page, finding);
        }
        for part in &section.tables {
            section_table(page, part);
        }
        page.push_str("</section>\n");
    }
}

/// A table with a row a participant is folded away, and left to the JSON report if it is huge.
fn section_table(page: &mut String, part: &SectionTable) {
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

fn methods_section(page: &mut String, analysis: &Analysis) {
    page.push_str("<section>\n<h2>Methods</h2>\n<blockquote>\n");
    paragraph(page, &methods::paragraph(analysis));
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

fn provenance(page: &mut String, analysis: &Analysis) {
    page.push_str("<section>\n<h2>Provenance</h2>\n");
    let sources = &analysis.data.sources;
    let many = sources.len() > 8;
    if many {
        let _ = writeln!(
            page,
            "<details>\n<summary>{} input files, {} rows used</summary>",
            sources.len(),
            sources.iter().map(|source| source.rows_used).sum::<u64>()
        );
    }
    page.push_str("<div class=\"scroll\"><table>\n<thead><tr><th>input</th><th>read as</th><th class=\"n\">rows used</th><th class=\"n\">left out</th><th>SHA-256</th></tr></thead>\n<tbody>\n");
    for source in sources {
        let _ = writeln!(
            page,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td><code>{}</code></td></tr>",
            escape(&source.path),
            source.kind,
            source.rows_used,
            source.rows_left_out,
            source.sha256
        );
    }
    page.push_str("</tbody>\n</table></div>\n");
    if many {
        page.push_str("</details>\n");
    }
    paragraph(
        page,
        &format!(
            "Greyfield {VERSION}, alpha = {}. The same input gives this page again, byte for byte.",
            analysis.settings.alpha.get()
        ),
    );
    page.push_str("</section>\n");
}

fn paragraph(page: &mut String, text: &str) {
    let _ = writeln!(page, "<p>{}</p>", escape(text));
}

fn figure(page: &mut String, svg: &str, caption: &str) {
    let _ = writeln!(
        page,
        "<figure>\n{svg}<figcaption>{}</figcaption>\n</figure>",
        escape(caption)
    );
}

fn table(page: &mut String, table: &Table, caption: &str, strong: Option<&[bool]>) {
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

fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars
        .next()
        .map(|first| first.to_uppercase().chain(chars).collect())
        .unwrap_or_default()
}
