//! How long participants took, on a log scale: by condition, by the position they chose, and
//! whether either makes a difference within participants.

use super::conclusion::{p_text, plural};
use super::dataset::{Answer, Dataset};
use super::settings::Settings;
use super::statistic::{About, Context, Section, SectionTable, StudyStatistic};
use super::table::{Cell, Column, Group, Interval, Status, Style, Table, Undefined};
use super::tails::{Alpha, Probability, chi_square_upper, student_t_critical};
use position::PositionTest;
use summary::{Moments, quantiles};

mod friedman;
mod position;
mod summary;

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "response_times",
        name: "response times on a log scale",
        formula: "geometric mean exp(mean ln t) with the t interval of mean ln t; position: one-sample t of each participant's mean ln t choosing first minus choosing second; condition: Friedman's χ² over participants who answered all, with ties",
        source: "R. D. Luce (1986), Response Times, on their skew; Student (1908), Biometrika 6(1), 1–25; M. Friedman (1937), JASA 32(200), 675–701",
        validity: "times over 0 only; the t interval wants ln t near normal or many participants; Friedman's χ² uses ranks and needs neither that nor equal variances, but is an approximation under 10 participants",
    },
    section,
};

const NO_TIMES: Undefined = Undefined::degenerate("no response times");
const ONE_TIME: Undefined = Undefined::degenerate("a spread needs two response times");
const ONE_PARTICIPANT: Undefined = Undefined::degenerate("needs two participants");
const NO_SPREAD: Undefined =
    Undefined::degenerate("the difference is the same for every participant");
const FEW_CONDITIONS: Undefined = Undefined::degenerate("needs two conditions with response times");
const FEW_COMPLETE: Undefined =
    Undefined::degenerate("needs two participants with a response time in every condition");
const ALL_TIED: Undefined = Undefined::degenerate("every participant took equally long everywhere");

/// The time of an answer that counts here: answered, and longer than nothing.
fn time(answer: &Answer) -> Option<f32> {
    answer.chosen?;
    answer
        .response_time_ms
        .filter(|time| *time > 0.0 && time.is_finite())
}

fn section(context: &Context<'_>) -> Option<Section> {
    let Context { data, settings, .. } = *context;
    if !data.has_answers() {
        return None;
    }
    let counts = Counts::of(data);
    let (status, findings, tables) = if counts.used == 0 {
        let none = "No answer has a response time.".to_owned();
        (Status::NotAvailable, vec![none], Vec::new())
    } else {
        let position = PositionTest::of(data, settings.alpha);
        let condition = ConditionTest::of(data);
        let findings = findings(&counts, &position, &condition, settings);
        let tables = tables(data, settings, &position, &condition);
        (Status::Ok, findings, tables)
    };
    Some(Section {
        id: "response_times",
        title: "Response times",
        status,
        findings,
        tables,
    })
}

fn tables(
    data: &Dataset,
    settings: &Settings,
    position: &PositionTest,
    condition: &ConditionTest,
) -> Vec<SectionTable> {
    let part = |id, caption, table| SectionTable {
        id,
        caption,
        long: false,
        table,
    };
    vec![
        part(
            "by_condition",
            "Response times by condition, milliseconds; interval of the geometric mean",
            by_condition(data, settings.alpha),
        ),
        part(
            "by_position",
            "Response times by the position chosen; geometric mean of the participants' own ones, quantiles of the trials",
            by_position(data, position, settings.alpha),
        ),
        part(
            "position_test",
            "Choosing first against choosing second, within participants: one-sample t of the difference of mean ln t; ratio of the times",
            position.table(),
        ),
        part(
            "condition_test",
            "Between conditions, within participants: Friedman's test",
            condition.table(),
        ),
    ]
}

/// How many trials there are, and why some are left out here.
struct Counts {
    used: usize,
    unanswered: usize,
    missing: usize,
    zero: usize,
}

impl Counts {
    fn of(data: &Dataset) -> Self {
        let mut counts = Self {
            used: 0,
            unanswered: 0,
            missing: 0,
            zero: 0,
        };
        for answer in &data.answers {
            *match (answer.chosen, answer.response_time_ms, time(answer)) {
                (None, ..) => &mut counts.unanswered,
                (_, None, _) => &mut counts.missing,
                (.., None) => &mut counts.zero,
                (.., Some(_)) => &mut counts.used,
            } += 1;
        }
        counts
    }

