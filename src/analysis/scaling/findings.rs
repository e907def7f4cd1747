//! The section in sentences.

use super::goodness::misfit;
use super::graph;
use super::link::{Link, PROBIT_OF_JOD};
use super::pairwise::{two_sided, wald};
use super::scale::{Component, Method, Scale};
use super::tables::degrees_of_freedom;
use super::{MOST_DIFFERENCES, Scaling};
use crate::analysis::conclusion::{p_text, plural};
use crate::analysis::statistic::Context;
use crate::analysis::table::Interval;
use crate::analysis::tails::chi_square_upper;

/// More names than this are summed up.
const MOST_NAMES: usize = 8;
/// More parts than this are left to the tables.
const MOST_PARTS: usize = 6;

pub(super) fn all(scaling: &Scaling, context: &Context<'_>) -> Vec<String> {
    if scaling.table.pairs.is_empty() {
        return vec!["There is no vote, so there is no scale.".to_owned()];
    }
    let mut found = Vec::new();
    found.extend(parts(scaling));
    for component in scaling.components.iter().take(MOST_PARTS) {
        found.extend(one_way(scaling, component));
    }
    for (at, component) in scaling.components.iter().enumerate().take(MOST_PARTS) {
        match &scaling.scales[0][at] {
            Ok(scale) => found.push(ends(scaling, at, scale, context)),
            Err(why) => found.push(format!(
                "{} has no scale: {}.",
                set(scaling, &component.members),
                why.reason
            )),
        }
    }
    if scaling.table.techniques.len() > 2 {
        found.extend(differences(scaling, context));
        for (at, component) in scaling.components.iter().enumerate().take(MOST_PARTS) {
            found.extend(fit(
                scaling,
                component,
                scaling.scales[0][at].as_ref().ok(),
                context,
            ));
        }
    }
    found.extend(order_effect(scaling, context));
    found.extend(pooled(context));
    found.extend(one_scale(scaling, context));
    found.push(uncertainty(scaling, context));
    found
}

/// Names in braces.
fn set(scaling: &Scaling, members: &[usize]) -> String {
    let mut names: Vec<String> = members
        .iter()
        .take(MOST_NAMES)
        .map(|member| scaling.table.techniques[*member].clone())
        .collect();
    if members.len() > MOST_NAMES {
        names.push(format!("{} more", members.len() - MOST_NAMES));
    }
    format!("{{{}}}", names.join(", "))
}

fn parts(scaling: &Scaling) -> Vec<String> {
    if scaling.labels.iter().all(|label| *label == 0) {
        return Vec::new();
    }
    let mut found = Vec::new();
    let alone: Vec<usize> = (0..scaling.labels.len())
        .filter(|at| {
            let same = |label: &&usize| **label == scaling.labels[*at];
            scaling.labels.iter().filter(same).count() == 1
        })
        .collect();
    if !alone.is_empty() {
        found.push(format!(
            "Without a vote, so without a place on any scale: {}.",
            set(scaling, &alone)
        ));
    }
    let parts: Vec<String> = scaling
        .components
        .iter()
        .take(MOST_PARTS)
        .map(|component| set(scaling, &component.members))
        .collect();
    if scaling.components.len() > 1 {
        let count = scaling.components.len();
        let more = if count > MOST_PARTS { ", …" } else { "" };
        found.push(format!(
            "The techniques fall into {count} components that were never compared with each other: {}{more}. A common scale does not exist: each component has a scale of its own with a zero of its own, and values of different components say nothing about each other.",
            parts.join(", "),
        ));
    }
    found
}

