//! `greyfield watch`: a study while it runs, in a window of its own.

use std::path::PathBuf;

use clap::Args;

use super::Failure;
use super::run::failure_of_folder;
use crate::app;
use crate::record::Study;

/// Watch a study while it runs: who is at which trial, balance, audit, decisions, exports.
///
/// For the experimenter, on a second monitor or on another computer that sees the results
/// folder. It is a program of its own and reads the folder once a second, so that a running
/// session never waits for it.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  greyfield watch results/my-study")]
pub struct Watch {
    /// The results folder.
    #[arg(value_name = "RESULTS")]
    results: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Bad input: no results folder. Otherwise the display.
pub fn run(args: &Watch) -> Result<(), Failure> {
    Study::open_existing(&args.results).map_err(failure_of_folder)?;
    app::watch(&args.results)?;
    Ok(())
}
