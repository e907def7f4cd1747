//! The answers to a question of power as tables: participants needed, what a given number can find,
//! and power over numbers and shares.

use serde::Serialize;

use super::family::Holm;
use super::power::Test;
use super::sample_size::{Criterion, Question, SampleSize};
use crate::analysis::conclusion::plural;
use crate::analysis::statistic::{Section, SectionTable};
use crate::analysis::table::{Cell, Column, Group, Status, Style, Table, Undefined};
use crate::analysis::tails::Alpha;

/// Shares that tables go over.
pub const SHARES: [f64; 6] = [0.55, 0.60, 0.65, 0.70, 0.75, 0.80];

/// Rows of the table over numbers of participants.
const ROWS: u32 = 10;

const NO_EFFECT: Undefined =
    Undefined::degenerate("no effect, or one so small that a million answers may not find it");
const NEVER: Undefined =
    Undefined::degenerate("even if everybody chose the same technique the power would be less");
const NO_SPLIT: Undefined = Undefined::degenerate("even all votes one way are not significant");

/// What is asked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Request {
    /// Share of technique b where there is an effect.
    pub p: f64,
    /// Level of the family.
    pub alpha: Alpha,
    /// Conditions of the family, from 1.
    pub conditions: u32,
    /// Powers wanted, each above 0 and below 1.
    pub powers: Vec<f64>,
    /// Participants of a full block of the design, from 1.
    pub block: u32,
    /// A number of participants to look at; without, the one that the first power wanted asks for.
    pub participants: Option<u32>,
}

/// Everything that is answered.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// What was asked, with the number of participants that is looked at.
    pub request: Request,
    /// The tables, each with what its numbers mean.
    pub sections: Vec<Section>,
    /// Power over numbers of participants and shares, one row a number, share and criterion.
    pub curve: Table,
}

impl Request {
    fn question(&self, test: Test, criterion: Criterion) -> Question {
        Question {
            test,
            p: self.p,
            alpha: self.alpha,
            conditions: self.conditions,
            criterion,
        }
    }

    /// What can be asked of a family of this size; one condition has nothing to be corrected for.
    fn criteria(&self) -> &'static [Criterion] {
        match self.conditions {
            1 => &Criterion::ALL[..1],
            _ => &Criterion::ALL,
        }
    }

    /// The criterion to plan by: one that holds whatever the other conditions do.
    fn main_criterion(&self) -> Criterion {
        match self.conditions {
            1 => Criterion::Uncorrected,
            _ => Criterion::Bonferroni,
        }
    }

    /// The number looked at where none is given.
    fn usual_participants(&self) -> u32 {
        let question = self.question(Test::Exact, self.main_criterion());
        let size = (self.powers.first()).and_then(|&power| question.sample_size(power));
        size.map_or(5 * self.block, |size| size.in_blocks(self.block))
    }
}

/// Answers a question of power.
#[must_use]
pub fn sheet(request: &Request) -> Sheet {
    let participants = request
        .participants
        .unwrap_or_else(|| request.usual_participants());
    let request = Request {
        participants: Some(participants),
        ..request.clone()
    };
    let numbers = numbers(participants, request.block);
    Sheet {
        sections: vec![
            needed(&request),
            with(&request, participants),
            over(&request, &numbers),
        ],
        curve: curve(&request, &numbers),
        request,
    }
}

