//! Rules that leave data out, laid down before: who has failed the attention checks, who has
//! answered too little, what was answered too fast or too slowly. They are applied in that order;
//! what one has left out the next does not count again.

use std::collections::{BTreeMap, BTreeSet};

use super::Options;
use super::files::{Files, Place};
use crate::analysis::dataset::Exclusion;
use crate::protocol::Protocol;

/// What one participant's rows of a study tell the rules.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    /// Catch trials answered.
    pub catch: u32,
    /// Of them right.
    pub catch_right: u32,
    /// Main trials answered.
    pub main: u32,
}

/// The rules for the rows of one study, or of all tables.
#[derive(Debug, Default)]
pub struct Rules {
    /// Their words, in the order they are applied.
    texts: Vec<String>,
    /// Participants that a rule leaves out, by id: the number of the first such rule.
    out: BTreeMap<String, usize>,
    /// Response times under this many milliseconds, and the rule that leaves them out.
    minimum: Option<(f32, usize)>,
    /// Response times over this.
    maximum: Option<(f32, usize)>,
}

impl Rules {
    /// Those that were chosen for this analysis alone.
    pub fn chosen(options: Options) -> Self {
        let mut rules = Self::default();
        rules.limit_times(options, None);
        rules
    }

    /// Those of a study's protocol, given what its participants did.
    pub fn of_protocol(
        protocol: &Protocol,
        tallies: &BTreeMap<String, Tally>,
        options: Options,
    ) -> Self {
        let mut rules = Self::default();
        let study = &*protocol.study_id;
        let plan = protocol.analysis.as_ref();
        if let Some(catch) = &protocol.catch
            && plan.is_some_and(|plan| plan.exclude_failed_catch)
        {
            let (needed, there) = (catch.minimum_correct.get(), catch.trials.len());
            // Nobody has failed who can still pass.
            let failed = |tally: &Tally| {
                let wrong = tally.catch.saturating_sub(tally.catch_right) as usize;
                there.saturating_sub(wrong) < needed as usize
            };
            let text = format!(
                "participants with fewer than {needed} of {there} catch trials right (protocol of {study}: analysis.exclude_failed_catch)"
            );
            rules.leave_out(text, tallies, failed);
        }
        if let Some(needed) = plan.and_then(|plan| plan.minimum_main_trials) {
            let needed = needed.get();
            let text = format!(
                "participants with fewer than {needed} answered main trials (protocol of {study}: analysis.minimum_main_trials)"
            );
            rules.leave_out(text, tallies, |tally| tally.main < needed);
        }
        rules.limit_times(options, Some(protocol));
        rules
    }

    fn leave_out(
        &mut self,
        text: String,
        tallies: &BTreeMap<String, Tally>,
        is_out: impl Fn(&Tally) -> bool,
    ) {
        let rule = self.texts.len();
        self.texts.push(text);
        for (id, _) in tallies.iter().filter(|(_, tally)| is_out(tally)) {
            self.out.entry(id.clone()).or_insert(rule);
        }
    }

    /// The limits of the response time: those chosen, else the protocol's.
    fn limit_times(&mut self, options: Options, protocol: Option<&Protocol>) {
        let plan = protocol.and_then(|protocol| Some((protocol, protocol.analysis.as_ref()?)));
        let declared = |ms: Option<u32>| ms.map(f64::from);
        for (is_minimum, chosen, declared, name) in [
            (
                true,
                options.minimum_response_ms,
                declared(
                    plan.and_then(|(_, it)| it.minimum_response_ms)
                        .map(|it| it.get()),
                ),
                "minimum_response_ms",
            ),
            (
                false,
                options.maximum_response_ms,
                declared(
                    plan.and_then(|(_, it)| it.maximum_response_ms)
                        .map(|it| it.get()),
                ),
                "maximum_response_ms",
            ),
        ] {
            let Some(limit) = chosen.or(declared) else {
                continue;
            };
            let source = match (chosen, declared, plan) {
                (Some(_), Some(declared), _) => {
                    format!("chosen for this analysis, in place of the protocol's {declared} ms")
                }
                (None, _, Some((protocol, _))) => {
                    format!("protocol of {}: analysis.{name}", &*protocol.study_id)
                }
                _ => "chosen for this analysis".to_owned(),
            };
            let compared = if is_minimum { "less" } else { "more" };
            let rule = self.texts.len();
            self.texts.push(format!(
                "trials answered in {compared} than {limit} ms ({source})"
            ));
            let at = if is_minimum {
                &mut self.minimum
            } else {
                &mut self.maximum
            };
            *at = Some((limit as f32, rule));
        }
    }

