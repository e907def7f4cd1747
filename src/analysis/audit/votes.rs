//! Are there enough votes, equally many in all conditions, and what stays significant once the
//! number of tests is counted?

use super::{Check, Verdict, published};
use crate::analysis::chi_square::FEWEST_VOTES;
use crate::analysis::conclusion::{listed, plural};
use crate::analysis::conditions::{Family, tests};
use crate::analysis::dataset::{ConditionData, Dataset};
use crate::analysis::holm;
use crate::analysis::settings::Settings;
use crate::analysis::statistic::ConditionTest;

/// Corrections, numbers of votes, unanimity.
pub fn checks(data: &Dataset, settings: &Settings) -> Vec<Check> {
    let mut checks: Vec<Check> = tests()
        .map(|test| correction(&test, data, settings))
        .collect();
    checks.extend([equally_many(data), few(data), unanimous(data)]);
    checks
}

fn ids(data: &Dataset, wanted: impl Fn(usize, &ConditionData) -> bool) -> Vec<&str> {
    (data.conditions.iter().enumerate())
        .filter(|(i, condition)| wanted(*i, condition))
        .map(|(_, condition)| condition.id.as_str())
        .collect()
}

/// `none` or `2 (x, y)`.
fn named(ids: &[&str]) -> String {
    if ids.is_empty() {
        "none".to_owned()
    } else {
        format!("{} ({})", ids.len(), listed(ids))
    }
}

/// What one test finds before and after Holm's correction.
fn correction(test: &ConditionTest, data: &Dataset, settings: &Settings) -> Check {
    let family = Family::new(test, &holm::CORRECTION, data, settings);
    let at_most = |p: Result<crate::analysis::tails::Probability, _>| {
        p.is_ok_and(|p: crate::analysis::tails::Probability| p.at_most(settings.alpha))
    };
    let corrected = |i: usize| family.corrected[i];
    let before = ids(data, |i, _| corrected(i).is_ok() && at_most(family.p[i]));
    let after = ids(data, |i, _| at_most(corrected(i)));
    let mut finding = format!(
        "{}; p at most alpha = {} uncorrected: {}; with Holm's correction: {}",
        plural(family.size(), "test"),
        settings.alpha.get(),
        named(&before),
        named(&after),
    );
    let claimed = ids(data, |_, condition| {
        published::significant(condition, settings.alpha) == Some(true)
    });
    if !claimed.is_empty() {
        finding += &format!("; published as significant: {}", named(&claimed));
    }
    let lost = before.len() > after.len() || claimed.iter().any(|id| !after.contains(id));
    let verdict = if lost { Verdict::Note } else { Verdict::Ok };
    Check::new("significance after correction", verdict, finding).of(test.short)
}

fn equally_many(data: &Dataset) -> Check {
    const CHECK: &str = "equal numbers of votes";
    let totals = || data.conditions.iter().map(|c| c.votes.total());
    let (least, most) = (totals().min().unwrap_or(0), totals().max().unwrap_or(0));
    if least == most {
        let n = plural(data.conditions.len(), "condition");
        return Check::new(CHECK, Verdict::Ok, format!("{least} in each of {n}"));
    }
    let fewer = ids(data, |_, condition| condition.votes.total() < most);
    Check::new(
        CHECK,
        Verdict::Note,
        format!(
            "from {least} to {most}; fewer than {most} in {}",
            named(&fewer)
        ),
    )
}

fn few(data: &Dataset) -> Check {
    let few = ids(data, |_, condition| condition.votes.total() < FEWEST_VOTES);
    let verdict = if few.is_empty() {
        Verdict::Ok
    } else {
        Verdict::Note
    };
    let finding = format!("conditions with fewer than {FEWEST_VOTES}: {}", named(&few));
    Check::new("enough votes", verdict, finding)
}

fn unanimous(data: &Dataset) -> Check {
    let one_way = ids(data, |_, condition| {
        let votes = condition.votes;
        votes.total() > 1 && (votes.a == 0 || votes.b == 0)
    });
    let verdict = if one_way.is_empty() {
        Verdict::Ok
    } else {
        Verdict::Note
    };
    let finding = format!(
        "conditions in which all votes went one way: {}",
        named(&one_way)
    );
    Check::new("votes both ways", verdict, finding)
}
