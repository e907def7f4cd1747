//! The balance of a plan, as text for people and as CSV for machines.

use std::fmt::{self, Write as _};
use std::io;

use crate::protocol::Balance;
use crate::protocol::balance::{Aspect, Table};

/// One line a count: table, row, column, count.
pub fn csv(balance: &Balance, output: impl io::Write) -> Result<(), csv::Error> {
    let mut csv = csv::Writer::from_writer(output);
    csv.write_record(["table", "row", "column", "count"])?;
    for aspect in Aspect::ALL {
        let table = balance.table(aspect);
        for (row, counts) in table.rows.iter().zip(&table.counts) {
            for (column, count) in table.columns.iter().zip(counts) {
                if let Some(count) = count {
                    csv.write_record([aspect.name(), row, column, &count.to_string()])?;
                }
            }
        }
    }
    Ok(csv.flush()?)
}

/// A heading, the tables, and under each how even it is.
pub fn text(balance: &Balance, heading: &str) -> String {
    let mut text = format!("{heading}\n");
    // Writing to a text cannot fail.
    let _ = write_tables(balance, &mut text);
    text
}

fn write_tables(balance: &Balance, text: &mut String) -> fmt::Result {
    if let Some(range) = balance.reversed_in_session() {
        writeln!(text, "Reversed in a session: {range} pairs.")?;
    }
    for aspect in Aspect::ALL {
        let evenness = balance.evenness(aspect);
        writeln!(text, "\n{}", title(aspect))?;
        write_table(&balance.table(aspect), text)?;
        writeln!(
            text,
            "{}{}; imbalance {:.3}",
            match aspect {
                Aspect::Position | Aspect::CarryOver => "",
                Aspect::InnerOrder | Aspect::InnerOrderAtPosition => "reversed ",
            },
            evenness.range,
            evenness.imbalance
        )?;
    }
    Ok(())
}

const fn title(aspect: Aspect) -> &'static str {
    match aspect {
        Aspect::Position => "Conditions at positions",
        Aspect::InnerOrder => "Inner orders of conditions",
        Aspect::CarryOver => "Conditions (rows) right before conditions (columns)",
        Aspect::InnerOrderAtPosition => "Inner orders at positions",
    }
}

fn write_table(table: &Table, text: &mut String) -> fmt::Result {
    let cell = |count: &Option<u32>| count.map_or_else(|| String::from("-"), |n| n.to_string());
    let longest = |names: &[String]| names.iter().map(|name| name.chars().count()).max();
    let first = longest(&table.rows).unwrap_or(0);
    // Conditions as columns are called by their numbers: their ids would be wider than a
    // terminal.
    let same = table.rows == table.columns;
    let name = |index: usize, name: &str| match same {
        true => format!("{index} {name}"),
        false => name.to_owned(),
    };
    let columns: Vec<String> = match same {
        true => (0..table.columns.len()).map(|n| n.to_string()).collect(),
        false => table.columns.clone(),
    };
    let first = if same { first + 3 } else { first };
    let counts = table.counts.iter().flatten().map(|count| cell(count).len());
    let width = counts.chain(columns.iter().map(String::len)).max();
    let width = width.unwrap_or(0);
    let line = |text: &mut String, name: &str, cells: Vec<String>| {
        write!(text, "  {name:first$}")?;
        for cell in cells {
            write!(text, "  {cell:>width$}")?;
        }
        writeln!(text)
    };
    line(text, "", columns)?;
    for (index, (row, counts)) in table.rows.iter().zip(&table.counts).enumerate() {
        line(text, &name(index, row), counts.iter().map(cell).collect())?;
    }
    Ok(())
}
