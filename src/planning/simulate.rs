//! Whole studies simulated: scripted observers of a known preference sit the protocol's own sessions,
//! through the state machine that people sit, and the rows are analysed as people's are. Nothing is
//! drawn, shown or written.
//!
//! What the exact sums of [`power`](super::power) leave out is in here: which orders the design
//! gives when its blocks are not full, a preference for the image shown first, participants who differ,
//! participants who leave, and the whole of Holm's procedure where conditions depend on each other.

mod study;
pub mod tables;

use rayon::prelude::*;
use serde::Serialize;

use super::orders::Orders;
use super::power::Test;
use crate::analysis::statistic::Watch;
use crate::analysis::tails::Alpha;
use crate::protocol::procedure::{Ask, Step};
use crate::protocol::{Condition, PlanError, Protocol, SessionPlan};
use study::{Study, StudyResult};

/// What is simulated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Assumptions {
    /// Share of technique b in every condition, for a participant without an own preference and
    /// without a bias; above 0 and below 1.
    pub p: f64,
    /// Preference for the image shown first, on the logit scale.
    pub order_bias: f64,
    /// Standard deviation of the participants' own preferences for b, on the logit scale.
    pub participant_sd: f64,
    /// Probability that a participant leaves before the end; the next one takes the slot.
    pub drop_out: f64,
    /// Whether the answers of those who left are left out of the analysis.
    pub leave_out_incomplete: bool,
    /// How many participants finish: as many slots are filled.
    pub participants: u32,
    /// Studies to simulate.
    pub studies: u32,
    /// Level of the family.
    pub alpha: Alpha,
    /// Ids of the conditions of the declared family; empty: all.
    pub family: Vec<String>,
    /// Seed of everything random in the answers. The orders are the protocol's own.
    pub seed: u64,
}

/// A protocol that cannot be simulated.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SimulateError {
    /// No plan.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// It asks no choices.
    #[error(
        "the procedure \"{0}\" does not ask for a choice between two images, which is what power is computed for"
    )]
    NoChoices(&'static str),
    /// A session that does not end as it should.
    #[error("a simulated session cannot go on: {0}")]
    Session(String),
}

/// How often something happened, of how many studies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Frequency {
    /// Studies in which it did.
    pub happened: u32,
    /// Studies.
    pub studies: u32,
}

/// One condition over all studies.
#[derive(Debug, Clone, PartialEq)]
pub struct ConditionOutcome {
    /// Its id.
    pub id: String,
    /// The techniques of its base order.
    pub techniques: [String; 2],
    /// Exact p at most alpha.
    pub uncorrected: Frequency,
    /// Chi-square p at most alpha.
    pub chi_square: Frequency,
    /// Holm's p at most alpha.
    pub holm: Frequency,
    /// Mean number of answers.
    pub answers: f64,
    /// Mean share of technique b.
    pub share_b: f64,
    /// Mean number of answers in each order: (a then b, b then a).
    pub orders: (f64, f64),
    /// Uncorrected power by summation over the plan's orders; `None` where drop-outs' answers
    /// count, which makes the orders random.
    pub exact: Option<f64>,
    /// Share of technique b that the plan's orders lead to on average; `None` likewise.
    pub expected_share: Option<f64>,
}

/// All studies of one set of assumptions.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// By condition, in the study's order.
    pub conditions: Vec<ConditionOutcome>,
    /// At least one condition of the family significant without correction.
    pub any_uncorrected: Frequency,
    /// At least one after Holm: where nothing is there, the family-wise error.
    pub any_holm: Frequency,
    /// All of the family after Holm.
    pub all_holm: Frequency,
    /// Mean share of the family's conditions found after Holm.
    pub each_holm: f64,
    /// Mean number of participants who came, drop-outs included.
    pub came: f64,
    /// Mean share of answers for the image shown first.
    pub chose_first: f64,
}

/// Simulated studies, with the effect and without.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulated {
    /// What was assumed.
    pub assumptions: Assumptions,
    /// With the share assumed in every condition.
    pub effect: Outcome,
    /// With a share of ½ in every condition, all else alike: whatever is found is an error.
    pub null: Outcome,
}

