//! Percentile intervals over resampled participants, which hold where answers of one participant
//! hang together: B. Efron, R. J. Tibshirani (1993), An Introduction to the Bootstrap, ch. 13.
//!
//! Plain percentiles are too short for few participants, as an interval of a mean would be with z for t and n
//! for n − 1 in the variance. Their levels are moved outwards by both: T. C. Hesterberg (2015), The
//! American Statistician 69(4), 371–386, section 5.2, the expanded percentile interval.

use rayon::prelude::*;

use super::comparison::{Comparisons, Pair};
use super::link::Link;
use super::scale::{Component, Method, component, numbered_within};
use crate::analysis::dataset::Dataset;
use crate::analysis::statistic::Context;
use crate::analysis::table::{Interval, Undefined};
use crate::analysis::tails::{Alpha, normal_upper, student_t_critical};
use crate::seed;

/// Resamples, by replicate: for every technique its value on its component's scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Bootstrap {
    /// How many were drawn.
    pub replicates: usize,
    /// Of how many participants.
    pub participants: usize,
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
    Some(gather(votes.participants(), &replicates, components))
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
    let local = numbered_within(members, pairs);
    super::graph::components(members.len(), &local)
        .iter()
        .all(|label| *label == 0)
}

fn gather(
    participants: usize,
    replicates: &[Vec<Refitted>],
    components: &[Component],
) -> Bootstrap {
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
        participants,
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
        let too_few = Undefined::not_available("too few resamples for the ends of the interval");
        let tail = expanded_tail(self.participants, alpha).ok_or(too_few)?;
        let low = quantile(sorted, tail).ok_or(too_few)?;
        let high = quantile(sorted, 1.0 - tail).ok_or(too_few)?;
        Ok(Interval { low, high })
    }
}

/// The share of resamples beyond either end: Φ(−t √(n/(n − 1))), t the two-sided critical value with n − 1
/// degrees of freedom. `None` for one participant.
fn expanded_tail(participants: usize, alpha: Alpha) -> Option<f64> {
    let n = participants as f64;
    let t = student_t_critical(alpha, n - 1.0)?;
    Some(normal_upper(t * (n / (n - 1.0)).sqrt()).value())
}

/// The quantile of sorted values by linear interpolation, the definition 6 of R. J. Hyndman, Y. Fan
/// (1996), The American Statistician 50(4), 361–365: one more value falls below it with the probability `share`
/// exactly, so that few resamples do not shorten the interval. `None` where it is beyond the outermost value.
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let at = share * (sorted.len() as f64 + 1.0) - 1.0;
    let last = sorted.len().checked_sub(1)?;
    // 1 − share was rounded.
    let slack = 1e-9 * sorted.len() as f64;
    if at < -slack || at > last as f64 + slack {
        return None;
    }
    let at = at.clamp(0.0, last as f64);
    let below = at.floor() as usize;
    let above = (below + 1).min(last);
    Some(sorted[below] + (at - below as f64) * (sorted[above] - sorted[below]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R 4.2: `pnorm(-qt(1 - alpha/2, n - 1) * sqrt(n / (n - 1)))`.
    #[test]
    fn few_participants_move_the_levels_outwards() {
        for (n, alpha, expected) in [
            (5, 0.05, 0.000_954_100_551_882_491_6),
            (20, 0.05, 0.015_880_829_920_347_96),
            (20, 0.1, 0.038_027_205_853_879_86),
            (36, 0.05, 0.019_751_659_291_132_78),
            (60, 0.05, 0.021_801_790_933_923_39),
        ] {
            let alpha = Alpha::try_from(alpha).unwrap();
            let tail = expanded_tail(n, alpha).unwrap();
            assert!((tail - expected).abs() < 1e-12, "{n}: {tail}");
        }
        assert_eq!(expanded_tail(1, Alpha::FIVE_PERCENT), None);
        // For large n: φ(z) ((z³ + z)/4 + z/2)/n less than α/2.
        let many = expanded_tail(10_000_000, Alpha::FIVE_PERCENT).unwrap();
        assert!((0.025 - many - 1.959_2e-8).abs() < 1e-11);
    }

    /// R 4.2: `quantile(x, type = 6)`.
    #[test]
    fn quantiles_are_those_of_definition_6() {
        let sorted = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0];
        for (share, expected) in [(0.1, 1.0), (0.25, 3.0), (0.33, 5.2), (0.9, 256.0)] {
            let ours = quantile(&sorted, share).unwrap();
            assert!((ours - expected).abs() < 1e-12, "{share}: {ours}");
        }
        assert_eq!(quantile(&sorted, 0.09), None);
        assert_eq!(quantile(&sorted, 0.91), None);
        assert_eq!(quantile(&[], 0.5), None);
    }
}
