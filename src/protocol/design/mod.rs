//! Designs: who sees the conditions in which order. One file a design, one line
//! in [`DESIGNS`].

mod inner_order;
mod latin;
mod random;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod williams;

pub use inner_order::InnerOrder;

use serde::{Deserialize, Deserializer};

/// A way of ordering the conditions of a study over its participants.
#[derive(Debug)]
pub struct Design {
    /// Name in a protocol.
    pub name: &'static str,
    /// What it does, in one sentence.
    pub summary: &'static str,
    /// The order of one session: `(conditions, seed, slot, inner order)` to one [`Place`] a
    /// trial. A pure function; every condition stands in it exactly once, and the inner
    /// order has no influence on where.
    pub order: fn(conditions: usize, seed: u64, slot: u32, inner_order: InnerOrder) -> Vec<Place>,
    /// How many slots make a block, after which everything that the design balances is even;
    /// `None` if it balances nothing between participants.
    pub block_slots: fn(conditions: usize) -> Option<usize>,
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
pub const DESIGNS: &[&Design] = &[&latin::LATIN, &williams::WILLIAMS, &random::RANDOM];

impl PartialEq for Design {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// The design of this name.
///
/// # Errors
/// What was found and what is allowed.
pub fn named(name: &str) -> Result<&'static Design, String> {
    let found = DESIGNS.iter().find(|design| design.name == name).copied();
    found.ok_or_else(|| {
        let allowed: Vec<&str> = DESIGNS.iter().map(|design| design.name).collect();
        format!("found {name:?}, allowed is {}", allowed.join(", "))
    })
}

impl<'de> Deserialize<'de> for &'static Design {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        named(&name).map_err(serde::de::Error::custom)
    }
}
