//! The report as parts and blocks, before it is a page, a text or a screen: what stands in it is
//! decided here, once.

mod choices;
mod closing;
mod study;

use super::study_figures::{self, Drawing};
use crate::analysis::Analysis;
use crate::analysis::table::Table;

/// The whole report.
pub struct Document {
    /// What it is of, in a few words.
    pub title: String,
    /// What kind of thing it is, above the heading.
    pub kicker: String,
    /// The heading: what participants were asked.
    pub heading: String,
    /// Its parts in order; the first is the result.
    pub parts: Vec<Part>,
}

/// A part of the report.
#[derive(Default)]
pub struct Part {
    /// Heading; empty for the result, which stands right under the report's.
    pub title: String,
    /// What stands in it, in order.
    pub blocks: Vec<Block>,
}

/// One thing in a part.
pub enum Block {
    /// A sentence or more.
    Paragraph(String),
    /// The same, less loud: notes and reasons.
    Note(String),
    /// Paragraphs to be copied out.
    Quote(Vec<String>),
    /// A picture.
    Figure(Drawing),
    /// A table.
    Table(TableBlock),
    /// Formulas and sources, folded away.
    Terms(Vec<Term>),
}

/// A table with what is said of it.
pub struct TableBlock {
    /// What it holds.
    pub caption: String,
    /// Its rows.
    pub table: Table,
    /// Rows that stand out, by number.
    pub strong: Vec<bool>,
    /// Long: folded away in a page, left out of a text.
    pub folded: bool,
    /// Cells hold sentences, which may take several lines.
    pub wraps: bool,
}

/// One statistic explained.
pub struct Term {
    /// Its name.
    pub name: &'static str,
    /// Its formula.
    pub formula: &'static str,
    /// Where it holds.
    pub validity: &'static str,
    /// Where it was published.
    pub source: &'static str,
}

/// More rows are left to the files with every table.
const MOST_ROWS: usize = 500;

impl Part {
    fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            blocks: Vec::new(),
        }
    }

    fn paragraph(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Paragraph(text.into()));
    }

    fn note(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Note(text.into()));
    }

    /// A table with rows; one that is too long is named instead.
    fn table(&mut self, block: TableBlock) {
        match block.table.rows.len() {
            0 => {}
            rows if rows > MOST_ROWS => {
                self.note(format!(
                    "{}: {rows} rows, in the JSON report.",
                    block.caption
                ));
            }
            _ => self.blocks.push(Block::Table(block)),
        }
    }

    /// The figures that stand with a section.
    fn figures(&mut self, analysis: &Analysis, section: &str) {
        let figures = study_figures::of_section(analysis, section);
        self.blocks.extend(figures.map(Block::Figure));
    }
}

impl TableBlock {
    /// A plain one.
    fn new(caption: impl Into<String>, table: Table) -> Self {
        Self {
            caption: caption.into(),
            table,
            strong: Vec::new(),
            folded: false,
            wraps: false,
        }
    }

    fn folded(self, folded: bool) -> Self {
        Self { folded, ..self }
    }

    fn wrapping(self) -> Self {
        Self {
            wraps: true,
            ..self
        }
    }

    /// Whether a row stands out.
    pub fn is_strong(&self, row: usize) -> bool {
        self.strong.get(row).copied().unwrap_or(false)
    }
}

/// The report of an analysis.
#[must_use]
pub fn document(analysis: &Analysis) -> Document {
    let mut parts = vec![choices::result(analysis)];
    parts.extend(study::asked(analysis));
    parts.push(study::who(analysis));
    if !analysis.data.conditions.is_empty() {
        parts.push(choices::votes(analysis));
        parts.push(choices::tests(analysis));
    }
    let sections = analysis.sections.iter();
    parts.extend(sections.map(|section| choices::section(section, analysis)));
    parts.push(closing::methods(analysis));
    parts.push(closing::provenance(analysis));
    Document {
        title: study::title(analysis),
        kicker: study::kicker(analysis),
        heading: study::heading(analysis),
        parts,
    }
}