/// Between which sets all votes went one way.
fn one_way(scaling: &Scaling, component: &Component) -> Option<String> {
    if component.is_finite() {
        return None;
    }
    let members_of = |wanted: usize| -> String {
        let members: Vec<usize> = component
            .members
            .iter()
            .zip(&component.sets)
            .filter(|(_, set)| **set == wanted)
            .map(|(member, _)| *member)
            .collect();
        set(scaling, &members)
    };
    let local: Vec<usize> = {
        let mut sets = vec![0; scaling.table.techniques.len()];
        for (member, set) in component.members.iter().zip(&component.sets) {
            sets[*member] = *set;
        }
        sets
    };
    let ways = graph::one_way(&local, &component.pairs);
    let mut named: Vec<String> = ways
        .iter()
        .take(MOST_PARTS)
        .map(|(winner, loser)| {
            format!(
                "between {} and {} to the former",
                members_of(*winner),
                members_of(*loser)
            )
        })
        .collect();
    if ways.len() > MOST_PARTS {
        named.push(format!("and {} more", ways.len() - MOST_PARTS));
    }
    Some(format!(
        "All votes went one way {}: the likelihood of the component {} has no finite maximum (Ford 1957). Its values are estimates with Firth's penalty, marked “Firth” in the tables: their order can be read, their distances depend on the penalty.",
        named.join(", "),
        set(scaling, &component.members),
    ))
}

/// Highest and lowest of a scale.
/// The ends of a component's scale. Their intervals are the bootstrap's where there are resamples:
/// Wald's are too short where participants differ.
fn ends(scaling: &Scaling, at: usize, scale: &Scale, context: &Context<'_>) -> String {
    let alpha = context.settings.alpha;
    let component = &scaling.components[at];
    let name = |place: usize| scaling.table.techniques[component.members[place]].as_str();
    let places = || 0..component.members.len();
    let by_value = |a: &usize, b: &usize| scale.value(*a).total_cmp(&scale.value(*b));
    let highest = places().max_by(by_value).unwrap_or(0);
    let lowest = places().min_by(by_value).unwrap_or(0);
    let value = |place: usize| {
        let jod = scale.value(place) / PROBIT_OF_JOD;
        if place == 0 {
            return format!("{} (0 by definition)", name(0));
        }
        let se = scale.standard_error(place, 0) / PROBIT_OF_JOD;
        let bootstrap = scaling.bootstrap.as_ref();
        let resampled = bootstrap.and_then(|it| it.interval(at, place, alpha).ok());
        let (kind, ends) = match resampled {
            Some(ends) => (
                "bootstrap interval",
                Interval {
                    low: ends.low / PROBIT_OF_JOD,
                    high: ends.high / PROBIT_OF_JOD,
                },
            ),
            None => ("interval", wald(jod, se, alpha)),
        };
        format!(
            "{} ({jod:.2} JOD, {}\u{a0}% {kind} {:.2} to {:.2})",
            name(place),
            alpha.confidence_percent(),
            ends.low,
            ends.high,
        )
    };
    let by = match scale.method {
        Method::MaximumLikelihood => "",
        Method::Penalised => ", with Firth's penalty",
    };
    if highest == lowest || scale.value(highest) == scale.value(lowest) {
        return format!(
            "On the scale of {}{by}, all techniques stand at the same place.",
            set(scaling, &component.members)
        );
    }
    format!(
        "On the scale of {} (Thurstone case V, 1 JOD = 75\u{a0}% preferred{by}; {} is 0), {} stands highest and {} lowest.",
        set(scaling, &component.members),
        name(0),
        value(highest),
        value(lowest),
    )
}

fn differences(scaling: &Scaling, context: &Context<'_>) -> Option<String> {
    let alpha = context.settings.alpha;
    if scaling.differences.is_empty() {
        return Some(format!(
            "There are more than {MOST_DIFFERENCES} pairs of techniques; their differences are left out."
        ));
    }
    let significant = scaling
        .differences
        .iter()
        .filter(|difference| difference.p_holm.at_most(alpha))
        .count();
    Some(format!(
        "{significant} of {} between techniques on a common scale {} significant after Holm's correction at alpha = {}.",
        plural(scaling.differences.len(), "difference"),
        if significant == 1 { "is" } else { "are" },
        alpha.get(),
    ))
}

