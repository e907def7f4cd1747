//! `greyfield run`: participant sessions.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::anyhow;
use clap::{Args, ValueEnum};
use serde_json::json;
use time::OffsetDateTime;

use super::observer::scripted;
use super::{Failure, Verbosity, replay};
use crate::app;
use crate::config;
use crate::protocol::Protocol;
use crate::record::RecordError;
use crate::session::headless::{Headless, HeadlessError, Progress, Summary};
use crate::session::start;
use crate::stimulus::{Manifest, StimulusSet};

/// Run participant sessions, in a window or with scripted observers.
///
/// Every answer is on disk before the next screen is shown. A session that was
/// interrupted goes on where it stopped: run the same command again.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  greyfield run protocols/thesis-2010.toml --results results/thesis --headless --observer random:1 --participants 28"
)]
pub struct Run {
    /// The protocol [with --replay, default: materials/protocol.toml beside the data].
    #[arg(value_name = "PROTOCOL.toml", required_unless_present = "replay")]
    pub protocol: Option<PathBuf>,
    /// Folder for the data, of this protocol alone; made if it is not there.
    #[arg(long, value_name = "DIR", required_unless_present = "replay")]
    pub results: Option<PathBuf>,
    /// Show a recorded session again, from its data file; nothing is written.
    #[arg(long, value_name = "SESSION.csv", conflicts_with_all = ["results", "pilot", "windowed", "headless"])]
    pub replay: Option<PathBuf>,
    /// Folder of the rendered stimuli [default: beside the stimulus set's config, named like it].
    #[arg(long, value_name = "DIR")]
    pub stimuli: Option<PathBuf>,
    /// Name of this computer in the rows.
    #[arg(long, value_name = "NAME", default_value = "station-1")]
    pub station: String,
    /// Mark the rows as pilot data; pilot slots are counted apart.
    #[arg(long)]
    pub pilot: bool,
    /// A window instead of the full screen, to try things out.
    #[arg(long, conflicts_with = "headless")]
    pub windowed: bool,
    /// No window: scripted observers sit the same sessions in virtual time.
    #[arg(long, requires_all = ["observer", "participants"])]
    pub headless: bool,
    /// Who answers: random:SEED (a fair coin), first (always the first image),
    /// model:SEED[,KEY=VALUE…] (by the images' distance to the truth; keys: metric=flip|error,
    /// sigma, lapse, bias, participants, truth=LABEL), or share:SEED[,KEY=VALUE…] (the second
    /// technique of each pair with a given probability; keys: p, bias, participants); see
    /// docs/observers.md.
    #[arg(long, value_name = "OBSERVER", requires = "headless")]
    pub observer: Option<String>,
    /// How many scripted participants there are to be in the end.
    #[arg(long, value_name = "N", requires = "headless", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub participants: Option<u32>,
    /// What is printed: text, or one JSON object a line, a row's once it is synced.
    #[arg(long, value_enum, default_value_t = Format::Text, requires = "headless")]
    pub format: Format,
}

/// How a headless run tells what it does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A summary; with -v a line a participant, with -vv a line a row.
    Text,
    /// One JSON object a line.
    Json,
}

/// Everything a session needs from disk, checked.
pub struct Prepared {
    /// The protocol.
    pub protocol: Protocol,
    /// Its text.
    pub protocol_text: String,
    /// What was rendered.
    pub manifest: Manifest,
    /// Where the images are.
    pub stimuli: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Bad input (exit code 2): protocol, stimuli, names. Otherwise the disk.
pub fn run(args: &Run, verbosity: Verbosity) -> Result<(), Failure> {
    let stimuli = args.stimuli.as_deref();
    if let Some(session) = &args.replay {
        return replay::run(session, args.protocol.as_deref(), stimuli);
    }
    // clap asks for both where nothing is replayed.
    let (Some(protocol), Some(results)) = (&args.protocol, &args.results) else {
        return Err(Failure::bad_input(anyhow!(
            "PROTOCOL.toml and --results are needed"
        )));
    };
    if args.headless {
        let prepared = prepare(protocol, stimuli)?;
        return headless(args, &prepared, results, verbosity);
    }
    open_window(&InWindow {
        protocol,
        stimuli,
        results,
        station: &args.station,
        pilot: args.pilot,
        windowed: args.windowed,
    })
}

/// Sessions in a window that covers the screen, until it is closed.
///
/// # Errors
/// As [`run`]; also no display, or no graphics adapter.
pub fn window(
    protocol: &Path,
    stimuli: Option<&Path>,
    results: &Path,
    station: &str,
    pilot: bool,
) -> Result<(), Failure> {
    open_window(&InWindow {
        protocol,
        stimuli,
        results,
        station,
        pilot,
        windowed: false,
    })
}

struct InWindow<'a> {
    protocol: &'a Path,
    stimuli: Option<&'a Path>,
    results: &'a Path,
    station: &'a str,
    pilot: bool,
    windowed: bool,
}

