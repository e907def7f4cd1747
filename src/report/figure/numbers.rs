//! Numbers as people read them.

/// What stands for a missing value.
pub const MISSING: &str = "–";

/// With so many significant digits, no power of ten between a millionth and a billion, no sign
/// on nothing.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return MISSING.to_owned();
    }
    if value == 0.0 {
        return String::from("0");
    }
    let magnitude = value.abs().log10().floor();
    if !(-6.0..9.0).contains(&magnitude) {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    let decimals = (digits as f64 - 1.0 - magnitude).max(0.0) as usize;
    format!("{value:.decimals$}")
}

/// A time, milliseconds.
pub fn ms(value: f64) -> String {
    significant(value, 3)
}

/// Fixed decimals, no sign on nothing.
pub fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return MISSING.to_owned();
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        _ => text,
    }
}

/// A number that may be missing.
pub fn or_missing(value: Option<f64>, shown: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| MISSING.to_owned(), shown)
}

/// A tick of an axis: as short as the number is.
pub fn tick(value: f64) -> String {
    let large = [(1e9, "G"), (1e6, "M"), (1e4, "k")];
    for (from, letter) in large {
        let unit: f64 = if letter == "k" { 1e3 } else { from };
        if value.abs() >= from && value.abs() < 1e12 {
            return format!("{}{letter}", trimmed(&format!("{:.3}", value / unit)));
        }
    }
    if value != 0.0 && !(1e-6..1e12).contains(&value.abs()) {
        return format!("{value:.0e}");
    }
    trimmed(&format!("{value:.7}")).to_owned()
}

fn trimmed(number: &str) -> &str {
    match number.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0",
        number => number,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_count() {
        let shown: Vec<String> = [0.0123456, 1.23456, 123.456, 12345.6, 0.0].map(ms).into();
        assert_eq!(shown, ["0.0123", "1.23", "123", "12346", "0"]);
        assert_eq!(fixed(-0.0001, 2), "0.00");
        assert_eq!(ms(f64::NAN), MISSING);
    }

    #[test]
    fn ticks_are_short() {
        let ticks = [0.05, 1.0, 500.0, 20_000.0, 1e6, 0.000_02].map(tick);
        assert_eq!(ticks, ["0.05", "1", "500", "20k", "1M", "0.00002"]);
    }
}
