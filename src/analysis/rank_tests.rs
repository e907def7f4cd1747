//! Tables that ratings and rankings have in common: Friedman's test of every set of blocks, with
//! Holm's correction over the conditions.

use super::blocks::{Blocks, Unit};
use super::friedman::{Friedman, friedman};
use super::holm;
use super::settings::Settings;
use super::table::{Cell, Column, Group, Style, Undefined};
use super::tails::Probability;

/// What stands for all conditions in the first column.
pub const ALL: &str = "all conditions";

/// A set of blocks and its test.
pub struct Tested {
    /// The blocks.
    pub blocks: Blocks,
    /// Their test.
    pub result: Result<Friedman, Undefined>,
    /// The p to go by after Holm's correction over the conditions; that of all conditions together
    /// is one test of its own.
    pub p_holm: Result<Probability, Undefined>,
}

/// Tests every set of blocks.
pub fn test(all: Vec<Blocks>) -> Vec<Tested> {
    let mut tested: Vec<Tested> = all
        .into_iter()
        .map(|blocks| {
            let result = friedman(&blocks);
            Tested {
                blocks,
                p_holm: result.map(|it| it.p().0),
                result,
            }
        })
        .collect();
    let of_conditions = |it: &&mut Tested| it.blocks.condition.is_some();
    correct(
        tested
            .iter_mut()
            .filter(of_conditions)
            .map(|it| &mut it.p_holm),
    );
    tested
}

/// Replaces the p-values that are there by Holm's.
pub fn correct<'a>(p: impl Iterator<Item = &'a mut Result<Probability, Undefined>>) {
    let mut defined: Vec<&mut Probability> = p.filter_map(|p| p.as_mut().ok()).collect();
    let before: Vec<Probability> = defined.iter().map(|p| **p).collect();
    for (p, corrected) in defined.iter_mut().zip(holm::adjust(&before)) {
        **p = corrected;
    }
}

/// The test that the main result rests on: of the participants' means over all conditions, or of
/// the one condition there is.
pub fn main_test(tested: &[Tested]) -> Option<&Tested> {
    let main = |it: &&Tested| is_main(&it.blocks, tested.len());
    tested.iter().find(main)
}

/// That test alone.
pub fn only_main_test(mut all: Vec<Blocks>) -> Option<Tested> {
    let several = all.len();
    all.retain(|blocks| is_main(blocks, several));
    test(all).pop()
}

fn is_main(blocks: &Blocks, of: usize) -> bool {
    of == 1 || blocks.unit == Unit::ParticipantMeans
}

/// Columns of the table of tests, behind those that name the row.
pub fn columns() -> Vec<Column> {
    vec![
        Column::new("blocks", "blocks", Style::Text, Group::Key),
        Column::new("n", "n", Style::Count, Group::Choices),
        Column::new("incomplete", "incomplete", Style::Count, Group::Choices),
        Column::new("techniques", "techniques", Style::Count, Group::Choices),
        Column::new("chi_square", "χ²", Style::Decimals(3), Group::Tests),
        Column::new("df", "df", Style::Count, Group::Tests),
        Column::new("p_chi_square", "p χ²", Style::P, Group::Tests),
        Column::new("f", "F", Style::Decimals(3), Group::Tests),
        Column::new("p_f", "p F", Style::P, Group::Tests),
        Column::new("p_exact", "p exact", Style::P, Group::Tests),
        Column::new("p", "p", Style::P, Group::Tests),
        Column::new("p_from", "from", Style::Text, Group::Tests),
        Column::new("p_holm", "Holm", Style::P, Group::Tests),
        Column::new(
            "kendall_w",
            "Kendall's W",
            Style::Decimals(3),
            Group::Effects,
        ),
    ]
}

/// The cells of one set of blocks.
pub fn cells(tested: &Tested) -> Vec<Cell> {
    let Tested {
        blocks,
        result,
        p_holm,
    } = tested;
    let number = |value: Result<f64, Undefined>| Cell::or_undefined(value, Cell::Number);
    let p = |value: Result<Probability, Undefined>| Cell::or_undefined(value, Cell::Probability);
    let count = |n: usize| Cell::Count(u32::try_from(n).unwrap_or(u32::MAX));
    let f = result.and_then(|it| it.f);
    vec![
        Cell::Text(blocks.unit.text().to_owned()),
        count(blocks.count()),
        Cell::Count(blocks.incomplete),
        count(blocks.techniques.len()),
        number(result.map(|it| it.chi_square)),
        Cell::or_undefined(result.map(|it| it.df), Cell::Count),
        p(result.map(|it| it.p_chi_square)),
        number(f.map(|it| it.0)),
        p(f.map(|it| it.1)),
        p(result.and_then(|it| it.p_exact)),
        p(result.map(|it| it.p().0)),
        Cell::or_undefined(result.map(|it| it.p().1), |from| {
            Cell::Text(from.to_owned())
        }),
        p(*p_holm),
        number(result.map(|it| it.w)),
    ]
}

/// The name of a set of blocks in the first column.
pub fn name(blocks: &Blocks, conditions: &[String]) -> Cell {
    let name = blocks.condition.map_or(ALL, |it| conditions[it].as_str());
    Cell::Text(name.to_owned())
}

/// The result in one sentence: `what` are ranks or ratings.
pub fn sentence(tested: &Tested, what: &str, conditions: &[String], settings: &Settings) -> String {
    let place = match tested.blocks.condition {
        Some(it) => format!("in {}", conditions[it]),
        None => "over all conditions (means of each participant)".to_owned(),
    };
    match tested.result {
        Ok(result) => {
            let (p, from) = result.p();
            let verdict = if p.at_most(settings.alpha) {
                "differ between the techniques"
            } else {
                "do not differ significantly between the techniques"
            };
            format!(
                "The {what} {verdict} {place}: Friedman's χ²({}) = {:.2}, n = {}, p {} ({from}), Kendall's W = {:.2}.",
                result.df,
                result.chi_square,
                tested.blocks.count(),
                super::conclusion::p_text(p),
                result.w,
            )
        }
        Err(why) => format!("The {what} {place} could not be tested: {}.", why.reason),
    }
}

/// How many conditions have different ranks after the correction, where there are several.
pub fn by_condition(tested: &[Tested], what: &str, settings: &Settings) -> Option<String> {
    let single = tested.iter().filter(|it| it.blocks.condition.is_some());
    let p: Vec<Probability> = single.filter_map(|it| it.p_holm.ok()).collect();
    let significant = p.iter().filter(|p| p.at_most(settings.alpha)).count();
    (p.len() > 1).then(|| {
        format!(
            "By condition the {what} differ in {significant} of {} after Holm's correction at alpha = {}.",
            p.len(),
            settings.alpha.get(),
        )
    })
}

/// What to say of blocks that lack a technique.
pub fn left_out(tested: &[Tested], what: &str) -> Option<String> {
    let single = tested.iter().filter(|it| it.blocks.condition.is_some());
    let incomplete: u32 = single.map(|it| it.blocks.incomplete).sum();
    (incomplete > 0).then(|| {
        format!(
            "{incomplete} {what} of a condition lack one of its techniques and are left out of the tests."
        )
    })
}
