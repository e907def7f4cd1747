//! Ratings, scale by scale: means and medians, Friedman's test, and which techniques differ.

use super::blocks::{Unit, Value, blocks, by_size};
use super::conclusion::plural;
use super::cumulative_link;
use super::dataset::{Dataset, Rating};
use super::rank_tests::{self, Tested, correct, main_test};
use super::settings::Settings;
use super::statistic::{Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Interval, Status, Style, Table, Undefined};
use super::tails::student_t_critical;
use super::wilcoxon::{self, SignedRank, signed_rank};

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: wilcoxon::ABOUT,
    section,
};

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    let ratings = &data.ratings;
    if ratings.answers.is_empty() {
        return None;
    }
    let scales: Vec<(usize, Vec<Tested>)> = (0..ratings.scales.len())
        .map(|scale| (scale, rank_tests::test(scale_blocks(data, scale))))
        .collect();
    let pairs: Vec<Pair> = (scales.iter())
        .flat_map(|(scale, tested)| tested.iter().flat_map(|it| compare(*scale, it)))
        .collect();
    let models: Vec<cumulative_link::Model> = (0..ratings.scales.len())
        .map(|scale| cumulative_link::model(data, scale))
        .collect();
    let mut findings = Vec::new();
    for (scale, tested) in &scales {
        let what = what(data, *scale);
        findings.extend(
            main_test(tested)
                .map(|it| rank_tests::sentence(it, &what, &ratings.conditions, settings)),
        );
        findings.extend(rank_tests::by_condition(tested, &what, settings));
        findings.extend(pairs_sentence(*scale, tested, &pairs, data, settings));
        findings.extend(rank_tests::left_out(tested, &format!("sets of {what}")));
        findings.push(models[*scale].sentence(data, settings));
    }
    let tested = scales.iter().flat_map(|(_, tested)| tested);
    let has_test = tested.filter_map(|it| it.result.ok()).next().is_some();
    Some(Section {
        id: "ratings",
        title: "Ratings",
        status: if has_test {
            Status::Ok
        } else {
            Status::Degenerate
        },
        findings,
        tables: vec![
            SectionTable {
                id: "ratings",
                caption: "Mean rating with its t interval, and median, of every technique and scale",
                long: false,
                table: described(data, settings),
            },
            SectionTable {
                id: "rating_tests",
                caption: "Friedman's test of the ratings' ranks within blocks; blocks participant × condition are not independent",
                long: false,
                table: tests(&scales, data),
            },
            SectionTable {
                id: "rating_pairs",
                caption: "Wilcoxon's signed-rank test of every pair of techniques, Holm over the pairs of a condition and scale; r > 0: technique b is rated higher",
                long: false,
                table: pairs_table(&pairs, data),
            },
            SectionTable {
                id: "rating_model",
                caption: "Proportional-odds model: log odds of a higher rating against the reference technique, conditions taken into account, standard errors clustered by participant, t with participants − 1 degrees of freedom; Holm over the techniques of a scale",
                long: false,
                table: cumulative_link::table(&models, data, settings),
            },
        ],
    })
}

/// The main results, one sentence a scale.
#[must_use]
pub fn main_results(data: &Dataset, settings: &Settings) -> Vec<String> {
    let sentence = |scale| {
        let main = rank_tests::only_main_test(scale_blocks(data, scale))?;
        let conditions = &data.ratings.conditions;
        Some(rank_tests::sentence(
            &main,
            &what(data, scale),
            conditions,
            settings,
        ))
    };
    (0..data.ratings.scales.len())
        .filter_map(sentence)
        .collect()
}

fn what(data: &Dataset, scale: usize) -> String {
    format!("ratings of {}", data.ratings.scales[scale])
}

fn on_scale(data: &Dataset, scale: usize) -> impl Iterator<Item = &Rating> {
    let answers = data.ratings.answers.iter();
    answers.filter(move |it| it.scale as usize == scale)
}

