//! `greyfield export`: results in the layouts of other tools.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;

use super::run::failure_of_folder;
use super::{Failure, Verbosity};
use crate::record::export::{FORMATS, Selection, export};

/// Export a results folder for other tools; the folder itself stays as it is.
///
/// psych-ds and bids are datasets for an archive, pwcmp is a table of comparisons for scaling,
/// csv is one flat file. Rows of pilot sessions and of rejected participants are left out unless
/// asked for.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield export results/thesis-2010 --to bids --out thesis-2010-bids"
)]
pub struct Export {
    /// The results folder.
    #[arg(value_name = "RESULTS")]
    results: PathBuf,
    /// The layout.
    #[arg(long, value_name = "FORMAT", value_parser = PossibleValuesParser::new(FORMATS.iter().map(|format| clap::builder::PossibleValue::new(format.name).help(format.summary))))]
    to: String,
    /// Where to; a folder that is not there yet, or empty.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Rows of pilot sessions too.
    #[arg(long)]
    include_pilot: bool,
    /// Rows of rejected participants too.
    #[arg(long)]
    include_rejected: bool,
}

/// Runs the command.
///
/// # Errors
/// Bad input (exit code 2): no results folder, or a place that is taken. Otherwise the disk.
pub fn run(args: &Export, verbosity: Verbosity) -> Result<(), Failure> {
    let selection = Selection {
        include_pilot: args.include_pilot,
        include_rejected: args.include_rejected,
    };
    // The parser lets no other name through.
    let format = FORMATS.iter().find(|format| format.name == args.to);
    let Some(format) = format else {
        return Err(Failure::bad_input(anyhow::anyhow!(
            "no format {:?}",
            args.to
        )));
    };
    let done = export(&args.results, format, selection, &args.out).map_err(failure_of_folder)?;
    for note in &done.notes {
        eprintln!("note: {note}");
    }
    if !verbosity.quiet {
        println!(
            "{} rows in {} files, {}: {}",
            done.rows,
            done.files.len(),
            format.name,
            args.out.display()
        );
    }
    Ok(())
}
