//! What cannot be estimated.

/// Settings that make no sense.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("setting `{setting}`: found {found}, allowed is {allowed}")]
pub struct ReferenceError {
    /// The setting.
    pub setting: &'static str,
    /// Its value.
    pub found: String,
    /// What it may be.
    pub allowed: &'static str,
}
