//! Complete sets of pairs: all pairs of three or more techniques, on one scene where scenes are
//! known, and who judged all of one.

use std::collections::BTreeMap;

use super::triads::{circular, most_circular};
use crate::analysis::dataset::{ConditionData, Dataset};

/// A scene whose conditions hold every pair of its techniques.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Set {
    /// The scene; `None` where it is not known.
    pub scene: Option<String>,
    /// How many techniques, 3 or more.
    pub techniques: usize,
    /// Number of its first pair among all pairs of all sets.
    first_pair: usize,
    /// The pairs (i, j), i < j.
    pairs: Vec<(usize, usize)>,
}

/// All complete sets of a study.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sets {
    /// The sets, by scene.
    pub sets: Vec<Set>,
    /// For every condition (set, pair among all, technique a is the pair's j).
    of_condition: Vec<Option<(usize, usize, bool)>>,
    pairs: usize,
}

/// What one observer did with complete sets.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Own {
    /// Numbers of techniques of the sets judged, sorted.
    pub sizes: Vec<u8>,
    /// Circular triads in all of them.
    pub circular: u32,
    /// The most there could be.
    most: u32,
}

impl Own {
    /// Kendall's coefficient of consistence: 1 without circular triads, 0 with as many as can be.
    #[must_use]
    pub fn zeta(&self) -> f64 {
        1.0 - f64::from(self.circular) / f64::from(self.most.max(1))
    }
}

/// What all observers did.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Judged {
    /// By participant; `None` for who judged no set completely.
    pub observers: Vec<Option<Own>>,
    /// By set the number of observers who judged all of it.
    pub complete: Vec<u32>,
    /// By set, for every pair how many of them preferred i.
    pub for_i: Vec<Vec<u32>>,
}

/// With more techniques a set is passed over: nobody judges thousands of pairs.
const MOST_TECHNIQUES: usize = 100;

impl Sets {
    /// Finds them.
    #[must_use]
    pub fn of(data: &Dataset) -> Self {
        let mut scenes: BTreeMap<Option<&str>, Vec<usize>> = BTreeMap::new();
        for (at, condition) in data.conditions.iter().enumerate() {
            scenes
                .entry(condition.scene.as_deref())
                .or_default()
                .push(at);
        }
        let mut found = Self {
            of_condition: vec![None; data.conditions.len()],
            ..Self::default()
        };
        for (scene, members) in scenes {
            found.add(scene, &members, &data.conditions);
        }
        found
    }

    fn add(&mut self, scene: Option<&str>, members: &[usize], conditions: &[ConditionData]) {
        let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
        let mut ends = Vec::with_capacity(members.len());
        for &at in members {
            let mut number = |name| {
                let next = numbers.len();
                *numbers.entry(name).or_insert(next)
            };
            let a = number(conditions[at].technique_a.as_str());
            let b = number(conditions[at].technique_b.as_str());
            ends.push((a, b));
        }
        let techniques = numbers.len();
        let mut pairs: Vec<(usize, usize)> =
            ends.iter().map(|&(a, b)| (a.min(b), a.max(b))).collect();
        pairs.sort_unstable();
        pairs.dedup();
        if !(3..=MOST_TECHNIQUES).contains(&techniques)
            || pairs.len() != techniques * (techniques - 1) / 2
        {
            return;
        }
        for (&at, &(a, b)) in members.iter().zip(&ends) {
            let pair = pairs.partition_point(|pair| *pair < (a.min(b), a.max(b)));
            self.of_condition[at] = Some((self.sets.len(), self.pairs + pair, a > b));
        }
        self.sets.push(Set {
            scene: scene.map(str::to_owned),
            techniques,
            first_pair: self.pairs,
            pairs,
        });
        self.pairs += self.sets.last().map_or(0, |set| set.pairs.len());
    }

    /// Goes through the answers, one participant after the other.
    #[must_use]
    pub fn judge(&self, data: &Dataset) -> Judged {
        let mut judged = Judged {
            observers: vec![None; data.participants.len()],
            complete: vec![0; self.sets.len()],
            for_i: self
                .sets
                .iter()
                .map(|set| vec![0; set.pairs.len()])
                .collect(),
        };
        if self.sets.is_empty() {
            return judged;
        }
        let (ends, order) = by_participant(data);
        // Answers for i less answers for j, of all pairs; wiped after every participant.
        let mut net = vec![0_i32; self.pairs];
        for participant in 0..data.participants.len() {
            let own = &order[ends[participant]..ends[participant + 1]];
            let mut touched: Vec<usize> = Vec::new();
            for &answer in own {
                let answer = &data.answers[answer as usize];
                let place = self.of_condition[answer.condition as usize];
                if let (Some((set, pair, turned)), Some(chose_b)) = (place, answer.chose_b()) {
                    net[pair] += if chose_b == turned { 1 } else { -1 };
                    if touched.last() != Some(&set) {
                        touched.push(set);
                    }
                }
            }
            touched.sort_unstable();
            touched.dedup();
            for set in touched {
                let range = self.sets[set].first_pair..;
                let net = &mut net[range][..self.sets[set].pairs.len()];
                self.count(set, net, participant, &mut judged);
                net.fill(0);
            }
        }
        judged
    }

    /// One observer's answers to one set, if every pair is decided.
    fn count(&self, set: usize, net: &[i32], participant: usize, judged: &mut Judged) {
        if net.contains(&0) {
            return;
        }
        let known = &self.sets[set];
        let mut scores = vec![0_u32; known.techniques];
        for (&(i, j), &net) in known.pairs.iter().zip(net) {
            scores[if net > 0 { i } else { j }] += 1;
        }
        for (count, &net) in judged.for_i[set].iter_mut().zip(net) {
            *count += u32::from(net > 0);
        }
        judged.complete[set] += 1;
        let own = judged.observers[participant].get_or_insert_with(Own::default);
        own.circular += circular(&scores);
        own.most += most_circular(known.techniques);
        // At most 100 techniques.
        let size = u8::try_from(known.techniques).unwrap_or(u8::MAX);
        let at = own.sizes.partition_point(|other| *other < size);
        own.sizes.insert(at, size);
    }
}

/// Numbers of answers by participant: the ends of each one's part, and the numbers.
fn by_participant(data: &Dataset) -> (Vec<usize>, Vec<u32>) {
    let mut ends = vec![0_usize; data.participants.len() + 1];
    for answer in &data.answers {
        ends[answer.participant as usize + 1] += 1;
    }
    for at in 1..ends.len() {
        ends[at] += ends[at - 1];
    }
    let mut next = ends.clone();
    let mut order = vec![0_u32; data.answers.len()];
    for (number, answer) in data.answers.iter().enumerate() {
        let at = &mut next[answer.participant as usize];
        order[*at] = u32::try_from(number).unwrap_or(u32::MAX);
        *at += 1;
    }
    (ends, order)
}
