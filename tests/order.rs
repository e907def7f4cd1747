//! `greyfield order` says how even a plan is, and what drop-outs leave of it.
#![allow(clippy::unwrap_used)]

use std::collections::HashMap;
use std::process::{Command, Output};

const PROTOCOL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/protocols/thesis-2010.toml");

fn order(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .args(["order", PROTOCOL])
        .args(arguments)
        .output()
        .unwrap()
}

fn printed(arguments: &[&str]) -> String {
    let output = order(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    String::from_utf8(output.stdout).unwrap()
}

fn refused(arguments: &[&str]) -> String {
    let output = order(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

/// The counts of `--balance --format csv`, by table, row and column.
fn counts(arguments: &[&str]) -> HashMap<[String; 3], u32> {
    let text = printed(&[&["--balance", "--format", "csv"], arguments].concat());
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("table,row,column,count"));
    let count = |line: &str| {
        let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        let [table, row, column, count] = cells.try_into().unwrap();
        ([table, row, column], count.parse().unwrap())
    };
    lines.map(count).collect()
}

/// All different counts of a table.
fn values(counts: &HashMap<[String; 3], u32>, table: &str) -> Vec<u32> {
    let mut values: Vec<u32> = counts
        .iter()
        .filter(|(key, _)| key[0] == table)
        .map(|(_, &count)| count)
        .collect();
    values.sort_unstable();
    values.dedup();
    values
}

#[test]
fn one_block_of_every_design_is_as_even_as_it_says() {
    // Seven conditions: a block is 14 slots, of the Williams pair of squares 28.
    for (design, sessions, follows_evenly) in [("latin", 14, false), ("williams", 28, true)] {
        for inner_order in ["block", "within"] {
            let counts = counts(&[
                "--blocks",
                "1",
                "--design",
                design,
                "--inner-order",
                inner_order,
            ]);
            assert_eq!(values(&counts, "position"), [sessions / 7]);
            assert_eq!(values(&counts, "inner-order"), [sessions / 2]);
            assert_eq!(values(&counts, "inner-order-at-position"), [sessions / 2]);
            let follows = values(&counts, "carry-over");
            assert_eq!(follows == [sessions / 7], follows_evenly, "{follows:?}");
        }
    }
}

/// The counts are those of the plan that the same command prints.
#[test]
fn the_balance_counts_the_plan() {
    let only = ["--only", "0,3-5,20"];
    let plan = printed(&only);
    let counts = counts(&only);
    let rows: Vec<Vec<&str>> = plan
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let mut slots: Vec<&str> = rows.iter().map(|row| row[0]).collect();
    slots.dedup();
    assert_eq!(slots, ["0", "3", "4", "5", "20"]);
    let mut expected: HashMap<[String; 3], u32> = HashMap::new();
    for row in &rows {
        let key = ["position", row[2], row[1]].map(str::to_owned);
        *expected.entry(key).or_default() += 1;
    }
    for (key, &count) in counts.iter().filter(|(key, _)| key[0] == "position") {
        assert_eq!(count, expected.get(key).copied().unwrap_or(0), "{key:?}");
    }
}

#[test]
fn a_drop_out_shows() {
    let all = printed(&["--balance", "--only", "0-13"]);
    let without_one = printed(&["--balance", "--only", "0-6,8-13"]);
    assert!(all.starts_with("14 sessions of 7 conditions; design latin, inner order block, seed 2010; a block is 14 slots."));
    assert!(all.contains("\n2; imbalance 0.000\n"), "{all}");
    assert!(all.contains("reversed 7; imbalance 0.000\n"), "{all}");
    assert!(without_one.starts_with("13 sessions"));
    assert!(
        without_one.contains("\n1 to 2; imbalance 0."),
        "{without_one}"
    );
    assert!(
        without_one.contains("reversed 6; imbalance 0.038\n"),
        "{without_one}"
    );
}

#[test]
fn what_cannot_be_is_refused() {
    let message = refused(&["--blocks", "1", "--design", "random"]);
    assert!(message.contains("\"random\" has no blocks"), "{message}");
    let message = refused(&["--design", "greek"]);
    assert!(message.contains("latin, williams, random"), "{message}");
    let message = refused(&["--inner-order", "inside"]);
    assert!(message.contains("block, within"), "{message}");
    let message = refused(&["--only", "5-3"]);
    assert!(message.contains("3-5"), "{message}");
    refused(&["--only", "0", "--participants", "3"]);
    refused(&["--format", "csv"]);
}
