//! The report as one page: no script, no font, no picture from elsewhere.

mod elements;

use std::fmt::Write as _;

use self::elements::{capitalised, figure, paragraph, table};
use super::document::{Block, Document, Term, document};
use super::svg::escape;
use crate::analysis::Analysis;

const STYLE: &str = include_str!("page.css");

/// The whole page.
pub fn render(analysis: &Analysis) -> String {
    let Document {
        title,
        kicker,
        heading,
        parts,
    } = document(analysis);
    let mut page = String::new();
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<header>\n<p class=\"kicker\">{}</p>\n<h1>{}</h1>\n</header>\n",
        escape(&title),
        escape(&kicker),
        escape(&heading)
    );
    for part in parts {
        match part.title.as_str() {
            "" => page.push_str("<section class=\"result\">\n"),
            title => {
                let _ = writeln!(page, "<section>\n<h2>{}</h2>", escape(title));
            }
        }
        for block in part.blocks {
            write_block(&mut page, block);
        }
        page.push_str("</section>\n");
    }
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

fn write_block(page: &mut String, block: Block) {
    match block {
        Block::Paragraph(text) => paragraph(page, &text),
        Block::Note(text) => {
            let _ = writeln!(page, "<p class=\"reason\">{}</p>", escape(&text));
        }
        Block::Quote(paragraphs) => {
            page.push_str("<blockquote>\n");
            for text in paragraphs {
                paragraph(page, &text);
            }
            page.push_str("</blockquote>\n");
        }
        Block::Figure(drawing) => figure(page, drawing),
        Block::Table(block) if block.folded => {
            let summary = escape(&block.caption);
            let _ = writeln!(page, "<details>\n<summary>{summary}</summary>");
            table(page, &block);
            page.push_str("</details>\n");
        }
        Block::Table(block) => table(page, &block),
        Block::Terms(terms) => write_terms(page, &terms),
    }
}

fn write_terms(page: &mut String, terms: &[Term]) {
    page.push_str("<details>\n<summary>Formulas, sources, and where each holds</summary>\n<dl>\n");
    for term in terms {
        let _ = writeln!(
            page,
            "<dt>{}</dt>\n<dd>{}<br>{}. <span class=\"source\">{}.</span></dd>",
            escape(term.name),
            escape(term.formula),
            escape(&capitalised(term.validity)),
            escape(term.source),
        );
    }
    page.push_str("</dl>\n</details>\n");
}
