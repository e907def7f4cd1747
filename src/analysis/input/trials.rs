//! Single answers gathered from any number of files: one pair of techniques a condition, one
//! answer a participant and condition.

use std::path::{Path, PathBuf};

use super::error::InputError;
use super::names::Names;
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
    places: Vec<(u32, u32)>,
    files: Vec<PathBuf>,
    /// Conditions in the study's order, where a results folder says it.
    study_order: Vec<String>,
}

/// The techniques of a condition in base order, and where that was read.
struct Pair {
    a: u32,
    b: u32,
    hypothesis: Option<String>,
    counts: OrderCounts,
    place: (u32, u32),
}

impl Trials {
    /// Whether nothing was gathered.
    pub fn is_empty(&self) -> bool {
        self.answers.is_empty()
    }

    /// Announces the file that the next trials come from.
    pub fn begin_file(&mut self, path: &Path) {
        self.files.push(path.to_owned());
    }

    /// Fixes base orders from the study a results folder belongs to. Without, a condition's base
    /// order is that of its first row.
    ///
    /// # Errors
    /// [`InputError`] if another folder had another pair for one of the conditions.
    pub fn declare(&mut self, path: &Path, conditions: &[Condition]) -> Result<(), InputError> {
        self.begin_file(path);
        for condition in conditions {
            // Only a choice between two is a condition here.
            let [first, second] = &condition.techniques[..] else {
                continue;
            };
            let place = (self.file_number(), 0);
            let names = (
                self.techniques.number(first.as_bytes()),
                self.techniques.number(second.as_bytes()),
                self.condition_ids.number(condition.id.as_bytes()),
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
                            self.place(pair.place),
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
    /// techniques other than the condition's.
    pub fn add(&mut self, trial: &Observation<'_>) -> Result<(), InputError> {
        let path = self.files.last().map_or(Path::new(""), PathBuf::as_path);
        let error = |message: String| InputError::line(path, trial.line, message);
        let fields = [
            ("participant", trial.participant),
            ("condition", trial.condition),
            ("first technique", trial.first_technique),
            ("second technique", trial.second_technique),
        ];
        if let Some((name, _)) = fields.iter().find(|(_, bytes)| bytes.is_empty()) {
            return Err(error(format!("the {name} is empty")));
        }
        let numbers = (
            self.participants.number(trial.participant),
            self.condition_ids.number(trial.condition),
            self.techniques.number(trial.first_technique),
            self.techniques.number(trial.second_technique),
        );
        let (Some(participant), Some(condition), Some(first), Some(second)) = numbers else {
            return Err(error(
                "a name is not UTF-8 text; save the file as UTF-8 and try again".to_owned(),
            ));
        };
        let line = u32::try_from(trial.line).unwrap_or(u32::MAX);
        let place = (self.file_number(), line);
        if condition as usize == self.conditions.len() {
            self.conditions.push(Pair {
                a: first,
                b: second,
                hypothesis: trial.hypothesis.map(str::to_owned),
                counts: OrderCounts::default(),
                place,
            });
        }
        let pair = &self.conditions[condition as usize];
        let order = if first == second {
            return Err(error(format!(
                "both techniques are `{}`; a pair needs two",
                self.techniques.name(first)
            )));
        } else if (first, second) == (pair.a, pair.b) {
            Order::AThenB
        } else if (second, first) == (pair.a, pair.b) {
            Order::BThenA
        } else {
            return Err(error(format!(
                "condition {} shows {} and {} here, but {} and {} in {}; one condition is one pair, give each pair an id of its own",
                self.condition_ids.name(condition),
                self.techniques.name(first),
                self.techniques.name(second),
                self.techniques.name(pair.a),
                self.techniques.name(pair.b),
                self.place(pair.place),
            )));
        };
        self.conditions[condition as usize]
            .counts
            .add(order, trial.chosen);
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

    /// The dataset: conditions in the study's order, or by id where no study says.
    ///
    /// # Errors
    /// [`InputError`] naming both places where a participant answered a condition twice.
    pub fn finish(mut self) -> Result<Dataset, InputError> {
        self.refuse_duplicates()?;
        let ids = self.condition_ids.into_names();
        let mut order: Vec<usize> = (0..self.conditions.len()).collect();
        let rank = |id: &String| {
            self.study_order
                .iter()
                .position(|known| known == id)
                .unwrap_or(usize::MAX)
        };
        order.sort_by_cached_key(|&i| (rank(&ids[i]), ids[i].clone()));
        let mut new_number = vec![0_u32; order.len()];
        for (new, &old) in (0_u32..).zip(&order) {
            new_number[old] = new;
        }
        for answer in &mut self.answers {
            answer.condition = new_number[answer.condition as usize];
        }
        let conditions = order
            .iter()
            .map(|&i| {
                let pair = &self.conditions[i];
                ConditionData {
                    id: ids[i].clone(),
                    technique_a: self.techniques.name(pair.a).to_owned(),
                    technique_b: self.techniques.name(pair.b).to_owned(),
                    hypothesis: pair.hypothesis.clone(),
                    votes: pair.counts.votes(),
                    orders: Some(pair.counts),
                    ..ConditionData::default()
                }
            })
            .collect();
        Ok(Dataset {
            conditions,
            participants: self.participants.into_names(),
            answers: self.answers,
            ..Dataset::default()
        })
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
        let (file, line) = self.places[later];
        Err(InputError::line(
            &self.files[file as usize],
            u64::from(line),
            format!(
                "participant {} answers condition {} a second time; the first is {}. Remove one of them",
                self.participants.name(answer.participant),
                self.condition_ids.name(answer.condition),
                self.place(self.places[earlier]),
            ),
        ))
    }

    fn file_number(&self) -> u32 {
        u32::try_from(self.files.len().saturating_sub(1)).unwrap_or(u32::MAX)
    }

    /// `file:line`, or the file alone for line 0.
    fn place(&self, (file, line): (u32, u32)) -> String {
        let path = self.files[file as usize].display();
        if line == 0 {
            path.to_string()
        } else {
            format!("{path}:{line}")
        }
    }
}
