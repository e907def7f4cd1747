//! Are the printed numbers those of the votes?

use super::{Check, Verdict};
use crate::analysis::conclusion::p_text;
use crate::analysis::dataset::{ConditionData, Dataset, Votes};
use crate::analysis::exact_binomial::exact_p;
use crate::analysis::table::Undefined;
use crate::analysis::tails::{Alpha, Probability, chi_square_upper};

/// More wrong numbers than these are counted, not listed.
const MOST: usize = 200;

const NOTHING: Undefined = Undefined::not_available("the input has no published numbers");
const UNREADABLE: Undefined = Undefined::not_available("what is printed is no number");

/// Every number that is printed and wrong, and how many are right.
pub fn checks(data: &Dataset, alpha: Alpha) -> Vec<Check> {
    let mut all: Vec<Check> = Vec::new();
    let mut printed = 0;
    for condition in &data.conditions {
        let numbers = [&condition.published.chi_square, &condition.published.p];
        printed += numbers.iter().filter(|number| number.is_some()).count();
        let checks = [
            (numbers[0].as_deref()).and_then(|text| chi_square(condition, text, alpha)),
            (numbers[1].as_deref()).and_then(|text| p(condition, text, alpha)),
        ];
        all.extend(
            checks
                .into_iter()
                .flatten()
                .map(|check| check.of(&condition.id)),
        );
    }
    if printed == 0 {
        return vec![Check::undefined("published numbers", NOTHING)];
    }
    let summary = Check::new(
        "published numbers",
        Verdict::Ok,
        format!(
            "{} of {printed} are the recomputed ones, rounded",
            printed - all.len()
        ),
    );
    all.truncate(MOST);
    all.insert(0, summary);
    all
}

/// A number as it was printed: `mantissa` · 10^−`decimals`, or less than that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Printed {
    mantissa: i128,
    decimals: i32,
    below: bool,
}

impl Printed {
    /// `5.445`, `.019`, `< 0.001`, `2.1e-7`; at most 18 digits.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let (below, text) = match text.strip_prefix('<') {
            Some(rest) => (true, rest.trim_start()),
            None => (false, text),
        };
        let (number, exponent) = match text.split_once(['e', 'E']) {
            Some((number, exponent)) => (number, exponent.parse().ok()?),
            None => (text, 0_i32),
        };
        let (whole, decimals) = number.split_once('.').unwrap_or((number, ""));
        let digits = format!("{whole}{decimals}");
        let sound = (1..=18).contains(&digits.len()) && digits.bytes().all(|b| b.is_ascii_digit());
        (sound && exponent.abs() <= 300).then_some(Self {
            mantissa: digits.parse().ok()?,
            decimals: i32::try_from(decimals.len()).ok()? - exponent,
            below,
        })
    }

    fn value(&self) -> f64 {
        self.mantissa as f64 / 10_f64.powi(self.decimals)
    }

    /// Whether `exact`, rounded to as many decimals, is this; on a tie either neighbour is.
    fn is(&self, exact: f64) -> bool {
        if self.below {
            return exact < self.value();
        }
        // The recomputed number has 12 digits: within those a tie is a tie.
        let half = 0.5 * 10_f64.powi(-self.decimals);
        (self.value() - exact).abs() <= half + 1e-12 * exact.abs()
    }

    /// The same for a fraction, in whole numbers.
    pub fn is_fraction(&self, numerator: i128, denominator: i128) -> bool {
        if self.below || !(0..=15).contains(&self.decimals) {
            return self.is(numerator as f64 / denominator as f64);
        }
        let unit = 10_i128.pow(self.decimals.unsigned_abs());
        // At most 2 · (10^18 · 2^31 + 10^18 · 10^15): far inside 127 bits.
        2 * (self.mantissa * denominator - numerator * unit).abs() <= denominator
    }

    /// `exact` with as many decimals.
    fn rounded(&self, exact: f64) -> String {
        format!(
            "{exact:.*}",
            self.decimals.clamp(0, 15).unsigned_abs() as usize
        )
    }

    fn text(&self, as_printed: &str) -> String {
        format!("printed {}", as_printed.trim())
    }
}

