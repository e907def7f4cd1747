//! Single answers gathered from any number of files: one pair of techniques a condition, one
//! answer a participant and condition.

use std::collections::HashMap;
use std::path::Path;

use super::csv_file::shown;
use super::error::InputError;
use super::files::{Files, Place};
use super::lookalikes;
use super::names::{Names, only_used};
use super::rules::{Rules, Sieve};
use crate::analysis::dataset::{Answer, ConditionData, Dataset, Order, OrderCounts};
use crate::protocol::{Condition, Position};

/// One trial as it stands in a file; names are bytes until seen for the first time.
pub struct Observation<'a> {
    pub participant: &'a [u8],
    pub condition: &'a [u8],
    pub first_technique: &'a [u8],
    pub second_technique: &'a [u8],
    pub chosen: Option<Position>,
    pub response_time_ms: Option<f32>,
    pub hypothesis: Option<&'a str>,
    /// Empty where the input does not say.
    pub scene: &'a [u8],
    pub line: u64,
}

/// The gathered answers.
#[derive(Default)]
pub struct Trials {
    participants: Names,
    condition_ids: Names,
    techniques: Names,
    conditions: Vec<Pair>,
    answers: Vec<Answer>,
    /// File and line of every answer.
    places: Vec<Place>,
    files: Files,
    /// Conditions in the study's order, where a results folder says it.
    study_order: Vec<String>,
}

/// The techniques of a condition in base order, and where that was read.
struct Pair {
    a: u32,
    b: u32,
    hypothesis: Option<String>,
    scene: Option<String>,
    counts: OrderCounts,
    place: Place,
}

impl Trials {
    /// Whether nothing was gathered.
    pub fn is_empty(&self) -> bool {
        self.answers.is_empty()
    }

    /// Announces the file that the next trials come from, and the number of the study it is of.
    pub fn begin_file(&mut self, path: &Path, origin: u32) {
        self.files.begin(path, origin);
    }

    /// Fixes base orders from the study a results folder belongs to. Without, a condition's base
    /// order is that of its first row.
    ///
    /// # Errors
    /// [`InputError`] if another folder had another pair for one of the conditions.
    pub fn declare(
        &mut self,
        path: &Path,
        origin: u32,
        conditions: &[Condition],
    ) -> Result<(), InputError> {
        self.begin_file(path, origin);
        let place = self.files.here(0);
        for condition in conditions {
            // Only a choice between two is a condition here.
            let [first, second] = &condition.techniques[..] else {
                continue;
            };
            let names = (
                self.techniques.number(first.as_bytes(), place),
                self.techniques.number(second.as_bytes(), place),
                self.condition_ids.number(condition.id.as_bytes(), place),
            );
            let (Some(a), Some(b), Some(id)) = names else {
                continue;
            };
            match self.conditions.get(id as usize) {
                Some(pair) if (pair.a, pair.b) != (a, b) => {
                    return Err(InputError::whole(
                        path,
                        format!(
                            "condition {}: {} / {} here, {} / {} in {}; analyse the studies apart",
                            condition.id,
                            first,
                            second,
                            self.techniques.name(pair.a),
                            self.techniques.name(pair.b),
                            self.files.shown(pair.place),
                        ),
                    ));
                }
                Some(_) => {}
                None => {
                    self.conditions.push(Pair {
                        a,
                        b,
                        hypothesis: Some(condition.hypothesis.clone())
                            .filter(|hypothesis| !hypothesis.is_empty()),
                        scene: Some(condition.scene.clone()).filter(|scene| !scene.is_empty()),
                        counts: OrderCounts::default(),
                        place,
                    });
                    self.study_order.push(condition.id.clone());
                }
            }
        }
        Ok(())
    }

