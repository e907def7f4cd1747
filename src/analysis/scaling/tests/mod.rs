//! Tests: values of other implementations, existence by brute force, hard cases, reports.

mod bootstrap;
mod existence;
mod hard_cases;
mod oracle;
mod report;

use super::comparison::{Comparisons, Pair};
use super::fit::GRADIENT_GOOD;
use super::link::Link;
use super::scale::{Component, Method, Scale, components};
use crate::analysis::dataset::{ConditionData, Dataset, Votes};
use crate::analysis::settings::Settings;
use crate::analysis::statistic::{Context, Section};
use crate::analysis::table::{Cell, Status, Table};

/// A table of counts from (a, b, votes for a, votes for b).
fn counted(rows: &[(&str, &str, u32, u32)]) -> Dataset {
    Dataset {
        conditions: rows
            .iter()
            .enumerate()
            .map(|(at, &(a, b, for_a, for_b))| ConditionData {
                id: format!("c{at}"),
                technique_a: a.into(),
                technique_b: b.into(),
                votes: Votes { a: for_a, b: for_b },
                ..ConditionData::default()
            })
            .collect(),
        ..Dataset::default()
    }
}

fn report_of(data: &Dataset) -> Section {
    report_with(data, &Settings::default())
}

fn report_with(data: &Dataset, settings: &Settings) -> Section {
    (super::STATISTIC.section)(&Context::of(data, settings)).unwrap()
}

fn table<'a>(section: &'a Section, id: &str) -> &'a Table {
    let found = section.tables.iter().find(|table| table.id == id);
    &found.unwrap_or_else(|| panic!("no table {id}")).table
}

fn cell<'a>(table: &'a Table, row: usize, key: &str) -> &'a Cell {
    table.column(key).nth(row).unwrap()
}

fn number(cell: &Cell) -> f64 {
    let Cell::Number(number) = cell else {
        panic!("{cell:?}")
    };
    *number
}

/// Every number of every table.
fn all_finite(section: &Section) -> bool {
    let cells = section.tables.iter().flat_map(|table| &table.table.rows);
    cells.flatten().all(|cell| match cell {
        Cell::Number(number) => number.is_finite(),
        Cell::Interval(ends) => {
            ends.low.is_finite() && ends.high.is_finite() && ends.low <= ends.high
        }
        Cell::Probability(p) => !p.ln().is_nan(),
        _ => true,
    }) && section.tables.iter().all(|table| {
        let wide = table.table.columns.len();
        table.table.rows.iter().all(|row| row.len() == wide)
    }) && !section
        .findings
        .iter()
        .any(|finding| finding.contains("NaN") || finding.contains("inf "))
}

fn only_component(data: &Dataset) -> Component {
    let (found, _) = components(&Comparisons::of(&data.conditions));
    assert_eq!(found.len(), 1);
    found.into_iter().next().unwrap()
}
