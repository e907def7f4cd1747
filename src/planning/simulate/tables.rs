//! Simulated studies as tables, each estimate with the interval that the number of studies allows.

use super::{Assumptions, ConditionOutcome, Frequency, Outcome, Simulated};
use crate::analysis::conclusion::plural;
use crate::analysis::statistic::{Section, SectionTable};
use crate::analysis::table::{Cell, Column, Group, Interval, Status, Style, Table, Undefined};
use crate::analysis::tails::{Alpha, clopper_pearson};

const ORDERS_AT_RANDOM: Undefined = Undefined::not_available(
    "answers of those who left count, so the orders are not known beforehand",
);

impl Frequency {
    /// The share of studies.
    #[must_use]
    pub fn share(self) -> f64 {
        f64::from(self.happened) / f64::from(self.studies.max(1))
    }

    /// Clopper–Pearson, 95 %: how far the share may be off because so few studies were simulated.
    #[must_use]
    pub fn interval(self) -> Interval {
        let (low, high) = clopper_pearson(self.happened, self.studies, Alpha::FIVE_PERCENT);
        Interval { low, high }
    }

    fn cells(self) -> [Cell; 2] {
        [Cell::Number(self.share()), Cell::Interval(self.interval())]
    }
}

impl Simulated {
    /// What was found, and what was taken for found where nothing is.
    #[must_use]
    pub fn sections(&self) -> Vec<Section> {
        vec![
            self.assumed(),
            Section {
                id: "simulated_conditions",
                title: "Power of each condition",
                status: Status::Ok,
                findings: vec![
                    "Share of studies in which the condition is significant, with its 95\u{a0}% interval (Clopper–Pearson: a matter of how many studies were simulated). \"exact\" is the power without correction summed over the orders that the plan shows.".to_owned(),
                ],
                tables: vec![SectionTable {
                    id: "conditions",
                    caption: "With the preference assumed",
                    long: false,
                    table: self.conditions(),
                }],
            },
            self.family(),
        ]
    }

    fn assumed(&self) -> Section {
        let assumed = &self.assumptions;
        let mut findings = vec![format!(
            "{} of {} and {}: technique b is chosen with probability {} in every condition; order bias {} and standard deviation of the participants {} on the logit scale.",
            plural(assumed.studies as usize, "study").replace("studys", "studies"),
            plural(assumed.participants as usize, "participant"),
            plural(self.effect.conditions.len(), "condition"),
            assumed.p,
            assumed.order_bias,
            assumed.participant_sd,
        )];
        findings.extend(marginal(assumed, &self.effect));
        if assumed.drop_out > 0.0 {
            findings.push(format!(
                "Each participant leaves with probability {} after some trial, and the next takes the slot: {:.1} come on average. The answers of those who left {}.",
                assumed.drop_out,
                self.effect.came,
                match assumed.leave_out_incomplete {
                    true => "are left out",
                    false => "count, as they do in `greyfield analyse` unless the participant is rejected",
                },
            ));
        }
        findings.extend(self.order_finding());
        Section {
            id: "assumptions",
            title: "Simulated studies",
            status: Status::Ok,
            findings,
            tables: Vec::new(),
        }
    }

    /// How uneven the orders are, and what a bias makes of that.
    fn order_finding(&self) -> Option<String> {
        let imbalance = |it: &&ConditionOutcome| (it.orders.0 - it.orders.1).abs();
        let conditions = self.effect.conditions.iter();
        let worst = conditions.max_by(|a, b| imbalance(a).total_cmp(&imbalance(b)))?;
        if imbalance(&worst) < 0.5 {
            return Some("Every condition is seen equally often in both orders.".to_owned());
        }
        let alike = |it: &ConditionOutcome| it.orders == worst.orders;
        let place = match self.effect.conditions.iter().all(alike) {
            true => "in every condition".to_owned(),
            false => format!("most in {}", worst.id),
        };
        let null = self.null.conditions.iter().find(|it| it.id == worst.id)?;
        let bias = match self.assumptions.order_bias == 0.0 {
            true => String::new(),
            false => format!(
                " With this bias that makes a share of b of {:.3} on average where nobody prefers either.",
                null.expected_share.unwrap_or(null.share_b)
            ),
        };
        Some(format!(
            "The two orders are uneven, {place}: {:.1} participants see a first, {:.1} see b first.{bias}",
            worst.orders.0, worst.orders.1
        ))
    }

