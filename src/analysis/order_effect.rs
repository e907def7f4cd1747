//! Does the choice depend on the order shown? Cochran, Mantel and Haenszel's test over all
//! conditions, each a 2 × 2 table of order and choice: position bias with the preference of each
//! condition taken out.

use super::conclusion::{listed, p_text, plural};
use super::dataset::{Dataset, OrderCounts};
use super::statistic::{About, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Interval, Status, Style, Table, Undefined};
use super::tails::{Alpha, Probability, chi_square_upper, normal_critical};

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "order_effect",
        name: "Cochran–Mantel–Haenszel test of choice by order shown, stratified by condition",
        formula: "χ² = (Σ(x − E))²/Σ V, 1 degree of freedom, no continuity correction; x: shown a, b and chose b; E, V: hypergeometric mean and variance; odds ratio Σ(x·w/n)/Σ(y·z/n) with the interval of Robins, Breslow and Greenland; homogeneity by Breslow and Day with Tarone's correction",
        source: "N. Mantel, W. Haenszel (1959), JNCI 22(4), 719–748; J. Robins, N. Breslow, S. Greenland (1986), Biometrics 42(2), 311–323; R. E. Tarone (1985), Biometrika 72(1), 91–95",
        validity: "approximation for many answers in all, also where each condition has few; homogeneity needs many in each; the answers of one participant are not independent: a warning, not a finding",
    },
    section,
};

const NO_STRATUM: Undefined =
    Undefined::degenerate("in no condition were both orders shown and both techniques chosen");
const NO_FINITE_RATIO: Undefined = Undefined::no_finite_estimate(
    "everybody who told by position chose the same one: the odds ratio is 0 or has no bound",
);
const ONE_STRATUM: Undefined =
    Undefined::degenerate("homogeneity needs two conditions with both orders and both choices");
const NO_CONDITION_RATIO: Undefined =
    Undefined::no_finite_estimate("a cell of the condition's table is empty");

/// One condition: rows are orders shown (a, b and b, a), columns the choice of b and of a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stratum {
    /// Shown a, b: chose b.
    pub ab_b: f64,
    /// Shown a, b: chose a.
    pub ab_a: f64,
    /// Shown b, a: chose b.
    pub ba_b: f64,
    /// Shown b, a: chose a.
    pub ba_a: f64,
}

impl Stratum {
    fn of(counts: &OrderCounts) -> Self {
        Self {
            ab_b: f64::from(counts.ab_second),
            ab_a: f64::from(counts.ab_first),
            ba_b: f64::from(counts.ba_first),
            ba_a: f64::from(counts.ba_second),
        }
    }

    fn n(&self) -> f64 {
        self.ab_b + self.ab_a + self.ba_b + self.ba_a
    }

    /// Answers shown a, b; choices of b.
    fn margins(&self) -> (f64, f64) {
        (self.ab_b + self.ab_a, self.ab_b + self.ba_b)
    }

    /// Whether both orders were shown and both techniques chosen: else it cannot tell.
    fn tells(&self) -> bool {
        let (shown_ab, chose_b) = self.margins();
        shown_ab > 0.0 && shown_ab < self.n() && chose_b > 0.0 && chose_b < self.n()
    }

    /// The number expected to see a, b and choose b under a common odds ratio, and its variance
    /// (Breslow & Day 1980, section 4.4). All four cells of the solution are positive.
    fn expected(&self, ratio: f64) -> (f64, f64) {
        let (row, column) = self.margins();
        let rest = self.n() - row - column;
        // (1 − ψ) x² + (n − r − c + ψ (r + c)) x − ψ r c = 0; of two forms of the root, the one
        // that does not cancel.
        let square = 1.0 - ratio;
        let linear = rest + ratio * (row + column);
        let root = (linear * linear + 4.0 * square * ratio * row * column)
            .max(0.0)
            .sqrt();
        let x = if linear >= 0.0 {
            2.0 * ratio * row * column / (linear + root)
        } else {
            (root - linear) / (2.0 * square)
        };
        let inverse = 1.0 / x + 1.0 / (row - x) + 1.0 / (column - x) + 1.0 / (rest + x);
        (x, 1.0 / inverse)
    }
}

/// χ² of Cochran, Mantel and Haenszel, without continuity correction.
///
/// # Errors
/// Where no condition was shown in both orders and chosen both ways.
pub fn chi_square(strata: &[Stratum]) -> Result<f64, Undefined> {
    let (mut excess, mut variance) = (0.0, 0.0);
    for stratum in strata.iter().filter(|stratum| stratum.tells()) {
        let ((row, column), n) = (stratum.margins(), stratum.n());
        excess += stratum.ab_b - row * column / n;
        variance += row * (n - row) / n * (column * (n - column)) / (n * (n - 1.0));
    }
    if variance > 0.0 {
        Ok(excess * excess / variance)
    } else {
        Err(NO_STRATUM)
    }
}

