//! Rank orders: mean ranks, Friedman's test, and which techniques differ.

use super::blocks::{Blocks, Unit, Value, blocks};
use super::conclusion::plural;
use super::dataset::{Dataset, Votes};
use super::exact_binomial::exact_p;
use super::rank_tests::{self, Tested, correct, main_test};
use super::settings::Settings;
use super::statistic::{About, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Status, Style, Table, Undefined};
use super::tails::Probability;

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "rank_sign_test",
        name: "exact sign test between ranked techniques",
        formula: "participants who rank a before b against those who rank b before a, ties left out: exact binomial, ½, two-sided; Holm over the pairs",
        source: "W. J. Conover (1999), Practical Nonparametric Statistics, section 3.4",
        validity: "exact; complete rankings. Over all conditions a participant counts once, by the mean of the ranks",
    },
    section,
};

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    let tested = rank_tests::test(rank_blocks(data));
    if tested.is_empty() {
        return None;
    }
    let rankings = &data.rankings;
    let pairs: Vec<Pair> = tested.iter().flat_map(compare).collect();
    let mut findings: Vec<String> = main_test(&tested)
        .map(|it| rank_tests::sentence(it, "ranks", &rankings.conditions, settings))
        .into_iter()
        .collect();
    findings.extend(rank_tests::by_condition(&tested, "ranks", settings));
    findings.extend(pairs_sentence(&tested, &pairs, settings));
    findings.extend(rank_tests::left_out(&tested, "rankings"));
    let status = match tested.iter().find_map(|it| it.result.ok()) {
        Some(_) => Status::Ok,
        None => Status::Degenerate,
    };
    Some(Section {
        id: "rankings",
        title: "Rank orders",
        status,
        findings,
        tables: vec![
            SectionTable {
                id: "ranks",
                caption: "Mean rank of every technique in complete rankings; 1 is the best",
                long: false,
                table: means(&tested, data),
            },
            SectionTable {
                id: "rank_tests",
                caption: "Friedman's test; blocks participant × condition count a participant once a condition and are not independent",
                long: false,
                table: tests(&tested, data),
            },
            SectionTable {
                id: "rank_pairs",
                caption: "Exact sign test of every pair of techniques, Holm over the pairs of a condition",
                long: false,
                table: pairs_table(&pairs, data),
            },
        ],
    })
}

/// The main result in one sentence.
#[must_use]
pub fn main_result(data: &Dataset, settings: &Settings) -> Option<String> {
    let main = rank_tests::only_main_test(rank_blocks(data))?;
    let conditions = &data.rankings.conditions;
    Some(rank_tests::sentence(&main, "ranks", conditions, settings))
}

fn rank_blocks(data: &Dataset) -> Vec<Blocks> {
    let rankings = &data.rankings;
    let values: Vec<Value> = (rankings.answers.iter())
        .map(|it| Value {
            participant: it.participant,
            condition: it.condition,
            technique: it.technique,
            value: f64::from(it.rank),
        })
        .collect();
    blocks(
        &values,
        rankings.conditions.len(),
        rankings.techniques.len(),
    )
}

fn means(tested: &[Tested], data: &Dataset) -> Table {
    let columns = vec![
        Column::new("condition", "condition", Style::Text, Group::Key),
        Column::new("technique", "technique", Style::Text, Group::Key),
        Column::new("n", "n", Style::Count, Group::Choices),
        Column::new("mean_rank", "mean rank", Style::Decimals(2), Group::Choices),
        Column::new("firsts", "ranked first", Style::Count, Group::Choices),
    ];
    let mut rows = Vec::new();
    // Of all conditions the rows are those of the participants' means.
    let shown = |it: &&Tested| it.blocks.unit != Unit::ParticipantByCondition;
    for Tested { blocks, .. } in tested.iter().filter(shown) {
        let means = blocks.means();
        for (at, &technique) in blocks.techniques.iter().enumerate() {
            let of_block = |row: &&[f64]| row.iter().all(|value| *value >= row[at]);
            let firsts = blocks.rows().filter(of_block).count();
            let mean = means.get(at).copied();
            let none = Undefined::degenerate("no complete ranking");
            rows.push(vec![
                rank_tests::name(blocks, &data.rankings.conditions),
                Cell::Text(data.rankings.techniques[technique].clone()),
                count(blocks.count()),
                Cell::or_undefined(mean.ok_or(none), Cell::Number),
                count(firsts),
            ]);
        }
    }
    Table { columns, rows }
}