    /// One row a condition.
    #[must_use]
    pub fn conditions(&self) -> Table {
        let interval = |key, title| Column::new(key, title, Style::Interval(3), Group::Tests);
        let number = |key, title| Column::new(key, title, Style::Decimals(3), Group::Tests);
        let mean = |key, title| Column::new(key, title, Style::Decimals(1), Group::Position);
        let columns = vec![
            Column::new("condition", "condition", Style::Text, Group::Key),
            Column::new("technique_a", "a", Style::Text, Group::Key),
            Column::new("technique_b", "b", Style::Text, Group::Key),
            mean("answers", "answers"),
            mean("shown_ab", "a first"),
            mean("shown_ba", "b first"),
            number("share_b", "share b"),
            number("power_holm", "Holm"),
            interval("power_holm_interval", "95 %"),
            number("power_uncorrected", "uncorrected"),
            interval("power_uncorrected_interval", "95 %"),
            number("power_exact", "exact"),
            number("power_chi_square", "χ²"),
        ];
        let row = |it: &ConditionOutcome| {
            let mut cells = vec![
                Cell::Text(it.id.clone()),
                Cell::Text(it.techniques[0].clone()),
                Cell::Text(it.techniques[1].clone()),
                Cell::Number(it.answers),
                Cell::Number(it.orders.0),
                Cell::Number(it.orders.1),
                Cell::Number(it.share_b),
            ];
            cells.extend(it.holm.cells());
            cells.extend(it.uncorrected.cells());
            cells.push(Cell::or_undefined(
                it.exact.ok_or(ORDERS_AT_RANDOM),
                Cell::Number,
            ));
            cells.push(Cell::Number(it.chi_square.share()));
            cells
        };
        Table {
            columns,
            rows: self.effect.conditions.iter().map(row).collect(),
        }
    }

    fn family(&self) -> Section {
        let of = |outcome: fn(&Outcome) -> Frequency| [outcome(&self.effect), outcome(&self.null)];
        let row = |quantity: &str, [effect, null]: [Frequency; 2]| {
            let mut cells = vec![Cell::Text(quantity.to_owned())];
            cells.extend(effect.cells());
            cells.extend(null.cells());
            cells
        };
        let family_wise = self.null.any_holm;
        let alpha = self.assumptions.alpha.get();
        let verdict = match family_wise.interval() {
            Interval { low, .. } if low > alpha => "above",
            Interval { high, .. } if high < alpha => "below",
            _ => "compatible with",
        };
        let findings = vec![
            format!(
                "With the preference assumed, Holm finds {:.1}\u{a0}% of the conditions on average; the image shown first is chosen in {:.1}\u{a0}% of the trials.",
                100.0 * self.effect.each_holm,
                100.0 * self.effect.chose_first,
            ),
            format!(
                "Where nobody prefers either technique, at least one condition is significant after Holm in {:.2}\u{a0}% of the studies: the family-wise error, {verdict} alpha = {alpha}.",
                100.0 * family_wise.share(),
            ),
        ];
        Section {
            id: "simulated_family",
            title: "The family",
            status: Status::Ok,
            findings,
            tables: vec![SectionTable {
                id: "family",
                caption: "Share of studies with significant conditions (exact test)",
                long: false,
                table: Table {
                    columns: vec![
                        Column::new("quantity", "significant", Style::Text, Group::Key),
                        Column::new("effect", "preference", Style::Decimals(3), Group::Tests),
                        Column::new("effect_interval", "95 %", Style::Interval(3), Group::Tests),
                        Column::new("null", "none", Style::Decimals(3), Group::Tests),
                        Column::new("null_interval", "95 %", Style::Interval(3), Group::Tests),
                    ],
                    rows: vec![
                        row("at least one, Holm", of(|it| it.any_holm)),
                        row("all, Holm", of(|it| it.all_holm)),
                        row("at least one, uncorrected", of(|it| it.any_uncorrected)),
                    ],
                },
            }],
        }
    }
}

/// What bias and differences between participants make of the share.
fn marginal(assumed: &Assumptions, outcome: &Outcome) -> Option<String> {
    if assumed.order_bias == 0.0 && assumed.participant_sd == 0.0 {
        return None;
    }
    let count = outcome.conditions.len().max(1) as f64;
    let shares = outcome.conditions.iter();
    let shares = shares.map(|it| it.expected_share.unwrap_or(it.share_b));
    let mean = shares.sum::<f64>() / count;
    Some(format!(
        "Over these orders and participants, b is chosen in {:.1}\u{a0}% of the answers: a bias and participants who differ pull a share towards one half.",
        100.0 * mean
    ))
}