/// Numerator and denominator of χ², without and with Yates' continuity correction.
fn fractions(votes: Votes) -> [(i128, i128); 2] {
    let difference = i128::from(votes.a.abs_diff(votes.b));
    let n = i128::from(votes.total());
    [(difference.pow(2), n), ((difference - 1).max(0).pow(2), n)]
}

fn value((numerator, denominator): (i128, i128)) -> f64 {
    numerator as f64 / denominator as f64
}

/// `None` where the printed statistic is right.
fn chi_square(condition: &ConditionData, text: &str, alpha: Alpha) -> Option<Check> {
    const CHECK: &str = "published χ²";
    let Some(printed) = Printed::parse(text) else {
        return Some(Check::undefined(CHECK, UNREADABLE));
    };
    if condition.votes.total() == 0 {
        return Some(Check::undefined(CHECK, Undefined::NO_VOTES));
    }
    let [plain, yates] = fractions(condition.votes);
    if printed.is_fraction(plain.0, plain.1) {
        return None;
    }
    let exact = value(plain);
    let shown = printed.text(text);
    if printed.is_fraction(yates.0, yates.1) {
        return Some(Check::new(
            CHECK,
            Verdict::Note,
            format!("{shown} has Yates' continuity correction; without it χ² is {exact:.6}"),
        ));
    }
    let (before, after) = (
        chi_square_upper(printed.value(), 1),
        chi_square_upper(exact, 1),
    );
    Some(Check::new(
        CHECK,
        Verdict::Fault,
        format!(
            "{shown}, exact {exact:.6}, which rounds to {}; {}",
            printed.rounded(exact),
            decision(before.at_most(alpha), after.at_most(alpha), alpha),
        ),
    ))
}

/// `None` where the printed p is right.
fn p(condition: &ConditionData, text: &str, alpha: Alpha) -> Option<Check> {
    const CHECK: &str = "published p";
    let Some(printed) = Printed::parse(text) else {
        return Some(Check::undefined(CHECK, UNREADABLE));
    };
    let Ok(exact_test) = exact_p(condition.votes) else {
        return Some(Check::undefined(CHECK, Undefined::NO_VOTES));
    };
    let [plain, yates] = fractions(condition.votes).map(|x| chi_square_upper(value(x), 1));
    if printed.is(plain.value()) {
        return None;
    }
    let shown = printed.text(text);
    for (other, what) in [
        (exact_test, "is that of the exact binomial test"),
        (yates, "is that of χ² with Yates' continuity correction"),
    ] {
        if printed.is(other.value()) {
            return Some(Check::new(
                CHECK,
                Verdict::Note,
                format!("{shown} {what}; the chi-square test's is {}", digits(plain)),
            ));
        }
    }
    let before = printed.value() <= alpha.get();
    Some(Check::new(
        CHECK,
        Verdict::Fault,
        format!(
            "{shown}, exact {}, which rounds to {}; {}",
            digits(plain),
            printed.rounded(plain.value()),
            decision(before, plain.at_most(alpha), alpha),
        ),
    ))
}

/// More digits than were printed.
fn digits(p: Probability) -> String {
    if p.value() >= 1e-6 {
        format!("{:.6}", p.value())
    } else {
        p_text(p)
    }
}

fn decision(before: bool, after: bool, alpha: Alpha) -> String {
    let alpha = alpha.get();
    match (before, after) {
        (true, false) => format!("at alpha = {alpha} the decision changes: it is not significant"),
        (false, true) => format!("at alpha = {alpha} the decision changes: it is significant"),
        _ => format!("the decision at alpha = {alpha} stays the same"),
    }
}

/// Whether a condition was published as significant at alpha; `None` where no p is printed.
pub(super) fn significant(condition: &ConditionData, alpha: Alpha) -> Option<bool> {
    let printed = Printed::parse(condition.published.p.as_deref()?)?;
    Some(printed.value() <= alpha.get())
}
