//! One scale for all scenes, or a scale a scene?

use std::collections::BTreeMap;

use super::comparison::Comparisons;
use super::goodness::misfit;
use super::link::Link;
use super::scale::{Component, Method, Scale, component, components};
use crate::analysis::dataset::{ConditionData, Dataset};
use crate::analysis::table::Undefined;
use crate::analysis::tails::{Probability, chi_square_upper};

/// The comparisons of one scene. Techniques are those of the scene only.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Its table.
    pub table: Comparisons,
    /// Its components of two or more techniques.
    pub components: Vec<Component>,
    /// The component of each technique.
    pub labels: Vec<usize>,
}

/// The scenes that have votes, by name; conditions without a scene are left out.
#[must_use]
pub fn scenes(data: &Dataset) -> Vec<Scene> {
    let mut by_name: BTreeMap<&str, Vec<&ConditionData>> = BTreeMap::new();
    for condition in data.conditions.iter().filter(|c| c.votes.total() > 0) {
        if let Some(scene) = &condition.scene {
            by_name.entry(scene).or_default().push(condition);
        }
    }
    by_name
        .into_iter()
        .map(|(name, conditions)| {
            let table = Comparisons::of(conditions);
            let (components, labels) = components(&table);
            Scene {
                name: name.to_owned(),
                table,
                components,
                labels,
            }
        })
        .collect()
}

/// The likelihood-ratio test of one scale for all scenes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OneScale {
    /// Twice the log of the likelihood ratio.
    pub statistic: f64,
    /// Parameters that a scale a scene has more.
    pub df: u32,
    /// p.
    pub p: Probability,
}

/// Tests it.
///
/// # Errors
/// Why it cannot be tested.
pub fn one_scale(data: &Dataset, scenes: &[Scene], link: Link) -> Result<OneScale, Undefined> {
    let mut voted = data.conditions.iter().filter(|c| c.votes.total() > 0);
    if voted.any(|condition| condition.scene.is_none()) {
        return Err(Undefined::not_available(
            "needs the scene of every condition",
        ));
    }
    if scenes.len() < 2 {
        return Err(Undefined::not_available("needs two scenes or more"));
    }
    let pooled = Comparisons::of(data.conditions.iter());
    let (pooled_components, _) = components(&pooled);
    let free = |components: &[Component]| -> usize {
        components.iter().map(|c| c.members.len() - 1).sum()
    };
    let separate: usize = scenes.iter().map(|scene| free(&scene.components)).sum();
    let df = separate.saturating_sub(free(&pooled_components));
    let Some(df) = u32::try_from(df).ok().filter(|df| *df > 0) else {
        return Err(Undefined::degenerate(
            "no two scenes share what would tell their scales apart",
        ));
    };
    let mut statistic = 0.0;
    for whole in &pooled_components {
        statistic += common_misfit(whole, &pooled, scenes, link)?;
    }
    for part in scenes.iter().flat_map(|scene| &scene.components) {
        let scale = finite(part, link)?;
        statistic -= misfit(&scale.design, link, &scale.fit.beta).g2;
    }
    let statistic = statistic.max(0.0);
    Ok(OneScale {
        statistic,
        df,
        p: chi_square_upper(statistic, df),
    })
}

/// G² of the common scale against a table with a row for every scene and pair.
fn common_misfit(
    whole: &Component,
    pooled: &Comparisons,
    scenes: &[Scene],
    link: Link,
) -> Result<f64, Undefined> {
    let scale = finite(whole, link)?;
    let numbers: BTreeMap<&str, usize> = whole
        .members
        .iter()
        .map(|&member| (pooled.techniques[member].as_str(), member))
        .collect();
    let mut pairs = Vec::new();
    for scene in scenes {
        for pair in &scene.table.pairs {
            let number = |at: usize| numbers.get(scene.table.techniques[at].as_str()).copied();
            if let (Some(i), Some(j)) = (number(pair.i), number(pair.j)) {
                pairs.push(super::comparison::Pair { i, j, ..*pair });
            }
        }
    }
    let design = component(whole.members.clone(), pairs).design();
    Ok(misfit(&design, link, &scale.fit.beta).g2)
}

fn finite(component: &Component, link: Link) -> Result<Scale, Undefined> {
    let none = Undefined::no_finite_estimate(
        "no likelihood ratio where a scale has no finite maximum of the likelihood",
    );
    component
        .fit(link)
        .ok()
        .filter(|scale| scale.method == Method::MaximumLikelihood)
        .ok_or(none)
}
