//! The comparison table: who was preferred to whom how often, pooled over conditions.

use std::collections::BTreeMap;

use crate::analysis::dataset::{ConditionData, Dataset};

/// Votes between two techniques that were compared, i before j in [`Comparisons::techniques`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair {
    /// The earlier technique.
    pub i: usize,
    /// The later one.
    pub j: usize,
    /// Votes for i.
    pub i_wins: u64,
    /// Votes for j.
    pub j_wins: u64,
}

impl Pair {
    /// Number of votes.
    #[must_use]
    pub fn votes(&self) -> u64 {
        self.i_wins + self.j_wins
    }
}

/// Who was preferred to whom how often.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Comparisons {
    /// The techniques in base order: the order in which conditions name them, a before b.
    pub techniques: Vec<String>,
    /// The pairs with at least one vote, by (i, j).
    pub pairs: Vec<Pair>,
}

impl Comparisons {
    /// Pools conditions.
    #[must_use]
    pub fn of<'a>(conditions: impl IntoIterator<Item = &'a ConditionData>) -> Self {
        let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
        let mut techniques = Vec::new();
        let mut table: BTreeMap<(usize, usize), (u64, u64)> = BTreeMap::new();
        for condition in conditions {
            let mut number = |name: &'a str| {
                *numbers.entry(name).or_insert_with(|| {
                    techniques.push(name.to_owned());
                    techniques.len() - 1
                })
            };
            let a = number(&condition.technique_a);
            let b = number(&condition.technique_b);
            let (for_a, for_b) = (u64::from(condition.votes.a), u64::from(condition.votes.b));
            if a == b || for_a + for_b == 0 {
                continue;
            }
            let cell = table.entry((a.min(b), a.max(b))).or_default();
            let (for_i, for_j) = if a < b {
                (for_a, for_b)
            } else {
                (for_b, for_a)
            };
            cell.0 += for_i;
            cell.1 += for_j;
        }
        let pairs = table
            .into_iter()
            .map(|((i, j), (i_wins, j_wins))| Pair {
                i,
                j,
                i_wins,
                j_wins,
            })
            .collect();
        Self { techniques, pairs }
    }

    /// For every technique how often it was preferred, and how often the other one was.
    #[must_use]
    pub fn wins_and_losses(&self) -> Vec<(u64, u64)> {
        let mut sums = vec![(0, 0); self.techniques.len()];
        for pair in &self.pairs {
            sums[pair.i].0 += pair.i_wins;
            sums[pair.i].1 += pair.j_wins;
            sums[pair.j].0 += pair.j_wins;
            sums[pair.j].1 += pair.i_wins;
        }
        sums
    }

    /// For every condition of the data its pair, and whether technique a is the pair's j.
    #[must_use]
    pub fn pair_of_conditions(&self, data: &Dataset) -> Vec<Option<(usize, bool)>> {
        let numbers: BTreeMap<&str, usize> = self
            .techniques
            .iter()
            .enumerate()
            .map(|(at, name)| (name.as_str(), at))
            .collect();
        data.conditions
            .iter()
            .map(|condition| {
                let a = *numbers.get(condition.technique_a.as_str())?;
                let b = *numbers.get(condition.technique_b.as_str())?;
                let key = (a.min(b), a.max(b));
                let at = self
                    .pairs
                    .binary_search_by_key(&key, |pair| (pair.i, pair.j))
                    .ok()?;
                Some((at, a > b))
            })
            .collect()
    }
}
