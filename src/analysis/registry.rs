//! Every statistic, one line each. Tables, files, the methods text and the docs follow this order.

use super::statistic::{About, AnswerStatistic, ConditionStatistic, Correction, StudyStatistic};
use super::{
    audit, bayes_factor, benjamini_hochberg, chi_square, clopper_pearson, cochran_q, consistency,
    cumulative_link, effect_size, exact_binomial, friedman, holm, mcnemar, order_effect,
    position_bias, rankings, ratings, response_times, scaling, sequential, wilson,
};

/// Statistics of one condition.
pub const CONDITION_STATISTICS: &[ConditionStatistic] = &[
    wilson::STATISTIC,
    clopper_pearson::STATISTIC,
    chi_square::STATISTIC,
    exact_binomial::STATISTIC,
    effect_size::STATISTIC,
    bayes_factor::BY_CONDITION,
    position_bias::BY_CONDITION,
];

/// Columns of the conditions that need the single answers.
pub const ANSWER_STATISTICS: &[AnswerStatistic] = &[sequential::BY_CONDITION];

/// Corrections for the family of all conditions, the main one first.
pub const CORRECTIONS: &[Correction] = &[holm::CORRECTION, benjamini_hochberg::CORRECTION];

/// Statistics of the whole study.
pub const STUDY_STATISTICS: &[StudyStatistic] = &[
    position_bias::POOLED,
    order_effect::STATISTIC,
    mcnemar::STATISTIC,
    cochran_q::STATISTIC,
    bayes_factor::SENSITIVITY,
    sequential::STATISTIC,
    response_times::STATISTIC,
    scaling::STATISTIC,
    consistency::STATISTIC,
    rankings::STATISTIC,
    ratings::STATISTIC,
    audit::STATISTIC,
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
        .chain(ANSWER_STATISTICS.iter().map(|statistic| statistic.about))
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