fn fit(
    scaling: &Scaling,
    component: &Component,
    scale: Option<&Scale>,
    context: &Context<'_>,
) -> Option<String> {
    let df = degrees_of_freedom(component);
    let scale = scale.filter(|scale| scale.method == Method::MaximumLikelihood)?;
    if df == 0 {
        return None;
    }
    let misfit = misfit(&scale.design, Link::Thurstone, &scale.fit.beta);
    let p = chi_square_upper(misfit.g2, df);
    let verdict = if p.at_most(context.settings.alpha) {
        "departs from the choices by more than chance explains: one dimension does not hold them"
    } else {
        "does not depart from the choices by more than chance explains"
    };
    let small = if misfit.smallest_expected < 5.0 {
        " Some expected counts are under 5, so this p is rough."
    } else {
        ""
    };
    Some(format!(
        "The scale of {} {verdict} (G² = {:.2}, df {df}, p {}).{small}",
        set(scaling, &component.members),
        misfit.g2,
        p_text(p),
    ))
}

fn order_effect(scaling: &Scaling, context: &Context<'_>) -> Option<String> {
    let alpha = context.settings.alpha;
    Some(match scaling.order_effect? {
        Err(why) => format!("The order effect cannot be estimated: {}.", why.reason),
        Ok(effect) => {
            let ends = wald(effect.delta, effect.se, alpha);
            let (test, p) = match effect.likelihood_ratio {
                Ok((_, p)) => ("likelihood-ratio p", p),
                Err(_) => (
                    "with Firth's penalty, Wald p",
                    two_sided(effect.delta / effect.se),
                ),
            };
            format!(
                "Order effect in the Bradley–Terry model: δ = {:.3} logits for the image shown first ({}\u{a0}% interval {:.3} to {:.3}; {test} {}).",
                effect.delta,
                alpha.confidence_percent(),
                ends.low,
                ends.high,
                p_text(p),
            )
        }
    })
}

fn one_scale(scaling: &Scaling, context: &Context<'_>) -> Option<String> {
    let test = scaling.one_scale[0].ok()?;
    let verdict = if test.p.at_most(context.settings.alpha) {
        "The scales of the scenes differ: the common scale is an average over scenes"
    } else {
        "One scale for all scenes is not rejected"
    };
    Some(format!(
        "{verdict} (likelihood ratio χ² = {:.2}, df {}, p {}).",
        test.statistic,
        test.df,
        p_text(test.p)
    ))
}

/// What a scale over several conditions means, where one pair of techniques was compared in more
/// than one.
fn pooled(context: &Context<'_>) -> Option<String> {
    let pairs = context.data.by_techniques().len();
    (pairs < context.data.conditions.len()).then(|| {
        "Votes of all conditions that compare the same two techniques are pooled: where the preference depends on the scene or its light, the scale is an average over those that were shown."
            .to_owned()
    })
}

fn uncertainty(scaling: &Scaling, context: &Context<'_>) -> String {
    let independent = "Standard errors, Wald intervals and p take every vote as independent; votes of one participant need not be.";
    let Some(bootstrap) = &scaling.bootstrap else {
        return independent.to_owned();
    };
    let mut text = format!(
        "{independent} Bootstrap intervals are expanded percentiles of {} of the {} (seed {}).",
        plural(bootstrap.replicates, "resample"),
        plural(bootstrap.participants, "participant"),
        context.settings.seed,
    );
    if bootstrap.penalised > 0 {
        text += &format!(
            " {} had no finite estimate and took Firth's penalty.",
            bootstrap.penalised
        );
    }
    let broken = bootstrap.broken.iter().max().copied().unwrap_or(0);
    if broken > 0 {
        text += &format!(
            " Up to {broken} a component left its techniques unconnected and are not counted."
        );
    }
    text
}
