//! What the statistics work on: votes by condition, and where single answers are known, the
//! answers themselves.

use std::collections::BTreeMap;

use serde::Serialize;

use super::tails::Alpha;
use crate::protocol::Position;

/// Votes for the two techniques of one condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Votes {
    /// For technique a, the first of the base order.
    pub a: u32,
    /// For technique b.
    pub b: u32,
}

impl Votes {
    /// Number of votes. The readers keep the sum within 32 bits.
    #[must_use]
    pub fn total(self) -> u32 {
        self.a.saturating_add(self.b)
    }

    /// Share of technique b, 0 to 1; `None` without votes.
    #[must_use]
    pub fn share_b(self) -> Option<f64> {
        (self.total() > 0).then(|| f64::from(self.b) / f64::from(self.total()))
    }
}

/// Which technique of the pair stood first in a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Order {
    /// The base order: technique a, then b.
    AThenB,
    /// Turned round.
    BThenA,
}

/// Answers of one condition by the order shown and the position chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OrderCounts {
    /// Shown a then b, chose the first (a).
    pub ab_first: u32,
    /// Shown a then b, chose the second (b).
    pub ab_second: u32,
    /// Shown b then a, chose the first (b).
    pub ba_first: u32,
    /// Shown b then a, chose the second (a).
    pub ba_second: u32,
    /// Trials without an answer.
    pub missing: u32,
}

impl OrderCounts {
    /// Counts one trial.
    pub fn add(&mut self, order: Order, chosen: Option<Position>) {
        let cell = match (order, chosen) {
            (_, None) => &mut self.missing,
            (Order::AThenB, Some(Position::First)) => &mut self.ab_first,
            (Order::AThenB, Some(Position::Second)) => &mut self.ab_second,
            (Order::BThenA, Some(Position::First)) => &mut self.ba_first,
            (Order::BThenA, Some(Position::Second)) => &mut self.ba_second,
        };
        *cell += 1;
    }

    /// Votes by technique.
    #[must_use]
    pub fn votes(&self) -> Votes {
        Votes {
            a: self.ab_first + self.ba_second,
            b: self.ab_second + self.ba_first,
        }
    }

    /// Answers by position: (first, second).
    #[must_use]
    pub fn positions(&self) -> (u32, u32) {
        (
            self.ab_first + self.ba_first,
            self.ab_second + self.ba_second,
        )
    }

    /// Answers by order shown: (a then b, b then a).
    #[must_use]
    pub fn orders(&self) -> (u32, u32) {
        (
            self.ab_first + self.ab_second,
            self.ba_first + self.ba_second,
        )
    }
}

/// What a publication says of a condition, digit for digit as it was printed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Published {
    /// The chi-square statistic.
    pub chi_square: Option<String>,
    /// Its p.
    pub p: Option<String>,
}

/// One condition: two techniques on one scene, and how the votes fell.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ConditionData {
    /// Condition id.
    pub id: String,
    /// Technique a of the base order.
    pub technique_a: String,
    /// Technique b.
    pub technique_b: String,
    /// What it asks (`H1`), where the input says.
    pub hypothesis: Option<String>,
    /// The scene both images show, where the input says.
    pub scene: Option<String>,
    /// What was published of it, to be recomputed.
    pub published: Published,
    /// The votes.
    pub votes: Votes,
    /// By order and position; `None` when only counts are known.
    pub orders: Option<OrderCounts>,
}

/// One trial's answer, by number of participant and condition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Index into [`Dataset::participants`].
    pub participant: u32,
    /// Index into [`Dataset::conditions`].
    pub condition: u32,
    /// Order shown.
    pub order: Order,
    /// The choice; `None` for a trial without an answer.
    pub chosen: Option<Position>,
    /// Response time, milliseconds from the question's onset, where known.
    pub response_time_ms: Option<f32>,
}

impl Answer {
    /// Whether technique b was chosen.
    #[must_use]
    pub fn chose_b(&self) -> Option<bool> {
        self.chosen
            .map(|position| (position == Position::Second) == (self.order == Order::AThenB))
    }
}

/// Ratings of single images. A condition here is what was rated in several versions: a scene in
/// one light.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ratings {
    /// Ids of the conditions.
    pub conditions: Vec<String>,
    /// The techniques, in order of appearance.
    pub techniques: Vec<String>,
    /// The scales.
    pub scales: Vec<String>,
    /// The ratings; one a participant, condition, technique and scale, sorted by participant,
    /// condition, scale and technique.
    pub answers: Vec<Rating>,
}

/// One rating; the numbers are indices into [`Ratings`] and [`Dataset::participants`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rating {
    /// Who.
    pub participant: u32,
    /// Of which scene.
    pub condition: u32,
    /// Of which of its versions.
    pub technique: u32,
    /// On which scale.
    pub scale: u32,
    /// Points, the more the better.
    pub value: f32,
}

/// Rank orders of the versions of a scene.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rankings {
    /// Ids of the conditions.
    pub conditions: Vec<String>,
    /// The techniques, in order of appearance.
    pub techniques: Vec<String>,
    /// The ranks; one a participant, condition and technique, sorted by those.
    pub answers: Vec<Rank>,
}

