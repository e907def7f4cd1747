//! The studies that results folders are of: their protocols, and what they lay down.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use super::Options;
use super::error::InputError;
use super::rules::{Rules, Tally};
use crate::analysis::dataset::{Declared, StudyFacts};
use crate::analysis::tails::Alpha;
use crate::config;
use crate::protocol::{Phase, Protocol};
use crate::record::study::{PROTOCOL_FILE, STUDY_FILE};
use crate::record::{self, ParticipantId, StudyIdentity, TrialRow, about};

/// One results folder.
pub struct Study {
    folder: PathBuf,
    /// What the folder was begun with, where it says so.
    pub identity: Option<StudyIdentity>,
    /// The protocol, where it can be trusted.
    protocol: Option<Protocol>,
    /// Who was rejected.
    pub rejected: BTreeSet<String>,
    tallies: BTreeMap<String, Tally>,
    versions: BTreeSet<String>,
}

/// The results folders of an input. Number 0 is everything that is in none; they count from 1.
#[derive(Default)]
pub struct Studies {
    all: Vec<Study>,
    known: HashMap<PathBuf, u32>,
}

/// The results folder that a data file stands in.
pub fn folder_of(file: &Path) -> PathBuf {
    let data = file.parent().unwrap_or(Path::new(""));
    match (data.file_name(), data.parent()) {
        (Some(_), Some(results)) => results.to_owned(),
        _ => data.join(".."),
    }
}

impl Studies {
    /// The number of a results folder, and whether it is met for the first time.
    ///
    /// # Errors
    /// [`InputError`] for a `study.json` or slots that cannot be read.
    pub fn number(
        &mut self,
        folder: &Path,
        notes: &mut Vec<String>,
    ) -> Result<(u32, bool), InputError> {
        if let Some(&number) = self.known.get(folder) {
            return Ok((number, false));
        }
        let identity = identity(folder)?;
        self.all.push(Study {
            folder: folder.to_owned(),
            protocol: protocol(folder, identity.as_ref(), notes),
            identity,
            rejected: record::rejections(folder)?.into_keys().collect(),
            tallies: BTreeMap::new(),
            versions: BTreeSet::new(),
        });
        let number = u32::try_from(self.all.len()).unwrap_or(u32::MAX);
        self.known.insert(folder.to_owned(), number);
        Ok((number, true))
    }

    /// A study by its number.
    pub fn get(&mut self, number: u32) -> &mut Study {
        &mut self.all[number as usize - 1]
    }

    /// The rules of everything, by number.
    pub fn rules(&self, options: Options) -> Vec<Rules> {
        let of_study = |study: &Study| match &study.protocol {
            Some(protocol) => Rules::of_protocol(protocol, &study.tallies, options),
            None => Rules::chosen(options),
        };
        std::iter::once(Rules::chosen(options))
            .chain(self.all.iter().map(of_study))
            .collect()
    }

    /// What the one protocol of all studies says and declares. Of several protocols none speaks for
    /// all the data; that is noted.
    pub fn facts(
        &self,
        participants: &[String],
        notes: &mut Vec<String>,
    ) -> (Option<StudyFacts>, Option<Declared>) {
        let hash = |study: &Study| match (&study.protocol, &study.identity) {
            (Some(protocol), _) => Some(protocol.hash.clone()),
            (None, identity) => identity.as_ref().map(|it| it.protocol_hash.clone()),
        };
        let hashes: BTreeSet<Option<String>> = self.all.iter().map(hash).collect();
        if hashes.len() > 1 {
            notes.push(
                "the results are of several protocols: none of them declares the level or the family for all, and the report does not speak of one study."
                    .to_owned(),
            );
            return (None, None);
        }
        let Some(study) = self.all.iter().find(|study| study.protocol.is_some()) else {
            return (self.all.first().and_then(Study::known), None);
        };
        let Some(protocol) = &study.protocol else {
            return (None, None);
        };
        let versions: BTreeSet<&String> = self.all.iter().flat_map(|it| &it.versions).collect();
        let facts = StudyFacts {
            versions: versions.into_iter().cloned().collect(),
            participants_told: self.told(protocol, participants, notes),
            ..said(protocol)
        };
        (Some(facts), declared(protocol))
    }

