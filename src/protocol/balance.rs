//! How even a number of sessions is: who stood where, was reversed how often, followed what.
//!
//! A pure function of session plans. Only trials of the study itself count
//! ([`Phase::Main`]); positions are those among them, and what follows what likewise.

use super::{Phase, SessionPlan};

/// What is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Aspect {
    /// Each condition at each position.
    Position,
    /// Each condition in its base order and reversed.
    InnerOrder,
    /// Each condition right after each other.
    CarryOver,
    /// Base order and reversed at each position.
    InnerOrderAtPosition,
}

impl Aspect {
    /// All of them, in the order they are told.
    pub const ALL: [Self; 4] = [
        Self::Position,
        Self::InnerOrder,
        Self::CarryOver,
        Self::InnerOrderAtPosition,
    ];

    /// Name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::InnerOrder => "inner-order",
            Self::CarryOver => "carry-over",
            Self::InnerOrderAtPosition => "inner-order-at-position",
        }
    }
}

/// Counts over a number of sessions.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Balance {
    /// Ids of the conditions, in the study's order.
    conditions: Vec<String>,
    sessions: usize,
    /// `[condition][position]`
    position: Grid,
    /// `[condition][reversed]`
    inner_order: Grid,
    /// `[condition][next]`
    carry_over: Grid,
    /// `[position][reversed]`
    inner_order_at_position: Grid,
    reversed_in_session: Option<Range>,
}

type Grid = Vec<Vec<u32>>;

/// The least and the greatest of some counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Range {
    /// The least.
    pub low: u32,
    /// The greatest.
    pub high: u32,
}

impl std::fmt::Display for Range {
    /// `2`, or `0 to 2`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.low == self.high {
            write!(f, "{}", self.low)
        } else {
            write!(f, "{} to {}", self.low, self.high)
        }
    }
}

/// How even the counts of one [`Aspect`] are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evenness {
    /// The least and the greatest count; of the inner orders, of the reversed.
    pub range: Range,
    /// The share of what is counted that would have to stand elsewhere for all counts to be
    /// the same: 0 is even, near 1 is all in one place. Half the sum of the distances from
    /// the mean, over the sum. Too few sessions to be even have one above 0, too.
    pub imbalance: f64,
}

/// The counts of one [`Aspect`], with their names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Names of the rows.
    pub rows: Vec<String>,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// `[row][column]`; `None` where a condition would follow itself.
    pub counts: Vec<Vec<Option<u32>>>,
}

