//! Differences, fit, and what else is tested.

use super::super::goodness::misfit;
use super::super::link::Link;
use super::super::pairwise::{two_sided, wald};
use super::super::scale::{Component, Method, Scale};
use super::super::{LINKS, Scaling};
use super::{
    NOT_FINITE, count, count_column, effect, interval, key, label, p_column, status, undefined,
};
use crate::analysis::table::{Cell, Column, Group, Style, Table, Undefined};
use crate::analysis::tails::{Alpha, chi_square_upper};

pub(super) fn pairwise(scaling: &Scaling) -> Table {
    let rows = scaling
        .differences
        .iter()
        .map(|pair| {
            vec![
                Cell::Text(scaling.table.techniques[pair.a].clone()),
                Cell::Text(scaling.table.techniques[pair.b].clone()),
                label(scaling.labels[pair.a]),
                count(pair.direct.0),
                count(pair.direct.1),
                Cell::Number(pair.jod),
                Cell::Number(pair.se),
                Cell::Interval(pair.interval),
                Cell::Number(pair.z),
                Cell::Probability(pair.p),
                Cell::Probability(pair.p_holm),
                status(pair.method),
            ]
        })
        .collect();
    Table {
        columns: vec![
            key("technique_a", "technique a"),
            key("technique_b", "technique b"),
            Column::new("component", "component", Style::Count, Group::Key),
            count_column("votes_a", "votes a"),
            count_column("votes_b", "votes b"),
            effect("difference", "b − a"),
            effect("se", "SE"),
            interval("difference_ci", "interval"),
            Column::new("z", "z", Style::Decimals(3), Group::Tests),
            p_column("p", "p"),
            p_column("p_holm", "Holm"),
            key("status", "status"),
        ],
        rows,
    }
}

pub(super) fn fit(scaling: &Scaling) -> Table {
    let mut rows = Vec::new();
    for (at, link) in LINKS.into_iter().enumerate() {
        for (component, scale) in scaling.components.iter().zip(&scaling.scales[at]) {
            let part = scaling.labels[component.members[0]];
            rows.push(fit_row(link, part, component, scale.as_ref().ok()));
        }
    }
    Table {
        columns: vec![
            key("model", "model"),
            Column::new("component", "component", Style::Count, Group::Key),
            count_column("techniques", "techniques"),
            count_column("pairs", "pairs"),
            Column::new(
                "log_likelihood",
                "log-likelihood",
                Style::Decimals(3),
                Group::Tests,
            ),
            Column::new("df", "df", Style::Count, Group::Tests),
            Column::new("g2", "G²", Style::Decimals(3), Group::Tests),
            p_column("p_g2", "p"),
            Column::new("x2", "X²", Style::Decimals(3), Group::Tests),
            p_column("p_x2", "p"),
            Column::new(
                "smallest_expected",
                "smallest expected",
                Style::Decimals(1),
                Group::Tests,
            ),
        ],
        rows,
    }
}

/// Degrees of freedom of the fit.
pub(in super::super) fn degrees_of_freedom(component: &Component) -> u32 {
    let parameters = component.members.len() - 1;
    u32::try_from(component.pairs.len() - parameters).unwrap_or(u32::MAX)
}

fn fit_row(link: Link, part: usize, component: &Component, scale: Option<&Scale>) -> Vec<Cell> {
    let df = degrees_of_freedom(component);
    let mut row = vec![
        Cell::Text(link.name().to_owned()),
        label(part),
        count(component.members.len() as u64),
        count(component.pairs.len() as u64),
    ];
    let Some(scale) = scale.filter(|scale| scale.method == Method::MaximumLikelihood) else {
        row.extend([Cell::Undefined(NOT_FINITE), Cell::Count(df)]);
        row.extend(vec![Cell::Undefined(NOT_FINITE); 5]);
        return row;
    };
    let misfit = misfit(&scale.design, link, &scale.fit.beta);
    row.extend([Cell::Number(misfit.log_likelihood), Cell::Count(df)]);
    if df == 0 {
        let why = Undefined::degenerate("no degrees of freedom left: the fit is perfect by itself");
        row.extend(vec![Cell::Undefined(why); 4]);
    } else {
        for statistic in [misfit.g2, misfit.x2] {
            row.push(Cell::Number(statistic));
            row.push(Cell::Probability(chi_square_upper(statistic, df)));
        }
    }
    row.push(Cell::Number(misfit.smallest_expected));
    row
}

pub(super) fn order_effect(scaling: &Scaling, alpha: Alpha) -> Table {
    let row = match scaling.order_effect {
        None => Vec::new(),
        Some(Err(why)) => undefined(why, 7, why.status.text()),
        Some(Ok(effect)) => {
            let z = if effect.se > 0.0 {
                effect.delta / effect.se
            } else {
                0.0
            };
            vec![
                Cell::Number(effect.delta),
                Cell::Number(effect.se),
                Cell::Interval(wald(effect.delta, effect.se, alpha)),
                Cell::Number(z),
                Cell::Probability(two_sided(z)),
                Cell::or_undefined(effect.likelihood_ratio, |(lr, _)| Cell::Number(lr)),
                Cell::or_undefined(effect.likelihood_ratio, |(_, p)| Cell::Probability(p)),
                status(effect.method),
            ]
        }
    };
    Table {
        columns: vec![
            effect("delta", "δ"),
            effect("se", "SE"),
            interval("delta_ci", "interval"),
            Column::new("z", "z", Style::Decimals(3), Group::Tests),
            p_column("p_wald", "p (Wald)"),
            Column::new("lr", "LR χ²", Style::Decimals(3), Group::Tests),
            p_column("p_lr", "p (LR)"),
            key("status", "status"),
        ],
        rows: vec![row],
    }
}

pub(super) fn one_scale(scaling: &Scaling) -> Table {
    let rows = LINKS
        .into_iter()
        .zip(&scaling.one_scale)
        .map(|(link, test)| {
            vec![
                Cell::Text(link.name().to_owned()),
                Cell::or_undefined(*test, |test| Cell::Number(test.statistic)),
                Cell::or_undefined(*test, |test| Cell::Count(test.df)),
                Cell::or_undefined(*test, |test| Cell::Probability(test.p)),
            ]
        })
        .collect();
    Table {
        columns: vec![
            key("model", "model"),
            Column::new("lr", "LR χ²", Style::Decimals(3), Group::Tests),
            Column::new("df", "df", Style::Count, Group::Tests),
            p_column("p", "p"),
        ],
        rows,
    }
}
