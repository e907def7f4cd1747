//! A test that may be looked at after every answer: how much a gambler would hold who bets on the
//! votes of a condition, against the house's claim that they are even.

use super::conclusion::{listed, plural};
use super::dataset::Dataset;
use super::holm;
use super::settings::Settings;
use super::statistic::{About, AnswerStatistic, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Status, Style, Table, Undefined};
use super::tails::Probability;

mod monitor;

pub use monitor::{Monitor, confidence_sequence, ln_e_value};

const ABOUT: About = About {
    id: "sequential",
    name: "anytime-valid test against an even split",
    formula: "e_k = 2ᵏ B(b + 1, a + 1) after k votes, p = min(1, 1/max e_k); interval: all shares q with B(b + 1, a + 1)/(qᵇ (1 − q)ᵃ) < 1/alpha",
    source: "H. Robbins (1970), Annals of Mathematical Statistics 41(5), 1397–1409; S. R. Howard, A. Ramdas, J. McAuliffe, J. Sekhon (2021), Annals of Statistics 49(2), 1055–1080",
    validity: "under an even split the chance that p is ever at most alpha is at most alpha, at whatever answer the study stops and for whatever reason; needs independent votes in the order in which they were given; less powerful than a test at a fixed number of votes",
};

/// By condition.
pub const BY_CONDITION: AnswerStatistic = AnswerStatistic {
    about: ABOUT,
    columns: &[
        Column::new(
            "e_value_log10",
            "log₁₀ e",
            Style::Decimals(3),
            Group::Evidence,
        ),
        Column::new("p_anytime", "p anytime", Style::P, Group::Evidence),
        Column::new("anytime_ci", "anytime", Style::Interval(3), Group::Evidence),
    ],
    cells: |data, settings| {
        (runs(data, settings).iter())
            .map(|run| run.cells(settings).to_vec())
            .collect()
    },
};

/// The study's section.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: ABOUT,
    section,
};

const NEEDS_ORDER: Undefined =
    Undefined::not_available("needs the order of single answers, the input has only counts");
const NOT_REACHED: Undefined = Undefined::degenerate("alpha was not reached at any answer");
const OUTSIDE: Undefined = Undefined::not_available("not of the declared family");

/// One condition's votes, looked at after each of them.
#[derive(Clone, Copy, Default)]
struct Run {
    monitor: Monitor,
    /// The number of votes at which p was at most alpha for the first time.
    reached: Option<u32>,
    /// Whether the order of the votes is known.
    ordered: bool,
}

impl Run {
    fn p(&self) -> Result<Probability, Undefined> {
        match (self.monitor.votes().total(), self.ordered) {
            (0, _) => Err(Undefined::NO_VOTES),
            (_, false) => Err(NEEDS_ORDER),
            (_, true) => Ok(self.monitor.p()),
        }
    }

    /// e, p, interval.
    fn cells(&self, settings: &Settings) -> [Cell; 3] {
        if self.monitor.votes().total() == 0 {
            return [(); 3].map(|()| Cell::Undefined(Undefined::NO_VOTES));
        }
        [
            Cell::Number(self.monitor.ln_e_value() * std::f64::consts::LOG10_E),
            Cell::or_undefined(self.p(), Cell::Probability),
            Cell::Interval(self.monitor.interval(settings.alpha)),
        ]
    }
}

/// Every condition's run: participants in order of appearance. Of counts only the end is known.
fn runs(data: &Dataset, settings: &Settings) -> Vec<Run> {
    if !data.has_answers() {
        return (data.conditions.iter())
            .map(|condition| Run {
                monitor: Monitor::at_once(condition.votes),
                ..Run::default()
            })
            .collect();
    }
    let ordered = Run {
        ordered: true,
        ..Run::default()
    };
    let mut runs = vec![ordered; data.conditions.len()];
    let ln_threshold = -settings.alpha.get().ln();
    in_order(data, |condition, for_b| {
        let run = &mut runs[condition];
        let larger = run.monitor.vote(for_b);
        if larger && run.reached.is_none() && run.monitor.ln_e_value() >= ln_threshold {
            run.reached = Some(run.monitor.votes().total());
        }
    });
    runs
}

/// Every vote as (condition, for b): participants in order of appearance, each one's answers in
/// theirs.
fn in_order(data: &Dataset, mut vote: impl FnMut(usize, bool)) {
    let mut feed = |at: usize| {
        let answer = &data.answers[at];
        if let Some(for_b) = answer.chose_b() {
            vote(answer.condition as usize, for_b);
        }
    };
    let participant = |at: &usize| data.answers[*at].participant;
    if data.answers.is_sorted_by_key(|answer| answer.participant) {
        (0..data.answers.len()).for_each(&mut feed);
    } else {
        let mut order: Vec<usize> = (0..data.answers.len()).collect();
        order.sort_by_key(participant);
        order.into_iter().for_each(&mut feed);
    }
}