/// Simulates the studies, with the effect and without, on all processors. The same assumptions give
/// the same result on any number of them.
///
/// # Errors
/// [`SimulateError`].
pub fn simulate(
    protocol: &Protocol,
    conditions: &[Condition],
    assumptions: &Assumptions,
    watch: &dyn Watch,
) -> Result<Simulated, SimulateError> {
    let asks = (protocol.procedure.steps)(protocol);
    if !matches!(
        asks.last(),
        Some(Step::Ask(Ask::Choice | Ask::CloserToReference))
    ) {
        return Err(SimulateError::NoChoices(protocol.procedure.name));
    }
    let plans = (0..assumptions.participants)
        .map(|slot| SessionPlan::new(protocol, conditions, slot))
        .collect::<Result<Vec<_>, _>>()?;
    let main: Vec<usize> = (0..conditions.len())
        .filter(|&index| !protocol.names(&conditions[index].id))
        .collect();
    watch.begin("studies", 2 * u64::from(assumptions.studies));
    let of = |p: f64, purpose: &'static str| {
        let study = Study {
            protocol,
            conditions,
            plans: &plans,
            main: &main,
            assumptions: Assumptions {
                p,
                ..assumptions.clone()
            },
            purpose,
        };
        outcome(&study, watch)
    };
    Ok(Simulated {
        effect: of(assumptions.p, "planning-effect")?,
        null: of(0.5, "planning-null")?,
        assumptions: assumptions.clone(),
    })
}

fn outcome(study: &Study<'_>, watch: &dyn Watch) -> Result<Outcome, SimulateError> {
    let numbers: Vec<u32> = (0..study.assumptions.studies).collect();
    let results = numbers
        .par_iter()
        .map(|&number| {
            let result = study.run(number);
            watch.step();
            result
        })
        .collect::<Result<Vec<_>, _>>()
        .map_err(SimulateError::Session)?;
    let conditions = (study.main.iter().enumerate())
        .map(|(index, _)| condition_outcome(study, index, &results))
        .collect();
    let how_often = |happened: &dyn Fn(&StudyResult) -> bool| frequency(&results, happened);
    Ok(Outcome {
        conditions,
        any_uncorrected: how_often(&|it| it.found(|c| c.in_family && c.uncorrected) > 0),
        any_holm: how_often(&|it| it.found(|c| c.holm) > 0),
        all_holm: how_often(&|it| it.found(|c| c.holm) == it.found(|c| c.in_family)),
        each_holm: mean(&results, |it| {
            it.found(|c| c.holm) as f64 / it.found(|c| c.in_family).max(1) as f64
        }),
        came: mean(&results, |it| f64::from(it.came)),
        chose_first: mean(&results, StudyResult::chose_first),
    })
}

fn condition_outcome(study: &Study<'_>, index: usize, results: &[StudyResult]) -> ConditionOutcome {
    let condition = study.condition(index);
    let how_often = |happened: &dyn Fn(&study::ConditionResult) -> bool| {
        frequency(results, |it| happened(&it.conditions[index]))
    };
    let mean = |value: &dyn Fn(&study::ConditionResult) -> f64| {
        mean(results, |it| value(&it.conditions[index]))
    };
    let of_order = |which: fn((u32, u32)) -> u32| mean(&|it| f64::from(which(it.orders.orders())));
    let assumed = &study.assumptions;
    let orders_are_planned = assumed.drop_out == 0.0 || assumed.leave_out_incomplete;
    let (a_then_b, b_then_a) = study.planned_orders(index);
    let orders = Orders {
        p: assumed.p,
        bias: assumed.order_bias,
        participant_sd: assumed.participant_sd,
        a_then_b,
        b_then_a,
    };
    let exact = || orders.power(Test::Exact, assumed.alpha).value();
    ConditionOutcome {
        id: condition.id.clone(),
        techniques: [0, 1].map(|i| condition.techniques.get(i).cloned().unwrap_or_default()),
        uncorrected: how_often(&|it| it.uncorrected),
        chi_square: how_often(&|it| it.chi_square),
        holm: how_often(&|it| it.holm),
        answers: mean(&|it| f64::from(it.orders.votes().total())),
        share_b: mean(&|it| it.orders.votes().share_b().unwrap_or(0.5)),
        orders: (of_order(|(ab, _)| ab), of_order(|(_, ba)| ba)),
        exact: orders_are_planned.then(exact),
        expected_share: orders_are_planned.then(|| orders.mean_share()),
    }
}

fn frequency(results: &[StudyResult], happened: impl Fn(&StudyResult) -> bool) -> Frequency {
    let count = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    Frequency {
        happened: count(results.iter().filter(|it| happened(it)).count()),
        studies: count(results.len()),
    }
}

/// In the order of the studies, so that the sum does not depend on who was finished first.
fn mean(results: &[StudyResult], value: impl Fn(&StudyResult) -> f64) -> f64 {
    results.iter().map(value).sum::<f64>() / results.len().max(1) as f64
}

#[cfg(test)]
mod tests;