/// Mantel and Haenszel's common odds ratio, with the variance of its logarithm by Robins, Breslow
/// and Greenland (1986).
///
/// # Errors
/// Without a stratum that tells, or where one diagonal of all tables is empty.
pub fn common_odds_ratio(strata: &[Stratum]) -> Result<(f64, f64), Undefined> {
    let (mut r, mut s, mut pr, mut mixed, mut qs) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for stratum in strata.iter().filter(|stratum| stratum.tells()) {
        let n = stratum.n();
        let (same, other) = (
            stratum.ab_b * stratum.ba_a / n,
            stratum.ab_a * stratum.ba_b / n,
        );
        let (p, q) = (
            (stratum.ab_b + stratum.ba_a) / n,
            (stratum.ab_a + stratum.ba_b) / n,
        );
        r += same;
        s += other;
        pr += p * same;
        mixed += p * other + q * same;
        qs += q * other;
    }
    if r == 0.0 && s == 0.0 {
        return Err(NO_STRATUM);
    }
    if r == 0.0 || s == 0.0 {
        return Err(NO_FINITE_RATIO);
    }
    let variance = pr / (2.0 * r * r) + mixed / (2.0 * r * s) + qs / (2.0 * s * s);
    Ok((r / s, variance))
}

fn interval(ratio: f64, variance: f64, alpha: Alpha) -> Result<Interval, Undefined> {
    let half = normal_critical(alpha) * variance.sqrt();
    let (low, high) = ((ratio.ln() - half).exp(), (ratio.ln() + half).exp());
    if high.is_finite() {
        Ok(Interval { low, high })
    } else {
        Err(NO_FINITE_RATIO)
    }
}

/// Breslow and Day's χ² with Tarone's correction, and its degrees of freedom.
///
/// # Errors
/// Under two strata that tell, or without a common odds ratio.
pub fn homogeneity(strata: &[Stratum]) -> Result<(f64, u32), Undefined> {
    let (ratio, _) = common_odds_ratio(strata)?;
    let told: Vec<&Stratum> = strata.iter().filter(|stratum| stratum.tells()).collect();
    if told.len() < 2 {
        return Err(ONE_STRATUM);
    }
    let (mut sum, mut excess, mut variance) = (0.0, 0.0, 0.0);
    for stratum in &told {
        let (x, v) = stratum.expected(ratio);
        let difference = stratum.ab_b - x;
        sum += difference * difference / v;
        excess += difference;
        variance += v;
    }
    let corrected = (sum - excess * excess / variance).max(0.0);
    if corrected.is_finite() {
        Ok((corrected, u32::try_from(told.len() - 1).unwrap_or(u32::MAX)))
    } else {
        Err(NO_FINITE_RATIO)
    }
}

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    let strata = strata(data);
    if strata.is_empty() {
        return None;
    }
    let tables: Vec<Stratum> = strata.iter().map(|(_, stratum)| *stratum).collect();
    let result = Outcome::of(&tables, settings.alpha);
    let status = match (result.chi_square, result.ratio) {
        (Err(why), _) | (Ok(_), Err(why)) => why.status,
        _ => Status::Ok,
    };
    Some(Section {
        id: "order_effect",
        title: "Choice by order shown",
        status,
        findings: result.findings(&strata, settings.alpha),
        tables: vec![
            SectionTable {
                id: "test",
                caption: "Cochran–Mantel–Haenszel over all conditions; odds ratio of choosing b shown second against first: above 1, the second image is favoured",
                long: false,
                table: result.table(&tables),
            },
            SectionTable {
                id: "by_condition",
                caption: "Choice by order shown, and the odds ratio of each condition",
                long: false,
                table: by_condition(&strata),
            },
        ],
    })
}

/// Conditions whose orders are known and that were answered.
fn strata(data: &Dataset) -> Vec<(&str, Stratum)> {
    (data.conditions.iter())
        .filter_map(|condition| {
            let stratum = Stratum::of(condition.orders.as_ref()?);
            (stratum.n() > 0.0).then_some((condition.id.as_str(), stratum))
        })
        .collect()
}

/// What the three methods say.
struct Outcome {
    chi_square: Result<f64, Undefined>,
    p: Result<Probability, Undefined>,
    ratio: Result<f64, Undefined>,
    interval: Result<Interval, Undefined>,
    homogeneity: Result<(f64, u32), Undefined>,
}

impl Outcome {
    fn of(strata: &[Stratum], alpha: Alpha) -> Self {
        let chi_square = chi_square(strata);
        let ratio = common_odds_ratio(strata);
        Self {
            chi_square,
            p: chi_square.map(|x| chi_square_upper(x, 1)),
            ratio: ratio.map(|(ratio, _)| ratio),
            interval: ratio.and_then(|(ratio, variance)| interval(ratio, variance, alpha)),
            homogeneity: homogeneity(strata),
        }
    }

    fn p_homogeneity(&self) -> Result<Probability, Undefined> {
        self.homogeneity.map(|(x, df)| chi_square_upper(x, df))
    }

