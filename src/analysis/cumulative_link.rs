//! The proportional-odds model of ratings: by how much a technique raises the odds of a higher
//! rating, whatever the distances between the points of the scale mean to people.

mod fit;

use super::conclusion::plural;
use super::dataset::{Dataset, Rating};
use super::rank_tests::correct;
use super::settings::Settings;
use super::statistic::About;
use super::table::{Cell, Column, Group, Interval, Style, Table, Undefined};
use super::tails::{Probability, student_t_critical, student_t_upper};
use fit::{Fit, Observation};

/// The declaration.
pub const ABOUT: About = About {
    id: "cumulative_link",
    name: "proportional-odds model (cumulative logit link)",
    formula: "logit P(rating ≤ c) = θ_c − β_technique − γ_condition; standard errors by the sandwich H⁻¹ (Σ s sᵀ) H⁻¹ G/(G − 1) over the scores s of G participants; t = β/se with G − 1 degrees of freedom",
    source: "P. McCullagh (1980), Journal of the Royal Statistical Society B 42(2), 109–142; existence: S. J. Haberman, discussion of it, 136–137; K.-Y. Liang & S. L. Zeger (1986), Biometrika 73(1), 13–22; small samples: A. C. Cameron & D. L. Miller (2015), Journal of Human Resources 50(2), 317–372",
    validity: "effects of the population, alike in all conditions and at all points of the scale; a participant's ratings may depend on each other, participants not. Many participants are needed for the standard errors: under about 30 they are too small",
};

/// More different values than this are no scale of categories.
const MOST_CATEGORIES: usize = 20;

/// The model of one scale.
pub struct Model {
    scale: usize,
    /// Numbers of the techniques rated; the first is what the others are compared with.
    techniques: Vec<usize>,
    participants: usize,
    ratings: usize,
    categories: usize,
    /// Log odds and standard errors of the others, in order.
    fit: Result<Fit, Undefined>,
}

/// Fits the model of one scale.
pub fn model(data: &Dataset, scale: usize) -> Model {
    let answers: Vec<&Rating> = (data.ratings.answers.iter())
        .filter(|it| it.scale as usize == scale)
        .collect();
    let techniques = used(&answers, |it| it.technique);
    let conditions = used(&answers, |it| it.condition);
    let mut points: Vec<f32> = Vec::new();
    for it in &answers {
        if points.len() <= MOST_CATEGORIES && !points.contains(&it.value) {
            points.push(it.value);
        }
    }
    points.sort_by(f32::total_cmp);
    Model {
        scale,
        participants: used(&answers, |it| it.participant).len(),
        ratings: answers.len(),
        categories: points.len(),
        fit: fitted(&answers, &techniques, &conditions, &points),
        techniques,
    }
}