fn needed(request: &Request) -> Section {
    let mut rows = Vec::new();
    for &criterion in request.criteria() {
        for &power in &request.powers {
            let question = request.question(Test::Exact, criterion);
            let size = question.sample_size(power).ok_or(NO_EFFECT);
            let count = |of: fn(SampleSize) -> u32| Cell::or_undefined(size.map(of), Cell::Count);
            let filled = size.map(|size| size.in_blocks(request.block));
            let there = filled.map(|n| question.power(n));
            rows.push(vec![
                Cell::Text(criterion.words(request.conditions)),
                Cell::Text(criterion.id().to_owned()),
                Cell::Number(power),
                count(|size| size.smallest),
                count(|size| size.stable),
                Cell::or_undefined(filled, Cell::Count),
                Cell::or_undefined(there, Cell::Number),
            ]);
        }
    }
    let mut findings = vec![
        format!(
            "To find a preference that is there: technique b is chosen with probability {}. Exact binomial test against an even split, two-sided, alpha = {}; each participant answers each condition once.",
            request.p,
            request.alpha.get()
        ),
        "\"first\" is the smallest number with the power wanted. Votes are whole numbers, so one participant more can lower the power again: \"from\" is the smallest number from which on it never falls below. Plan by \"blocks\", which is that number filled up to full blocks of the design.".to_owned(),
    ];
    if request.conditions > 1 {
        findings.push(format!(
            "\"whatever the other {} do\" tests at alpha/{}, Holm's smallest step, so that the condition stays significant after Holm's correction even if it is the only one. The lines below it take all {} conditions to have the effect and the participants' answers to be independent; `greyfield power PROTOCOL.toml` simulates what is not.",
            request.conditions - 1,
            request.conditions,
            request.conditions,
        ));
    }
    Section {
        id: "participants_needed",
        title: "Participants needed",
        status: Status::Ok,
        findings,
        tables: vec![SectionTable {
            id: "sample_size",
            caption: "Smallest numbers of participants",
            long: false,
            table: Table {
                columns: vec![
                    Column::new("found", "found", Style::Text, Group::Key),
                    Column::new("criterion", "criterion", Style::Text, Group::Key),
                    Column::new("power_wanted", "power", Style::UpTo(3), Group::Tests),
                    Column::new("n_first", "first", Style::Count, Group::Tests),
                    Column::new("n_from", "from", Style::Count, Group::Tests),
                    Column::new("n_blocks", "blocks", Style::Count, Group::Tests),
                    Column::new(
                        "power_blocks",
                        "power there",
                        Style::Decimals(3),
                        Group::Tests,
                    ),
                ],
                rows,
            },
        }],
    }
}

/// The levels a condition is tested at: alpha, and in a family alpha/K.
fn levels(request: &Request) -> Vec<(String, Alpha)> {
    let question = request.question(Test::Exact, Criterion::Uncorrected);
    let mut levels = vec![("alpha".to_owned(), request.alpha)];
    if request.conditions > 1 {
        levels.push((format!("alpha/{}", request.conditions), question.level(1)));
    }
    levels
}

fn with(request: &Request, n: u32) -> Section {
    let mut columns = vec![
        Column::new("test", "test", Style::Text, Group::Key),
        Column::new("level", "level", Style::Text, Group::Key),
        Column::new("level_value", "at", Style::UpTo(6), Group::Key),
        Column::new(
            "critical_split",
            "significant from",
            Style::Text,
            Group::Tests,
        ),
        Column::new("size", "size", Style::Decimals(4), Group::Tests),
        Column::new("power", "power", Style::Decimals(3), Group::Tests),
    ];
    columns.extend(request.powers.iter().map(|power| Column {
        key: format!("detectable_{power}").into(),
        title: format!("share for {power}").into(),
        style: Style::Decimals(3),
        group: Group::Tests,
    }));
    let mut rows = Vec::new();
    for test in [Test::Exact, Test::ChiSquare] {
        for (name, alpha) in levels(request) {
            let split = test.critical(n, alpha).ok_or(NO_SPLIT);
            let split = split.map(|fewer| format!("{fewer} : {}", n - fewer));
            let power = |p| Cell::Number(test.power(n, p, alpha).value());
            let mut row = vec![
                Cell::Text(test.name().to_owned()),
                Cell::Text(name),
                Cell::Number(alpha.get()),
                Cell::or_undefined(split, Cell::Text),
                power(0.5),
                power(request.p),
            ];
            row.extend(request.powers.iter().map(|&wanted| {
                Cell::or_undefined(test.detectable(n, wanted, alpha).ok_or(NEVER), Cell::Number)
            }));
            rows.push(row);
        }
    }
    Section {
        id: "given_participants",
        title: "With a given number of participants",
        status: Status::Ok,
        findings: given_findings(request, n),
        tables: vec![SectionTable {
            id: "given",
            caption: "What the tests of one condition do",
            long: false,
            table: Table { columns, rows },
        }],
    }
}

