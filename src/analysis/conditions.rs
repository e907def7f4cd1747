//! The wide table of conditions: votes, every statistic of the registry, the corrections over the
//! family, and a verdict.

use std::borrow::Cow;

use super::dataset::{ConditionData, Dataset};
use super::exact_binomial;
use super::registry::{ANSWER_STATISTICS, CONDITION_STATISTICS, CORRECTIONS};
use super::settings::Settings;
use super::statistic::{ConditionTest, Correction};
use super::table::{Cell, Column, Group, Style, Table, Undefined};
use super::tails::Probability;

/// What a test says of one condition once the family is corrected for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Holm's p is at most alpha.
    Significant,
    /// The uncorrected p is, Holm's is not.
    OnlyUncorrected,
    /// Neither.
    NotSignificant,
    /// Not of the declared family; its p is uncorrected.
    Exploratory,
    /// There are no votes.
    NoVotes,
}

impl Verdict {
    /// In words.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Significant => "significant",
            Self::OnlyUncorrected => "only uncorrected",
            Self::NotSignificant => "not significant",
            Self::Exploratory => "outside the family",
            Self::NoVotes => "no votes",
        }
    }
}

/// A test over the family: p of every condition, before and after Holm.
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    /// Uncorrected, by condition.
    pub p: Vec<Result<Probability, Undefined>>,
    /// After the correction, by condition.
    pub corrected: Vec<Result<Probability, Undefined>>,
}

impl Family {
    /// One test and one correction. Conditions without votes are not tested and do not count;
    /// those outside the declared family are tested and not corrected.
    #[must_use]
    pub fn new(
        test: &ConditionTest,
        correction: &Correction,
        data: &Dataset,
        settings: &Settings,
    ) -> Self {
        const OUTSIDE: Undefined = Undefined::not_available("not of the declared family");
        let p: Vec<_> = data.conditions.iter().map(test.p).collect();
        let of_family = |i: usize| settings.in_family(&data.conditions[i].id);
        let tested: Vec<Probability> = (p.iter().enumerate())
            .filter(|(i, _)| of_family(*i))
            .filter_map(|(_, p)| p.ok())
            .collect();
        let mut adjusted = (correction.adjust)(&tested).into_iter();
        let corrected = (p.iter().enumerate())
            .map(|(i, p)| match p {
                Ok(_) if !of_family(i) => Err(OUTSIDE),
                Ok(p) => Ok(adjusted.next().unwrap_or(*p)),
                Err(why) => Err(*why),
            })
            .collect();
        Self { p, corrected }
    }

    /// Number of tests.
    #[must_use]
    pub fn size(&self) -> usize {
        self.corrected.iter().filter(|p| p.is_ok()).count()
    }

    /// The verdict on one condition.
    #[must_use]
    pub fn verdict(&self, condition: usize, settings: &Settings) -> Verdict {
        match (self.p[condition], self.corrected[condition]) {
            (Ok(_), Ok(corrected)) if corrected.at_most(settings.alpha) => Verdict::Significant,
            (Ok(_), Err(_)) => Verdict::Exploratory,
            (Ok(p), _) if p.at_most(settings.alpha) => Verdict::OnlyUncorrected,
            (Ok(_), _) => Verdict::NotSignificant,
            (Err(_), _) => Verdict::NoVotes,
        }
    }
}

/// The tests of the registry.
pub fn tests() -> impl Iterator<Item = ConditionTest> {
    CONDITION_STATISTICS
        .iter()
        .filter_map(|statistic| statistic.test)
}

/// The family the verdicts rest on: exact p, Holm.
#[must_use]
pub fn main_family(data: &Dataset, settings: &Settings) -> Family {
    let test = ConditionTest {
        p_key: "p_exact",
        short: "exact",
        p: |condition| exact_binomial::exact_p(condition.votes),
    };
    Family::new(&test, &super::holm::CORRECTION, data, settings)
}

/// The wide table.
#[must_use]
pub fn table(data: &Dataset, settings: &Settings) -> Table {
    let mut columns = base_columns(data);
    let mut rows: Vec<Vec<Cell>> = data
        .conditions
        .iter()
        .map(|condition| base_cells(condition, data))
        .collect();
    for statistic in CONDITION_STATISTICS {
        columns.extend(statistic.columns.iter().cloned());
        for (row, condition) in rows.iter_mut().zip(&data.conditions) {
            row.extend((statistic.cells)(condition, settings));
        }
    }
    for statistic in ANSWER_STATISTICS {
        columns.extend(statistic.columns.iter().cloned());
        for (row, cells) in rows.iter_mut().zip((statistic.cells)(data, settings)) {
            row.extend(cells);
        }
    }
    for correction in CORRECTIONS {
        for test in tests() {
            columns.push(Column {
                key: Cow::Owned(format!("{}_{}", test.p_key, correction.about.id)),
                title: Cow::Owned(format!("{} {}", correction.short, test.short)),
                style: Style::P,
                group: Group::Tests,
            });
            let family = Family::new(&test, correction, data, settings);
            for (row, p) in rows.iter_mut().zip(family.corrected) {
                row.push(Cell::or_undefined(p, Cell::Probability));
            }
        }
    }
    columns.push(Column::new("verdict", "verdict", Style::Text, Group::Tests));
    let family = main_family(data, settings);
    for (i, row) in rows.iter_mut().enumerate() {
        row.push(Cell::Text(family.verdict(i, settings).text().to_owned()));
    }
    Table { columns, rows }
}

fn asks(data: &Dataset) -> bool {
    data.conditions
        .iter()
        .any(|condition| condition.hypothesis.is_some())
}

fn base_columns(data: &Dataset) -> Vec<Column> {
    let mut columns = vec![Column::new(
        "condition",
        "condition",
        Style::Text,
        Group::Key,
    )];
    if asks(data) {
        columns.push(Column::new(
            "hypothesis",
            "asks",
            Style::Text,
            Group::Choices,
        ));
    }
    columns.extend([
        Column::new("technique_a", "technique a", Style::Text, Group::Choices),
        Column::new("technique_b", "technique b", Style::Text, Group::Choices),
        Column::new("votes_a", "a", Style::Count, Group::Choices),
        Column::new("votes_b", "b", Style::Count, Group::Choices),
        Column::new("share_b", "share b", Style::Decimals(3), Group::Choices),
    ]);
    columns
}

fn base_cells(condition: &ConditionData, data: &Dataset) -> Vec<Cell> {
    let mut cells = vec![Cell::Text(condition.id.clone())];
    if asks(data) {
        cells.push(Cell::Text(condition.hypothesis.clone().unwrap_or_default()));
    }
    let share = condition.votes.share_b().ok_or(Undefined::NO_VOTES);
    cells.extend([
        Cell::Text(condition.technique_a.clone()),
        Cell::Text(condition.technique_b.clone()),
        Cell::Count(condition.votes.a),
        Cell::Count(condition.votes.b),
        Cell::or_undefined(share, Cell::Number),
    ]);
    cells
}
