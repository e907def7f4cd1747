//! Values of several techniques by the same people, in blocks: what rank tests of ratings and of
//! rankings work on.

use std::cmp::Ordering;

/// One value of a technique, by number of participant, condition and technique.
#[derive(Debug, Clone, Copy)]
pub struct Value {
    /// Who.
    pub participant: u32,
    /// Of which condition.
    pub condition: u32,
    /// Of which technique.
    pub technique: u32,
    /// A rank or a rating.
    pub value: f64,
}

/// What a block is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// One participant in one condition.
    Participant,
    /// One participant in one of all conditions: several blocks a participant.
    ParticipantByCondition,
    /// The means of one participant over all conditions.
    ParticipantMeans,
}

impl Unit {
    /// In words.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Participant => "participants",
            Self::ParticipantByCondition => "participants × conditions",
            Self::ParticipantMeans => "participants, means over conditions",
        }
    }
}

/// Complete blocks: in each a value of every technique.
#[derive(Debug, Clone, PartialEq)]
pub struct Blocks {
    /// Number of the condition; `None` for all of them.
    pub condition: Option<usize>,
    /// What a block is.
    pub unit: Unit,
    /// Numbers of the techniques.
    pub techniques: Vec<usize>,
    /// Row by row, one value a technique.
    pub values: Vec<f64>,
    /// Blocks that lack a technique; they are not here.
    pub incomplete: u32,
}

impl Blocks {
    /// The blocks, one value a technique each.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.techniques.len().max(1))
    }

    /// How many blocks there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.values.len() / self.techniques.len().max(1)
    }

    /// Mean value of every technique; none where there is no block.
    #[must_use]
    pub fn means(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.techniques.len()];
        for row in self.rows() {
            for (sum, value) in sums.iter_mut().zip(row) {
                *sum += value;
            }
        }
        let count = self.count() as f64;
        let means = sums.into_iter().map(|sum| sum / count);
        means.filter(|mean| mean.is_finite()).collect()
    }

    /// The same blocks, the values of each replaced by twice their ranks in it: ties have the mean
    /// of their places, and twice that is a whole number.
    #[must_use]
    pub fn doubled_ranks(&self) -> Vec<u32> {
        let mut ranks = Vec::with_capacity(self.values.len());
        for row in self.rows() {
            ranks.extend(row.iter().map(|value| {
                let below = row.iter().filter(|other| *other < value).count();
                let equal = row.iter().filter(|other| *other == value).count();
                u32::try_from(2 * below + equal + 1).unwrap_or(u32::MAX)
            }));
        }
        ranks
    }

    /// Every pair of techniques, by place in [`techniques`](Self::techniques).
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let k = self.techniques.len();
        (0..k).flat_map(move |a| (a + 1..k).map(move |b| (a, b)))
    }
}

/// The blocks of every condition, then, where several conditions have two or more techniques in
/// common, those of all conditions: as they are, and as means of each participant. `values` are sorted
/// by participant, condition and technique.
#[must_use]
pub fn blocks(values: &[Value], conditions: usize, techniques: usize) -> Vec<Blocks> {
    let mut seen = vec![vec![false; techniques]; conditions];
    for value in values {
        seen[value.condition as usize][value.technique as usize] = true;
    }
    let of = |seen: &[bool]| -> Vec<usize> { (0..techniques).filter(|&t| seen[t]).collect() };
    let empty = |condition, unit, techniques| Blocks {
        condition,
        unit,
        techniques,
        values: Vec::new(),
        incomplete: 0,
    };
    let mut all: Vec<Blocks> = seen
        .iter()
        .enumerate()
        .map(|(condition, seen)| empty(Some(condition), Unit::Participant, of(seen)))
        .collect();
    let judged: Vec<usize> = (0..conditions)
        .filter(|&it| all[it].techniques.len() > 1)
        .collect();
    let common: Vec<bool> = (0..techniques)
        .map(|technique| judged.iter().all(|&it| seen[it][technique]))
        .collect();
    let mut pooled = empty(None, Unit::ParticipantByCondition, of(&common));
    for block in values.chunk_by(same_block) {
        all[block[0].condition as usize].take(block);
        if judged.contains(&(block[0].condition as usize)) {
            pooled.take(block);
        }
    }
    all.retain(|blocks| blocks.techniques.len() > 1);
    if judged.len() > 1 && pooled.techniques.len() > 1 {
        let mut means = empty(None, Unit::ParticipantMeans, pooled.techniques.clone());
        for participant in values.chunk_by(|one, other| one.participant == other.participant) {
            means.take_means(participant, &judged);
        }
        all.extend([pooled, means]);
    }
    all
}

