//! Who sees what when: protocol configs, counterbalancing, the session plan.
//!
//! Everything here is a pure function of (protocol, seed, slot): no clock, no
//! disk, no window. The same three give the same session on any machine, forever.

pub mod config;
pub mod design;
pub mod display;
pub mod key;
pub mod plan;
pub mod procedure;
pub mod text;

pub use config::Protocol;
pub use display::DisplayRequirements;
pub use key::Key;
pub use plan::{Condition, Phase, PlanError, Position, SessionPlan, Trial};
