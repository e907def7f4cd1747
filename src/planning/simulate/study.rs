//! One simulated study: its participants, who sit the protocol's own sessions, and its analysis.

use rand_chacha::rand_core::Rng;
use time::OffsetDateTime;

use super::Assumptions;
use crate::analysis::chi_square;
use crate::analysis::conditions::{Family, main_family};
use crate::analysis::dataset::{ConditionData, Dataset, Order, OrderCounts};
use crate::analysis::{Settings, holm};
use crate::protocol::{Condition, Phase, Protocol, SessionPlan};
use crate::record::{InputDevice, OnsetMethod, Response, TrialRow};
use crate::seed;
use crate::session::observer::Share;
use crate::session::{DisplayOnRecord, Effect, Event, Session, SessionInfo, headless};

/// What every study of a simulation has in common.
pub(super) struct Study<'a> {
    pub protocol: &'a Protocol,
    /// All of the stimulus set.
    pub conditions: &'a [Condition],
    /// By slot; as many as participants finish.
    pub plans: &'a [SessionPlan],
    /// Those of the main part, as numbers of the conditions.
    pub main: &'a [usize],
    pub assumptions: Assumptions,
    /// Keeps the answers with the effect apart from those without.
    pub purpose: &'static str,
}

/// One condition of one study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ConditionResult {
    pub orders: OrderCounts,
    pub in_family: bool,
    pub uncorrected: bool,
    pub chi_square: bool,
    pub holm: bool,
}

/// One study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct StudyResult {
    pub conditions: Vec<ConditionResult>,
    /// Participants, those who left included.
    pub came: u32,
}

impl StudyResult {
    pub fn found(&self, is: impl Fn(&ConditionResult) -> bool) -> usize {
        self.conditions.iter().filter(|it| is(it)).count()
    }

    /// Share of answers for the image shown first.
    pub fn chose_first(&self) -> f64 {
        let positions = self.conditions.iter().map(|it| it.orders.positions());
        let (first, second) = positions.fold((0, 0), |(a, b), (c, d)| (a + c, b + d));
        f64::from(first) / f64::from((first + second).max(1))
    }
}