    fn sentence(&self) -> String {
        let mut left_out = Vec::new();
        for (count, why) in [
            (self.unanswered, "without an answer"),
            (self.missing, "without a time"),
            (self.zero, "with a time of 0 or less"),
        ] {
            if count > 0 {
                left_out.push(format!("{count} {why}"));
            }
        }
        if left_out.is_empty() {
            format!(
                "Response times of all {} are used.",
                plural(self.used, "trial")
            )
        } else {
            format!(
                "Response times of {} are used; left out: {}.",
                plural(self.used, "trial"),
                left_out.join(", ")
            )
        }
    }
}

/// exp of the t interval of a mean.
fn geometric_interval(
    moments: &Moments,
    alpha: Alpha,
    too_few: Undefined,
) -> Result<Interval, Undefined> {
    let standard_error = moments.standard_error().ok_or(too_few)?;
    let t = student_t_critical(alpha, moments.n() - 1.0).ok_or(too_few)?;
    let ends = [-1.0, 1.0].map(|side| (moments.mean() + side * t * standard_error).exp());
    if ends[1].is_finite() {
        Ok(Interval {
            low: ends[0],
            high: ends[1],
        })
    } else {
        Err(Undefined::no_finite_estimate(
            "the interval has no bound: too few and too different times",
        ))
    }
}

const QUANTILES: [(f64, &str, &str); 5] = [
    (0.05, "p5_ms", "5 %"),
    (0.25, "q1_ms", "25 %"),
    (0.5, "median_ms", "median"),
    (0.75, "q3_ms", "75 %"),
    (0.95, "p95_ms", "95 %"),
];

fn quantile_cells(times: &mut [f32]) -> Vec<Cell> {
    match quantiles(times, QUANTILES.map(|(at, ..)| at)) {
        Some(values) => values.map(Cell::Number).to_vec(),
        None => vec![Cell::Undefined(NO_TIMES); QUANTILES.len()],
    }
}

fn columns(first: &[Column]) -> Vec<Column> {
    let ms = |key, title| Column::new(key, title, Style::Decimals(0), Group::Choices);
    let mut columns = first.to_vec();
    columns.push(ms("geometric_mean_ms", "geometric mean"));
    columns.push(Column::new(
        "geometric_mean_ms_ci",
        "interval",
        Style::Interval(0),
        Group::Choices,
    ));
    columns.push(Column::new(
        "sd_ln",
        "SD of ln",
        Style::Decimals(3),
        Group::Choices,
    ));
    columns.extend(QUANTILES.map(|(_, key, title)| ms(key, title)));
    columns
}

fn by_condition(data: &Dataset, alpha: Alpha) -> Table {
    let mut sizes = vec![0; data.conditions.len()];
    for answer in data.answers.iter().filter(|answer| time(answer).is_some()) {
        sizes[answer.condition as usize] += 1;
    }
    let mut times: Vec<Vec<f32>> = sizes.into_iter().map(Vec::with_capacity).collect();
    for answer in &data.answers {
        times[answer.condition as usize].extend(time(answer));
    }
    let rows = (data.conditions.iter().zip(&mut times))
        .map(|(condition, times)| {
            let moments: Moments = times.iter().map(|time| f64::from(*time).ln()).collect();
            let mut row = vec![Cell::Text(condition.id.clone()), count(times.len())];
            row.extend(moment_cells(&moments, alpha, ONE_TIME));
            row.extend(quantile_cells(times));
            row
        })
        .collect();
    let first = [
        Column::new("condition", "condition", Style::Text, Group::Key),
        Column::new("n", "n", Style::Count, Group::Choices),
    ];
    Table {
        columns: columns(&first),
        rows,
    }
}

/// Geometric mean, its interval, spread.
fn moment_cells(moments: &Moments, alpha: Alpha, too_few: Undefined) -> [Cell; 3] {
    if moments.n() < 1.0 {
        return [(); 3].map(|()| Cell::Undefined(NO_TIMES));
    }
    [
        Cell::Number(moments.mean().exp()),
        Cell::or_undefined(geometric_interval(moments, alpha, too_few), Cell::Interval),
        Cell::or_undefined(moments.sd().ok_or(too_few), Cell::Number),
    ]
}

