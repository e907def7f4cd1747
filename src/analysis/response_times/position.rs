//! Does choosing the first image take longer than choosing the second?

use super::summary::Moments;
use super::{NO_SPREAD, ONE_PARTICIPANT, count, geometric_interval, time};
use crate::analysis::dataset::Dataset;
use crate::analysis::table::{Cell, Column, Group, Interval, Style, Table, Undefined};
use crate::analysis::tails::{Alpha, Probability, student_t_upper};

/// Student's t of each participant's mean ln t choosing first, minus choosing second.
pub struct PositionTest {
    /// The participants' means: choosing first, choosing second.
    pub of_position: [Moments; 2],
    pub differences: Moments,
    pub t: Result<f64, Undefined>,
    pub p: Result<Probability, Undefined>,
    /// Of the time choosing first by that choosing second.
    pub ratio_interval: Result<Interval, Undefined>,
}

impl PositionTest {
    pub fn of(data: &Dataset, alpha: Alpha) -> Self {
        let participants = data.answers.iter().map(|a| a.participant).max();
        let participants = participants.map_or(0, |last| last as usize + 1);
        let mut own = vec![[(0_u32, 0.0_f64); 2]; participants];
        for answer in &data.answers {
            if let (Some(time), Some(position)) = (time(answer), answer.chosen) {
                let (n, sum) = &mut own[answer.participant as usize][position.place()];
                *n += 1;
                *sum += f64::from(time).ln();
            }
        }
        let mean = |(n, sum): (u32, f64)| (n > 0).then(|| sum / f64::from(n));
        let of_position = [0, 1].map(|at| own.iter().filter_map(|own| mean(own[at])).collect());
        let differences: Moments = (own.iter())
            .filter_map(|own| Some(mean(own[0])? - mean(own[1])?))
            .collect();
        let t = match differences.standard_error() {
            None => Err(ONE_PARTICIPANT),
            Some(error) if error > 0.0 => Ok(differences.mean() / error),
            Some(_) => Err(NO_SPREAD),
        };
        Self {
            of_position,
            differences,
            t,
            p: t.map(|t| student_t_upper(t.abs(), differences.n() - 1.0).times(2.0)),
            ratio_interval: geometric_interval(&differences, alpha, ONE_PARTICIPANT),
        }
    }

    pub fn table(&self) -> Table {
        let n = self.differences.n();
        let ratio = if n < 1.0 {
            Err(ONE_PARTICIPANT)
        } else {
            Ok(self.differences.mean().exp())
        };
        let tests = |key, title, style| Column::new(key, title, style, Group::Tests);
        Table {
            columns: vec![
                tests("participants", "participants", Style::Count),
                tests("ratio", "ratio", Style::Decimals(3)),
                tests("ratio_ci", "interval", Style::Interval(3)),
                tests("t", "t", Style::Decimals(3)),
                tests("df", "df", Style::Count),
                tests("p_t", "p", Style::P),
            ],
            rows: vec![vec![
                count(n as usize),
                Cell::or_undefined(ratio, Cell::Number),
                Cell::or_undefined(self.ratio_interval, Cell::Interval),
                Cell::or_undefined(self.t, Cell::Number),
                Cell::or_undefined(self.t, |_| count(n as usize - 1)),
                Cell::or_undefined(self.p, Cell::Probability),
            ]],
        }
    }
}