    /// Adds one trial.
    ///
    /// # Errors
    /// [`InputError`] for an empty name, a name that is not UTF-8, one technique on both sides, or
    /// techniques or a scene other than the condition's.
    pub fn add(&mut self, trial: &Observation<'_>) -> Result<(), InputError> {
        let place = self.files.here(trial.line);
        let numbers = (
            self.participants.number(trial.participant, place),
            self.condition_ids.number(trial.condition, place),
        );
        let (Some(participant), Some(condition)) = numbers else {
            return Err(self.name_error(trial));
        };
        if condition as usize == self.conditions.len() {
            let pair = self.new_pair(trial, place)?;
            self.conditions.push(pair);
        }
        let order = self.order(trial, condition)?;
        if trial.participant.is_empty() || trial.condition.is_empty() {
            return Err(self.name_error(trial));
        }
        let pair = &mut self.conditions[condition as usize];
        if !trial.scene.is_empty() {
            match &pair.scene {
                Some(scene) if scene.as_bytes() == trial.scene => {}
                Some(_) => return Err(self.scene_error(trial, condition)),
                None => pair.scene = Some(String::from_utf8_lossy(trial.scene).into_owned()),
            }
        }
        self.answers.push(Answer {
            participant,
            condition,
            order,
            chosen: trial.chosen,
            response_time_ms: trial.response_time_ms,
        });
        self.places.push(place);
        Ok(())
    }

    /// The pair of a condition met for the first time.
    fn new_pair(&mut self, trial: &Observation<'_>, place: Place) -> Result<Pair, InputError> {
        let numbers = (
            self.techniques.number(trial.first_technique, place),
            self.techniques.number(trial.second_technique, place),
        );
        let (Some(a), Some(b)) = numbers else {
            return Err(self.name_error(trial));
        };
        Ok(Pair {
            a,
            b,
            hypothesis: trial.hypothesis.map(str::to_owned),
            scene: None,
            counts: OrderCounts::default(),
            place,
        })
    }

    /// Which of the condition's techniques stood first.
    fn order(&self, trial: &Observation<'_>, condition: u32) -> Result<Order, InputError> {
        let pair = &self.conditions[condition as usize];
        let name = |number| self.techniques.name(number).as_bytes();
        let (first, second) = (trial.first_technique, trial.second_technique);
        if first != second && !first.is_empty() && !second.is_empty() {
            if first == name(pair.a) && second == name(pair.b) {
                return Ok(Order::AThenB);
            }
            if first == name(pair.b) && second == name(pair.a) {
                return Ok(Order::BThenA);
            }
        }
        let here = (text(first), text(second));
        let (Some(first), Some(second)) = here else {
            return Err(self.name_error(trial));
        };
        if first.is_empty() || second.is_empty() {
            return Err(self.name_error(trial));
        }
        Err(self.error(
            trial,
            if first == second {
                format!("both techniques are `{first}`; a pair needs two")
            } else {
                format!(
                    "condition {} shows {first} and {second} here, but {} and {} in {}; one condition is one pair, give each pair an id of its own",
                    self.condition_ids.name(condition),
                    self.techniques.name(pair.a),
                    self.techniques.name(pair.b),
                    self.files.shown(pair.place),
                )
            },
        ))
    }

    fn error(&self, trial: &Observation<'_>, message: String) -> InputError {
        InputError::line(self.files.current(), trial.line, message)
    }

    /// A name that is empty or no text.
    fn name_error(&self, trial: &Observation<'_>) -> InputError {
        let fields = [
            ("participant", trial.participant),
            ("condition", trial.condition),
            ("first technique", trial.first_technique),
            ("second technique", trial.second_technique),
        ];
        self.error(trial, name_error(&fields))
    }

    fn scene_error(&self, trial: &Observation<'_>, condition: u32) -> InputError {
        let pair = &self.conditions[condition as usize];
        self.error(
            trial,
            format!(
                "condition {} shows the scene {} here, but {} from {} on; one condition is one pair on one scene",
                self.condition_ids.name(condition),
                String::from_utf8_lossy(trial.scene).escape_debug(),
                pair.scene.as_deref().unwrap_or_default(),
                self.files.shown(pair.place),
            ),
        )
    }