fn open_window(wanted: &InWindow<'_>) -> Result<(), Failure> {
    let started = Instant::now();
    // Before anything is written.
    app::check_display()?;
    let prepared = prepare(wanted.protocol, wanted.stimuli)?;
    let study = start::open_study(
        wanted.results,
        &prepared.protocol,
        &prepared.protocol_text,
        &prepared.manifest,
    )
    .map_err(failure_of_opening)?;
    app::run(app::Setup {
        protocol: prepared.protocol,
        protocol_path: wanted.protocol.to_owned(),
        manifest: prepared.manifest,
        stimuli: prepared.stimuli,
        study,
        station: wanted.station.to_owned(),
        pilot: wanted.pilot,
        windowed: wanted.windowed,
        started,
    })?;
    Ok(())
}

/// Reads the protocol and the rendered stimuli, and checks every image.
///
/// # Errors
/// Bad input, naming the file and how to mend it.
pub fn prepare(protocol_path: &Path, stimuli: Option<&Path>) -> Result<Prepared, Failure> {
    let protocol_text = config::read(protocol_path).map_err(Failure::bad_input)?;
    let protocol = Protocol::parse(protocol_path, &protocol_text).map_err(Failure::bad_input)?;
    let (manifest, stimuli) = match stimuli {
        Some(folder) => (
            load(folder, &protocol.stimulus_set(protocol_path))?,
            folder.to_owned(),
        ),
        None => rendered(&protocol.stimulus_set(protocol_path))?,
    };
    manifest.verify(&stimuli).map_err(Failure::bad_input)?;
    Ok(Prepared {
        protocol,
        protocol_text,
        manifest,
        stimuli,
    })
}

/// The images of a set where `greyfield render` puts them, drawn from the set as it is now.
pub(super) fn rendered(set_path: &Path) -> Result<(Manifest, PathBuf), Failure> {
    let set = StimulusSet::load(set_path).map_err(Failure::bad_input)?;
    let folder = set.default_folder();
    let manifest = load(&folder, set_path)?;
    let drawn: Vec<&str> = manifest
        .pairs
        .iter()
        .map(|pair| pair.condition.as_str())
        .collect();
    let wanted: Vec<&str> = set
        .conditions
        .iter()
        .map(|condition| condition.id.as_str())
        .collect();
    if manifest.config_sha256 != set.sha256 || drawn != wanted {
        return Err(Failure::bad_input(anyhow!(
            "{}: these images were drawn from another state of the set or are not all of it; draw it again with `greyfield render {}`, or name the images' folder with --stimuli",
            folder.display(),
            set_path.display()
        )));
    }
    Ok((manifest, folder))
}

fn load(folder: &Path, set_path: &Path) -> Result<Manifest, Failure> {
    if folder.join(crate::stimulus::manifest::FILE_NAME).exists() {
        return Manifest::load(folder).map_err(Failure::bad_input);
    }
    Err(Failure::bad_input(anyhow!(
        "{}: no rendered stimuli here; draw them with `greyfield render {} --out {}`, or name their folder with --stimuli",
        folder.display(),
        set_path.display(),
        folder.display()
    )))
}

