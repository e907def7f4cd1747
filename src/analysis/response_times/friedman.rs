//! Friedman's test of response times between conditions, participants as blocks: ranks within
//! participants, so that it asks for neither equal variances nor sphericity.

use super::{ALL_TIED, FEW_COMPLETE, FEW_CONDITIONS, time};
use crate::analysis::dataset::Dataset;
use crate::analysis::table::Undefined;

/// The test of participants who have a time in every condition that has any.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friedman {
    /// How many such participants.
    pub participants: usize,
    /// How many conditions.
    pub conditions: usize,
    /// The statistic, corrected for ties.
    pub chi_square: f64,
}

impl Friedman {
    /// # Errors
    /// Under two conditions or two such participants, or where everything ties.
    pub fn of(data: &Dataset) -> Result<Self, Undefined> {
        let (mut rows, conditions) = complete_rows(data)?;
        let participants = rows.len() / conditions;
        if participants < 2 {
            return Err(FEW_COMPLETE);
        }
        // Ranks are doubled so that the mean rank of a tie is whole.
        let mut sums = vec![0_i128; conditions];
        let mut squares = 0_i128;
        let mut ranks = vec![0_i128; conditions];
        let mut order: Vec<usize> = Vec::with_capacity(conditions);
        for row in rows.chunks_exact_mut(conditions) {
            doubled_ranks(row, &mut order, &mut ranks);
            for (sum, rank) in sums.iter_mut().zip(&ranks) {
                *sum += rank;
                squares += rank * rank;
            }
        }
        let (n, k) = (participants as i128, conditions as i128);
        // Twice n (k + 1)/2, and k n ((k + 1)/2)² of doubled ranks.
        let between: i128 = sums.iter().map(|sum| (sum - n * (k + 1)).pow(2)).sum();
        let within = squares - n * k * (k + 1).pow(2);
        if within == 0 {
            return Err(ALL_TIED);
        }
        Ok(Self {
            participants,
            conditions,
            chi_square: (k - 1) as f64 * between as f64 / within as f64,
        })
    }

    /// Degrees of freedom.
    pub fn df(&self) -> u32 {
        u32::try_from(self.conditions - 1).unwrap_or(u32::MAX)
    }

    /// Kendall's coefficient of concordance, 0 to 1.
    pub fn kendall_w(&self) -> f64 {
        self.chi_square / (self.participants as f64 * (self.conditions - 1) as f64)
    }
}

/// Times of the participants who have one in every condition that has any, a row each, and the
/// length of a row. No larger than the answers, however few participants saw everything.
fn complete_rows(data: &Dataset) -> Result<(Vec<f32>, usize), Undefined> {
    let timed = || {
        data.answers
            .iter()
            .filter_map(|a| time(a).map(|time| (a, time)))
    };
    let mut column = vec![None; data.conditions.len()];
    let mut conditions = 0;
    for (answer, _) in timed() {
        if column[answer.condition as usize].is_none() {
            column[answer.condition as usize] = Some(conditions);
            conditions += 1;
        }
    }
    if conditions < 2 {
        return Err(FEW_CONDITIONS);
    }
    let participants = data.answers.iter().map(|a| a.participant).max();
    let mut answered = vec![0_usize; participants.map_or(0, |last| last as usize + 1)];
    timed().for_each(|(answer, _)| answered[answer.participant as usize] += 1);
    // From number of answers to number of row.
    let mut rows = 0;
    for answered in &mut answered {
        *answered = if *answered == conditions {
            rows += 1;
            rows - 1
        } else {
            usize::MAX
        };
    }
    let mut times = vec![0.0; rows * conditions];
    for (answer, time) in timed() {
        let row = answered[answer.participant as usize];
        if let (Some(column), true) = (column[answer.condition as usize], row != usize::MAX) {
            times[row * conditions + column] = time;
        }
    }
    Ok((times, conditions))
}

/// Twice the ranks of a row, 1 the shortest, ties at their mean.
fn doubled_ranks(row: &[f32], order: &mut Vec<usize>, ranks: &mut [i128]) {
    order.clear();
    order.extend(0..row.len());
    order.sort_unstable_by(|i, j| row[*i].total_cmp(&row[*j]));
    let mut from = 0;
    while from < order.len() {
        let tied = (order[from..].iter())
            .take_while(|i| row[**i] == row[order[from]])
            .count();
        for i in &order[from..from + tied] {
            // Ranks from + 1 to from + tied.
            ranks[*i] = (2 * from + tied + 1) as i128;
        }
        from += tied;
    }
}