/// Different numbers, sorted.
fn used(answers: &[&Rating], number: impl Fn(&Rating) -> u32) -> Vec<usize> {
    let mut all: Vec<usize> = answers.iter().map(|it| number(it) as usize).collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn fitted(
    answers: &[&Rating],
    techniques: &[usize],
    conditions: &[usize],
    points: &[f32],
) -> Result<Fit, Undefined> {
    const ONE_TECHNIQUE: Undefined = Undefined::degenerate("one technique only");
    const ONE_POINT: Undefined = Undefined::degenerate("all ratings are the same");
    const NO_SCALE: Undefined =
        Undefined::not_available("more than 20 different ratings: no scale of categories");
    const APART: Undefined =
        Undefined::disconnected("the conditions fall into groups without a technique in common");
    if techniques.len() < 2 {
        return Err(ONE_TECHNIQUE);
    }
    match points.len() {
        0 | 1 => return Err(ONE_POINT),
        n if n > MOST_CATEGORIES => return Err(NO_SCALE),
        _ => {}
    }
    let at = |list: &[usize], number: u32| list.binary_search(&(number as usize)).unwrap_or(0);
    let observations: Vec<Observation> = answers
        .iter()
        .map(|it| Observation {
            category: points
                .iter()
                .position(|point| *point == it.value)
                .unwrap_or(0),
            technique: at(techniques, it.technique),
            condition: at(conditions, it.condition),
            cluster: it.participant,
        })
        .collect();
    if !are_connected(&observations, techniques.len(), conditions.len()) {
        return Err(APART);
    }
    let size = [points.len(), techniques.len(), conditions.len()];
    fit::fit(&observations, size)
}

/// Whether techniques and conditions hang together: else their effects cannot be told apart.
fn are_connected(observations: &[Observation], techniques: usize, conditions: usize) -> bool {
    let mut parent: Vec<usize> = (0..techniques + conditions).collect();
    fn root(parent: &mut [usize], mut of: usize) -> usize {
        while parent[of] != of {
            parent[of] = parent[parent[of]];
            of = parent[of];
        }
        of
    }
    for it in observations {
        let one = root(&mut parent, it.technique);
        let other = root(&mut parent, techniques + it.condition);
        parent[one] = other;
    }
    let first = root(&mut parent, 0);
    (0..parent.len()).all(|it| root(&mut parent, it) == first)
}

/// One row of the table.
struct Effect {
    technique: usize,
    estimate: Result<f64, Undefined>,
    error: Result<f64, Undefined>,
    interval: Result<Interval, Undefined>,
    t: Result<f64, Undefined>,
    p: Result<Probability, Undefined>,
    p_holm: Result<Probability, Undefined>,
}

impl Model {
    fn rows(&self, settings: &Settings) -> Vec<Effect> {
        const FAR: Undefined = Undefined::no_finite_estimate("no finite interval at this alpha");
        let df = self.participants as f64 - 1.0;
        let others = self.techniques.iter().skip(1).enumerate();
        let mut rows: Vec<Effect> = others
            .map(|(at, &technique)| {
                let fit = self.fit.as_ref().map_err(|why| *why);
                let estimate = fit.map(|fit| fit.effects[at]);
                let error = fit.and_then(|fit| fit.errors[at]);
                let t = estimate.and_then(|estimate| Ok(estimate / error?));
                let interval = estimate.and_then(|estimate| {
                    let half = error? * student_t_critical(settings.alpha, df).ok_or(FAR)?;
                    Ok(Interval {
                        low: estimate - half,
                        high: estimate + half,
                    })
                });
                let p = t.map(|t| student_t_upper(t.abs(), df).times(2.0));
                Effect {
                    technique,
                    estimate,
                    error,
                    interval,
                    t,
                    p,
                    p_holm: p,
                }
            })
            .collect();
        correct(rows.iter_mut().map(|row| &mut row.p_holm));
        rows
    }

    /// The result in one sentence.
    pub fn sentence(&self, data: &Dataset, settings: &Settings) -> String {
        let scale = &data.ratings.scales[self.scale];
        let model = format!(
            "Proportional-odds model of {scale} ({} by {}, {} of the scale in use)",
            plural(self.ratings, "rating"),
            plural(self.participants, "participant"),
            plural(self.categories, "point"),
        );
        let rows = self.rows(settings);
        if let Some(why) =
            rows.iter()
                .find_map(|row| row.p.err())
                .or(self.fit.as_ref().err().copied())
        {
            return format!("{model}: {}.", why.reason);
        }
        let differ = |row: &&Effect| row.p_holm.is_ok_and(|p| p.at_most(settings.alpha));
        let reference = self
            .techniques
            .first()
            .map_or("", |&it| &data.ratings.techniques[it]);
        format!(
            "{model}: {} of {} differ from {reference} after Holm's correction at alpha = {}.",
            rows.iter().filter(differ).count(),
            plural(rows.len(), "technique"),
            settings.alpha.get(),
        )
    }
}

/// The table of all scales.
pub fn table(models: &[Model], data: &Dataset, settings: &Settings) -> Table {
    let columns = vec![
        Column::new("scale", "scale", Style::Text, Group::Key),
        Column::new("technique", "technique", Style::Text, Group::Key),
        Column::new("reference", "against", Style::Text, Group::Key),
        Column::new("n", "ratings", Style::Count, Group::Choices),
        Column::new("participants", "participants", Style::Count, Group::Choices),
        Column::new("log_odds", "log odds", Style::Decimals(3), Group::Effects),
        Column::new("se", "se", Style::Decimals(3), Group::Effects),
        Column::new(
            "log_odds_ci",
            "interval",
            Style::Interval(2),
            Group::Effects,
        ),
        Column::new(
            "odds_ratio",
            "odds ratio",
            Style::Decimals(2),
            Group::Effects,
        ),
        Column::new("t", "t", Style::Decimals(2), Group::Tests),
        Column::new("p", "p", Style::P, Group::Tests),
        Column::new("p_holm", "Holm", Style::P, Group::Tests),
    ];
    let count = |n: usize| Cell::Count(u32::try_from(n).unwrap_or(u32::MAX));
    let (scales, techniques) = (&data.ratings.scales, &data.ratings.techniques);
    let mut rows = Vec::new();
    for model in models {
        let reference = model.techniques.first().map_or("", |&it| &techniques[it]);
        for row in model.rows(settings) {
            rows.push(vec![
                Cell::Text(scales[model.scale].clone()),
                Cell::Text(techniques[row.technique].clone()),
                Cell::Text(reference.to_owned()),
                count(model.ratings),
                count(model.participants),
                Cell::or_undefined(row.estimate, Cell::Number),
                Cell::or_undefined(row.error, Cell::Number),
                Cell::or_undefined(row.interval, Cell::Interval),
                Cell::or_undefined(row.estimate.map(f64::exp), Cell::Number),
                Cell::or_undefined(row.t, Cell::Number),
                Cell::or_undefined(row.p, Cell::Probability),
                Cell::or_undefined(row.p_holm, Cell::Probability),
            ]);
        }
    }
    Table { columns, rows }
}

#[cfg(test)]
mod tests;
