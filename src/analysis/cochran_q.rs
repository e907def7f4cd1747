//! Cochran's Q: do the conditions that compare the same two techniques, answered by the same
//! participants, all have the same share? McNemar's test for more than two conditions.

use super::conclusion::p_text;
use super::dataset::Dataset;
use super::holm;
use super::statistic::{About, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Status, Style, Table, Undefined};
use super::tails::{Probability, chi_square_upper};

mod exact;

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "cochran_q",
        name: "Cochran's Q between the conditions of one technique pair",
        formula: "Q = (k − 1) (k Σ C² − T²)/(k T − Σ R²) over k conditions; C, R: votes for b by condition and by participant, T all of them; chi-square with k − 1 degrees of freedom, and the exact p over all ways to share out each participant's votes",
        source: "W. G. Cochran (1950), Biometrika 37(3/4), 256–266; M. W. Tate, S. M. Brown (1970), JASA 65(329), 155–160",
        validity: "participants who answered all k conditions; chi-square is poor under 4 participants who chose differently, or under 24 of their answers: there the exact p is to be used",
    },
    section,
};

const INCOMPLETE: Undefined =
    Undefined::degenerate("no participant answered all conditions of the pair");
const ALL_ALIKE: Undefined =
    Undefined::degenerate("every participant chose alike in all conditions of the pair");
const TOO_MANY: Undefined =
    Undefined::not_available("too many ways to share out the votes; chi-square holds here");

/// The conditions of one technique pair, and the votes of those who answered them all.
struct Family<'a> {
    technique_a: &'a str,
    technique_b: &'a str,
    /// Indices of the conditions.
    conditions: Vec<usize>,
    /// Votes for b by condition.
    columns: Vec<u64>,
    /// How many participants gave b so many votes: 0 to k.
    participants: Vec<u64>,
}

impl Family<'_> {
    fn complete(&self) -> u64 {
        self.participants.iter().sum()
    }

    /// Participants who did not choose alike everywhere.
    fn discordant(&self) -> u64 {
        let k = self.conditions.len();
        self.participants[1..k].iter().sum()
    }

    /// Whether chi-square is a fair approximation (Tate & Brown 1970).
    fn is_large(&self) -> bool {
        self.discordant() >= 4 && self.discordant() * self.conditions.len() as u64 >= 24
    }

    fn statistic(&self) -> Result<f64, Undefined> {
        if self.complete() == 0 {
            return Err(INCOMPLETE);
        }
        // Whole numbers: C, T < 2^32 · k.
        let k = self.conditions.len() as u128;
        let total: u128 = self.columns.iter().map(|c| u128::from(*c)).sum();
        let squares: u128 = self.columns.iter().map(|c| u128::from(*c).pow(2)).sum();
        let within: u128 = (0_u128..)
            .zip(&self.participants)
            .map(|(r, count)| r * (k - r) * u128::from(*count))
            .sum();
        if within == 0 {
            return Err(ALL_ALIKE);
        }
        Ok((k - 1) as f64 * (k * squares - total * total) as f64 / within as f64)
    }

    fn df(&self) -> u32 {
        u32::try_from(self.conditions.len() - 1).unwrap_or(u32::MAX)
    }
}

fn section(context: &Context<'_>) -> Option<Section> {
    let data = context.data;
    if !data.has_answers() {
        return None;
    }
    let families = families(data);
    if families.is_empty() {
        return None;
    }
    let tests: Vec<Test> = families.iter().map(Test::of).collect();
    let used: Vec<Probability> = tests.iter().filter_map(|test| test.used().ok()).collect();
    let mut adjusted = holm::adjust(&used).into_iter();
    let adjusted: Vec<_> = (tests.iter())
        .map(|test| test.used().map(|p| adjusted.next().unwrap_or(p)))
        .collect();
    let findings = (families.iter().zip(&tests).zip(&adjusted))
        .map(|((family, test), adjusted)| finding(family, test, *adjusted, families.len()))
        .collect();
    let rows = (families.iter().zip(&tests).zip(&adjusted))
        .map(|((family, test), adjusted)| row(data, family, test, *adjusted))
        .collect();
    Some(Section {
        id: "cochran_q",
        title: "Same techniques, several conditions",
        status: if used.is_empty() {
            Status::Degenerate
        } else {
            Status::Ok
        },
        findings,
        tables: vec![SectionTable {
            id: "families",
            caption: "Cochran's Q; “differing”: participants who did not choose the same technique in all of the conditions; Holm over the exact p, or chi-square's where there is no exact one",
            long: false,
            table: Table {
                columns: columns(),
                rows,
            },
        }],
    })
}

/// Q and its p.
struct Test {
    q: Result<f64, Undefined>,
    chi_square: Result<Probability, Undefined>,
    exact: Result<Probability, Undefined>,
}

impl Test {
    fn of(family: &Family<'_>) -> Self {
        let q = family.statistic();
        Self {
            q,
            chi_square: q.map(|q| chi_square_upper(q, family.df())),
            exact: q.and_then(|_| exact::p(&family.columns, &family.participants).ok_or(TOO_MANY)),
        }
    }

    /// The exact p where there is one.
    fn used(&self) -> Result<Probability, Undefined> {
        self.exact.or(self.chi_square)
    }
}