    /// What the analysed participants told of themselves: every question with choices, every
    /// choice with its number. Free text is nobody's business here.
    fn told(
        &self,
        protocol: &Protocol,
        participants: &[String],
        notes: &mut Vec<String>,
    ) -> Vec<(String, Vec<(String, u32)>)> {
        let mut abouts = Vec::new();
        for study in &self.all {
            if !study.folder.join(about::ABOUT_FOLDER).is_dir() {
                continue;
            }
            for id in participants
                .iter()
                .filter(|id| study.tallies.contains_key(*id))
            {
                let Ok(id) = ParticipantId::new(id) else {
                    continue;
                };
                match about::load(&study.folder, &id) {
                    Ok(about) => abouts.extend(about),
                    Err(error) => notes.push(format!("passed over: {error}")),
                }
            }
        }
        if abouts.is_empty() {
            return Vec::new();
        }
        let with_choices = protocol.metadata.iter().filter(|it| !it.choices.is_empty());
        with_choices
            .map(|field| {
                let words = protocol.texts.metadata.get(&*field.id);
                let label = words.map_or(&*field.id, |words| &*words.label);
                let answer = |about: &about::About| {
                    let found = about.answers.iter().find(|it| it.id == *field.id)?;
                    field.choices.iter().position(|it| **it == *found.answer)
                };
                let mut counts = vec![0; field.choices.len()];
                let mut silent = 0;
                for about in &abouts {
                    *answer(about).map_or(&mut silent, |at| &mut counts[at]) += 1;
                }
                let said = |at: usize| {
                    let shown = words.and_then(|words| words.choices.get(at));
                    shown.map_or(&*field.choices[at], |text| &**text).to_owned()
                };
                let mut answers: Vec<(String, u32)> = (0..).map(said).zip(counts).collect();
                if silent > 0 {
                    answers.push(("no answer".to_owned(), silent));
                }
                (label.to_owned(), answers)
            })
            .collect()
    }
}

impl Study {
    /// Takes note of a row that nobody has set aside.
    pub fn see(&mut self, row: &TrialRow) {
        if !self.versions.contains(&row.app_version) {
            self.versions.insert(row.app_version.clone());
        }
        if !self.tallies.contains_key(&row.participant_id) {
            self.tallies
                .insert(row.participant_id.clone(), Tally::default());
        }
        let Some(tally) = self.tallies.get_mut(&row.participant_id) else {
            return;
        };
        match row.phase {
            Phase::Practice => {}
            Phase::Catch => {
                tally.catch += 1;
                tally.catch_right += u32::from(row.correct == Some(true));
            }
            Phase::Main => tally.main += 1,
        }
    }

    /// What is known without the protocol.
    fn known(&self) -> Option<StudyFacts> {
        let identity = self.identity.as_ref()?;
        Some(StudyFacts {
            id: identity.study_id.clone(),
            protocol_sha256: identity.protocol_hash.clone(),
            versions: self.versions.iter().cloned().collect(),
            ..StudyFacts::default()
        })
    }
}

/// What a protocol says of the study.
fn said(protocol: &Protocol) -> StudyFacts {
    StudyFacts {
        id: protocol.study_id.to_string(),
        protocol_sha256: protocol.hash.clone(),
        question: protocol.texts.question.to_string(),
        procedure: protocol.procedure.name.to_owned(),
        design: format!("{}, {}", protocol.design.name, protocol.inner_order.name()),
        seed: protocol.seed,
        planned_participants: protocol.planned_participants.get(),
        hypotheses: (protocol.hypotheses.iter())
            .map(|(name, text)| (name.clone(), text.to_string()))
            .collect(),
        ..StudyFacts::default()
    }
}

/// The level and the family that a protocol declares.
fn declared(protocol: &Protocol) -> Option<Declared> {
    let plan = protocol.analysis.as_ref()?;
    // Every level that a protocol can hold is an alpha.
    let alpha = plan
        .alpha
        .and_then(|level| Alpha::try_from(level.get()).ok());
    (alpha.is_some() || !plan.family.is_empty()).then(|| Declared {
        alpha,
        family: plan.family.clone(),
    })
}

fn identity(folder: &Path) -> Result<Option<StudyIdentity>, InputError> {
    let path = folder.join(STUDY_FILE);
    if !path.is_file() {
        return Ok(None);
    }
    let text =
        std::fs::read_to_string(&path).map_err(|error| InputError::unreadable(&path, error))?;
    serde_json::from_str(&text)
        .map(Some)
        .map_err(|error| InputError::whole(&path, format!("not a study: {error}")))
}

/// The protocol kept with the data, if it is the one that the study was begun with. Where it is
/// not there, or not the same any more, a note says that none of its rules is applied.
fn protocol(
    folder: &Path,
    identity: Option<&StudyIdentity>,
    notes: &mut Vec<String>,
) -> Option<Protocol> {
    const MEND: &str =
        "no rule of it is applied; put back the protocol's file that the study was begun with";
    let path = folder.join(PROTOCOL_FILE);
    if identity.is_none() && !path.is_file() {
        return None;
    }
    let parsed = config::read(&path).and_then(|text| Protocol::parse(&path, &text));
    match (parsed, identity) {
        (Ok(protocol), Some(identity)) if protocol.hash != identity.protocol_hash => {
            notes.push(format!(
                "{}: its SHA-256 is not the one in {STUDY_FILE}: it was changed. {MEND}.",
                path.display()
            ));
            None
        }
        (Ok(protocol), _) => Some(protocol),
        (Err(error), _) => {
            notes.push(format!("{error}; {MEND}."));
            None
        }
    }
}
