//! Values of the sections' tables, by the names they have in files.

use crate::analysis::Analysis;
use crate::analysis::table::{Cell, Interval, Table};

/// A table of a section that has rows.
pub fn table<'a>(analysis: &'a Analysis, section: &str, table: &str) -> Option<&'a Table> {
    let section = analysis.sections.iter().find(|one| one.id == section)?;
    let part = section.tables.iter().find(|part| part.id == table)?;
    (!part.table.rows.is_empty()).then_some(&part.table)
}

/// One row of a table.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    table: &'a Table,
    at: usize,
}

/// All rows.
pub fn rows(table: &Table) -> impl Iterator<Item = Row<'_>> {
    (0..table.rows.len()).map(move |at| Row { table, at })
}

impl<'a> Row<'a> {
    fn cell(self, key: &str) -> Option<&'a Cell> {
        let column = self.table.columns.iter().position(|one| one.key == key)?;
        self.table.rows[self.at].get(column)
    }

    /// A name; empty where there is none.
    pub fn text(self, key: &str) -> &'a str {
        match self.cell(key) {
            Some(Cell::Text(text)) => text,
            _ => "",
        }
    }

    /// A name or a number, as it is.
    pub fn label(self, key: &str) -> String {
        match self.cell(key) {
            Some(Cell::Count(count)) => count.to_string(),
            _ => self.text(key).to_owned(),
        }
    }

    /// A number or a count.
    pub fn number(self, key: &str) -> Option<f64> {
        match self.cell(key)? {
            Cell::Number(number) => Some(*number),
            Cell::Count(count) => Some(f64::from(*count)),
            _ => None,
        }
    }

    /// An interval.
    pub fn interval(self, key: &str) -> Option<Interval> {
        match self.cell(key)? {
            Cell::Interval(interval) => Some(*interval),
            _ => None,
        }
    }
}