fn same_block(one: &Value, other: &Value) -> bool {
    (one.participant, one.condition) == (other.participant, other.condition)
}

impl Blocks {
    /// The values of these techniques in one block, if all are there.
    fn row<'a>(&'a self, block: &'a [Value]) -> impl Iterator<Item = Option<f64>> + 'a {
        self.techniques.iter().map(|&technique| {
            let compare = |value: &Value| (value.technique as usize).cmp(&technique);
            let found: Result<usize, usize> = block.binary_search_by(compare);
            found.ok().map(|at| block[at].value)
        })
    }

    fn take(&mut self, block: &[Value]) {
        let row: Option<Vec<f64>> = self.row(block).collect();
        match row {
            Some(row) => self.values.extend(row),
            None => self.incomplete += 1,
        }
    }

    /// The means over the conditions of one participant, who must have all of all.
    fn take_means(&mut self, participant: &[Value], conditions: &[usize]) {
        let mut sums = vec![0.0; self.techniques.len()];
        let mut complete = 0;
        for block in participant.chunk_by(same_block) {
            if !conditions.contains(&(block[0].condition as usize)) {
                continue;
            }
            let row: Option<Vec<f64>> = self.row(block).collect();
            for (sum, value) in sums.iter_mut().zip(row.iter().flatten()) {
                *sum += value;
            }
            complete += usize::from(row.is_some());
        }
        if complete == conditions.len() {
            let count = complete as f64;
            self.values.extend(sums.iter().map(|sum| sum / count));
        } else {
            self.incomplete += 1;
        }
    }
}

/// Total order of finite numbers.
pub(super) fn by_size(one: &f64, other: &f64) -> Ordering {
    one.total_cmp(other)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(participant: u32, condition: u32, technique: u32, value: f64) -> Value {
        Value {
            participant,
            condition,
            technique,
            value,
        }
    }

    #[test]
    fn incomplete_blocks_are_counted_and_left_out() {
        let values = [
            value(0, 0, 0, 1.0),
            value(0, 0, 1, 2.0),
            value(0, 1, 0, 5.0),
            value(0, 1, 1, 3.0),
            value(0, 1, 2, 4.0),
            value(1, 0, 0, 2.0),
            value(1, 0, 1, 2.0),
            value(1, 1, 0, 1.0),
            value(1, 1, 2, 3.0),
        ];
        let all = blocks(&values, 2, 3);
        let [first, second, pooled, means] = &all[..] else {
            panic!("{all:?}")
        };
        assert_eq!((first.count(), first.incomplete), (2, 0));
        assert_eq!(first.doubled_ranks(), [2, 4, 3, 3]);
        assert_eq!((second.count(), second.incomplete), (1, 1));
        assert_eq!(second.doubled_ranks(), [6, 2, 4]);
        // Techniques 0 and 1 are in both conditions.
        assert_eq!(pooled.techniques, [0, 1]);
        assert_eq!(pooled.values, [1.0, 2.0, 5.0, 3.0, 2.0, 2.0]);
        assert_eq!(pooled.incomplete, 1);
        assert_eq!(means.values, [3.0, 2.5]);
        assert_eq!(means.incomplete, 1);
    }
}