fn scale_blocks(data: &Dataset, scale: usize) -> Vec<super::blocks::Blocks> {
    let values: Vec<Value> = on_scale(data, scale)
        .map(|it| Value {
            participant: it.participant,
            condition: it.condition,
            technique: it.technique,
            value: f64::from(it.value),
        })
        .collect();
    let (conditions, techniques) = (&data.ratings.conditions, &data.ratings.techniques);
    blocks(&values, conditions.len(), techniques.len())
}

/// The ratings of one technique in one condition.
fn described(data: &Dataset, settings: &Settings) -> Table {
    let columns = vec![
        Column::new("scale", "scale", Style::Text, Group::Key),
        Column::new("condition", "condition", Style::Text, Group::Key),
        Column::new("technique", "technique", Style::Text, Group::Key),
        Column::new("n", "n", Style::Count, Group::Choices),
        Column::new("mean", "mean", Style::Decimals(2), Group::Choices),
        Column::new("mean_ci", "interval", Style::Interval(2), Group::Choices),
        Column::new("sd", "sd", Style::Decimals(2), Group::Choices),
        Column::new("median", "median", Style::UpTo(1), Group::Choices),
    ];
    let ratings = &data.ratings;
    let (conditions, techniques) = (ratings.conditions.len(), ratings.techniques.len());
    let mut values = vec![Vec::new(); ratings.scales.len() * conditions * techniques];
    for it in &ratings.answers {
        let row = it.scale as usize * conditions + it.condition as usize;
        values[row * techniques + it.technique as usize].push(f64::from(it.value));
    }
    let mut rows = Vec::new();
    for (at, mut values) in values.into_iter().enumerate() {
        if values.is_empty() {
            continue;
        }
        values.sort_by(by_size);
        let (row, technique) = (at / techniques, at % techniques);
        let mut cells = vec![
            Cell::Text(ratings.scales[row / conditions].clone()),
            Cell::Text(ratings.conditions[row % conditions].clone()),
            Cell::Text(ratings.techniques[technique].clone()),
        ];
        cells.extend(description(&values, settings));
        rows.push(cells);
    }
    Table { columns, rows }
}

/// n, mean, interval, standard deviation and median of sorted values.
fn description(values: &[f64], settings: &Settings) -> [Cell; 5] {
    const ONE: Undefined = Undefined::degenerate("one rating only");
    const SAME: Undefined = Undefined::degenerate("all ratings are the same");
    const FAR: Undefined = Undefined::no_finite_estimate("no finite interval at this alpha");
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let sd = if values.len() > 1 {
        Ok((squares / (n - 1.0)).sqrt())
    } else {
        Err(ONE)
    };
    let is_same = values.first() == values.last();
    let interval = sd.and_then(|sd| {
        if is_same {
            return Err(SAME);
        }
        let t = student_t_critical(settings.alpha, n - 1.0).ok_or(FAR)?;
        let half = t * sd / n.sqrt();
        Ok(Interval {
            low: mean - half,
            high: mean + half,
        })
    });
    let middle = values.len() / 2;
    let median = match values.len() % 2 {
        1 => values[middle],
        _ => f64::midpoint(values[middle - 1], values[middle]),
    };
    [
        Cell::Count(u32::try_from(values.len()).unwrap_or(u32::MAX)),
        Cell::Number(mean),
        Cell::or_undefined(interval, Cell::Interval),
        Cell::or_undefined(sd, Cell::Number),
        Cell::Number(median),
    ]
}

fn tests(scales: &[(usize, Vec<Tested>)], data: &Dataset) -> Table {
    let mut columns = vec![
        Column::new("scale", "scale", Style::Text, Group::Key),
        Column::new("condition", "condition", Style::Text, Group::Key),
    ];
    columns.extend(rank_tests::columns());
    let mut rows = Vec::new();
    for (scale, tested) in scales {
        for it in tested {
            let mut row = vec![
                Cell::Text(data.ratings.scales[*scale].clone()),
                rank_tests::name(&it.blocks, &data.ratings.conditions),
            ];
            row.extend(rank_tests::cells(it));
            rows.push(row);
        }
    }
    Table { columns, rows }
}