impl Balance {
    /// Counts these sessions of one study.
    pub fn of<'a>(plans: impl IntoIterator<Item = &'a SessionPlan>) -> Self {
        let mut balance = Self::default();
        for plan in plans {
            balance.add(plan);
        }
        balance
    }

    /// Counts one more session.
    pub fn add(&mut self, plan: &SessionPlan) {
        let trials = || plan.trials.iter().filter(|t| t.phase == Phase::Main);
        let shown = |&index: &usize| trials().any(|trial| trial.condition == index);
        for index in (0..plan.conditions.len()).filter(shown) {
            self.known(&plan.conditions[index].id);
        }
        self.sessions += 1;
        self.make_room(trials().count());
        let mut before = None;
        let mut reversed_here = 0;
        for (position, trial) in trials().enumerate() {
            let condition = self.known(&plan.conditions[trial.condition].id);
            let reversed = usize::from(trial.reversed);
            self.position[condition][position] += 1;
            self.inner_order[condition][reversed] += 1;
            self.inner_order_at_position[position][reversed] += 1;
            if let Some(before) = before.replace(condition) {
                self.carry_over[before][condition] += 1;
            }
            reversed_here += u32::from(trial.reversed);
        }
        self.reversed_in_session = Some(match self.reversed_in_session {
            None => Range::of([reversed_here]),
            Some(range) => Range::of([range.low, range.high, reversed_here]),
        });
    }

    /// What this would become with one more session.
    #[must_use]
    pub fn if_next(&self, plan: &SessionPlan) -> Self {
        let mut after = self.clone();
        after.add(plan);
        after
    }

    /// Index of a condition, which is noted if it is new.
    fn known(&mut self, id: &str) -> usize {
        let found = self.conditions.iter().position(|known| known == id);
        found.unwrap_or_else(|| {
            self.conditions.push(id.to_owned());
            self.conditions.len() - 1
        })
    }

    fn make_room(&mut self, positions: usize) {
        let positions = positions.max(self.inner_order_at_position.len());
        let conditions = self.conditions.len();
        let sizes = [
            (&mut self.position, conditions, positions),
            (&mut self.inner_order, conditions, 2),
            (&mut self.carry_over, conditions, conditions),
            (&mut self.inner_order_at_position, positions, 2),
        ];
        for (grid, rows, columns) in sizes {
            grid.resize_with(rows, Vec::new);
            grid.iter_mut().for_each(|row| row.resize(columns, 0));
        }
    }

    /// How many sessions are counted.
    #[must_use]
    pub const fn sessions(&self) -> usize {
        self.sessions
    }

    /// How many pairs were reversed in a session; `None` without any.
    #[must_use]
    pub const fn reversed_in_session(&self) -> Option<Range> {
        self.reversed_in_session
    }

    const fn grid(&self, aspect: Aspect) -> &Grid {
        match aspect {
            Aspect::Position => &self.position,
            Aspect::InnerOrder => &self.inner_order,
            Aspect::CarryOver => &self.carry_over,
            Aspect::InnerOrderAtPosition => &self.inner_order_at_position,
        }
    }

    /// How even one aspect is.
    #[must_use]
    pub fn evenness(&self, aspect: Aspect) -> Evenness {
        let grid = self.grid(aspect);
        let cells = grid.iter().enumerate().flat_map(|(row, counts)| {
            let possible = move |column| aspect != Aspect::CarryOver || row != column;
            let counts = counts.iter().copied().enumerate();
            counts
                .filter(move |&(column, _)| possible(column))
                .map(|(_, count)| count)
        });
        let counts: Vec<u32> = cells.collect();
        let range = match aspect {
            Aspect::Position | Aspect::CarryOver => Range::of(counts.iter().copied()),
            Aspect::InnerOrder | Aspect::InnerOrderAtPosition => {
                Range::of(grid.iter().map(|by_order| by_order[1]))
            }
        };
        Evenness {
            range,
            imbalance: imbalance(&counts),
        }
    }

    /// The counts of one aspect, with their names. Positions are counted from 0, as in data.
    #[must_use]
    pub fn table(&self, aspect: Aspect) -> Table {
        let positions = || {
            let count = self.inner_order_at_position.len();
            (0..count).map(|n| n.to_string()).collect()
        };
        let orders = || vec![String::from("base"), String::from("reversed")];
        let conditions = || self.conditions.clone();
        let (rows, columns) = match aspect {
            Aspect::Position => (conditions(), positions()),
            Aspect::InnerOrder => (conditions(), orders()),
            Aspect::CarryOver => (conditions(), conditions()),
            Aspect::InnerOrderAtPosition => (positions(), orders()),
        };
        let never = |row, column, count| aspect == Aspect::CarryOver && row == column && count == 0;
        let counts = self.grid(aspect).iter().enumerate().map(|(row, counts)| {
            let cell = |(column, &count)| (!never(row, column, count)).then_some(count);
            counts.iter().enumerate().map(cell).collect()
        });
        Table {
            rows,
            columns,
            counts: counts.collect(),
        }
    }
}

impl Range {
    fn of(counts: impl IntoIterator<Item = u32>) -> Self {
        let mut counts = counts.into_iter();
        let first = counts.next().unwrap_or(0);
        let start = Self {
            low: first,
            high: first,
        };
        counts.fold(start, |range, count| Self {
            low: range.low.min(count),
            high: range.high.max(count),
        })
    }
}

