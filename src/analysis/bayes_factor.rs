//! The Bayes factor of each condition: how much better the votes are told by a share that could be
//! anything than by an even split.

use super::conclusion::plural;
use super::dataset::{ConditionData, Dataset, Votes};
use super::settings::Settings;
use super::statistic::{About, ConditionStatistic, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Interval, Status, Style, Table, Undefined};
use super::tails::{Alpha, clopper_pearson, deviance, stirling_error};

const ABOUT: About = About {
    id: "bayes_factor",
    name: "Bayes factor against an even split",
    formula: "BF₁₀ = 2ⁿ B(b + s, a + s)/B(s, s); prior Beta(s, s) on b's share, s = 1 (uniform) unless said otherwise; B the beta function",
    source: "H. Jeffreys (1961), Theory of Probability, 3rd ed., chapter 5 and appendix B; R. E. Kass, A. E. Raftery (1995), JASA 90(430), 773–795",
    validity: "exact for independent votes; depends on the prior, so that its range over s = 0.5 to 10 is told; no correction for the number of conditions",
};

/// By condition.
pub const BY_CONDITION: ConditionStatistic = ConditionStatistic {
    about: ABOUT,
    columns: &[
        Column::new(
            "bf10_log10",
            "log₁₀ BF₁₀",
            Style::Decimals(3),
            Group::Evidence,
        ),
        Column::new(
            "posterior_mean",
            "posterior mean",
            Style::Decimals(3),
            Group::Evidence,
        ),
        Column::new("credible", "credible", Style::Interval(3), Group::Evidence),
    ],
    cells,
    test: None,
};

/// With other priors.
pub const SENSITIVITY: StudyStatistic = StudyStatistic {
    about: ABOUT,
    section,
};

/// The priors Beta(s, s) that the factor is told for, and the keys of their columns.
const PRIORS: [(f64, &str, &str); 5] = [
    (0.5, "bf10_log10_prior_0_5", "s = 0.5"),
    (1.0, "bf10_log10_prior_1", "s = 1"),
    (2.0, "bf10_log10_prior_2", "s = 2"),
    (5.0, "bf10_log10_prior_5", "s = 5"),
    (10.0, "bf10_log10_prior_10", "s = 10"),
];

/// log₁₀ BF₁₀ from which the evidence is called substantial: Jeffreys' √10.
const SUBSTANTIAL: f64 = 0.5;

/// ln BF₁₀ with the prior Beta(s, s) on the share of b; s > 0.
///
/// By Stirling's series ln B(x, y) + (x + y) ln 2 is the deviance of (x, y) from an even split and
/// terms that stay small, so that nothing of the size of n cancels: 12 digits at n = 10⁹.
#[must_use]
pub fn ln_bayes_factor(votes: Votes, s: f64) -> f64 {
    ln_beta_even(f64::from(votes.b) + s, f64::from(votes.a) + s) - ln_beta_even(s, s)
}

/// ln B(x, y) + (x + y) ln 2, without ½ ln 2π, which every difference of two of them loses.
fn ln_beta_even(x: f64, y: f64) -> f64 {
    let sum = x + y;
    // x − (x + y)/2, formed from the difference: exact where the counts are.
    let half_difference = (x - y) / 2.0;
    deviance(x, sum / 2.0, half_difference)
        + deviance(y, sum / 2.0, -half_difference)
        + 0.5 * (sum / x / y).ln()
        + stirling_error(x)
        + stirling_error(y)
        - stirling_error(sum)
}

/// Equal-tailed interval of the posterior Beta(b + 1, a + 1).
///
/// P(Beta(b + 1, a + 1) ≤ p) = P(Bin(n + 1, p) ≥ b + 1) (DLMF 8.17.5), so that its quantiles are
/// Clopper–Pearson bounds with one vote more.
#[must_use]
pub fn credible_interval(votes: Votes, alpha: Alpha) -> Interval {
    let n = votes.total().saturating_add(1);
    Interval {
        low: clopper_pearson(votes.b.saturating_add(1), n, alpha).0,
        high: clopper_pearson(votes.b, n, alpha).1,
    }
}

fn log10(votes: Votes, s: f64) -> f64 {
    ln_bayes_factor(votes, s) * std::f64::consts::LOG10_E
}

fn cells(condition: &ConditionData, settings: &Settings) -> Vec<Cell> {
    let votes = condition.votes;
    if votes.total() == 0 {
        return vec![Cell::Undefined(Undefined::NO_VOTES); BY_CONDITION.columns.len()];
    }
    let mean = (f64::from(votes.b) + 1.0) / (f64::from(votes.total()) + 2.0);
    vec![
        Cell::Number(log10(votes, 1.0)),
        Cell::Number(mean),
        Cell::Interval(credible_interval(votes, settings.alpha)),
    ]
}

