//! What happens inside, told on stderr as loudly as the command line asks.

use std::io::IsTerminal as _;

use tracing_subscriber::EnvFilter;

use super::Verbosity;

/// Environment variable that overrules `-v`, in the syntax of `RUST_LOG`.
const VARIABLE: &str = "GREYFIELD_LOG";

/// Starts telling. Only the first call of a process counts.
pub fn init(verbosity: Verbosity) {
    let level = match verbosity {
        Verbosity { quiet: true, .. } => "error",
        Verbosity { level: 0, .. } => "warn",
        Verbosity { level: 1, .. } => "info",
        Verbosity { level: 2, .. } => "debug",
        Verbosity { .. } => "trace",
    };
    // Libraries warn of what they do without; their errors matter.
    let ours = || EnvFilter::new(format!("error,greyfield={level}"));
    let filter = EnvFilter::try_from_env(VARIABLE).unwrap_or_else(|_| ours());
    // A second subscriber is refused: tests may run several commands in a process.
    let _ = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .with_target(false)
        .try_init();
}