fn by_position(data: &Dataset, test: &PositionTest, alpha: Alpha) -> Table {
    let rows = (["first", "second"]
        .iter()
        .zip(&test.of_position)
        .enumerate())
    .map(|(at, (name, moments))| {
        let chose = |answer: &&Answer| answer.chosen.is_some_and(|position| position.place() == at);
        let mut times: Vec<f32> = data.answers.iter().filter(chose).filter_map(time).collect();
        let mut row = vec![
            Cell::Text((*name).to_owned()),
            count(times.len()),
            count(moments.n() as usize),
        ];
        row.extend(moment_cells(moments, alpha, ONE_PARTICIPANT));
        row.extend(quantile_cells(&mut times));
        row
    })
    .collect();
    let first = [
        Column::new("position", "chose", Style::Text, Group::Key),
        Column::new("n", "n", Style::Count, Group::Choices),
        Column::new("participants", "participants", Style::Count, Group::Choices),
    ];
    Table {
        columns: columns(&first),
        rows,
    }
}

fn count(n: usize) -> Cell {
    Cell::Count(u32::try_from(n).unwrap_or(u32::MAX))
}

/// Friedman's test of the conditions, participants as blocks.
struct ConditionTest {
    outcome: Result<friedman::Friedman, Undefined>,
}

impl ConditionTest {
    fn of(data: &Dataset) -> Self {
        Self {
            outcome: friedman::Friedman::of(data),
        }
    }

    fn p(&self) -> Result<Probability, Undefined> {
        self.outcome.map(|x| chi_square_upper(x.chi_square, x.df()))
    }

    fn table(&self) -> Table {
        let tests = |key, title, style| Column::new(key, title, style, Group::Tests);
        Table {
            columns: vec![
                tests("participants", "participants", Style::Count),
                tests("conditions", "conditions", Style::Count),
                tests("chi_square", "χ²", Style::UpTo(6)),
                tests("df", "df", Style::Count),
                tests("p_friedman", "p", Style::P),
                tests("kendall_w", "Kendall's W", Style::Decimals(3)),
            ],
            rows: vec![vec![
                Cell::or_undefined(self.outcome, |x| count(x.participants)),
                Cell::or_undefined(self.outcome, |x| count(x.conditions)),
                Cell::or_undefined(self.outcome, |x| Cell::Number(x.chi_square)),
                Cell::or_undefined(self.outcome, |x| Cell::Count(x.df())),
                Cell::or_undefined(self.p(), Cell::Probability),
                Cell::or_undefined(self.outcome, |x| Cell::Number(x.kendall_w())),
            ]],
        }
    }
}

fn findings(
    counts: &Counts,
    position: &PositionTest,
    condition: &ConditionTest,
    settings: &Settings,
) -> Vec<String> {
    let mut findings = vec![counts.sentence()];
    findings.push(match (position.t, position.p, position.ratio_interval) {
        (Ok(t), Ok(p), Ok(interval)) => format!(
            "Choosing the first image took {:.3} times as long as choosing the second ({}\u{a0}% interval {:.3} to {:.3}; geometric means within {}, t({}) = {t:.3}, p {}).",
            position.differences.mean().exp(),
            settings.alpha.confidence_percent(),
            interval.low,
            interval.high,
            plural(position.differences.n() as usize, "participant"),
            position.differences.n() - 1.0,
            p_text(p),
        ),
        (Err(why), ..) | (_, Err(why), _) | (.., Err(why)) => {
            format!("Times by position chosen are not compared: {}.", why.reason)
        }
    });
    findings.push(match (condition.outcome, condition.p()) {
        (Ok(x), Ok(p)) => format!(
            "Times {} between conditions (Friedman χ²({}) = {:.3}, p {}, Kendall's W = {:.3}; {} with a time in every condition).",
            if p.at_most(settings.alpha) { "differ" } else { "do not detectably differ" },
            x.df(),
            x.chi_square,
            p_text(p),
            x.kendall_w(),
            plural(x.participants, "participant"),
        ),
        (Err(why), _) | (_, Err(why)) => {
            format!("Times are not compared between conditions: {}.", why.reason)
        }
    });
    findings
}

#[cfg(test)]
mod tests;
