//! The tables of the section.

mod checks;
mod scales;

pub(super) use checks::degrees_of_freedom;

use super::Scaling;
use super::scale::{Component, Method};
use crate::analysis::statistic::{Context, SectionTable};
use crate::analysis::table::{Cell, Column, Group, Style, Table, Undefined};

const REFERENCE: Undefined =
    Undefined::not_available("0 by definition: the first technique of its scale");
const ALONE: Undefined = Undefined::disconnected("has no votes, so no scale");
const NOT_FINITE: Undefined = Undefined::no_finite_estimate(
    "the likelihood has no finite maximum: all votes between some techniques went one way",
);
/// With more rows the scales by scene are folded away.
const MOST_SHOWN: usize = 60;

pub(super) fn all(scaling: &Scaling, context: &Context<'_>) -> Vec<SectionTable> {
    let alpha = context.settings.alpha;
    let mut tables = vec![
        shown(
            "jod",
            "Thurstone case V in JOD (1 JOD = 75 % preferred), by component; intervals: Wald, and expanded percentiles over resampled participants",
            scales::jod(scaling, context),
        ),
        shown(
            "bradley_terry",
            "Bradley–Terry in logits, against the first technique of the component and against the component's mean",
            scales::bradley_terry(scaling, alpha),
        ),
    ];
    if scaling.table.techniques.len() > 2 {
        if !scaling.differences.is_empty() {
            tables.push(SectionTable {
                long: scaling.differences.len() > MOST_SHOWN,
                ..shown("pairwise", "Differences of techniques, b − a in JOD (Wald), corrected by Holm over all pairs", checks::pairwise(scaling))
            });
        }
        if !scaling.components.is_empty() {
            tables.push(shown(
                "fit",
                "Goodness of fit against a probability of its own for every compared pair",
                checks::fit(scaling),
            ));
        }
    }
    if scaling.order_effect.is_some() {
        tables.push(shown(
            "order_effect",
            "Order effect in logits: above 0 the image shown first gains (Davidson & Beaver)",
            checks::order_effect(scaling, alpha),
        ));
    }
    if scaling.scenes.len() > 1 {
        tables.push(shown(
            "one_scale",
            "Likelihood-ratio test of one scale for all scenes against a scale a scene",
            checks::one_scale(scaling),
        ));
        let table = scales::by_scene(scaling, alpha);
        tables.push(SectionTable {
            long: table.rows.len() > MOST_SHOWN,
            ..shown("by_scene", "Thurstone case V in JOD by scene; the first technique of each scene's component is 0", table)
        });
    }
    tables
}

fn shown(id: &'static str, caption: &'static str, table: Table) -> SectionTable {
    SectionTable {
        id,
        caption,
        long: false,
        table,
    }
}

const fn key(key: &'static str, title: &'static str) -> Column {
    Column::new(key, title, Style::Text, Group::Key)
}

const fn effect(key: &'static str, title: &'static str) -> Column {
    Column::new(key, title, Style::Decimals(3), Group::Effects)
}

const fn interval(key: &'static str, title: &'static str) -> Column {
    Column::new(key, title, Style::Interval(3), Group::Effects)
}

const fn count_column(key: &'static str, title: &'static str) -> Column {
    Column::new(key, title, Style::Count, Group::Choices)
}

const fn p_column(key: &'static str, title: &'static str) -> Column {
    Column::new(key, title, Style::P, Group::Tests)
}

/// A count; sums of a few conditions can be beyond 32 bits.
fn count(n: u64) -> Cell {
    u32::try_from(n).map_or(Cell::Number(n as f64), Cell::Count)
}

fn label(n: usize) -> Cell {
    count(n as u64 + 1)
}

fn status(method: Method) -> Cell {
    Cell::Text(
        match method {
            Method::MaximumLikelihood => "ok",
            Method::Penalised => "Firth",
        }
        .to_owned(),
    )
}

/// The component of a technique by its label: its number among those with votes, and its place.
fn find(components: &[Component], technique: usize) -> Option<(usize, usize)> {
    components.iter().enumerate().find_map(|(at, component)| {
        let place = component.members.binary_search(&technique).ok()?;
        Some((at, place))
    })
}

fn undefined(why: Undefined, cells: usize, status: &str) -> Vec<Cell> {
    let mut row = vec![Cell::Undefined(why); cells];
    row.push(Cell::Text(status.to_owned()));
    row
}
