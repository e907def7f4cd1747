//! Ratings and ranks gathered from any number of files: one value a participant, condition,
//! technique and scale. A rank is a value on a scale of its own.

use std::collections::HashMap;
use std::path::Path;

use super::error::InputError;
use super::files::{Files, Place};
use super::lookalikes;
use super::names::{Names, only_used};
use super::rules::{Rules, Sieve};
use super::trials::name_error;
use crate::analysis::dataset::{Dataset, Rank, Rankings, Rating, Ratings};

/// One value as it stands in a file.
pub struct Judgement<'a> {
    pub participant: &'a [u8],
    pub condition: &'a [u8],
    pub technique: &'a [u8],
    /// Empty for a rank.
    pub scale: &'a [u8],
    pub value: f32,
    pub response_time_ms: Option<f32>,
    pub line: u64,
}

/// The gathered values.
#[derive(Default)]
pub struct Judgements {
    participants: Names,
    conditions: Names,
    techniques: Names,
    scales: Names,
    entries: Vec<Entry>,
    files: Files,
    /// Conditions and techniques in the study's order, where a results folder says it.
    study_order: [Vec<String>; 2],
}

#[derive(Clone, Copy)]
struct Entry {
    participant: u32,
    condition: u32,
    technique: u32,
    scale: u32,
    value: f32,
    response_time_ms: Option<f32>,
    place: Place,
}

impl Entry {
    fn key(&self) -> [u32; 4] {
        [self.participant, self.condition, self.scale, self.technique]
    }
}

impl Judgements {
    /// Whether nothing was gathered.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Announces the file that the next values come from, and the number of the study it is of.
    pub fn begin_file(&mut self, path: &Path, origin: u32) {
        self.files.begin(path, origin);
    }

    /// Says in which order a study has a condition and its techniques.
    pub fn declare(&mut self, condition: &str, techniques: &[String]) {
        let [conditions, known] = &mut self.study_order;
        let add = |list: &mut Vec<String>, name: &str| {
            if !list.iter().any(|known| known == name) {
                list.push(name.to_owned());
            }
        };
        add(conditions, condition);
        for technique in techniques {
            add(known, technique);
        }
    }

    /// Adds one value.
    ///
    /// # Errors
    /// [`InputError`] for a name that is empty or not UTF-8.
    pub fn add(&mut self, given: &Judgement<'_>) -> Result<(), InputError> {
        let place = self.files.here(given.line);
        let fields = [
            ("participant", given.participant),
            ("condition", given.condition),
            ("technique", given.technique),
        ];
        let numbers = (
            self.participants.number(given.participant, place),
            self.conditions.number(given.condition, place),
            self.techniques.number(given.technique, place),
            self.scales.number(given.scale, place),
        );
        let (Some(participant), Some(condition), Some(technique), Some(scale)) = numbers else {
            let all = [&fields[..], &[("scale", given.scale)]].concat();
            return Err(self.error(given.line, name_error(&all)));
        };
        if fields.iter().any(|(_, name)| name.is_empty()) {
            return Err(self.error(given.line, name_error(&fields)));
        }
        self.entries.push(Entry {
            participant,
            condition,
            technique,
            scale,
            value: given.value,
            response_time_ms: given.response_time_ms,
            place,
        });
        Ok(())
    }

    fn error(&self, line: u64, message: String) -> InputError {
        InputError::line(self.files.current(), line, message)
    }

    /// The dataset of what was rated, without what the rules leave out.
    ///
    /// # Errors
    /// [`InputError`] naming both places where somebody rates one image twice on one scale.
    pub fn into_ratings(self, rules: &[Rules]) -> Result<Dataset, InputError> {
        let (mut data, gathered) = self.finish(rules, "rates")?;
        let answers = gathered.entries.iter().map(|entry| Rating {
            participant: entry.participant,
            condition: entry.condition,
            technique: entry.technique,
            scale: entry.scale,
            value: entry.value,
        });
        data.ratings = Ratings {
            answers: answers.collect(),
            conditions: gathered.conditions,
            techniques: gathered.techniques,
            scales: gathered.scales,
        };
        Ok(data)
    }

    /// The dataset of what was ranked, without what the rules leave out. The ranks of one
    /// participant and condition become 1 to their number, ties the mean of their places: 1, 1, 2
    /// and 1, 1, 3 say the same.
    ///
    /// # Errors
    /// [`InputError`] naming both places where somebody ranks one image twice.
    pub fn into_rankings(self, rules: &[Rules]) -> Result<Dataset, InputError> {
        let (mut data, gathered) = self.finish(rules, "ranks")?;
        let mut answers = Vec::with_capacity(gathered.entries.len());
        let of_one = |one: &Entry, other: &Entry| one.key()[..2] == other.key()[..2];
        for ranking in gathered.entries.chunk_by(of_one) {
            answers.extend(ranking.iter().map(|entry| Rank {
                participant: entry.participant,
                condition: entry.condition,
                technique: entry.technique,
                rank: mid_rank(entry.value, ranking),
            }));
        }
        data.rankings = Rankings {
            answers,
            conditions: gathered.conditions,
            techniques: gathered.techniques,
        };
        Ok(data)
    }

