//! Percentile intervals over resampled participants, which hold where answers of one participant
//! hang together: B. Efron, R. J. Tibshirani (1993), An Introduction to the Bootstrap, ch. 13.

use rayon::prelude::*;

use super::comparison::{Comparisons, Pair};
use super::link::Link;
use super::scale::{Component, Method, component};
use crate::analysis::dataset::Dataset;
use crate::analysis::statistic::Context;
use crate::analysis::table::{Interval, Undefined};
use crate::analysis::tails::Alpha;
use crate::seed;

/// Resamples, by replicate: for every technique its value on its component's scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Bootstrap {
    /// How many were drawn.
    pub replicates: usize,
    /// How many needed Firth's penalty in some component.
    pub penalised: usize,
    /// How many left techniques unconnected, by component.
    pub broken: Vec<usize>,
    /// By component and member, the values of the replicates that have one.
    values: Vec<Vec<Vec<f64>>>,
}

/// A component's values in a resample and how they were fitted; `None` where it fell apart.
type Refitted = Option<(Vec<f64>, Method)>;

/// Participants' votes on end: a vote is twice its pair's number, one more where j was preferred.
struct Votes {
    ends: Vec<usize>,
    votes: Vec<u32>,
}

impl Votes {
    fn of(data: &Dataset, table: &Comparisons) -> Self {
        let pairs = table.pair_of_conditions(data);
        let vote = |answer: &crate::analysis::dataset::Answer| {
            let (pair, turned) = pairs[answer.condition as usize]?;
            let j_preferred = answer.chose_b()? != turned;
            u32::try_from(2 * pair + usize::from(j_preferred)).ok()
        };
        let mut ends = vec![0_usize; data.participants.len() + 1];
        for answer in data.answers.iter().filter(|a| vote(a).is_some()) {
            ends[answer.participant as usize + 1] += 1;
        }
        for at in 1..ends.len() {
            ends[at] += ends[at - 1];
        }
        let mut votes = vec![0; ends.last().copied().unwrap_or(0)];
        let mut next = ends.clone();
        for answer in &data.answers {
            if let Some(vote) = vote(answer) {
                let at = &mut next[answer.participant as usize];
                votes[*at] = vote;
                *at += 1;
            }
        }
        // Participants without a vote are nobody who could be drawn.
        ends.dedup();
        Self { ends, votes }
    }

    fn participants(&self) -> usize {
        self.ends.len() - 1
    }

    /// Votes of as many participants as there are, drawn with replacement.
    fn resample(&self, seed: u64, replicate: u64, pairs: &[Pair]) -> Vec<Pair> {
        let mut rng = seed::generator(seed, "scaling-bootstrap", replicate);
        let bound = u32::try_from(self.participants()).unwrap_or(u32::MAX);
        let mut counts = vec![0_u64; 2 * pairs.len()];
        for _ in 0..bound {
            let drawn = seed::below(&mut rng, bound) as usize;
            for &vote in &self.votes[self.ends[drawn]..self.ends[drawn + 1]] {
                counts[vote as usize] += 1;
            }
        }
        pairs
            .iter()
            .zip(counts.chunks_exact(2))
            .map(|(pair, counts)| Pair {
                i_wins: counts[0],
                j_wins: counts[1],
                ..*pair
            })
            .collect()
    }
}

/// Draws and fits them. `None` without single answers, or where none were asked for.
#[must_use]
pub fn run(
    context: &Context<'_>,
    table: &Comparisons,
    components: &[Component],
) -> Option<Bootstrap> {
    let Context {
        data,
        settings,
        watch,
    } = *context;
    if settings.bootstrap == 0 || !data.has_answers() {
        return None;
    }
    let votes = Votes::of(data, table);
    if votes.participants() == 0 {
        return None;
    }
    watch.begin("bootstrap", u64::from(settings.bootstrap));
    let replicates: Vec<Vec<Refitted>> = (0..settings.bootstrap)
        .into_par_iter()
        .map(|replicate| {
            let pairs = votes.resample(settings.seed, u64::from(replicate), &table.pairs);
            let fitted = components
                .iter()
                .map(|original| refit(original, &pairs))
                .collect();
            watch.step();
            fitted
        })
        .collect();
    Some(gather(&replicates, components))
}

/// A component's values in a resample; `None` where it falls apart.
fn refit(original: &Component, pairs: &[Pair]) -> Refitted {
    let mine: Vec<Pair> = pairs
        .iter()
        .filter(|pair| pair.votes() > 0 && original.members.binary_search(&pair.i).is_ok())
        .copied()
        .collect();
    if !is_connected(&original.members, &mine) {
        return None;
    }
    let scale = component(original.members.clone(), mine).fit_once(Link::Thurstone)?;
    let values = (0..original.members.len())
        .map(|place| scale.value(place))
        .collect();
    Some((values, scale.method))
}

fn is_connected(members: &[usize], pairs: &[Pair]) -> bool {
    let place = |technique: usize| members.partition_point(|member| *member < technique);
    let local: Vec<Pair> = pairs
        .iter()
        .map(|pair| Pair {
            i: place(pair.i),
            j: place(pair.j),
            ..*pair
        })
        .collect();
    super::graph::components(members.len(), &local)
        .iter()
        .all(|label| *label == 0)
}

fn gather(replicates: &[Vec<Refitted>], components: &[Component]) -> Bootstrap {
    let mut values: Vec<Vec<Vec<f64>>> = components
        .iter()
        .map(|component| vec![Vec::new(); component.members.len()])
        .collect();
    let mut broken = vec![0; components.len()];
    let mut penalised = 0;
    for replicate in replicates {
        let mut by_penalty = false;
        for (at, fitted) in replicate.iter().enumerate() {
            match fitted {
                None => broken[at] += 1,
                Some((estimates, method)) => {
                    by_penalty |= *method == Method::Penalised;
                    for (list, value) in values[at].iter_mut().zip(estimates) {
                        list.push(*value);
                    }
                }
            }
        }
        penalised += usize::from(by_penalty);
    }
    for list in values.iter_mut().flatten() {
        list.sort_by(f64::total_cmp);
    }
    Bootstrap {
        replicates: replicates.len(),
        penalised,
        broken,
        values,
    }
}

impl Bootstrap {
    /// The percentile interval of a member's distance from the reference, on the probit scale.
    ///
    /// # Errors
    /// Too few resamples reach as far out as alpha asks for.
    pub fn interval(
        &self,
        component: usize,
        place: usize,
        alpha: Alpha,
    ) -> Result<Interval, Undefined> {
        let sorted = &self.values[component][place];
        if (sorted.len() as f64) * alpha.get() < 2.0 {
            return Err(Undefined::not_available(
                "too few resamples for the ends of the interval",
            ));
        }
        Ok(Interval {
            low: quantile(sorted, alpha.get() / 2.0),
            high: quantile(sorted, 1.0 - alpha.get() / 2.0),
        })
    }
}

/// The quantile of sorted values by linear interpolation, the definition 7 of R. J. Hyndman, Y. Fan
/// (1996), The American Statistician 50(4), 361–365. 0 without values.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return 0.0;
    };
    let at = share * last as f64;
    let below = (at.floor() as usize).min(last);
    let above = (below + 1).min(last);
    sorted[below] + (at - below as f64) * (sorted[above] - sorted[below])
}
