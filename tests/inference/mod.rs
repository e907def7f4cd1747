//! Studies of which the truth is known, put through the analysis, and how often it is right about them.
//!
//! Every claim has a range, a seed and a number of studies ([`claim`]). The same simulations are a test
//! (`cargo test --test inference`) and, longer and of more kinds, a bench (`cargo bench --bench inference`).

pub mod claim;
pub mod effects;
pub mod evidence;
pub mod families;
pub mod participants;
pub mod scales;
pub mod shares;
pub mod study;

/// How much is simulated.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Studies, by those of the test.
    pub times: u32,
    /// Whether the simulations that the test has no time for are there, too.
    pub wide: bool,
}

impl Effort {
    /// `few` in the test; `few` and `more` in the bench.
    pub fn of<T: Copy>(self, few: &[T], more: &[T]) -> Vec<T> {
        let more = if self.wide { more } else { &[] };
        [few, more].concat()
    }
}
