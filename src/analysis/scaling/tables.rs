//! The tables of the section.

use super::comparison::Comparisons;
use super::goodness::misfit;
use super::link::{Link, PROBIT_OF_JOD};
use super::pairwise::{two_sided, wald};
use super::scale::{Component, Method, Scale};
use super::scenes::Scene;
use super::{LINKS, Scaling};
use crate::analysis::statistic::{Context, SectionTable};
use crate::analysis::table::{Cell, Column, Group, Style, Table, Undefined};
use crate::analysis::tails::{Alpha, chi_square_upper};

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
            "Thurstone case V in JOD (1 JOD = 75 % preferred), by component; intervals: Wald, and percentiles over resampled participants",
            jod(scaling, context),
        ),
        shown(
            "bradley_terry",
            "Bradley–Terry in logits, against the first technique of the component and against the component's mean",
            bradley_terry(scaling, alpha),
        ),
    ];
    if scaling.table.techniques.len() > 2 {
        if !scaling.differences.is_empty() {
            tables.push(SectionTable {
                long: scaling.differences.len() > MOST_SHOWN,
                ..shown("pairwise", "Differences of techniques, b − a in JOD (Wald), corrected by Holm over all pairs", pairwise(scaling))
            });
        }
        if !scaling.components.is_empty() {
            tables.push(shown(
                "fit",
                "Goodness of fit against a probability of its own for every compared pair",
                fit(scaling),
            ));
        }
    }
    if scaling.order_effect.is_some() {
        tables.push(shown(
            "order_effect",
            "Order effect in logits: above 0 the image shown first gains (Davidson & Beaver)",
            order_effect(scaling, alpha),
        ));
    }
    if scaling.scenes.len() > 1 {
        tables.push(shown(
            "one_scale",
            "Likelihood-ratio test of one scale for all scenes against a scale a scene",
            one_scale(scaling),
        ));
        let table = by_scene(scaling, alpha);
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

fn jod(scaling: &Scaling, context: &Context<'_>) -> Table {
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

fn undefined(why: Undefined, cells: usize, status: &str) -> Vec<Cell> {
    let mut row = vec![Cell::Undefined(why); cells];
    row.push(Cell::Text(status.to_owned()));
    row
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

fn bradley_terry(scaling: &Scaling, alpha: Alpha) -> Table {
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

fn pairwise(scaling: &Scaling) -> Table {
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

fn fit(scaling: &Scaling) -> Table {
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
pub(super) fn degrees_of_freedom(component: &Component) -> u32 {
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

fn order_effect(scaling: &Scaling, alpha: Alpha) -> Table {
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

fn one_scale(scaling: &Scaling) -> Table {
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

fn by_scene(scaling: &Scaling, alpha: Alpha) -> Table {
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