fn count(n: usize) -> Cell {
    Cell::Count(u32::try_from(n).unwrap_or(u32::MAX))
}

fn tests(tested: &[Tested], data: &Dataset) -> Table {
    let mut columns = vec![Column::new(
        "condition",
        "condition",
        Style::Text,
        Group::Key,
    )];
    columns.extend(rank_tests::columns());
    let rows = tested.iter().map(|it| {
        let mut row = vec![rank_tests::name(&it.blocks, &data.rankings.conditions)];
        row.extend(rank_tests::cells(it));
        row
    });
    Table {
        rows: rows.collect(),
        columns,
    }
}

/// Two techniques of one set of blocks.
struct Pair {
    condition: Option<usize>,
    techniques: [usize; 2],
    /// Blocks that rank a, or b, before the other.
    before: Votes,
    ties: u32,
    p: Result<Probability, Undefined>,
    p_holm: Result<Probability, Undefined>,
}

/// The pairs of one set; blocks that are not independent are not compared.
fn compare(tested: &Tested) -> Vec<Pair> {
    const ALL_TIED: Undefined = Undefined::degenerate("no participant ranks the two differently");
    let blocks: &Blocks = &tested.blocks;
    if blocks.unit == Unit::ParticipantByCondition {
        return Vec::new();
    }
    let mut pairs: Vec<Pair> = blocks
        .pairs()
        .map(|(a, b)| {
            let (mut before, mut ties) = (Votes::default(), 0);
            for row in blocks.rows() {
                if row[a] < row[b] {
                    before.a += 1;
                } else if row[b] < row[a] {
                    before.b += 1;
                } else {
                    ties += 1;
                }
            }
            let p = exact_p(before).map_err(|_| ALL_TIED);
            Pair {
                condition: blocks.condition,
                techniques: [a, b].map(|at| blocks.techniques[at]),
                before,
                ties,
                p,
                p_holm: p,
            }
        })
        .collect();
    correct(pairs.iter_mut().map(|pair| &mut pair.p_holm));
    pairs
}

fn pairs_table(pairs: &[Pair], data: &Dataset) -> Table {
    let columns = vec![
        Column::new("condition", "condition", Style::Text, Group::Key),
        Column::new("technique_a", "technique a", Style::Text, Group::Key),
        Column::new("technique_b", "technique b", Style::Text, Group::Key),
        Column::new("a_before_b", "a before b", Style::Count, Group::Choices),
        Column::new("b_before_a", "b before a", Style::Count, Group::Choices),
        Column::new("ties", "ties", Style::Count, Group::Choices),
        Column::new("p_exact", "p exact", Style::P, Group::Tests),
        Column::new("p_exact_holm", "Holm", Style::P, Group::Tests),
    ];
    let rankings = &data.rankings;
    let rows = pairs.iter().map(|pair| {
        let [a, b] = pair.techniques.map(|at| rankings.techniques[at].clone());
        let condition = pair.condition.map(|at| rankings.conditions[at].as_str());
        vec![
            Cell::Text(condition.unwrap_or(rank_tests::ALL).to_owned()),
            Cell::Text(a),
            Cell::Text(b),
            Cell::Count(pair.before.a),
            Cell::Count(pair.before.b),
            Cell::Count(pair.ties),
            Cell::or_undefined(pair.p, Cell::Probability),
            Cell::or_undefined(pair.p_holm, Cell::Probability),
        ]
    });
    Table {
        rows: rows.collect(),
        columns,
    }
}

fn pairs_sentence(tested: &[Tested], pairs: &[Pair], settings: &Settings) -> Option<String> {
    let main = main_test(tested)?;
    let of_main = |it: &&Pair| it.condition == main.blocks.condition && it.p.is_ok();
    let pairs: Vec<&Pair> = pairs.iter().filter(of_main).collect();
    let differ = |it: &&&Pair| it.p_holm.is_ok_and(|p| p.at_most(settings.alpha));
    let significant = pairs.iter().filter(differ).count();
    (!pairs.is_empty()).then(|| {
        format!(
            "Of {} of techniques {significant} differ by the exact sign test after Holm's correction at alpha = {}.",
            plural(pairs.len(), "pair"),
            settings.alpha.get(),
        )
    })
}

#[cfg(test)]
mod tests;