/// log₁₀ e of the first conditions after every vote, 0 before the first; `None` where the order of
/// the votes is not known.
#[must_use]
pub fn paths(data: &Dataset, conditions: usize) -> Option<Vec<Vec<f64>>> {
    if !data.has_answers() {
        return None;
    }
    let shown = conditions.min(data.conditions.len());
    let mut monitors = vec![Monitor::default(); shown];
    let mut paths = vec![vec![0.0]; shown];
    in_order(data, |condition, for_b| {
        if let (Some(monitor), Some(path)) = (monitors.get_mut(condition), paths.get_mut(condition))
        {
            monitor.vote(for_b);
            path.push(monitor.ln_e_value() * std::f64::consts::LOG10_E);
        }
    });
    Some(paths)
}

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    if data.conditions.is_empty() {
        return None;
    }
    let runs = runs(data, settings);
    let corrected = corrected(data, settings, &runs);
    let status = if data.conditions.iter().all(|c| c.votes.total() == 0) {
        Status::Degenerate
    } else if data.has_answers() {
        Status::Ok
    } else {
        Status::NotAvailable
    };
    Some(Section {
        id: "sequential",
        title: "Anytime-valid test",
        status,
        findings: match status {
            Status::Degenerate => vec!["No condition has a vote: nothing was tested.".to_owned()],
            Status::Ok => findings(data, settings, &runs, &corrected),
            _ => vec!["Only counts are known, not the order of the answers: there are no anytime-valid p. The e-values and intervals are those of the last vote: one look, at a number of votes that was fixed before.".to_owned()],
        },
        tables: vec![SectionTable {
            id: "by_condition",
            caption: "e-values, the largest on the way, anytime-valid p with Holm's correction, confidence sequence of b's share at the last vote, and the vote at which p first reached alpha",
            long: false,
            table: table(data, settings, &runs, &corrected),
        }],
    })
}

/// Holm over the declared family; it holds for any dependence, also of anytime-valid p.
fn corrected(
    data: &Dataset,
    settings: &Settings,
    runs: &[Run],
) -> Vec<Result<Probability, Undefined>> {
    let of_family = |i: usize| settings.in_family(&data.conditions[i].id);
    let tested: Vec<Probability> = (runs.iter().enumerate())
        .filter(|(i, _)| of_family(*i))
        .filter_map(|(_, run)| run.p().ok())
        .collect();
    let mut adjusted = holm::adjust(&tested).into_iter();
    (runs.iter().enumerate())
        .map(|(i, run)| match run.p() {
            Ok(_) if !of_family(i) => Err(OUTSIDE),
            Ok(p) => Ok(adjusted.next().unwrap_or(p)),
            Err(why) => Err(why),
        })
        .collect()
}

fn findings(
    data: &Dataset,
    settings: &Settings,
    runs: &[Run],
    corrected: &[Result<Probability, Undefined>],
) -> Vec<String> {
    let with = |wanted: &dyn Fn(usize) -> bool| -> Vec<&str> {
        (0..runs.len())
            .filter(|i| wanted(*i))
            .map(|i| data.conditions[i].id.as_str())
            .collect()
    };
    let before = with(&|i| runs[i].p().is_ok_and(|p| p.at_most(settings.alpha)));
    let after = with(&|i| corrected[i].is_ok_and(|p| p.at_most(settings.alpha)));
    let named = |ids: &[&str]| {
        if ids.is_empty() {
            "none".to_owned()
        } else {
            format!("{} ({})", ids.len(), listed(ids))
        }
    };
    vec![
        format!(
            "Of {}, each looked at after every answer, the anytime-valid p reached alpha = {} in: {} before correction; {} after Holm's.",
            plural(runs.len(), "condition"),
            settings.alpha.get(),
            named(&before),
            named(&after),
        ),
        "Answers are taken in the order in which participants appear in the input; the error rate holds if that is the order in which they took part.".to_owned(),
        "p keeps the smallest value on the way; the interval is that of the last vote and may hold ½ again after p reached alpha.".to_owned(),
    ]
}

fn table(
    data: &Dataset,
    settings: &Settings,
    runs: &[Run],
    corrected: &[Result<Probability, Undefined>],
) -> Table {
    let rows = (data.conditions.iter().zip(runs).zip(corrected))
        .map(|((condition, run), corrected)| {
            let [e_value, p, interval] = run.cells(settings);
            let known = run.p();
            let largest = run.monitor.ln_largest_e_value() * std::f64::consts::LOG10_E;
            let reached = known.and_then(|_| run.reached.ok_or(NOT_REACHED));
            vec![
                Cell::Text(condition.id.clone()),
                Cell::Count(condition.votes.total()),
                e_value,
                Cell::or_undefined(known, |_| Cell::Number(largest)),
                Cell::or_undefined(known, |_| Cell::Count(run.monitor.largest_at())),
                p,
                Cell::or_undefined(*corrected, Cell::Probability),
                interval,
                Cell::or_undefined(reached, Cell::Count),
            ]
        })
        .collect();
    let evidence = |key, title, style| Column::new(key, title, style, Group::Evidence);
    Table {
        columns: vec![
            Column::new("condition", "condition", Style::Text, Group::Key),
            Column::new("votes", "votes", Style::Count, Group::Choices),
            evidence("e_value_log10", "log₁₀ e", Style::Decimals(3)),
            evidence("e_max_log10", "largest", Style::Decimals(3)),
            evidence("e_max_at", "at vote", Style::Count),
            evidence("p_anytime", "p anytime", Style::P),
            evidence("p_anytime_holm", "Holm", Style::P),
            evidence("anytime_ci", "interval", Style::Interval(3)),
            evidence("reached_at", "reached at", Style::Count),
        ],
        rows,
    }
}

#[cfg(test)]
mod tests;