fn imbalance(counts: &[u32]) -> f64 {
    let sum: f64 = counts.iter().copied().map(f64::from).sum();
    if sum == 0.0 {
        return 0.0;
    }
    let mean = sum / counts.len() as f64;
    let distances = counts.iter().map(|&count| (f64::from(count) - mean).abs());
    distances.sum::<f64>() / (2.0 * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::{Condition, Trial};

    fn plan(ids: &[&str], trials: &[(usize, bool, Phase)]) -> SessionPlan {
        let condition = |id: &&str| Condition {
            id: String::from(*id),
            scene: String::from("atrium"),
            techniques: vec![String::from("none"), String::from("blizzard24")],
            reference: None,
            hypothesis: String::new(),
        };
        let trial =
            |(index, &(condition, reversed, phase)): (usize, &(usize, bool, Phase))| Trial {
                index,
                condition,
                reversed,
                places: if reversed { vec![1, 0] } else { vec![0, 1] },
                phase,
                correct: None,
                pause: None,
            };
        SessionPlan {
            slot: 0,
            conditions: ids.iter().map(condition).collect(),
            trials: trials.iter().enumerate().map(trial).collect(),
        }
    }

    /// A session of the study alone.
    fn main(trials: &[(usize, bool)]) -> SessionPlan {
        let trials: Vec<_> = trials.iter().map(|&(c, r)| (c, r, Phase::Main)).collect();
        plan(&["a", "b", "c"], &trials)
    }

    #[test]
    fn two_sessions_are_counted_by_hand() {
        let one = main(&[(1, false), (0, true), (2, true)]);
        let two = main(&[(1, true), (2, false), (0, true)]);
        let balance = Balance::of([&one, &two]);
        assert_eq!(balance.sessions(), 2);
        let table = |aspect| balance.table(aspect).counts;
        let some = |rows: &[&[u32]]| -> Vec<Vec<Option<u32>>> {
            rows.iter()
                .map(|row| row.iter().copied().map(Some).collect())
                .collect()
        };
        assert_eq!(
            table(Aspect::Position),
            some(&[&[0, 1, 1], &[2, 0, 0], &[0, 1, 1]])
        );
        assert_eq!(
            table(Aspect::InnerOrder),
            some(&[&[0, 2], &[1, 1], &[1, 1]])
        );
        assert_eq!(
            table(Aspect::CarryOver),
            [
                [None, Some(0), Some(1)],
                [Some(1), None, Some(1)],
                [Some(1), Some(0), None]
            ]
        );
        assert_eq!(
            table(Aspect::InnerOrderAtPosition),
            some(&[&[1, 1], &[1, 1], &[0, 2]])
        );
        assert_eq!(
            balance.reversed_in_session(),
            Some(Range { low: 2, high: 2 })
        );
        let evenness = balance.evenness(Aspect::Position);
        assert_eq!(evenness.range, Range { low: 0, high: 2 });
        // 6 in 9 cells, mean 2/3: 4 × 1/3 + 4/3 + 4 × 2/3 = 16/3; half of it over 6.
        assert!((evenness.imbalance - 4.0 / 9.0).abs() < 1e-12);
        // Reversed 2, 1 and 1 times: of six trials one would have to be the other way round.
        let evenness = balance.evenness(Aspect::InnerOrder);
        assert_eq!(evenness.range, Range { low: 1, high: 2 });
        assert!((evenness.imbalance - 1.0 / 6.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_practised_or_checks_attention_does_not_count() {
        let study = [(0, false), (2, true), (1, true)];
        let with_more = plan(
            &["a", "b", "c", "easy"],
            &[
                (3, false, Phase::Practice),
                (2, true, Phase::Practice),
                (0, false, Phase::Main),
                (2, true, Phase::Main),
                (3, true, Phase::Catch),
                (1, true, Phase::Main),
            ],
        );
        assert_eq!(Balance::of([&with_more]), Balance::of([&main(&study)]));
    }

    #[test]
    fn a_mirrored_second_session_mends_the_inner_order() {
        let one = main(&[(0, false), (1, true), (2, false)]);
        let mirror = main(&[(0, true), (1, false), (2, true)]);
        let before = Balance::of([&one]);
        let after = before.if_next(&mirror);
        assert_eq!(after, Balance::of([&one, &mirror]));
        assert_eq!(before.sessions(), 1, "asking changes nothing");
        for aspect in [Aspect::InnerOrder, Aspect::InnerOrderAtPosition] {
            assert_eq!(before.evenness(aspect).imbalance, 0.5);
            assert_eq!(after.evenness(aspect).imbalance, 0.0);
            assert_eq!(after.evenness(aspect).range, Range { low: 1, high: 1 });
        }
        // The same places again.
        let places = Aspect::Position;
        assert_eq!(
            before.evenness(places).imbalance,
            after.evenness(places).imbalance
        );
    }

    #[test]
    fn nothing_and_one_condition_are_even() {
        let alone = plan(&["a"], &[(0, true, Phase::Main)]);
        for aspect in [Aspect::Position, Aspect::CarryOver] {
            assert_eq!(Balance::default().evenness(aspect).imbalance, 0.0);
            assert_eq!(Balance::of([&alone]).evenness(aspect).imbalance, 0.0);
        }
        assert_eq!(Balance::default().reversed_in_session(), None);
    }
}