/// Two techniques of one set of blocks.
struct Pair {
    scale: usize,
    condition: Option<usize>,
    techniques: [usize; 2],
    result: Result<SignedRank, Undefined>,
    p_holm: Result<super::tails::Probability, Undefined>,
}

/// The pairs of one set; blocks that are not independent are not compared.
fn compare(scale: usize, tested: &Tested) -> Vec<Pair> {
    let blocks = &tested.blocks;
    if blocks.unit == Unit::ParticipantByCondition {
        return Vec::new();
    }
    let mut pairs: Vec<Pair> = blocks
        .pairs()
        .map(|(a, b)| {
            let result = signed_rank(blocks.rows().map(|row| row[b] - row[a]));
            Pair {
                scale,
                condition: blocks.condition,
                techniques: [a, b].map(|at| blocks.techniques[at]),
                p_holm: result.map(|it| it.p),
                result,
            }
        })
        .collect();
    correct(pairs.iter_mut().map(|pair| &mut pair.p_holm));
    pairs
}

fn pairs_table(pairs: &[Pair], data: &Dataset) -> Table {
    let columns = vec![
        Column::new("scale", "scale", Style::Text, Group::Key),
        Column::new("condition", "condition", Style::Text, Group::Key),
        Column::new("technique_a", "technique a", Style::Text, Group::Key),
        Column::new("technique_b", "technique b", Style::Text, Group::Key),
        Column::new("n", "rated differently", Style::Count, Group::Choices),
        Column::new("zeros", "alike", Style::Count, Group::Choices),
        Column::new("v", "V", Style::UpTo(1), Group::Tests),
        Column::new("p", "p", Style::P, Group::Tests),
        Column::new("p_from", "from", Style::Text, Group::Tests),
        Column::new("p_holm", "Holm", Style::P, Group::Tests),
        Column::new("biserial", "r", Style::Decimals(2), Group::Effects),
    ];
    let ratings = &data.ratings;
    let rows = pairs.iter().map(|pair| {
        let [a, b] = pair.techniques.map(|at| ratings.techniques[at].clone());
        let condition = pair.condition.map(|at| ratings.conditions[at].as_str());
        let of = |cell: fn(SignedRank) -> Cell| Cell::or_undefined(pair.result, cell);
        vec![
            Cell::Text(ratings.scales[pair.scale].clone()),
            Cell::Text(condition.unwrap_or(rank_tests::ALL).to_owned()),
            Cell::Text(a),
            Cell::Text(b),
            of(|it| Cell::Count(it.n)),
            of(|it| Cell::Count(it.zeros)),
            of(|it| Cell::Number(it.positive)),
            of(|it| Cell::Probability(it.p)),
            of(|it| Cell::Text(if it.exact { "exact" } else { "normal" }.to_owned())),
            Cell::or_undefined(pair.p_holm, Cell::Probability),
            of(|it| Cell::Number(it.biserial)),
        ]
    });
    Table {
        rows: rows.collect(),
        columns,
    }
}

fn pairs_sentence(
    scale: usize,
    tested: &[Tested],
    pairs: &[Pair],
    data: &Dataset,
    settings: &Settings,
) -> Option<String> {
    let main = main_test(tested)?;
    let of_main = |it: &&Pair| {
        it.scale == scale && it.condition == main.blocks.condition && it.result.is_ok()
    };
    let pairs: Vec<&Pair> = pairs.iter().filter(of_main).collect();
    let differ = |it: &&&Pair| it.p_holm.is_ok_and(|p| p.at_most(settings.alpha));
    let significant = pairs.iter().filter(differ).count();
    (!pairs.is_empty()).then(|| {
        format!(
            "Of {} of techniques {significant} differ in {} by Wilcoxon's signed-rank test after Holm's correction at alpha = {}.",
            plural(pairs.len(), "pair"),
            data.ratings.scales[scale],
            settings.alpha.get(),
        )
    })
}

#[cfg(test)]
mod tests;
