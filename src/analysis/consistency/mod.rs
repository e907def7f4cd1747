//! Do observers agree with themselves, and with each other?
//!
//! With themselves ([`triads`]): whoever prefers A to B, B to C and C to A goes in a circle. With each
//! other ([`agreement`]): Kendall's u. Both need observers who judged all pairs of three or more
//! techniques ([`sets`]). [`outliers`] needs one answer a condition only.

pub mod agreement;
pub mod outliers;
pub mod sets;
pub mod triads;

#[cfg(test)]
mod tests;

use super::conclusion::plural;
use super::statistic::{About, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Status, Style, Table, Undefined};
use outliers::Outliers;
use sets::{Judged, Sets};
use triads::Chance;

/// More names than this are left to the table.
const MOST_NAMES: usize = 20;

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "consistency",
        name: "consistency of observers: circular triads, Kendall's ζ and u, outlier score",
        formula: "circular triads d = t(t − 1)(2t − 1)/12 − ½ Σ aᵢ²; ζ = 1 − d/d_max; u = 2 Σ C(γᵢⱼ, 2)/(C(m, 2) C(t, 2)) − 1; outlier: Σ (ln p̂ − E)/√Σ Var over the observer's answers, p̂ the share of the others who chose the same (half a vote added to either side), against the quartiles of all observers",
        source: "M. G. Kendall, B. Babington Smith (1940), Biometrika 31(3/4), 324–345; outlier score in the manner of M. Perez-Ortiz, R. K. Mantiuk (2017), arXiv:1712.03686, on the quartiles of J. W. Tukey (1977), Exploratory Data Analysis",
        validity: "triads and u: observers who judged every pair of three techniques or more; exact up to 10 techniques, then Kendall's chi-square; the outlier score is a reason to look, never to exclude",
    },
    section,
};

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    if !data.has_answers() {
        return None;
    }
    let outliers = Outliers::of(data);
    let sets = Sets::of(data);
    let judged = sets.judge(data);
    let mut chance = Chance::default();
    let mut findings = vec![outliers.finding(&data.participants)];
    let mut tables = Vec::new();
    let has_sets = judged.observers.iter().any(Option::is_some);
    if has_sets {
        findings.push(contradictions(&judged, &mut chance, settings.alpha));
        let agreed = agreement::all(&sets, &judged);
        findings.extend(agreement::finding(&agreed, settings.alpha));
        tables.push(SectionTable {
            id: "agreement",
            caption: "Kendall's coefficient of agreement u over the observers who judged every pair: 1 all agree, under 0 less than by chance",
            long: false,
            table: agreement::table(&agreed),
        });
    } else {
        findings.push("No observer judged every pair of three or more techniques, so there are no circular triads, no ζ and no u.".to_owned());
    }
    tables.push(SectionTable {
        id: "by_participant",
        caption: "Agreement with the other observers, and with oneself",
        long: true,
        table: by_participant(
            context,
            &outliers,
            has_sets.then_some((&judged, &mut chance)),
        ),
    });
    Some(Section {
        id: "consistency",
        title: "Consistency of the observers",
        status: if outliers.is_defined() {
            Status::Ok
        } else {
            Status::Degenerate
        },
        findings,
        tables,
    })
}

/// How many observers go in circles.
fn contradictions(judged: &Judged, chance: &mut Chance, alpha: super::tails::Alpha) -> String {
    let complete: Vec<_> = judged.observers.iter().flatten().collect();
    let circular = complete.iter().filter(|own| own.circular > 0).count();
    let zeta = complete.iter().map(|own| own.zeta()).sum::<f64>() / complete.len().max(1) as f64;
    let beyond_chance = complete
        .iter()
        .filter(|own| chance.at_most(&own.sizes, own.circular).at_most(alpha))
        .count();
    format!(
        "Of {} who judged every pair of three or more techniques, {circular} contradict themselves in a circular triad or more; ζ is {zeta:.3} on average (1: never). {beyond_chance} are more consistent than choices at random would be at alpha = {}.",
        plural(complete.len(), "observer"),
        alpha.get(),
    )
}

fn by_participant(
    context: &Context<'_>,
    outliers: &Outliers,
    mut sets: Option<(&Judged, &mut Chance)>,
) -> Table {
    let mut columns = vec![
        Column::new("participant", "participant", Style::Text, Group::Key),
        Column::new("answers", "answers", Style::Count, Group::Choices),
        Column::new(
            "agreement",
            "with majority",
            Style::Decimals(3),
            Group::Effects,
        ),
        Column::new(
            "mean_log_likelihood",
            "mean ln p",
            Style::Decimals(3),
            Group::Effects,
        ),
        Column::new("agreement_z", "z", Style::Decimals(2), Group::Effects),
        Column::new(
            "outlier_score",
            "outlier score",
            Style::Decimals(2),
            Group::Effects,
        ),
    ];
    if sets.is_some() {
        columns.extend([
            Column::new("circular_triads", "circular", Style::Count, Group::Choices),
            Column::new("zeta", "ζ", Style::Decimals(3), Group::Effects),
            Column::new("p_triads", "p", Style::P, Group::Tests),
        ]);
    }
    let mut rows = Vec::with_capacity(context.data.participants.len());
    for (at, name) in context.data.participants.iter().enumerate() {
        let mut row = Vec::with_capacity(columns.len());
        row.push(Cell::Text(name.clone()));
        row.extend(outliers.cells(at));
        if let Some((judged, chance)) = &mut sets {
            row.extend(triad_cells(judged, chance, at));
        }
        rows.push(row);
    }
    Table { columns, rows }
}

fn triad_cells(judged: &Judged, chance: &mut Chance, participant: usize) -> [Cell; 3] {
    match &judged.observers[participant] {
        None => {
            const WHY: Undefined =
                Undefined::not_available("did not judge every pair of three or more techniques");
            [
                Cell::Undefined(WHY),
                Cell::Undefined(WHY),
                Cell::Undefined(WHY),
            ]
        }
        Some(own) => [
            Cell::Count(own.circular),
            Cell::Number(own.zeta()),
            Cell::Probability(chance.at_most(&own.sizes, own.circular)),
        ],
    }
}

/// Names, at most [`MOST_NAMES`] of them.
fn names<'a>(of: impl ExactSizeIterator<Item = &'a str>) -> String {
    let more = of.len().saturating_sub(MOST_NAMES);
    let mut listed: Vec<String> = of.take(MOST_NAMES).map(str::to_owned).collect();
    if more > 0 {
        listed.push(format!("and {more} more"));
    }
    listed.join(", ")
}
