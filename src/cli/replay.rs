//! `greyfield run --replay`: a recorded session again.

use std::path::{Path, PathBuf};

use anyhow::anyhow;

use super::{Failure, run as session_run};
use crate::app::clock::Clock;
use crate::app::replay::Replaying;
use crate::protocol::Protocol;
use crate::record::read_rows;
use crate::session::replay::Replay;
use crate::stimulus::Manifest;
use crate::{app, config};

/// Opens a window on the session of a data file.
///
/// # Errors
/// Bad input: what cannot be read, or would not be what was shown.
pub(super) fn run(
    session: &Path,
    protocol: Option<&Path>,
    stimuli: Option<&Path>,
) -> Result<(), Failure> {
    let path = protocol.map_or_else(|| kept_protocol(session), |path| Ok(path.to_owned()))?;
    let text = config::read(&path).map_err(Failure::bad_input)?;
    let kept = Protocol::parse(&path, &text).map_err(Failure::bad_input)?;
    let (manifest, folder) = match (stimuli, protocol) {
        (Some(folder), _) => (
            Manifest::load(folder).map_err(Failure::bad_input)?,
            folder.to_owned(),
        ),
        (None, Some(given)) => session_run::rendered(&kept.stimulus_set(given))?,
        (None, None) => {
            return Err(Failure::bad_input(anyhow!(
                "{}: the copy of the protocol kept with the data does not say where the images are; name their folder with --stimuli",
                path.display()
            )));
        }
    };
    let rows = read_rows(session).map_err(Failure::bad_input)?;
    for warning in &rows.warnings {
        eprintln!("warning: {warning}");
    }
    let replay = Replay::new(&rows.rows, &kept, &manifest)
        .map_err(|error| Failure::bad_input(anyhow!("{}: {error}", session.display())))?;
    let replaying = Replaying::new(replay, kept, folder, Clock::start());
    Ok(app::replay(replaying)?)
}

/// The protocol as it was: RESULTS/materials/protocol.toml of RESULTS/data/SESSION.csv.
fn kept_protocol(session: &Path) -> Result<PathBuf, Failure> {
    let absolute = std::path::absolute(session).unwrap_or_else(|_| session.to_owned());
    let results = absolute.parent().and_then(Path::parent);
    let kept = results.map(|results| results.join("materials/protocol.toml"));
    kept.filter(|path| path.exists()).ok_or_else(|| {
        Failure::bad_input(anyhow!(
            "{}: no materials/protocol.toml in the folder above it, as results folders have; name the protocol it was recorded with",
            session.display()
        ))
    })
}