/// The rank of one version; the numbers are indices into [`Rankings`] and
/// [`Dataset::participants`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rank {
    /// Whose ranking.
    pub participant: u32,
    /// Of which scene.
    pub condition: u32,
    /// Which of its versions.
    pub technique: u32,
    /// 1 is the best; ties have the mean of their places.
    pub rank: f32,
}

/// What the study's own protocol says, where the input is a results folder.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct StudyFacts {
    /// Its id.
    pub id: String,
    /// SHA-256 of the protocol's file.
    pub protocol_sha256: String,
    /// What participants were asked, in the protocol's own language.
    pub question: String,
    /// What a trial was made of (`no-reference`).
    pub procedure: String,
    /// Who saw which order (`latin`, `within`).
    pub design: String,
    /// Seed of the design.
    pub seed: u64,
    /// How many participants were planned.
    pub planned_participants: u32,
    /// Hypotheses by name, in the protocol's words.
    pub hypotheses: Vec<(String, String)>,
    /// Versions of Greyfield that wrote the rows.
    pub versions: Vec<String>,
    /// What participants told of themselves: question, and answers with their number.
    pub participants_told: Vec<(String, Vec<(String, u32)>)>,
}

/// What a protocol declares of the tests.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Declared {
    /// Significance level.
    pub alpha: Option<Alpha>,
    /// Ids of the conditions of the family; empty: all of them.
    pub family: Vec<String>,
}

/// Data left out by a rule that was laid down before.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Exclusion {
    /// The rule in words, with its threshold and where it was laid down.
    pub rule: String,
    /// Whom it touched, by id.
    pub participants: Vec<String>,
    /// How many trials it left out.
    pub trials: u64,
}

/// A file the data came from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Source {
    /// As it was named on the command line, or found in a folder that was.
    pub path: String,
    /// What it was recognised as.
    pub kind: &'static str,
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// Data rows used.
    pub rows_used: u64,
    /// Data rows left out (practice, catch and pilot trials).
    pub rows_left_out: u64,
}

/// Everything read from the inputs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dataset {
    /// The files.
    pub sources: Vec<Source>,
    /// The conditions: in the order of a count table, else by id.
    pub conditions: Vec<ConditionData>,
    /// Participants' ids in order of appearance; empty when only counts are known.
    pub participants: Vec<String>,
    /// Single answers, in the order read; empty when only counts are known.
    pub answers: Vec<Answer>,
    /// Ratings of single images; empty where nobody rated.
    pub ratings: Ratings,
    /// Rank orders; empty where nobody ranked.
    pub rankings: Rankings,
    /// What the study's protocol says, where it is known.
    pub study: Option<StudyFacts>,
    /// What that protocol declares of the tests; for whoever makes the [`Settings`](super::Settings).
    pub declared: Option<Declared>,
    /// What was left out by rule; a rule that touched nobody is here, too.
    pub exclusions: Vec<Exclusion>,
    /// What a reader of the results should know about the input: left-out rows, repaired lines.
    pub notes: Vec<String>,
}

impl Dataset {
    /// Whether single answers are known, not only counts.
    #[must_use]
    pub fn has_answers(&self) -> bool {
        !self.answers.is_empty()
    }

    /// The conditions that compare the same two techniques, in either base order: their indices by
    /// the two names.
    #[must_use]
    pub fn by_techniques(&self) -> BTreeMap<(&str, &str), Vec<usize>> {
        let mut groups: BTreeMap<(&str, &str), Vec<usize>> = BTreeMap::new();
        for (i, condition) in self.conditions.iter().enumerate() {
            let (a, b) = (
                condition.technique_a.as_str(),
                condition.technique_b.as_str(),
            );
            groups.entry((a.min(b), a.max(b))).or_default().push(i);
        }
        groups
    }

    /// Whether there is nothing at all to analyse.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        let counted = self.conditions.iter().any(|it| it.orders.is_none());
        !counted
            && !self.has_answers()
            && self.ratings.answers.is_empty()
            && self.rankings.answers.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reversed_trial_counts_for_the_technique_not_the_position() {
        let mut counts = OrderCounts::default();
        counts.add(Order::AThenB, Some(Position::Second));
        counts.add(Order::BThenA, Some(Position::First));
        counts.add(Order::BThenA, Some(Position::Second));
        counts.add(Order::AThenB, None);
        assert_eq!(counts.votes(), Votes { a: 1, b: 2 });
        assert_eq!(counts.positions(), (1, 2));
        assert_eq!(counts.orders(), (1, 2));
        assert_eq!(counts.missing, 1);
    }

    #[test]
    fn an_answer_names_the_same_technique_as_the_counts() {
        for order in [Order::AThenB, Order::BThenA] {
            for position in [Position::First, Position::Second] {
                let answer = Answer {
                    participant: 0,
                    condition: 0,
                    order,
                    chosen: Some(position),
                    response_time_ms: None,
                };
                let mut counts = OrderCounts::default();
                counts.add(order, Some(position));
                assert_eq!(answer.chose_b(), Some(counts.votes().b == 1));
            }
        }
    }
}
