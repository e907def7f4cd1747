//! Who sees what when: protocol configs, counterbalancing, the session plan.
//!
//! Everything here is a pure function of (protocol, seed, slot): no clock, no
//! disk, no window. The same three give the same session on any machine, forever.

pub mod plan;

pub use plan::{Condition, Position, SessionPlan, Trial};
