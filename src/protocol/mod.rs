//! Who sees what when: protocol configs, counterbalancing, the session plan.
//!
//! Everything here is a pure function of (protocol, seed, slot): no clock, no
//! disk, no window. The same three give the same session on any machine, forever.

pub mod analysis;
pub mod balance;
mod checks;
pub mod config;
pub mod design;
pub mod display;
pub mod exhibit;
pub mod key;
pub mod locale;
pub mod options;
pub mod plan;
pub mod procedure;
pub mod text;

pub use analysis::AnalysisPlan;
pub use balance::Balance;
pub use config::Protocol;
pub use display::DisplayRequirements;
pub use exhibit::{Condition, Exhibit, Pair};
pub use key::Key;
pub use locale::{Language, Words};
pub use plan::{Pause, Phase, PlanError, Position, SessionPlan, Trial};
