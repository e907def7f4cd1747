//! Numbers as people read them, and columns of them aligned on the decimal point.

use unicode_width::UnicodeWidthStr;

use crate::analysis::table::{Cell, Style, Table};
use crate::analysis::tails::Probability;

/// What stands for a missing value.
pub const MISSING: &str = "–";

/// A cell for a person.
pub fn shown(cell: &Cell, style: Style) -> String {
    match cell {
        Cell::Text(text) => one_line(text),
        Cell::Count(count) => count.to_string(),
        Cell::Number(number) => fixed(*number, style),
        Cell::Probability(p) => p_value(*p),
        Cell::Interval(interval) => format!(
            "[{}, {}]",
            fixed(interval.low, style),
            fixed(interval.high, style)
        ),
        Cell::Undefined(_) => MISSING.to_owned(),
    }
}

/// Why values are missing, each reason once.
pub fn reasons(table: &Table) -> Vec<&'static str> {
    let mut reasons: Vec<&'static str> = Vec::new();
    for cell in table.rows.iter().flatten() {
        if let Cell::Undefined(why) = cell
            && !reasons.contains(&why.reason)
        {
            reasons.push(why.reason);
        }
    }
    reasons
}

/// Six decimals, a whole number without any; under 1e-6 two digits and the power of ten, also where a
/// double would be 0.
pub fn p_value(p: Probability) -> String {
    if p.value() >= 1e-6 {
        return trimmed(format!("{:.6}", p.value()));
    }
    scientific(p, 1)
}

/// Digits and power of ten of a probability, however small; for the impossible event 0.
pub fn scientific(p: Probability, digits: usize) -> String {
    let log10 = p.log10();
    if log10 == f64::NEG_INFINITY {
        return "0".to_owned();
    }
    let exponent = log10.floor();
    let mantissa = format!("{:.digits$}", 10_f64.powf(log10 - exponent));
    // 9.96 rounds to 10.0: that is 1.0 of the next power.
    if mantissa.starts_with("10") {
        format!("{:.digits$}e{}", 1.0, exponent + 1.0)
    } else {
        format!("{mantissa}e{exponent}")
    }
}

fn fixed(number: f64, style: Style) -> String {
    let text = match style {
        Style::UpTo(digits) => trimmed(format!("{number:.digits$}")),
        Style::Decimals(digits) | Style::Interval(digits) => format!("{number:.digits$}"),
        Style::P | Style::Count | Style::Text | Style::Code => number.to_string(),
    };
    // −0.000 is 0.000.
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        _ => text,
    }
}

/// 1.000000 as 1. Other zeros at the end are digits that were computed, and stay.
fn trimmed(number: String) -> String {
    match number.split_once('.') {
        Some((whole, decimals)) if decimals.chars().all(|c| c == '0') => whole.to_owned(),
        _ => number,
    }
}

/// Control characters would break a table or a terminal.
fn one_line(text: &str) -> String {
    text.chars()
        .flat_map(|c| {
            let escaped: Vec<char> = if c.is_control() {
                c.escape_default().collect()
            } else {
                vec![c]
            };
            escaped
        })
        .collect()
}

/// Pads the cells of a column behind the last digit so that decimal points stand under each other
/// once the column is aligned to the right. `digit` and `point` are the spaces as wide as those.
pub fn align_decimals(cells: &mut [String], digit: char, point: char) {
    let behind = |cell: &str| cell.find('.').map(|at| cell.len() - at - 1);
    let widest = cells
        .iter()
        .filter(|cell| *cell != MISSING)
        .filter_map(|cell| behind(cell))
        .max();
    let Some(widest) = widest else {
        return;
    };
    for cell in cells.iter_mut().filter(|cell| *cell != MISSING) {
        let missing = match behind(cell) {
            Some(digits) => widest - digits,
            None => {
                cell.push(point);
                widest
            }
        };
        cell.extend(std::iter::repeat_n(digit, missing));
    }
}

/// Columns a terminal needs for a text.
pub fn width(text: &str) -> usize {
    text.width()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p_values_from_one_to_underflow() {
        let p = |log10: f64| p_value(Probability::from_ln(log10 * std::f64::consts::LN_10));
        assert_eq!(p(0.0), "1");
        assert_eq!(p(0.5_f64.log10()), "0.500000");
        assert_eq!(p(0.019_630_657_f64.log10()), "0.019631");
        assert_eq!(p(-6.0 + 1e-9), "0.000001");
        assert_eq!(p(2.34e-9_f64.log10()), "2.3e-9");
        assert_eq!(p(9.96e-9_f64.log10()), "1.0e-8");
        assert_eq!(p(-1234.5), "3.2e-1235");
        assert_eq!(p(f64::NEG_INFINITY), "0");
    }

    #[test]
    fn a_negative_zero_has_no_sign() {
        assert_eq!(fixed(-0.0001, Style::Decimals(3)), "0.000");
        assert_eq!(fixed(-0.0, Style::UpTo(6)), "0");
        assert_eq!(fixed(-0.1, Style::Decimals(3)), "-0.100");
    }

    #[test]
    fn decimal_points_stand_under_each_other() {
        let mut cells: Vec<String> = ["1", "0.019631", "0.5", MISSING].map(str::to_owned).into();
        align_decimals(&mut cells, ' ', ' ');
        assert_eq!(cells, ["1       ", "0.019631", "0.5     ", MISSING]);
    }

    #[test]
    fn control_characters_are_made_visible() {
        let cell = Cell::Text("a\nb\u{1b}[31m é".to_owned());
        assert_eq!(shown(&cell, Style::Text), "a\\nb\\u{1b}[31m é");
    }
}