fn given_findings(request: &Request, n: u32) -> Vec<String> {
    let mut findings = Vec::new();
    let over = n % request.block;
    findings.push(match over {
        0 => format!(
            "{}: {} of {}.",
            plural(n as usize, "participant"),
            plural((n / request.block) as usize, "full block"),
            request.block
        ),
        _ => format!(
            "{}: no full blocks of {}, so orders will be uneven; {} fill them.",
            plural(n as usize, "participant"),
            request.block,
            n - over + request.block,
        ),
    });
    if request.conditions > 1 {
        let holm = holm(request, n, request.p);
        findings.push(format!(
            "If all {} conditions have the effect (p = {}), Holm finds a given one with probability {:.3}, at least one with {:.3} and all with {:.3}; answers taken to be independent between conditions.",
            request.conditions, request.p, holm.each(), holm.any(), holm.all()
        ));
    }
    findings.push("\"size\" is the probability to reject at p = 1/2, where nothing is there: the exact test keeps it under its level, chi-square may not. \"power\" is the probability to reject at the share asked about; \"share for\" is the smallest share that is found with that power.".to_owned());
    findings
}

fn holm(request: &Request, n: u32, p: f64) -> Holm {
    let question = request.question(Test::Exact, Criterion::HolmEach);
    let at_most: Vec<f64> = (1..=request.conditions)
        .map(|step| Test::Exact.power(n, p, question.level(step)).value())
        .collect();
    Holm::new(&at_most)
}

/// Numbers of participants for the table: full blocks up to about twice the number looked at, and
/// that number itself.
fn numbers(participants: u32, block: u32) -> Vec<u32> {
    let blocks = (2 * participants).div_ceil(block).max(ROWS / 2);
    let step = blocks.div_ceil(ROWS).max(1) * block;
    let mut numbers: Vec<u32> = (1..=ROWS).map(|row| row * step).collect();
    numbers.push(participants);
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

fn over(request: &Request, numbers: &[u32]) -> Section {
    let table = |alpha: Alpha| {
        let mut columns = vec![Column::new("n", "participants", Style::Count, Group::Key)];
        columns.extend(SHARES.iter().map(|p| Column {
            key: format!("power_{p}").into(),
            title: format!("p = {p:.2}").into(),
            style: Style::Decimals(3),
            group: Group::Tests,
        }));
        let row = |&n: &u32| {
            let power = |&p: &f64| Cell::Number(Test::Exact.power(n, p, alpha).value());
            std::iter::once(Cell::Count(n))
                .chain(SHARES.iter().map(power))
                .collect()
        };
        Table {
            columns,
            rows: numbers.iter().map(row).collect(),
        }
    };
    let mut tables = vec![SectionTable {
        id: "uncorrected",
        caption: "Power of the exact test of one condition, no correction",
        long: false,
        table: table(request.alpha),
    }];
    if request.conditions > 1 {
        let question = request.question(Test::Exact, Criterion::Bonferroni);
        tables.push(SectionTable {
            id: "bonferroni",
            caption: "Power of the exact test of one condition, whatever the others do",
            long: false,
            table: table(question.level(1)),
        });
    }
    Section {
        id: "power_table",
        title: "Power over participants and shares",
        status: Status::Ok,
        findings: Vec::new(),
        tables,
    }
}

fn curve(request: &Request, numbers: &[u32]) -> Table {
    let mut shares = SHARES.to_vec();
    shares.push(request.p);
    shares.sort_unstable_by(f64::total_cmp);
    shares.dedup();
    let mut rows = Vec::new();
    for &n in numbers {
        for &p in &shares {
            for &criterion in request.criteria() {
                let question = Question {
                    p,
                    ..request.question(Test::Exact, criterion)
                };
                rows.push(vec![
                    Cell::Count(n),
                    Cell::Number(p),
                    Cell::Text(criterion.id().to_owned()),
                    Cell::Number(request.alpha.get()),
                    Cell::Count(request.conditions),
                    Cell::Number(question.power(n)),
                ]);
            }
        }
    }
    Table {
        columns: vec![
            Column::new("n", "n", Style::Count, Group::Key),
            Column::new("p", "p", Style::UpTo(6), Group::Key),
            Column::new("criterion", "criterion", Style::Text, Group::Key),
            Column::new("alpha", "alpha", Style::UpTo(6), Group::Key),
            Column::new("conditions", "conditions", Style::Count, Group::Key),
            Column::new("power", "power", Style::Decimals(6), Group::Tests),
        ],
        rows,
    }
}

#[cfg(test)]
mod tests;
