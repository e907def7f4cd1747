//! What figures and page say in words: where the numbers come from, and what they are good for.

use super::CostReport;
use crate::cost::row::Row;
use crate::cost::store::About;
use crate::report::figure::words::distinct;

/// Most runs that a figure names.
const MOST_RUNS: usize = 3;

/// Adapter, driver, size, clock, runs: the sentences under a figure of some rows.
pub fn provenance(report: &CostReport, rows: &[&Row]) -> Vec<String> {
    let about = &report.record.about;
    let mut first = vec![adapter(about)];
    first.push(format!("{}×{} pixels", about.size_px.0, about.size_px.1));
    let clocks = distinct((rows.iter()).filter_map(|row| row.clock.map(|clock| clock.name())));
    if !clocks.is_empty() {
        let frames = rows
            .iter()
            .map(|row| row.frames)
            .filter(|frames| *frames > 0);
        let (fewest, most) = (frames.clone().min(), frames.max());
        let frames = match (fewest, most) {
            (Some(fewest), Some(most)) if fewest == most => format!("{most} frames"),
            (Some(fewest), Some(most)) => format!("{fewest} to {most} frames"),
            _ => String::from("frames"),
        };
        first.push(format!("{}, medians of {frames}", clocks.join(" and ")));
    }
    let mut found = vec![format!("{}.", first.join("; "))];
    found.extend(warnings(report, rows));
    found.extend(runs(report, rows));
    found
}

/// An adapter with its driver.
pub fn adapter(about: &About) -> String {
    let adapter = &about.adapter;
    format!(
        "{}, driver {}, {}",
        adapter.name, adapter.driver, adapter.backend
    )
}

/// What times are no good for.
pub fn warnings(report: &CostReport, rows: &[&Row]) -> Vec<String> {
    let mut found = Vec::new();
    if report.record.about.is_software {
        found.push(String::from("Software adapter: ratios only."));
    }
    let count = run_numbers(rows).len();
    if count > 1 {
        found.push(format!(
            "Rows of {count} runs: compare times within a run only."
        ));
    }
    found
}

fn run_numbers(rows: &[&Row]) -> Vec<u32> {
    let mut numbers: Vec<u32> = rows.iter().map(|row| row.run).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// The runs that some rows come from; of no rows the last one.
fn runs(report: &CostReport, rows: &[&Row]) -> Vec<String> {
    let runs = &report.record.runs;
    let mut numbers = run_numbers(rows);
    if numbers.is_empty() {
        numbers.extend(u32::try_from(runs.len()));
    }
    let known: Vec<_> = (numbers.iter())
        .filter_map(|number| runs.get((*number as usize).checked_sub(1)?))
        .collect();
    let mut found: Vec<String> = (known.iter().take(MOST_RUNS))
        .map(|run| format!("{}: {}", run.date, run.command))
        .collect();
    if known.len() > MOST_RUNS {
        found.push(format!("… and {} runs more.", known.len() - MOST_RUNS));
    }
    found
}
