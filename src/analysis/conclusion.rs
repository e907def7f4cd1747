//! What the main result is, in sentences.

use super::chi_square::FEWEST_VOTES;
use super::conditions::{Family, Verdict, main_family, tests};
use super::dataset::{Dataset, Rank};
use super::holm;
use super::rankings;
use super::ratings;
use super::settings::Settings;
use super::tails::Probability;

/// A p-value for running text: three decimals, a power of ten where that would be 0.
#[must_use]
pub fn p_text(p: Probability) -> String {
    if p.value() >= 0.0005 {
        format!("{:.3}", p.value())
    } else {
        let exponent = p.log10().floor();
        format!("{:.1}e{exponent}", 10_f64.powf(p.log10() - exponent))
    }
}

/// The main result: who answered, what differs from an even split before and after Holm. Of
/// ratings and rankings: whether they differ between the techniques.
#[must_use]
pub fn sentences(data: &Dataset, settings: &Settings) -> Vec<String> {
    if data.conditions.is_empty() {
        let mut sentences: Vec<String> = judged(data).into_iter().collect();
        sentences.extend(rankings::main_result(data, settings));
        sentences.extend(ratings::main_results(data, settings));
        return sentences;
    }
    let mut sentences = vec![who(data)];
    let tested = main_family(data, settings).size();
    if tested == 0 {
        sentences.push("No condition has a vote, so nothing was tested.".to_owned());
        return sentences;
    }
    for test in tests() {
        let family = Family::new(&test, &holm::CORRECTION, data, settings);
        let name = if test.p_key == "p_exact" {
            "exact binomial test"
        } else {
            "chi-square test"
        };
        sentences.push(of_test(name, &family, data, settings));
    }
    sentences.extend(by_hypothesis(data, settings));
    sentences.extend(few_votes(data));
    sentences
}

/// What was rated or ranked, and by how many.
fn judged(data: &Dataset) -> Option<String> {
    let participants = plural(data.participants.len(), "participant");
    let (ratings, rankings) = (&data.ratings, &data.rankings);
    if !ratings.answers.is_empty() {
        return Some(format!(
            "{participants} rated {} in {} on {}: {}.",
            plural(ratings.techniques.len(), "technique"),
            plural(ratings.conditions.len(), "condition"),
            plural(ratings.scales.len(), "scale"),
            plural(ratings.answers.len(), "rating"),
        ));
    }
    let of_one = |one: &Rank, other: &Rank| {
        (one.participant, one.condition) == (other.participant, other.condition)
    };
    (!rankings.answers.is_empty()).then(|| {
        format!(
            "{participants} ranked {} in {}: {}.",
            plural(rankings.techniques.len(), "technique"),
            plural(rankings.conditions.len(), "condition"),
            plural(rankings.answers.chunk_by(of_one).count(), "ranking"),
        )
    })
}

fn who(data: &Dataset) -> String {
    let votes: u64 = data
        .conditions
        .iter()
        .map(|condition| u64::from(condition.votes.total()))
        .sum();
    let conditions = plural(data.conditions.len(), "condition");
    if data.participants.is_empty() {
        return format!("{conditions}, {votes} votes; participants are not known from counts.");
    }
    let missing: u64 = data
        .conditions
        .iter()
        .filter_map(|condition| condition.orders)
        .map(|orders| u64::from(orders.missing))
        .sum();
    let missing = match missing {
        0 => String::new(),
        some => format!(", {some} without an answer"),
    };
    let trials = data.answers.len();
    format!(
        "{conditions}, {}, {}{missing}.",
        plural(data.participants.len(), "participant"),
        plural(trials, "trial"),
    )
}

fn of_test(name: &str, family: &Family, data: &Dataset, settings: &Settings) -> String {
    let with = |wanted: &dyn Fn(Verdict) -> bool| -> Vec<&str> {
        (0..data.conditions.len())
            .filter(|&i| wanted(family.verdict(i, settings)))
            .map(|i| data.conditions[i].id.as_str())
            .collect()
    };
    let before = with(&|v| matches!(v, Verdict::Significant | Verdict::OnlyUncorrected));
    let after = with(&|v| v == Verdict::Significant);
    let smallest = family
        .corrected
        .iter()
        .filter_map(|p| p.ok())
        .fold(Probability::ONE, Probability::min);
    let alpha = settings.alpha.get();
    let tested = family.size();
    let Some(found) = some_of(&before) else {
        let none = match tested {
            1 => "the condition does not differ".to_owned(),
            _ => format!("none of {} differs", plural(tested, "condition")),
        };
        return format!(
            "By the {name} {none} from an even split at alpha = {alpha}, even before correction."
        );
    };
    match some_of(&after) {
        None => format!(
            "By the {name} {found} from an even split at alpha = {alpha} before correction; after Holm's correction over the family of {tested} none stays significant (smallest corrected p {}).",
            p_text(smallest),
        ),
        Some(_) => format!(
            "By the {name} {found} from an even split at alpha = {alpha} before correction; after Holm's correction over the family of {tested}, {} significant: {} (smallest corrected p {}).",
            if after.len() == 1 {
                "1 stays".to_owned()
            } else {
                format!("{} stay", after.len())
            },
            listed(&after),
            p_text(smallest),
        ),
    }
}

fn some_of(ids: &[&str]) -> Option<String> {
    match ids.len() {
        0 => None,
        1 => Some(format!("1 condition ({}) differs", listed(ids))),
        n => Some(format!("{n} conditions ({}) differ", listed(ids))),
    }
}

/// Names, at most eight of them.
pub(super) fn listed(ids: &[&str]) -> String {
    const MOST: usize = 8;
    if ids.len() <= MOST {
        ids.join(", ")
    } else {
        format!("{} and {} more", ids[..MOST].join(", "), ids.len() - MOST)
    }
}

/// One sentence a hypothesis the input names, in order of appearance.
fn by_hypothesis(data: &Dataset, settings: &Settings) -> Vec<String> {
    let family = main_family(data, settings);
    let mut names: Vec<&str> = Vec::new();
    for name in data
        .conditions
        .iter()
        .filter_map(|c| c.hypothesis.as_deref())
    {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.sort_unstable();
    names
        .into_iter()
        .map(|name| {
            let of: Vec<usize> = (0..data.conditions.len())
                .filter(|&i| data.conditions[i].hypothesis.as_deref() == Some(name))
                .collect();
            let towards_b = of
                .iter()
                .filter(|&&i| data.conditions[i].votes.b > data.conditions[i].votes.a)
                .count();
            let significant = of
                .iter()
                .filter(|&&i| family.verdict(i, settings) == Verdict::Significant)
                .count();
            format!(
                "{name}: in {towards_b} of {} technique b has more votes; significant after Holm (exact): {}.",
                plural(of.len(), "condition"),
                match significant {
                    0 => "none".to_owned(),
                    n => n.to_string(),
                },
            )
        })
        .collect()
}

fn few_votes(data: &Dataset) -> Option<String> {
    let few: Vec<&str> = data
        .conditions
        .iter()
        .filter(|c| (1..FEWEST_VOTES).contains(&c.votes.total()))
        .map(|c| c.id.as_str())
        .collect();
    (!few.is_empty()).then(|| {
        format!(
            "Fewer than {FEWEST_VOTES} votes in {}: the chi-square approximation is poor there, use the exact p.",
            listed(&few),
        )
    })
}

/// `1 condition`, `7 conditions`.
pub(crate) fn plural(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}