    /// The dataset without what the rules leave out: conditions in the study's order, or by id
    /// where no study says. `rules` has the rules of every origin.
    ///
    /// # Errors
    /// [`InputError`] naming both places where a participant answered a condition twice.
    pub fn finish(mut self, rules: &[Rules]) -> Result<Dataset, InputError> {
        self.refuse_duplicates()?;
        let mut data = Dataset::default();
        for (kind, names) in [
            ("participant", &self.participants),
            ("condition", &self.condition_ids),
            ("technique", &self.techniques),
        ] {
            data.notes
                .extend(lookalikes::notes(kind, names, &self.files));
        }
        data.participants = self.sift(rules, &mut data);
        for answer in &self.answers {
            self.conditions[answer.condition as usize]
                .counts
                .add(answer.order, answer.chosen);
        }
        let ids = self.condition_ids.into_names();
        let mut order: Vec<usize> = (0..self.conditions.len()).collect();
        let rank: HashMap<&String, usize> = (self.study_order.iter().enumerate())
            .map(|(rank, id)| (id, rank))
            .collect();
        let rank = |id: &String| rank.get(id).copied().unwrap_or(usize::MAX);
        order.sort_by_cached_key(|&i| (rank(&ids[i]), ids[i].clone()));
        let mut new_number = vec![0_u32; order.len()];
        for (new, &old) in (0_u32..).zip(&order) {
            new_number[old] = new;
        }
        for answer in &mut self.answers {
            answer.condition = new_number[answer.condition as usize];
        }
        data.conditions = order
            .iter()
            .map(|&i| {
                let pair = &self.conditions[i];
                ConditionData {
                    id: ids[i].clone(),
                    technique_a: self.techniques.name(pair.a).to_owned(),
                    technique_b: self.techniques.name(pair.b).to_owned(),
                    hypothesis: pair.hypothesis.clone(),
                    scene: pair.scene.clone(),
                    votes: pair.counts.votes(),
                    orders: Some(pair.counts),
                    ..ConditionData::default()
                }
            })
            .collect();
        data.answers = self.answers;
        Ok(data)
    }

    /// Leaves out what the rules leave out, and whoever then has no trial. Gives the participants.
    fn sift(&mut self, rules: &[Rules], data: &mut Dataset) -> Vec<String> {
        let participants = std::mem::take(&mut self.participants).into_names();
        let Some(mut sieve) = Sieve::new(rules, &self.files, &participants) else {
            return participants;
        };
        let mut used = vec![false; participants.len()];
        let mut places = self.places.iter();
        self.answers.retain(|answer| {
            let place = places.next().copied().unwrap_or_default();
            let kept = sieve.keeps(place, answer.participant, answer.response_time_ms, 1);
            used[answer.participant as usize] |= kept;
            kept
        });
        let (exclusions, note) = sieve.finish(&participants);
        data.exclusions = exclusions;
        data.notes.extend(note);
        let (participants, numbers) = only_used(participants, &used);
        for answer in &mut self.answers {
            answer.participant = numbers[answer.participant as usize];
        }
        participants
    }

    fn refuse_duplicates(&self) -> Result<(), InputError> {
        // Sorted by (participant, condition, position), equal neighbours are duplicates.
        let mut keys: Vec<(u64, u32)> = (0_u32..)
            .zip(&self.answers)
            .map(|(i, answer)| {
                let key = u64::from(answer.participant) << 32 | u64::from(answer.condition);
                (key, i)
            })
            .collect();
        keys.sort_unstable();
        let first_double = keys
            .windows(2)
            .filter(|pair| pair[0].0 == pair[1].0)
            .min_by_key(|pair| pair[1].1);
        let Some(pair) = first_double else {
            return Ok(());
        };
        let (earlier, later) = (pair[0].1 as usize, pair[1].1 as usize);
        let answer = &self.answers[later];
        let place = self.places[later];
        Err(InputError::line(
            self.files.path(place),
            u64::from(place.1),
            format!(
                "participant {} answers condition {} a second time; the first is {}. Remove one of them",
                self.participants.name(answer.participant),
                self.condition_ids.name(answer.condition),
                self.files.shown(self.places[earlier]),
            ),
        ))
    }
}

/// A name as it stands in a message; `None` where it is not UTF-8.
fn text(name: &[u8]) -> Option<String> {
    std::str::from_utf8(name).ok().map(shown)
}

/// What is wrong with the first of the names that is empty or no text.
pub fn name_error(fields: &[(&str, &[u8])]) -> String {
    for (field, name) in fields {
        if name.is_empty() {
            return format!("the {field} is empty");
        }
        if std::str::from_utf8(name).is_err() {
            return format!(
                "the {field} `{}` is not UTF-8 text; save the file as UTF-8 and try again",
                shown(&String::from_utf8_lossy(name))
            );
        }
    }
    "too many different names".to_owned()
}
