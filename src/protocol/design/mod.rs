//! Designs: who sees the conditions in which order. One file a design, one line
//! in [`DESIGNS`].

mod latin;

use serde::{Deserialize, Deserializer};

/// A way of ordering the conditions of a study over its participants.
#[derive(Debug)]
pub struct Design {
    /// Name in a protocol.
    pub name: &'static str,
    /// What it does, in one sentence.
    pub summary: &'static str,
    /// The order of one session: `(conditions, seed, slot)` to one [`Place`] a trial.
    /// A pure function; every condition stands in it exactly once.
    pub order: fn(conditions: usize, seed: u64, slot: u32) -> Vec<Place>,
}

/// One place in a session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Place {
    /// Index of the condition.
    pub condition: usize,
    /// True when the pair is shown in the reverse of its base order.
    pub reversed: bool,
}

/// Every design there is.
pub const DESIGNS: &[&Design] = &[&latin::LATIN];

impl PartialEq for Design {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl<'de> Deserialize<'de> for &'static Design {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        DESIGNS
            .iter()
            .find(|design| design.name == name)
            .copied()
            .ok_or_else(|| {
                let allowed: Vec<&str> = DESIGNS.iter().map(|design| design.name).collect();
                serde::de::Error::custom(format!(
                    "found {name:?}, allowed is {}",
                    allowed.join(", ")
                ))
            })
    }
}
