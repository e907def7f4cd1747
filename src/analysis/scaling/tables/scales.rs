//! The scales themselves.

use super::super::Scaling;
use super::super::comparison::Comparisons;
use super::super::link::{Link, PROBIT_OF_JOD};
use super::super::pairwise::wald;
use super::super::scale::{Method, Scale};
use super::super::scenes::Scene;
use super::{
    ALONE, NOT_FINITE, REFERENCE, count, count_column, effect, find, interval, key, label, status,
    undefined,
};
use crate::analysis::statistic::Context;
use crate::analysis::table::{Cell, Column, Group, Style, Table, Undefined};
use crate::analysis::tails::Alpha;

/// A technique's value on a scale, with standard error and interval, in units of `unit`.
fn estimate(scale: &Scale, place: usize, unit: f64, alpha: Alpha) -> [Cell; 3] {
    let value = scale.value(place) / unit;
    if place == 0 {
        return [
            Cell::Number(value),
            Cell::Undefined(REFERENCE),
            Cell::Undefined(REFERENCE),
        ];
    }
    let se = scale.standard_error(place, 0) / unit;
    [
        Cell::Number(value),
        Cell::Number(se),
        Cell::Interval(wald(value, se, alpha)),
    ]
}

/// The value where the likelihood has a finite maximum.
fn unpenalised(scale: &Scale, place: usize, unit: f64) -> Cell {
    match scale.method {
        Method::MaximumLikelihood => Cell::Number(scale.value(place) / unit),
        Method::Penalised => Cell::Undefined(NOT_FINITE),
    }
}

pub(super) fn jod(scaling: &Scaling, context: &Context<'_>) -> Table {
    let alpha = context.settings.alpha;
    let votes = scaling.table.wins_and_losses();
    let row = |technique: usize| {
        let mut row = named(&scaling.table, technique, scaling.labels[technique], &votes);
        row.extend(match find(&scaling.components, technique) {
            None => undefined(ALONE, 5, "no votes"),
            Some((component, place)) => match &scaling.scales[0][component] {
                Err(why) => undefined(*why, 5, why.status.text()),
                Ok(scale) => {
                    let [value, se, wald] = estimate(scale, place, PROBIT_OF_JOD, alpha);
                    vec![
                        value,
                        se,
                        wald,
                        resampled(scaling, context, component, place),
                        unpenalised(scale, place, PROBIT_OF_JOD),
                        status(scale.method),
                    ]
                }
            },
        });
        row
    };
    Table {
        columns: vec![
            key("technique", "technique"),
            Column::new("component", "component", Style::Count, Group::Key),
            count_column("wins", "preferred"),
            count_column("losses", "not preferred"),
            effect("jod", "JOD"),
            effect("se", "SE"),
            interval("jod_ci", "interval"),
            interval("jod_bootstrap", "bootstrap"),
            effect("jod_unpenalised", "unpenalised"),
            key("status", "status"),
        ],
        rows: (0..scaling.table.techniques.len()).map(row).collect(),
    }
}

fn named(table: &Comparisons, technique: usize, part: usize, votes: &[(u64, u64)]) -> Vec<Cell> {
    vec![
        Cell::Text(table.techniques[technique].clone()),
        label(part),
        count(votes[technique].0),
        count(votes[technique].1),
    ]
}

fn resampled(scaling: &Scaling, context: &Context<'_>, component: usize, place: usize) -> Cell {
    let Some(bootstrap) = &scaling.bootstrap else {
        return Cell::Undefined(if context.data.has_answers() {
            Undefined::not_available("no resamples were asked for")
        } else {
            Undefined::COUNTS_ONLY
        });
    };
    if place == 0 {
        return Cell::Undefined(REFERENCE);
    }
    let ends = bootstrap.interval(component, place, context.settings.alpha);
    Cell::or_undefined(ends, |mut ends| {
        ends.low /= PROBIT_OF_JOD;
        ends.high /= PROBIT_OF_JOD;
        Cell::Interval(ends)
    })
}

pub(super) fn bradley_terry(scaling: &Scaling, alpha: Alpha) -> Table {
    let row = |technique: usize| {
        let mut row = vec![
            Cell::Text(scaling.table.techniques[technique].clone()),
            label(scaling.labels[technique]),
        ];
        row.extend(match find(&scaling.components, technique) {
            None => undefined(ALONE, 6, "no votes"),
            Some((component, place)) => match &scaling.scales[1][component] {
                Err(why) => undefined(*why, 6, why.status.text()),
                Ok(scale) => {
                    let (centred, centred_se) = scale.centred(place);
                    let mut cells = estimate(scale, place, 1.0, alpha).to_vec();
                    cells.extend([
                        Cell::Number(centred),
                        Cell::Number(centred_se),
                        unpenalised(scale, place, 1.0),
                        status(scale.method),
                    ]);
                    cells
                }
            },
        });
        row
    };
    Table {
        columns: vec![
            key("technique", "technique"),
            Column::new("component", "component", Style::Count, Group::Key),
            effect("logit", "logit"),
            effect("se", "SE"),
            interval("logit_ci", "interval"),
            effect("centred", "from mean"),
            effect("centred_se", "its SE"),
            effect("logit_unpenalised", "unpenalised"),
            key("status", "status"),
        ],
        rows: (0..scaling.table.techniques.len()).map(row).collect(),
    }
}

pub(super) fn by_scene(scaling: &Scaling, alpha: Alpha) -> Table {
    Table {
        columns: vec![
            key("scene", "scene"),
            key("technique", "technique"),
            Column::new("component", "component", Style::Count, Group::Key),
            count_column("wins", "preferred"),
            count_column("losses", "not preferred"),
            effect("jod", "JOD"),
            effect("se", "SE"),
            interval("jod_ci", "interval"),
            key("status", "status"),
        ],
        rows: scaling
            .scenes
            .iter()
            .flat_map(|scene| scene_rows(scene, alpha))
            .collect(),
    }
}

fn scene_rows(scene: &Scene, alpha: Alpha) -> Vec<Vec<Cell>> {
    let votes = scene.table.wins_and_losses();
    let mut rows = Vec::new();
    for component in &scene.components {
        let scale = component.fit(Link::Thurstone);
        for (place, &technique) in component.members.iter().enumerate() {
            let mut row = vec![Cell::Text(scene.name.clone())];
            row.extend(named(
                &scene.table,
                technique,
                scene.labels[technique],
                &votes,
            ));
            match &scale {
                Err(why) => row.extend(undefined(*why, 3, why.status.text())),
                Ok(scale) => {
                    row.extend(estimate(scale, place, PROBIT_OF_JOD, alpha));
                    row.push(status(scale.method));
                }
            }
            rows.push(row);
        }
    }
    rows
}
