//! Did every participant answer everything, once, by looking, and by the rules?

use super::{Check, Verdict};
use crate::analysis::conclusion::{listed, p_text, plural};
use crate::analysis::dataset::{Answer, Dataset};
use crate::analysis::table::Undefined;
use crate::analysis::tails::{Alpha, Binomial};
use crate::protocol::Position;

/// Faster than people see, decide and press (Luce 1986, Response Times).
const FASTEST_MS: f32 = 200.0;
/// Fewer equal answers are no duplicate.
const FEWEST_ANSWERS: u32 = 3;
/// Notes of the reader that are listed one by one.
const MOST_NOTES: usize = 20;

const NO_TIMES: Undefined = Undefined::not_available("no response times");

/// Of the participants, where single answers are known; of exclusions and the reader's notes.
pub fn checks(data: &Dataset, alpha: Alpha) -> Vec<Check> {
    let mut checks = if data.has_answers() {
        let people = People::of(data);
        vec![
            people.complete(data),
            people.duplicates(data),
            people.straight(data, alpha),
            people.fast(),
        ]
    } else {
        vec![Check::undefined("participants", Undefined::COUNTS_ONLY)]
    };
    checks.extend(exclusions(data));
    checks.extend(notes(data));
    checks
}

/// What one participant did.
#[derive(Clone, Copy, Default)]
struct Person {
    trials: u32,
    answered: u32,
    first: u32,
    timed: u32,
    /// Sum of a hash of every trial, so that the order of rows does not matter.
    fingerprint: u64,
}

struct People {
    people: Vec<Person>,
    timed: u64,
    fast: u64,
    zero: u64,
}

impl People {
    fn of(data: &Dataset) -> Self {
        let last = data.answers.iter().map(|a| a.participant).max();
        let mut all = Self {
            people: vec![Person::default(); last.map_or(0, |last| last as usize + 1)],
            timed: 0,
            fast: 0,
            zero: 0,
        };
        for answer in &data.answers {
            let person = &mut all.people[answer.participant as usize];
            person.trials += 1;
            person.answered += u32::from(answer.chosen.is_some());
            person.first += u32::from(answer.chosen == Some(Position::First));
            person.timed += u32::from(answer.response_time_ms.is_some());
            person.fingerprint = person.fingerprint.wrapping_add(fingerprint(answer));
            if let Some(time) = answer.response_time_ms {
                all.timed += 1;
                all.fast += u64::from(time < FASTEST_MS);
                all.zero += u64::from(time <= 0.0);
            }
        }
        all
    }

    /// Ids of the participants that are wanted; a number where there is no id.
    fn ids(&self, data: &Dataset, wanted: impl Fn(&Person) -> bool) -> Vec<String> {
        (self.people.iter().enumerate())
            .filter(|(_, person)| wanted(person))
            .map(|(i, _)| id(data, i))
            .collect()
    }

    fn complete(&self, data: &Dataset) -> Check {
        let conditions = data.conditions.len();
        let missing = self.ids(data, |person| (person.answered as usize) < conditions);
        let all = plural(self.people.len(), "participant");
        if missing.is_empty() {
            let finding = format!(
                "all of {all} answered all of {}",
                plural(conditions, "condition")
            );
            return Check::new("complete answers", Verdict::Ok, finding);
        }
        Check::new(
            "complete answers",
            Verdict::Note,
            format!(
                "{} of {all} did not answer all of {}: {}",
                missing.len(),
                plural(conditions, "condition"),
                listed_strings(&missing),
            ),
        )
    }

    /// Two participants with the same answers and the same times, to the last digit.
    fn duplicates(&self, data: &Dataset) -> Check {
        const CHECK: &str = "duplicate participants";
        let mut timed: Vec<(u64, usize)> = (self.people.iter().enumerate())
            .filter(|(_, person)| person.timed == person.trials && person.trials >= FEWEST_ANSWERS)
            .map(|(i, person)| (person.fingerprint, i))
            .collect();
        if timed.is_empty() {
            const WHY: Undefined = Undefined::not_available(
                "needs participants with three answers or more, all with response times",
            );
            return Check::undefined(CHECK, WHY);
        }
        timed.sort_unstable();
        let pairs: Vec<String> = (timed.windows(2))
            .filter(|pair| pair[0].0 == pair[1].0)
            .map(|pair| format!("{} and {}", id(data, pair[0].1), id(data, pair[1].1)))
            .collect();
        if pairs.is_empty() {
            let finding = "no two participants have the same answers and response times".to_owned();
            return Check::new(CHECK, Verdict::Ok, finding);
        }
        let finding = format!(
            "the same answers and response times throughout: {}",
            listed_strings(&pairs)
        );
        Check::new(CHECK, Verdict::Note, finding)
    }

