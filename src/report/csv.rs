//! A table as CSV: one row a condition, every digit, an empty field where there is no value.

use super::ReportError;
use super::number::scientific;
use crate::analysis::table::{Cell, Column, Table};
use crate::record::spreadsheet::neutral;

/// The table, UTF-8, lines ended by a line feed.
pub fn render(table: &Table) -> Result<String, ReportError> {
    let mut writer = ::csv::WriterBuilder::new().from_writer(Vec::new());
    writer.write_record(table.columns.iter().flat_map(|column| {
        if column.is_interval() {
            interval_keys(column).to_vec()
        } else {
            vec![column.key.to_string()]
        }
    }))?;
    for row in &table.rows {
        writer.write_record(
            row.iter()
                .zip(&table.columns)
                .flat_map(|(cell, column)| fields(cell, column.is_interval())),
        )?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| ::csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Names of an interval's two columns in files.
pub fn interval_keys(column: &Column) -> [String; 2] {
    [
        format!("{}_low", column.key),
        format!("{}_high", column.key),
    ]
}

fn fields(cell: &Cell, interval: bool) -> Vec<String> {
    match cell {
        // A spreadsheet would run a name that starts like a formula.
        Cell::Text(text) => vec![neutral(text).into_owned()],
        Cell::Count(count) => vec![count.to_string()],
        Cell::Number(number) => vec![number.to_string()],
        Cell::Probability(p) if p.value() >= f64::MIN_POSITIVE => vec![p.value().to_string()],
        Cell::Probability(p) => vec![scientific(*p, 8)],
        Cell::Interval(ends) => vec![ends.low.to_string(), ends.high.to_string()],
        Cell::Undefined(_) if interval => vec![String::new(); 2],
        Cell::Undefined(_) => vec![String::new()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::table::{Group, Interval, Style, Undefined};
    use crate::analysis::tails::Probability;

    #[test]
    fn every_digit_quotes_formulas_and_gaps() {
        let table = Table {
            columns: vec![
                Column::new("name", "", Style::Text, Group::Key),
                Column::new("ci", "", Style::Interval(3), Group::Choices),
                Column::new("p", "", Style::P, Group::Tests),
            ],
            rows: vec![
                vec![
                    Cell::Text("=a,\"b\"".into()),
                    Cell::Interval(Interval {
                        low: 0.1,
                        high: 1.0 / 3.0,
                    }),
                    Cell::Probability(Probability::from_ln(-5000.0)),
                ],
                vec![
                    Cell::Text("c".into()),
                    Cell::Undefined(Undefined::NO_VOTES),
                    Cell::Undefined(Undefined::NO_VOTES),
                ],
            ],
        };
        // e^-5000 = 3.36969414831e-2172.
        assert_eq!(
            render(&table).unwrap(),
            "name,ci_low,ci_high,p\n\"'=a,\"\"b\"\"\",0.1,0.3333333333333333,3.36969415e-2172\nc,,,\n"
        );
    }
}