impl Study<'_> {
    /// A condition of the main part.
    pub fn condition(&self, index: usize) -> &Condition {
        &self.conditions[self.main[index]]
    }

    /// How often the plans show a condition in each order: (a then b, b then a).
    pub fn planned_orders(&self, index: usize) -> (u32, u32) {
        let trials = self.plans.iter().flat_map(|plan| &plan.trials);
        let of_condition =
            trials.filter(|it| it.phase == Phase::Main && it.condition == self.main[index]);
        of_condition.fold((0, 0), |(ab, ba), trial| match trial.reversed {
            false => (ab + 1, ba),
            true => (ab, ba + 1),
        })
    }

    /// The study of this number: a pure function of it.
    pub fn run(&self, number: u32) -> Result<StudyResult, String> {
        let mut rng = seed::generator(self.assumptions.seed, self.purpose, number.into());
        let seed = rng.next_u64();
        let mut counts = vec![OrderCounts::default(); self.main.len()];
        let mut came = 0;
        for plan in self.plans {
            // Whoever leaves opens the slot for the next, as in a results folder.
            for claim in 0_u32.. {
                came += 1;
                let mut rng = seed::generator(seed, "planning-claim", number_of(plan.slot, claim));
                let leaves = seed::unit_f64(&mut rng) < self.assumptions.drop_out;
                let leaves_after = leaves.then(|| some_trial(&mut rng, plan.trials.len()));
                let sat = self.sit(plan, rng.next_u64(), leaves_after)?;
                if !(leaves && self.assumptions.leave_out_incomplete) {
                    sat.iter().for_each(|row| self.count(&mut counts, row));
                }
                if !leaves {
                    break;
                }
            }
        }
        Ok(self.analysed(&counts, came))
    }

    /// The rows of one session.
    fn sit(
        &self,
        plan: &SessionPlan,
        seed: u64,
        leaves_after: Option<usize>,
    ) -> Result<Vec<TrialRow>, String> {
        let observer = Share {
            seed,
            p: self.assumptions.p,
            bias: self.assumptions.order_bias,
            participants: self.assumptions.participant_sd,
        };
        let mut session = Session::new(plan.clone(), self.protocol, self.nobody());
        let mut rows = Vec::with_capacity(plan.trials.len());
        let keep = |effect: &Effect| {
            if let Effect::StoreRow(row) = effect {
                rows.push((**row).clone());
            }
            Event::RowStored
        };
        headless::sit(&mut session, self.protocol, &observer, leaves_after, keep)?;
        Ok(rows)
    }

    /// Who sits there: nobody in particular, in virtual time.
    fn nobody(&self) -> SessionInfo {
        SessionInfo {
            participant_id: "simulated".to_owned(),
            session: 1,
            segment: 1,
            station_id: "simulated".to_owned(),
            pilot: false,
            language: self.protocol.language,
            started_utc: OffsetDateTime::UNIX_EPOCH,
            onset_method: OnsetMethod::Virtual,
            onset_uncertainty_ms: Some(0.0),
            display: DisplayOnRecord::default(),
            refresh_period_ns: None,
            input_device: InputDevice::Scripted,
            images: Vec::new(),
            answered: 0,
            has_told: false,
            interrupted_utc: None,
        }
    }

    fn count(&self, counts: &mut [OrderCounts], row: &TrialRow) {
        if row.phase != Phase::Main {
            return;
        }
        let of_row = (0..self.main.len()).find(|&index| self.condition(index).id == row.condition);
        let Some(index) = of_row else {
            return;
        };
        let base_order = self.condition(index).techniques.first() == Some(&row.technique_first);
        let order = if base_order {
            Order::AThenB
        } else {
            Order::BThenA
        };
        counts[index].add(order, row.response.and_then(Response::position));
    }

    /// As `greyfield analyse` decides.
    fn analysed(&self, counts: &[OrderCounts], came: u32) -> StudyResult {
        let settings = Settings {
            alpha: self.assumptions.alpha,
            family: self.assumptions.family.clone(),
            ..Settings::default()
        };
        let conditions = counts
            .iter()
            .enumerate()
            .map(|(index, counts)| ConditionData {
                id: self.condition(index).id.clone(),
                votes: counts.votes(),
                orders: Some(*counts),
                ..ConditionData::default()
            });
        let data = Dataset {
            conditions: conditions.collect(),
            ..Dataset::default()
        };
        let exact = main_family(&data, &settings);
        let chi_square = chi_square::STATISTIC
            .test
            .map(|test| Family::new(&test, &holm::CORRECTION, &data, &settings));
        let alpha = settings.alpha;
        let result = |(index, &orders): (usize, &OrderCounts)| ConditionResult {
            orders,
            in_family: settings.in_family(&data.conditions[index].id),
            uncorrected: exact.p[index].is_ok_and(|p| p.at_most(alpha)),
            chi_square: (chi_square.as_ref())
                .is_some_and(|family| family.p[index].is_ok_and(|p| p.at_most(alpha))),
            holm: exact.corrected[index].is_ok_and(|p| p.at_most(alpha)),
        };
        StudyResult {
            conditions: counts.iter().enumerate().map(result).collect(),
            came,
        }
    }
}

fn number_of(slot: u32, claim: u32) -> u64 {
    (u64::from(slot) << 32) | u64::from(claim)
}

/// In the middle: after the first trial and before the last, each equally likely; a session of one
/// trial is left before it.
fn some_trial(rng: &mut rand_chacha::ChaCha20Rng, trials: usize) -> usize {
    let places = u32::try_from(trials.saturating_sub(1)).unwrap_or(u32::MAX);
    match places {
        0 => 0,
        _ => 1 + seed::below(rng, places) as usize,
    }
}
