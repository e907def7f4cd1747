//! Planning a study before anybody is invited: how likely it is to find what is there, how many
//! participants that takes, what happens on the way, and the text that lays all of it down.
//!
//! [`power`], [`sample_size`], [`family`] and [`orders`] are exact sums of binomial probabilities;
//! [`sheet`] puts them together as tables. `docs/planning.md` has the definitions and a worked
//! example.

pub mod family;
pub mod orders;
pub mod power;
pub mod preregistration;
pub mod sample_size;
pub mod sheet;
pub mod simulate;

pub use power::Test;
pub use sample_size::{Criterion, SampleSize};

#[cfg(test)]
mod tests;