fn headless(
    args: &Run,
    prepared: &Prepared,
    results: &Path,
    verbosity: Verbosity,
) -> Result<(), Failure> {
    let name = args.observer.as_deref().unwrap_or_default();
    let scripted = scripted(name, prepared, verbosity)?;
    let participants = args.participants.unwrap_or(1);
    let study = start::open_study(
        results,
        &prepared.protocol,
        &prepared.protocol_text,
        &prepared.manifest,
    )
    .map_err(failure_of_opening)?
    .pilot(args.pilot);
    let headless = Headless {
        study: &study,
        protocol: &prepared.protocol,
        manifest: &prepared.manifest,
        scripted: &scripted,
        station: &args.station,
    };
    let mut stdout = io::stdout().lock();
    let mut told = Ok(());
    let bar = verbosity.progress(participants.into());
    let summary = headless
        .run(participants, OffsetDateTime::now_utc, |progress| {
            match progress {
                // At once: the run may fail later, and this is about data on disk.
                Progress::Started(enrolment) => enrolment
                    .warnings
                    .iter()
                    .for_each(|warning| bar.suspend(|| eprintln!("warning: {warning}"))),
                Progress::Finished(_) => bar.inc(1),
                Progress::Stored { .. } => {}
            }
            if told.is_ok() {
                told = tell(&mut stdout, &progress, args.format, verbosity);
            }
        })
        .map_err(failure_of_run)?;
    bar.finish_and_clear();
    told?;
    summarise(&mut stdout, &summary, args.format, verbosity)?;
    Ok(())
}

/// A protocol without a plan is the user's to mend, too.
pub(super) fn failure_of_opening(error: start::OpenError) -> Failure {
    match error {
        start::OpenError::Record(error) => failure_of_folder(error),
        start::OpenError::Plan(_) => Failure::bad_input(error),
    }
}

/// A wrong folder or name is the user's to mend, a disk that fails is not.
pub(super) fn failure_of_folder(error: RecordError) -> Failure {
    match error {
        RecordError::Io { .. } | RecordError::Row { .. } => error.into(),
        _ => Failure::bad_input(error),
    }
}

pub(super) fn failure_of_run(error: HeadlessError) -> Failure {
    match error {
        HeadlessError::Record(error) => failure_of_folder(error),
        HeadlessError::Start(_) => Failure::bad_input(error),
        HeadlessError::Store { .. } => error.into(),
    }
}

fn tell(
    stdout: &mut impl Write,
    progress: &Progress,
    format: Format,
    verbosity: Verbosity,
) -> io::Result<()> {
    match (format, progress) {
        (Format::Json, Progress::Started(enrolment)) => writeln!(
            stdout,
            "{}",
            json!({"event": "started", "participant": enrolment.participant.as_str(), "slot": enrolment.slot, "segment": enrolment.segment, "answered": enrolment.rows.len(), "warnings": enrolment.warnings})
        ),
        (Format::Json, Progress::Stored { row_id, path }) => writeln!(
            stdout,
            "{}",
            json!({"event": "stored", "row_id": row_id, "file": path})
        ),
        (Format::Json, Progress::Finished(participant)) => writeln!(
            stdout,
            "{}",
            json!({"event": "finished", "participant": participant.as_str()})
        ),
        (Format::Text, Progress::Stored { row_id, .. }) if verbosity.level >= 2 => {
            writeln!(stdout, "stored {row_id}")
        }
        (Format::Text, Progress::Finished(participant)) if verbosity.level >= 1 => {
            writeln!(stdout, "finished {participant}")
        }
        (Format::Text, _) => Ok(()),
    }
}

fn summarise(
    stdout: &mut impl Write,
    summary: &Summary,
    format: Format,
    verbosity: Verbosity,
) -> io::Result<()> {
    match format {
        Format::Json => writeln!(
            stdout,
            "{}",
            json!({"event": "done", "finished": summary.finished, "resumed": summary.resumed, "already_finished": summary.already_finished, "rows": summary.rows, "data": summary.data})
        ),
        Format::Text if verbosity.quiet => Ok(()),
        Format::Text => {
            write!(
                stdout,
                "{} sessions finished",
                summary.finished + summary.resumed
            )?;
            if summary.resumed > 0 {
                write!(stdout, " ({} of them resumed)", summary.resumed)?;
            }
            if summary.already_finished > 0 {
                write!(stdout, ", {} were already", summary.already_finished)?;
            }
            let (rows, data) = (summary.rows, summary.data.display());
            writeln!(stdout, "; {rows} rows written to {data}")
        }
    }
}
