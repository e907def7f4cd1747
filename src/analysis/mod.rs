//! The statistics. Tails and quantiles come from [`tails`].

pub mod tails;