    /// Whoever chose one position throughout, in more answers than chance would do at alpha.
    fn straight(&self, data: &Dataset, alpha: Alpha) -> Check {
        const CHECK: &str = "one position throughout";
        let chance = |person: &Person| 2.0 * 0.5_f64.powf(f64::from(person.answered));
        let enough = |person: &&Person| person.answered > 1 && chance(person) <= alpha.get();
        let able: Vec<&Person> = self.people.iter().filter(enough).collect();
        let Some(one) = able.first() else {
            const WHY: Undefined = Undefined::not_available(
                "no participant has so many answers that one position throughout would be unlikely",
            );
            return Check::undefined(CHECK, WHY);
        };
        let straight = |person: &Person| {
            enough(&person) && (person.first == 0 || person.first == person.answered)
        };
        let found = self.ids(data, straight);
        let expected: f64 = able.iter().map(|person| chance(person)).sum();
        let first = self
            .ids(data, |person| straight(person) && person.first > 0)
            .len();
        let mut finding = format!(
            "{} of {}: always first {first}, always second {}; {expected:.2} expected by chance",
            found.len(),
            plural(able.len(), "participant"),
            found.len() - first,
        );
        if found.is_empty() {
            return Check::new(CHECK, Verdict::Ok, finding);
        }
        // With as many answers each, their number is binomial.
        if able.iter().all(|person| person.answered == one.answered)
            && let (Ok(n), Ok(k)) = (u32::try_from(able.len()), u32::try_from(found.len()))
            && let Some(by_chance) = Binomial::new(n, chance(one))
        {
            finding += &format!(
                " (p {} each, p {} for so many)",
                p_text(crate::analysis::tails::Probability::from_ln(
                    chance(one).ln()
                )),
                p_text(by_chance.upper_tail(k)),
            );
        }
        finding += &format!(": {}", listed_strings(&found));
        Check::new(CHECK, Verdict::Note, finding)
    }

    fn fast(&self) -> Check {
        const CHECK: &str = "response times";
        if self.timed == 0 {
            return Check::undefined(CHECK, NO_TIMES);
        }
        let verdict = if self.fast == 0 {
            Verdict::Ok
        } else {
            Verdict::Note
        };
        let zero = if self.zero > 0 {
            format!(", {} of them 0 or less", self.zero)
        } else {
            String::new()
        };
        let finding = format!(
            "under {FASTEST_MS} ms: {} of {} trials with a time{zero}",
            self.fast, self.timed
        );
        Check::new(CHECK, verdict, finding)
    }
}

fn id(data: &Dataset, participant: usize) -> String {
    (data.participants.get(participant)).map_or_else(|| format!("#{participant}"), Clone::clone)
}

fn listed_strings(texts: &[String]) -> String {
    listed(&texts.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Condition, order, choice and time, mixed so that sums of them do not collide: two different
/// participants look alike with probability 2⁻⁶⁴. The finalizer of SplitMix64 (Steele, Lea & Flood
/// 2014).
fn fingerprint(answer: &Answer) -> u64 {
    fn mix(mut x: u64) -> u64 {
        x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
        x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ x >> 31
    }
    let time = answer.response_time_ms.map_or(u32::MAX, f32::to_bits);
    let choice = match answer.chosen {
        None => 2,
        Some(position) => position.place() as u64,
    };
    let choice = 4 * choice + answer.order as u64;
    mix(mix(u64::from(answer.condition) << 32 | u64::from(time)) ^ choice)
}

/// One check a rule, also for a rule that touched nobody.
fn exclusions(data: &Dataset) -> Vec<Check> {
    const CHECK: &str = "exclusions";
    if data.exclusions.is_empty() {
        let none = "nothing was left out by a declared rule".to_owned();
        return vec![Check::new(CHECK, Verdict::Ok, none)];
    }
    (data.exclusions.iter())
        .map(|rule| {
            let touched = rule.trials > 0 || !rule.participants.is_empty();
            let who = if rule.participants.is_empty() {
                String::new()
            } else {
                format!(" ({})", listed_strings(&rule.participants))
            };
            let finding = format!(
                "{}: {}{who}, {} trials",
                rule.rule.trim_end_matches('.'),
                plural(rule.participants.len(), "participant"),
                rule.trials,
            );
            let verdict = if touched { Verdict::Note } else { Verdict::Ok };
            Check::new(CHECK, verdict, finding)
        })
        .collect()
}

/// What the reader noted: scripted answers, pilot sessions, damaged lines, unread columns.
fn notes(data: &Dataset) -> Vec<Check> {
    const CHECK: &str = "input";
    if data.notes.is_empty() {
        let none = "every row was used as it is".to_owned();
        return vec![Check::new(CHECK, Verdict::Ok, none)];
    }
    let mut checks: Vec<Check> = (data.notes.iter().take(MOST_NOTES))
        .map(|note| Check::new(CHECK, Verdict::Note, note.trim_end_matches('.').to_owned()))
        .collect();
    if data.notes.len() > MOST_NOTES {
        let more = format!("{} notes more", data.notes.len() - MOST_NOTES);
        checks.push(Check::new(CHECK, Verdict::Note, more));
    }
    checks
}