    /// The rule that leaves a trial out, if one does.
    fn applies(&self, out: Option<usize>, time: Option<f32>) -> Option<usize> {
        out.or_else(|| {
            let time = time?;
            let fast = self.minimum.filter(|(limit, _)| time < *limit);
            let slow = self.maximum.filter(|(limit, _)| time > *limit);
            fast.or(slow).map(|(_, rule)| rule)
        })
    }
}

/// Passes trials through the rules of what they are of, and counts what is left out.
pub struct Sieve<'a> {
    files: &'a Files,
    rules: &'a [Rules],
    /// For every origin and participant number: the rule that leaves the participant out.
    out: Vec<Vec<Option<usize>>>,
    /// For every origin and rule: whom it touched and how many trials.
    touched: Vec<Vec<(BTreeSet<u32>, u64)>>,
    /// Trials that no limit of the response time could be held to.
    untimed: u64,
}

impl<'a> Sieve<'a> {
    /// A sieve for trials of these participants, or `None` where no rule was laid down.
    pub fn new(rules: &'a [Rules], files: &'a Files, participants: &[String]) -> Option<Self> {
        if rules.iter().all(|rules| rules.texts.is_empty()) {
            return None;
        }
        let out_of = |rules: &Rules| {
            let rule = |id: &String| rules.out.get(id).copied();
            participants.iter().map(rule).collect()
        };
        Some(Self {
            files,
            rules,
            out: rules.iter().map(out_of).collect(),
            touched: rules
                .iter()
                .map(|rules| vec![Default::default(); rules.texts.len()])
                .collect(),
            untimed: 0,
        })
    }

    /// Whether a trial stays. `trials` is 1, or 0 where this is one more answer of the trial
    /// before.
    pub fn keeps(
        &mut self,
        place: Place,
        participant: u32,
        time: Option<f32>,
        trials: u64,
    ) -> bool {
        let origin = self.files.origin(place);
        let rules = &self.rules[origin];
        let out = self.out[origin][participant as usize];
        if let Some(rule) = rules.applies(out, time) {
            let (whom, count) = &mut self.touched[origin][rule];
            whom.insert(participant);
            *count += trials;
            return false;
        }
        if time.is_none() && (rules.minimum.is_some() || rules.maximum.is_some()) {
            self.untimed += trials;
        }
        true
    }

    /// Every rule and what it left out, and a note on what could not be held to one. A rule that
    /// names a participant of whom there is no trial to analyse names them all the same.
    pub fn finish(self, participants: &[String]) -> (Vec<Exclusion>, Option<String>) {
        let mut exclusions: Vec<Exclusion> = Vec::new();
        for (origin, (rules, touched)) in self.rules.iter().zip(self.touched).enumerate() {
            if !self.files.are_of(origin) {
                continue;
            }
            for (rule, (text, (whom, trials))) in rules.texts.iter().zip(touched).enumerate() {
                let named = whom.iter().map(|&at| participants[at as usize].clone());
                let mut ids: BTreeSet<String> = named.collect();
                let without_trial = rules.out.iter().filter(|(_, by)| **by == rule);
                ids.extend(without_trial.map(|(id, _)| id.clone()));
                // Several folders of one study have one rule.
                if let Some(known) = exclusions.iter_mut().find(|it| it.rule == *text) {
                    ids.extend(known.participants.drain(..));
                    known.participants.extend(ids);
                    known.trials += trials;
                } else {
                    exclusions.push(Exclusion {
                        rule: text.clone(),
                        participants: ids.into_iter().collect(),
                        trials,
                    });
                }
            }
        }
        let note = (self.untimed > 0).then(|| {
            format!(
                "{} trials have no response time; no limit of it could be held to them, and they count.",
                self.untimed
            )
        });
        (exclusions, note)
    }
}