    fn findings(&self, strata: &[(&str, Stratum)], alpha: Alpha) -> Vec<String> {
        let mut findings = Vec::new();
        match (self.chi_square, self.p) {
            (Ok(x), Ok(p)) => findings.push(format!(
                "Whether b was chosen {} on whether it was shown first or second (Cochran–Mantel–Haenszel χ²(1) = {x:.3}, p {}, no continuity correction, stratified by condition): {}.",
                if p.at_most(alpha) { "depends" } else { "does not detectably depend" },
                p_text(p),
                "this is position bias with each condition's preference taken out",
            )),
            (Err(why), _) | (_, Err(why)) => {
                findings.push(format!("The order effect cannot be tested: {}.", why.reason));
            }
        }
        if let (Ok(ratio), Ok(interval)) = (self.ratio, self.interval) {
            findings.push(format!(
                "The odds of choosing an image are {ratio:.2} times as high when it is shown second ({}\u{a0}% interval {:.2} to {:.2}).",
                alpha.confidence_percent(),
                interval.low,
                interval.high,
            ));
        } else if let (Ok(_), Err(why)) = (self.chi_square, self.ratio) {
            findings.push(format!("There is no odds ratio: {}.", why.reason));
        }
        if let (Ok((x, df)), Ok(p)) = (self.homogeneity, self.p_homogeneity()) {
            findings.push(format!(
                "The odds ratios of the conditions {} (Breslow–Day χ²({df}) = {x:.3}, Tarone's correction, p {}).",
                if p.at_most(alpha) { "differ: the common one is an average of unlike effects" } else { "do not detectably differ" },
                p_text(p),
            ));
        }
        let silent: Vec<&str> = (strata.iter())
            .filter(|(_, stratum)| !stratum.tells())
            .map(|(id, _)| *id)
            .collect();
        if !silent.is_empty() && silent.len() < strata.len() {
            findings.push(format!(
                "{} shown in one order only or chosen one way only and cannot tell: {}.",
                plural(silent.len(), "condition")
                    + if silent.len() == 1 { " was" } else { " were" },
                listed(&silent),
            ));
        }
        findings
    }

    fn table(&self, strata: &[Stratum]) -> Table {
        let told = strata.iter().filter(|stratum| stratum.tells()).count();
        let tests = |key, title, style| Column::new(key, title, style, Group::Tests);
        Table {
            columns: vec![
                tests("strata", "conditions", Style::Count),
                tests("chi_square", "χ²", Style::UpTo(6)),
                tests("df", "df", Style::Count),
                tests("p_chi_square", "p", Style::P),
                tests("odds_ratio", "odds ratio", Style::Decimals(3)),
                tests("odds_ratio_ci", "interval", Style::Interval(3)),
                tests("homogeneity_chi_square", "homogeneity χ²", Style::UpTo(6)),
                tests("homogeneity_df", "df", Style::Count),
                tests("p_homogeneity", "p", Style::P),
            ],
            rows: vec![vec![
                Cell::Count(u32::try_from(told).unwrap_or(u32::MAX)),
                Cell::or_undefined(self.chi_square, Cell::Number),
                Cell::Count(1),
                Cell::or_undefined(self.p, Cell::Probability),
                Cell::or_undefined(self.ratio, Cell::Number),
                Cell::or_undefined(self.interval, Cell::Interval),
                Cell::or_undefined(self.homogeneity, |(x, _)| Cell::Number(x)),
                Cell::or_undefined(self.homogeneity, |(_, df)| Cell::Count(df)),
                Cell::or_undefined(self.p_homogeneity(), Cell::Probability),
            ]],
        }
    }
}

fn by_condition(strata: &[(&str, Stratum)]) -> Table {
    let counts = |key, title| Column::new(key, title, Style::Count, Group::Position);
    Table {
        columns: vec![
            Column::new("condition", "condition", Style::Text, Group::Key),
            counts("ab_chose_b", "a, b: chose b"),
            counts("ab_chose_a", "chose a"),
            counts("ba_chose_b", "b, a: chose b"),
            counts("ba_chose_a", "chose a"),
            Column::new(
                "odds_ratio",
                "odds ratio",
                Style::Decimals(3),
                Group::Position,
            ),
        ],
        rows: (strata.iter())
            .map(|(id, stratum)| {
                let Stratum {
                    ab_b,
                    ab_a,
                    ba_b,
                    ba_a,
                } = *stratum;
                let ratio = ab_b / ab_a * (ba_a / ba_b);
                let ratio = if ratio.is_finite() && ratio > 0.0 {
                    Cell::Number(ratio)
                } else {
                    Cell::Undefined(NO_CONDITION_RATIO)
                };
                let count = |x: f64| Cell::Count(x as u32);
                vec![
                    Cell::Text((*id).to_owned()),
                    count(ab_b),
                    count(ab_a),
                    count(ba_b),
                    count(ba_a),
                    ratio,
                ]
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests;