    fn finish(mut self, rules: &[Rules], verb: &str) -> Result<(Dataset, Gathered), InputError> {
        // Sorted, the answers do not depend on the order of the rows; equal neighbours are doubles.
        self.entries
            .sort_unstable_by_key(|entry| (entry.key(), entry.place));
        self.refuse_duplicates(verb)?;
        let mut data = Dataset::default();
        for (kind, names) in [
            ("participant", &self.participants),
            ("condition", &self.conditions),
            ("technique", &self.techniques),
            ("scale", &self.scales),
        ] {
            data.notes
                .extend(lookalikes::notes(kind, names, &self.files));
        }
        data.participants = self.sift(rules, &mut data);
        let [conditions, techniques] = &self.study_order;
        let by_id = |names: &[String]| ordered(names, conditions, true);
        let (conditions, condition) = by_id(self.conditions.names());
        let (techniques, technique) = ordered(self.techniques.names(), techniques, false);
        for entry in &mut self.entries {
            entry.condition = condition[entry.condition as usize];
            entry.technique = technique[entry.technique as usize];
        }
        self.entries.sort_unstable_by_key(Entry::key);
        let gathered = Gathered {
            conditions,
            techniques,
            scales: self.scales.into_names(),
            entries: self.entries,
        };
        Ok((data, gathered))
    }

    fn refuse_duplicates(&self, verb: &str) -> Result<(), InputError> {
        let doubles = self
            .entries
            .windows(2)
            .filter(|pair| pair[0].key() == pair[1].key());
        let Some([earlier, later]) = doubles
            .min_by_key(|pair| pair[1].place)
            .and_then(|pair| <&[Entry; 2]>::try_from(pair).ok())
        else {
            return Ok(());
        };
        let scale = match self.scales.name(later.scale) {
            "" => String::new(),
            scale => format!(" on {scale}"),
        };
        Err(InputError::line(
            self.files.path(later.place),
            u64::from(later.place.1),
            format!(
                "participant {} {verb} {} of condition {}{scale} a second time; the first is {}. Remove one of them",
                self.participants.name(later.participant),
                self.techniques.name(later.technique),
                self.conditions.name(later.condition),
                self.files.shown(earlier.place),
            ),
        ))
    }

    /// Leaves out what the rules leave out, and whoever then has nothing. Gives the participants.
    fn sift(&mut self, rules: &[Rules], data: &mut Dataset) -> Vec<String> {
        let participants = std::mem::take(&mut self.participants).into_names();
        let Some(mut sieve) = Sieve::new(rules, &self.files, &participants) else {
            return participants;
        };
        let mut used = vec![false; participants.len()];
        // Several values of one row are one trial.
        self.entries.sort_unstable_by_key(|entry| entry.place);
        let mut before = None;
        self.entries.retain(|entry| {
            let trials = u64::from(before.replace(entry.place) != Some(entry.place));
            let time = entry.response_time_ms;
            let kept = sieve.keeps(entry.place, entry.participant, time, trials);
            used[entry.participant as usize] |= kept;
            kept
        });
        let (exclusions, note) = sieve.finish(&participants);
        data.exclusions = exclusions;
        data.notes.extend(note);
        let (participants, numbers) = only_used(participants, &used);
        for entry in &mut self.entries {
            entry.participant = numbers[entry.participant as usize];
        }
        participants
    }
}

/// The names and the values, numbered anew.
struct Gathered {
    conditions: Vec<String>,
    techniques: Vec<String>,
    scales: Vec<String>,
    entries: Vec<Entry>,
}

/// Names in the study's order, those it does not name behind them: by name, or as they appeared.
/// With the new number of each.
fn ordered(names: &[String], study: &[String], by_name: bool) -> (Vec<String>, Vec<u32>) {
    let ranks: HashMap<&String, usize> = study.iter().zip(0..).collect();
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by_key(|&i| {
        let rank = ranks.get(&names[i]).copied().unwrap_or(usize::MAX);
        (rank, by_name.then(|| &names[i]))
    });
    let mut numbers = vec![0; names.len()];
    for (new, &old) in (0..).zip(&order) {
        numbers[old] = new;
    }
    (order.iter().map(|&i| names[i].clone()).collect(), numbers)
}

/// The place of a value among those of one ranking; of equal ones the mean of their places.
fn mid_rank(value: f32, ranking: &[Entry]) -> f32 {
    let before = ranking.iter().filter(|other| other.value < value).count();
    let equal = ranking.iter().filter(|other| other.value == value).count();
    before as f32 + (equal as f32 + 1.0) / 2.0
}