fn section(context: &Context<'_>) -> Option<Section> {
    let data = context.data;
    if data.conditions.is_empty() {
        return None;
    }
    let voted: Vec<&ConditionData> = (data.conditions.iter())
        .filter(|condition| condition.votes.total() > 0)
        .collect();
    let status = if voted.is_empty() {
        Status::Degenerate
    } else {
        Status::Ok
    };
    let findings = if voted.is_empty() {
        vec!["No condition has a vote: there is no evidence to weigh.".to_owned()]
    } else {
        findings(&voted)
    };
    Some(Section {
        id: "bayes_factor",
        title: "Bayes factors against an even split",
        status,
        findings,
        tables: vec![SectionTable {
            id: "sensitivity",
            caption: "log₁₀ BF₁₀ with the priors Beta(s, s); above 0 for a preference, below 0 for an even split; the words are Jeffreys' and of s = 1",
            long: false,
            table: sensitivity(data),
        }],
    })
}

fn findings(voted: &[&ConditionData]) -> Vec<String> {
    let uniform: Vec<f64> = voted.iter().map(|c| log10(c.votes, 1.0)).collect();
    let for_preference = uniform.iter().filter(|bf| **bf >= SUBSTANTIAL).count();
    let for_even = uniform.iter().filter(|bf| **bf <= -SUBSTANTIAL).count();
    let mut findings = vec![format!(
        "With a uniform prior on the share, the evidence is substantial or more (BF at least √10 ≈ 3.2, Jeffreys 1961) for a preference in {for_preference} of {}, for an even split in {for_even}, and for neither in {}.",
        plural(voted.len(), "condition"),
        voted.len() - for_preference - for_even,
    )];
    let strongest = (voted.iter().zip(&uniform))
        .rev()
        .max_by(|x, y| x.1.total_cmp(y.1));
    if let Some((condition, bf)) = strongest {
        findings.push(format!(
            "The largest factor is that of {}: {} ({}).",
            condition.id,
            factor_text(*bf),
            category(*bf),
        ));
    }
    let turned: Vec<&str> = (voted.iter())
        .filter(|condition| {
            let side = |s: f64| {
                let bf = log10(condition.votes, s);
                i8::from(bf >= SUBSTANTIAL) - i8::from(bf <= -SUBSTANTIAL)
            };
            PRIORS.iter().any(|(s, ..)| side(*s) != side(1.0))
        })
        .map(|condition| condition.id.as_str())
        .collect();
    findings.push(if turned.is_empty() {
        "None of these verdicts depends on the prior within Beta(0.5, 0.5) to Beta(10, 10)."
            .to_owned()
    } else {
        format!(
            "The verdict depends on the prior within Beta(0.5, 0.5) to Beta(10, 10) in {}: {}.",
            plural(turned.len(), "condition"),
            super::conclusion::listed(&turned),
        )
    });
    findings
}

fn sensitivity(data: &Dataset) -> Table {
    let number = |key, title| Column::new(key, title, Style::Decimals(3), Group::Evidence);
    let mut columns = vec![Column::new(
        "condition",
        "condition",
        Style::Text,
        Group::Key,
    )];
    columns.extend(PRIORS.iter().map(|(_, key, title)| number(*key, *title)));
    columns.push(number("bf10_log10_min", "least"));
    columns.push(number("bf10_log10_max", "most"));
    columns.push(Column::new(
        "evidence",
        "evidence",
        Style::Text,
        Group::Evidence,
    ));
    let rows = (data.conditions.iter())
        .map(|condition| {
            let mut row = vec![Cell::Text(condition.id.clone())];
            if condition.votes.total() == 0 {
                row.extend(vec![Cell::Undefined(Undefined::NO_VOTES); PRIORS.len() + 3]);
                return row;
            }
            let factors = PRIORS.map(|(s, ..)| log10(condition.votes, s));
            row.extend(factors.map(Cell::Number));
            row.push(Cell::Number(factors.into_iter().fold(f64::MAX, f64::min)));
            row.push(Cell::Number(factors.into_iter().fold(f64::MIN, f64::max)));
            row.push(Cell::Text(category(log10(condition.votes, 1.0)).to_owned()));
            row
        })
        .collect();
    Table { columns, rows }
}

/// A factor for running text.
pub(super) fn factor_text(log10: f64) -> String {
    if log10.abs() < 4.0 {
        let factor = 10_f64.powf(log10);
        let digits = if factor < 0.1 { 4 } else { 2 };
        return format!("BF₁₀ = {factor:.digits$}");
    }
    format!("BF₁₀ = 10^{log10:.1}")
}

/// Jeffreys' grades (1961, appendix B): half powers of ten.
#[must_use]
pub fn category(log10: f64) -> &'static str {
    // Rounding may leave a factor of 1 a digit off.
    if log10.abs() < 1e-12 {
        return "none either way";
    }
    let grade = (log10.abs() * 2.0).floor().min(4.0);
    match (log10 >= 0.0, grade as u32) {
        (true, 0) => "barely worth mentioning, for a preference",
        (true, 1) => "substantial for a preference",
        (true, 2) => "strong for a preference",
        (true, 3) => "very strong for a preference",
        (true, _) => "decisive for a preference",
        (false, 0) => "barely worth mentioning, for an even split",
        (false, 1) => "substantial for an even split",
        (false, 2) => "strong for an even split",
        (false, 3) => "very strong for an even split",
        (false, _) => "decisive for an even split",
    }
}

#[cfg(test)]
mod tests;
