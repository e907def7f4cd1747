//! Every statistic, one line each. Tables, files, the methods text and the docs follow this order.

use super::statistic::{About, ConditionStatistic, Correction, StudyStatistic};
use super::{
    benjamini_hochberg, chi_square, clopper_pearson, cumulative_link, effect_size, exact_binomial,
    friedman, holm, mcnemar, position_bias, rankings, ratings, wilson,
};

/// Statistics of one condition.
pub const CONDITION_STATISTICS: &[ConditionStatistic] = &[
    wilson::STATISTIC,
    clopper_pearson::STATISTIC,
    chi_square::STATISTIC,
    exact_binomial::STATISTIC,
    effect_size::STATISTIC,
    position_bias::BY_CONDITION,
];

/// Corrections for the family of all conditions, the main one first.
pub const CORRECTIONS: &[Correction] = &[holm::CORRECTION, benjamini_hochberg::CORRECTION];

/// Statistics of the whole study.
pub const STUDY_STATISTICS: &[StudyStatistic] = &[
    position_bias::POOLED,
    mcnemar::STATISTIC,
    rankings::STATISTIC,
    ratings::STATISTIC,
];

/// What those of ratings and rankings compute beside what they are named for.
const PARTS: &[About] = &[friedman::ABOUT, cumulative_link::ABOUT];

/// What each of them is, without repetition.
#[must_use]
pub fn abouts() -> Vec<About> {
    let mut all: Vec<About> = Vec::new();
    let every = CONDITION_STATISTICS
        .iter()
        .map(|statistic| statistic.about)
        .chain(CORRECTIONS.iter().map(|correction| correction.about))
        .chain(STUDY_STATISTICS.iter().map(|statistic| statistic.about))
        .chain(PARTS.iter().copied());
    for about in every {
        if !all.contains(&about) {
            all.push(about);
        }
    }
    all
}