fn finding(
    family: &Family<'_>,
    test: &Test,
    adjusted: Result<Probability, Undefined>,
    families: usize,
) -> String {
    let k = family.conditions.len();
    let pair = format!("{} against {}", family.technique_a, family.technique_b);
    let (q, p, adjusted) = match (test.q, test.chi_square, adjusted) {
        (Ok(q), Ok(p), Ok(adjusted)) => (q, p, adjusted),
        (Err(why), ..) | (_, Err(why), _) | (.., Err(why)) => {
            return format!("{pair}, {k} conditions: not tested, {}.", why.reason);
        }
    };
    let exact = match test.exact {
        Ok(p) => format!(", exact p {}", p_text(p)),
        Err(_) => String::new(),
    };
    let holm = if families > 1 {
        format!(
            "; after Holm's correction over {families} technique pairs {}",
            p_text(adjusted)
        )
    } else {
        String::new()
    };
    let poor = match (family.is_large(), test.exact.is_ok()) {
        (true, _) => "",
        (false, true) => " The chi-square p is a poor approximation here; the exact one holds.",
        (false, false) => " The chi-square p is a poor approximation here.",
    };
    format!(
        "{pair}, {k} conditions: Cochran's Q({}) = {q:.3}, p {}{exact}{holm}; {} participants answered all, {} of them chose differently.{poor}",
        family.df(),
        p_text(p),
        family.complete(),
        family.discordant(),
    )
}

fn columns() -> Vec<Column> {
    vec![
        Column::new("technique_a", "technique a", Style::Text, Group::Key),
        Column::new("technique_b", "technique b", Style::Text, Group::Key),
        Column::new("conditions", "conditions", Style::Text, Group::Choices),
        Column::new("participants", "answered all", Style::Count, Group::Choices),
        Column::new("discordant", "differing", Style::Count, Group::Choices),
        Column::new("q", "Q", Style::UpTo(6), Group::Tests),
        Column::new("df", "df", Style::Count, Group::Tests),
        Column::new("p_chi_square", "p χ²", Style::P, Group::Tests),
        Column::new("p_exact", "p exact", Style::P, Group::Tests),
        Column::new("p_holm", "Holm", Style::P, Group::Tests),
    ]
}

fn row(
    data: &Dataset,
    family: &Family<'_>,
    test: &Test,
    adjusted: Result<Probability, Undefined>,
) -> Vec<Cell> {
    let ids: Vec<&str> = (family.conditions.iter())
        .map(|i| data.conditions[*i].id.as_str())
        .collect();
    let count = |n: u64| Cell::Count(u32::try_from(n).unwrap_or(u32::MAX));
    vec![
        Cell::Text(family.technique_a.to_owned()),
        Cell::Text(family.technique_b.to_owned()),
        Cell::Text(super::conclusion::listed(&ids)),
        count(family.complete()),
        count(family.discordant()),
        Cell::or_undefined(test.q, Cell::Number),
        Cell::Count(family.df()),
        Cell::or_undefined(test.chi_square, Cell::Probability),
        Cell::or_undefined(test.exact, Cell::Probability),
        Cell::or_undefined(adjusted, Cell::Probability),
    ]
}

/// Technique pairs with three conditions or more, in order of their first condition. Its base order
/// says which technique is b.
fn families(data: &Dataset) -> Vec<Family<'_>> {
    let by_techniques = data.by_techniques();
    let mut groups: Vec<Vec<usize>> = by_techniques
        .into_values()
        .filter(|g| g.len() > 2)
        .collect();
    groups.sort_unstable();
    if groups.is_empty() {
        return Vec::new();
    }
    let choices = super::mcnemar::choices_by_condition(data);
    let mut counters = vec![(0_u32, 0_u32); participants(&choices)];
    (groups.into_iter())
        .map(|conditions| count(data, conditions, &choices, &mut counters))
        .collect()
}

/// One more than the largest participant index.
fn participants(choices: &[Vec<(u32, bool)>]) -> usize {
    (choices.iter())
        .filter_map(|list| list.last())
        .map(|(participant, _)| *participant as usize + 1)
        .max()
        .unwrap_or(0)
}

/// Counts the votes of those who answered every condition of a group. `counters`: conditions
/// answered and votes for b, by participant.
fn count<'a>(
    data: &'a Dataset,
    conditions: Vec<usize>,
    choices: &[Vec<(u32, bool)>],
    counters: &mut [(u32, u32)],
) -> Family<'a> {
    let first = &data.conditions[conditions[0]];
    let turned = |i: usize| data.conditions[i].technique_b != first.technique_b;
    counters.fill((0, 0));
    for &i in &conditions {
        for &(participant, chose_b) in &choices[i] {
            let counter = &mut counters[participant as usize];
            counter.0 += 1;
            counter.1 += u32::from(chose_b != turned(i));
        }
    }
    let k = conditions.len();
    let mut participants = vec![0; k + 1];
    for (answered, for_b) in counters.iter() {
        if *answered as usize == k {
            participants[*for_b as usize] += 1;
        }
    }
    let columns = (conditions.iter())
        .map(|&i| {
            let votes = (choices[i].iter())
                .filter(|(participant, _)| counters[*participant as usize].0 as usize == k)
                .filter(|(_, chose_b)| *chose_b != turned(i));
            votes.count() as u64
        })
        .collect();
    Family {
        technique_a: &first.technique_a,
        technique_b: &first.technique_b,
        conditions,
        columns,
        participants,
    }
}

#[cfg(test)]
mod tests;
