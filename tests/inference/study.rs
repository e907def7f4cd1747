//! Simulated studies as the analysis gets them, and what it says of them.

use greyfield::analysis::dataset::{Answer, ConditionData, Dataset, Order, OrderCounts, Votes};
use greyfield::analysis::statistic::{Context, Section, StudyStatistic};
use greyfield::analysis::table::Cell;
use greyfield::analysis::tails::Alpha;
use greyfield::analysis::{Settings, scaling};
use greyfield::protocol::Position;
use greyfield::seed;
use rand_chacha::ChaCha20Rng;

/// One answer.
#[derive(Debug, Clone, Copy)]
pub struct Trial {
    pub order: Order,
    pub for_b: bool,
    pub time_ms: Option<f32>,
}

impl Trial {
    /// In the base order, without a time.
    pub fn choice(for_b: bool) -> Self {
        Self {
            order: Order::AThenB,
            for_b,
            time_ms: None,
        }
    }

    pub fn position(&self) -> Position {
        if self.for_b == (self.order == Order::AThenB) {
            Position::Second
        } else {
            Position::First
        }
    }
}

/// A study of counts only: for every condition its pair and its votes.
pub fn counts<'a>(conditions: impl IntoIterator<Item = ((&'a str, &'a str), Votes)>) -> Dataset {
    Dataset {
        conditions: (conditions.into_iter().enumerate())
            .map(|(number, (pair, votes))| ConditionData {
                votes,
                ..condition(number, pair)
            })
            .collect(),
        ..Dataset::default()
    }
}

/// A study in which every participant answers every condition.
pub fn answers(
    pairs: &[(&str, &str)],
    participants: u32,
    mut trial: impl FnMut(u32, usize) -> Trial,
) -> Dataset {
    let mut orders = vec![OrderCounts::default(); pairs.len()];
    let mut answers = Vec::with_capacity(participants as usize * pairs.len());
    for participant in 0..participants {
        for (number, orders) in (0_u32..).zip(&mut orders) {
            let trial = trial(participant, number as usize);
            let chosen = Some(trial.position());
            orders.add(trial.order, chosen);
            answers.push(Answer {
                participant,
                condition: number,
                order: trial.order,
                chosen,
                response_time_ms: trial.time_ms,
            });
        }
    }
    Dataset {
        conditions: (pairs.iter().zip(orders).enumerate())
            .map(|(number, (pair, orders))| ConditionData {
                votes: orders.votes(),
                orders: Some(orders),
                ..condition(number, *pair)
            })
            .collect(),
        participants: (0..participants).map(|it| format!("P{it}")).collect(),
        answers,
        ..Dataset::default()
    }
}

fn condition(number: usize, (a, b): (&str, &str)) -> ConditionData {
    ConditionData {
        id: format!("c{number}"),
        technique_a: a.to_owned(),
        technique_b: b.to_owned(),
        ..ConditionData::default()
    }
}

/// A section of the report, as the statistic writes it.
pub fn section(statistic: &StudyStatistic, data: &Dataset, settings: &Settings) -> Option<Section> {
    (statistic.section)(&Context::of(data, settings))
}

/// Scales with the usual settings.
pub fn scaling(data: &Dataset) -> Option<Section> {
    section(&scaling::STATISTIC, data, &Settings::default())
}

/// A cell of a section's table; `None` where there is no such table, column or row.
pub fn cell<'a>(
    section: &'a Option<Section>,
    table: &str,
    key: &str,
    row: usize,
) -> Option<&'a Cell> {
    let tables = &section.as_ref()?.tables;
    let table = tables.iter().find(|it| it.id == table)?;
    table.table.column(key).nth(row)
}

/// Whether an interval is there and holds the truth.
pub fn holds(cell: Option<&Cell>, truth: f64) -> bool {
    matches!(cell, Some(Cell::Interval(it)) if (it.low..=it.high).contains(&truth))
}

/// Whether a p is there and rejects at 5 %.
pub fn rejects(cell: Option<&Cell>) -> bool {
    matches!(cell, Some(Cell::Probability(p)) if p.at_most(Alpha::FIVE_PERCENT))
}

/// Something that happens with this probability.
pub fn chance(rng: &mut ChaCha20Rng, probability: f64) -> bool {
    seed::unit_f64(rng) < probability
}

/// How many of n go for b.
pub fn votes(rng: &mut ChaCha20Rng, n: u32, share_b: f64) -> Votes {
    let mut b = 0;
    (0..n).for_each(|_| b += u32::from(chance(rng, share_b)));
    Votes { a: n - b, b }
}

/// A standard normal number (G. E. P. Box, M. E. Muller 1958).
pub fn normal(rng: &mut ChaCha20Rng) -> f64 {
    let radius = (-2.0 * (1.0 - seed::unit_f64(rng)).ln()).sqrt();
    radius * (std::f64::consts::TAU * seed::unit_f64(rng)).cos()
}

/// A gamma number of shape 4, standardised: mean 0, standard deviation 1, skewness 1.
pub fn skewed(rng: &mut ChaCha20Rng) -> f64 {
    let sum: f64 = (0..4).map(|_| -(1.0 - seed::unit_f64(rng)).ln()).sum();
    (sum - 4.0) / 2.0
}

pub fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}
