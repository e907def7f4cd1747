//! The scale of one component: fitted by maximum likelihood where that exists, else with Firth's
//! penalty.

use nalgebra::DVector;

use super::comparison::{Comparisons, Pair};
use super::firth;
use super::fit::{Design, Fit, Row, maximise};
use super::graph;
use super::link::Link;
use crate::analysis::table::Undefined;

/// How a scale came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Maximum likelihood: finite and unique.
    MaximumLikelihood,
    /// No finite maximum: Firth's penalised likelihood.
    Penalised,
}

/// A component of the comparison graph with two or more techniques.
#[derive(Debug, Clone)]
pub struct Component {
    /// Its techniques in base order; the first is the reference, 0.
    pub members: Vec<usize>,
    /// Its compared pairs, numbered as in the whole table.
    pub pairs: Vec<Pair>,
    /// Its strongly connected sets, one number a member.
    pub sets: Vec<usize>,
}

impl Component {
    /// Whether maximum likelihood has a finite maximum.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.sets.iter().all(|set| *set == 0)
    }

    /// Its place of a technique.
    fn place(&self, technique: usize) -> usize {
        // Members are sorted, and pairs hold no other techniques.
        self.members.partition_point(|member| *member < technique)
    }

    /// The design whose parameters are all members but the reference.
    #[must_use]
    pub fn design(&self) -> Design {
        Design {
            parameters: self.members.len() - 1,
            position: false,
            rows: self
                .pairs
                .iter()
                .map(|pair| Row {
                    plus: self.place(pair.i).checked_sub(1),
                    minus: self.place(pair.j).checked_sub(1),
                    wins: pair.i_wins as f64,
                    losses: pair.j_wins as f64,
                })
                .collect(),
        }
    }

    /// How it can be fitted.
    #[must_use]
    pub fn method(&self) -> Method {
        if self.is_finite() {
            Method::MaximumLikelihood
        } else {
            Method::Penalised
        }
    }

    /// Fits a model.
    ///
    /// # Errors
    /// There is no finite maximum of the likelihood and no unique one of the penalised likelihood.
    pub fn fit(&self, link: Link) -> Result<Scale, Undefined> {
        let design = self.design();
        let fit = match self.method() {
            Method::MaximumLikelihood => maximise(&design, link, false, None)
                .ok_or(Undefined::no_finite_estimate("the fit did not converge"))?,
            Method::Penalised => firth::maximum(&design, link)?,
        };
        Ok(Scale {
            link,
            method: self.method(),
            fit,
            design,
        })
    }

    /// Fits a resample: without a search for other maxima of the penalised likelihood.
    #[must_use]
    pub fn fit_once(&self, link: Link) -> Option<Scale> {
        let design = self.design();
        let fit = maximise(&design, link, self.method() == Method::Penalised, None)?;
        Some(Scale {
            link,
            method: self.method(),
            fit,
            design,
        })
    }
}

/// Components of two or more techniques, and the label of every technique's component.
#[must_use]
pub fn components(table: &Comparisons) -> (Vec<Component>, Vec<usize>) {
    let labels = graph::components(table.techniques.len(), &table.pairs);
    let count = labels.iter().max().map_or(0, |last| last + 1);
    let mut members = vec![Vec::new(); count];
    for (technique, &label) in labels.iter().enumerate() {
        members[label].push(technique);
    }
    let mut pairs = vec![Vec::new(); count];
    for pair in &table.pairs {
        pairs[labels[pair.i]].push(*pair);
    }
    let found = members
        .into_iter()
        .zip(pairs)
        .filter(|(members, _)| members.len() > 1)
        .map(|(members, pairs)| component(members, pairs))
        .collect();
    (found, labels)
}

/// The pairs with their techniques numbered by their places among the members, which are sorted.
pub(super) fn numbered_within(members: &[usize], pairs: &[Pair]) -> Vec<Pair> {
    let place = |technique: usize| members.partition_point(|member| *member < technique);
    let numbered = pairs.iter().map(|pair| Pair {
        i: place(pair.i),
        j: place(pair.j),
        ..*pair
    });
    numbered.collect()
}

/// A component, with its strongly connected sets numbered from 0 in base order.
#[must_use]
pub fn component(members: Vec<usize>, pairs: Vec<Pair>) -> Component {
    let local = numbered_within(&members, &pairs);
    let sets = graph::strong_sets(members.len(), &local);
    Component {
        members,
        pairs,
        sets,
    }
}

/// A fitted scale. Values are on the link's own scale, in the order of the component's members.
#[derive(Debug, Clone)]
pub struct Scale {
    /// The model.
    pub link: Link,
    /// How it was fitted.
    pub method: Method,
    /// The estimates.
    pub fit: Fit,
    /// What was fitted.
    pub design: Design,
}

impl Scale {
    /// A member's distance from the reference.
    #[must_use]
    pub fn value(&self, place: usize) -> f64 {
        place.checked_sub(1).map_or(0.0, |at| self.fit.beta[at])
    }

    /// Standard error of the difference of two members.
    #[must_use]
    pub fn standard_error(&self, one: usize, other: usize) -> f64 {
        let covariance = |a: usize, b: usize| match (a.checked_sub(1), b.checked_sub(1)) {
            (Some(a), Some(b)) => self.fit.covariance[(a, b)],
            _ => 0.0,
        };
        let variance =
            covariance(one, one) + covariance(other, other) - 2.0 * covariance(one, other);
        variance.max(0.0).sqrt()
    }

    /// A member's distance from the mean of all, and its standard error.
    #[must_use]
    pub fn centred(&self, place: usize) -> (f64, f64) {
        let members = self.design.parameters + 1;
        let mean = self.fit.beta.sum() / members as f64;
        let mut contrast = DVector::from_element(members - 1, -1.0 / members as f64);
        if let Some(at) = place.checked_sub(1) {
            contrast[at] += 1.0;
        }
        let variance = (&self.fit.covariance * &contrast).dot(&contrast);
        (self.value(place) - mean, variance.max(0.0).sqrt())
    }
}
