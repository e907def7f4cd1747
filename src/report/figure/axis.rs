//! Scales: values to places on the drawing, and their ticks.

use super::numbers::tick;

/// How values are spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spread {
    /// Equal steps are equally long.
    Linear,
    /// Equal ratios are equally long.
    Log,
}

/// Values from one end to the other, and where the ends lie on the drawing.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    spread: Spread,
    low: f64,
    high: f64,
    /// Place of the low end.
    pub start: f64,
    /// Place of the high end.
    pub end: f64,
}

/// A line of the grid.
pub struct Tick {
    /// Where.
    pub at: f64,
    /// What it says; nothing for a line between.
    pub label: Option<String>,
}

/// Smallest and largest positive numbers that a logarithmic axis shows.
const LOG_ENDS: (f64, f64) = (1e-9, 1e12);

impl Scale {
    /// Ratios; values without a logarithm are left out. Spans `ratio` at least.
    pub fn log(values: impl Iterator<Item = f64>, ratio: f64, (start, end): (f64, f64)) -> Self {
        let usable = values.filter(|value| *value > 0.0 && value.is_finite());
        let usable = usable.map(|value| value.clamp(LOG_ENDS.0, LOG_ENDS.1));
        let (low, high) = ends(usable).unwrap_or((1.0, 10.0));
        let missing = (ratio / (high / low)).max(1.0).sqrt();
        Self {
            spread: Spread::Log,
            low: low / missing,
            high: high * missing,
            start,
            end,
        }
    }

    /// Steps, from the smallest to the largest value.
    pub fn linear(values: impl Iterator<Item = f64>, (start, end): (f64, f64)) -> Self {
        let usable = values.filter(|value| value.is_finite());
        let (low, high) = ends(usable.map(|value| value.clamp(-1e12, 1e12))).unwrap_or((0.0, 1.0));
        let (low, high) = match high - low > 1e-9 * high.abs().max(1e-9) {
            true => (low, high),
            false => (low - 0.05, high + 0.05),
        };
        Self {
            spread: Spread::Linear,
            low,
            high,
            start,
            end,
        }
    }

    /// Exactly these ends.
    pub fn exactly(low: f64, high: f64, (start, end): (f64, f64)) -> Self {
        Self {
            spread: Spread::Linear,
            low,
            high,
            start,
            end,
        }
    }

    /// The same values elsewhere on the drawing.
    pub fn between(self, start: f64, end: f64) -> Self {
        Self { start, end, ..self }
    }

    /// A wider scale with room before the low and behind the high end, as parts of its length.
    pub fn padded(self, before: f64, behind: f64) -> Self {
        let (low, high) = (self.unit(self.low), self.unit(self.high));
        let long = high - low;
        let (low, high) = (low - before * long, high + behind * long);
        let back = |unit: f64| match self.spread {
            Spread::Linear => unit,
            Spread::Log => unit.exp(),
        };
        Self {
            low: back(low),
            high: back(high),
            ..self
        }
    }

    /// Where a value lies; what lies outside is put at the end next to it.
    pub fn at(&self, value: f64) -> f64 {
        let part =
            (self.unit(value) - self.unit(self.low)) / (self.unit(self.high) - self.unit(self.low));
        // Nothing has no logarithm, and lies before every ratio.
        let part = if part.is_nan() { 0.0 } else { part };
        self.start + (self.end - self.start) * part.clamp(0.0, 1.0)
    }

    fn unit(&self, value: f64) -> f64 {
        match self.spread {
            Spread::Linear => value,
            Spread::Log => value.ln(),
        }
    }

    /// The lines of the grid within the ends.
    pub fn ticks(&self) -> Vec<Tick> {
        let found = match self.spread {
            Spread::Linear => self.linear_ticks(),
            Spread::Log => self.log_ticks(),
        };
        let slack = 1e-9 * (self.high - self.low);
        let is_within = |value: &f64| (self.low - slack..=self.high + slack).contains(value);
        (found.into_iter())
            .filter(|(value, _)| is_within(value))
            .map(|(value, is_labelled)| Tick {
                at: self.at(value),
                label: is_labelled.then(|| tick(value)),
            })
            .collect()
    }

    fn linear_ticks(&self) -> Vec<(f64, bool)> {
        let step = step_of(self.high - self.low);
        let first = (self.low / step).ceil() - 1.0;
        (0..14)
            .map(|k| ((first + f64::from(k)) * step, true))
            .collect()
    }

    /// Labels at 1, 2, 5 over few decades, at 1 over many; lines at all digits while they are
    /// not too many.
    fn log_ticks(&self) -> Vec<(f64, bool)> {
        let (first, last) = (self.low.log10().floor(), self.high.log10().ceil());
        let decades = (self.high / self.low).log10();
        let room = (self.end - self.start).abs() / decades.max(0.1);
        let every = (45.0 / room).ceil().max(1.0) as usize;
        let mut found = Vec::new();
        for exponent in ((first as i32)..=(last as i32)).step_by(every) {
            for digit in 1..10 {
                let is_labelled = match digit {
                    1 => true,
                    2 | 5 => room > 130.0,
                    3 | 7 => room > 350.0,
                    _ => false,
                };
                if is_labelled || (room > 60.0 && every == 1) {
                    let value = format!("{digit}e{exponent}").parse();
                    found.push((value.unwrap_or(f64::NAN), is_labelled));
                }
            }
        }
        found
    }
}

fn ends(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |ends, value| match ends {
        None => Some((value, value)),
        Some((low, high)) => Some((f64::min(low, value), f64::max(high, value))),
    })
}

/// A step of 1, 2 or 5 times a power of ten of which 4 to 10 make up a length.
fn step_of(length: f64) -> f64 {
    let raw = length / 5.0;
    let power = 10.0_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * power);
    step.into_iter()
        .find(|step| *step >= 0.8 * raw)
        .unwrap_or(raw)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: &Scale) -> Vec<String> {
        scale
            .ticks()
            .into_iter()
            .filter_map(|tick| tick.label)
            .collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        let log = Scale::log([1.0, 100.0].into_iter(), 4.0, (0.0, 600.0));
        assert_eq!(labels(&log), ["1", "2", "5", "10", "20", "50", "100"]);
        assert!((log.at(10.0) - 300.0).abs() < 1e-9 && log.at(0.0) == 0.0);
        let linear = Scale::linear([0.12, 0.208].into_iter(), (0.0, 100.0));
        assert_eq!(labels(&linear), ["0.12", "0.14", "0.16", "0.18", "0.2"]);
    }

    #[test]
    fn one_value_has_a_scale_too() {
        let log = Scale::log([5.0].into_iter(), 4.0, (0.0, 100.0));
        assert!((log.at(5.0) - 50.0).abs() < 1e-9);
        let linear = Scale::linear([0.3].into_iter(), (0.0, 100.0));
        assert!((0.0..=100.0).contains(&linear.at(0.3)));
        let none = Scale::log(std::iter::empty(), 4.0, (0.0, 100.0));
        assert!(none.at(f64::NAN).is_finite());
    }
}
