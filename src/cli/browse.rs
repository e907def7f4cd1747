//! `greyfield browse`: the stimuli of a set in a window.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;

use super::Failure;
use crate::app::{self, browser::Folder};

/// Look at the stimuli of a set: flip, split, difference, buffers, frame plans.
///
/// For the experimenter: it names the techniques. Keys: Space flips, A and B show one image,
/// S splits, D shows the difference, 0 fits, 1 shows one pixel as one, the arrows go through the
/// conditions; the wheel zooms, dragging moves.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  greyfield browse stimuli/thesis-2010.toml")]
pub struct Browse {
    /// The set's config (with frame plans and buffers), or a folder of stimuli.
    #[arg(value_name = "SET_OR_FOLDER")]
    path: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Bad input: what cannot be opened. Otherwise the display.
pub fn run(args: &Browse) -> Result<(), Failure> {
    let folder =
        Folder::open(&args.path).map_err(|message| Failure::bad_input(anyhow!(message)))?;
    if let Some(note) = &folder.note {
        eprintln!("note: {note}");
    }
    app::browse(folder)?;
    Ok(())
}
