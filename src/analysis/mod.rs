//! The statistics: pure functions from answers to results. The same input gives the same result,
//! bit for bit.
//!
//! Each statistic is one file that declares itself ([`statistic`]) and one line in [`registry`].
//! Tails and quantiles come from [`tails`]. `docs/analysis.md` lists formulas, sources and what is
//! said in edge cases.

pub mod conclusion;
pub mod conditions;
pub mod dataset;
pub mod input;
pub mod registry;
pub mod settings;
pub mod statistic;
pub mod table;
pub mod tails;

pub mod audit;
pub mod bayes_factor;
pub mod benjamini_hochberg;
pub mod blocks;
pub mod chi_square;
pub mod clopper_pearson;
pub mod cochran_q;
pub mod consistency;
pub mod cumulative_link;
pub mod effect_size;
pub mod exact_binomial;
pub mod friedman;
pub mod holm;
pub mod mcnemar;
pub mod order_effect;
pub mod position_bias;
mod rank_tests;
pub mod rankings;
pub mod ratings;
pub mod response_times;
pub mod scaling;
pub mod sequential;
pub mod wilcoxon;
pub mod wilson;

pub use dataset::Dataset;
pub use settings::Settings;
pub use tails::Alpha;

use statistic::{Context, Section, Watch};
use table::Table;

/// Everything the report tells.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// What was chosen.
    pub settings: Settings,
    /// What went in.
    pub data: Dataset,
    /// One row a condition, every statistic.
    pub conditions: Table,
    /// The main result in sentences.
    pub conclusion: Vec<String>,
    /// Statistics of the study as a whole.
    pub sections: Vec<Section>,
}

/// Runs every statistic of the registry.
#[must_use]
pub fn analyse(data: Dataset, settings: Settings) -> Analysis {
    analyse_watched(data, settings, &())
}

/// The same, and tells somebody how far long work is.
#[must_use]
pub fn analyse_watched(data: Dataset, settings: Settings, watch: &dyn Watch) -> Analysis {
    let context = Context {
        data: &data,
        settings: &settings,
        watch,
    };
    Analysis {
        conditions: conditions::table(&data, &settings),
        conclusion: conclusion::sentences(&data, &settings),
        sections: registry::STUDY_STATISTICS
            .iter()
            .filter_map(|statistic| (statistic.section)(&context))
            .collect(),
        settings,
        data,
    }
}
