//! `greyfield participants`: who took part, and what is decided about them.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;
use time::OffsetDateTime;
use unicode_width::UnicodeWidthStr;

use super::run::failure_of_folder;
use super::{Failure, output};
use crate::record::{ParticipantId, RecordError, Standing, Study};

/// List the participants of a results folder; release, reject or reinstate one.
///
/// --release gives a participant's slot to the next new one (both stay on record). --reject
/// leaves the data where it is and out of the analysis; the participant keeps the slot until
/// released. --reinstate takes back either or both, any number of times; a slot that somebody
/// else has taken since stays theirs.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  greyfield participants results/thesis-2010
  greyfield participants results/thesis-2010 --reject P07 --reason \"fell asleep\"
  greyfield participants results/thesis-2010 --release P07 --reason \"fell asleep\"
  greyfield participants results/thesis-2010 --reinstate P07")]
pub struct Participants {
    /// The results folder.
    #[arg(value_name = "RESULTS")]
    results: PathBuf,
    /// Give this participant's slot to the next new one.
    #[arg(long, value_name = "ID", requires = "reason", conflicts_with_all = ["reject", "reinstate"])]
    release: Option<String>,
    /// Leave this participant's data out of the analysis.
    #[arg(
        long,
        value_name = "ID",
        requires = "reason",
        conflicts_with = "reinstate"
    )]
    reject: Option<String>,
    /// Take back the rejection and the release of this participant.
    #[arg(long, value_name = "ID")]
    reinstate: Option<String>,
    /// Why, in your words; stands in the record.
    #[arg(long, value_name = "TEXT", value_parser = reason)]
    reason: Option<String>,
    /// How the list is printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// How the list is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A table.
    Text,
    /// One JSON object.
    Json,
}

fn reason(text: &str) -> Result<String, String> {
    let text = text.trim();
    if text.is_empty() {
        return Err(String::from("a reason needs at least one word"));
    }
    Ok(text.to_owned())
}

/// Runs the command.
///
/// # Errors
/// Bad input (exit code 2): no results folder, an unknown participant, or a slot that somebody
/// else has. Otherwise the disk.
pub fn run(args: &Participants) -> Result<(), Failure> {
    let study = Study::open_existing(&args.results).map_err(failure_of_folder)?;
    if let Some(told) = decide(args, &study).map_err(failure_of_folder)? {
        eprintln!("{told}");
    }
    let trials = study.identity().trials();
    let (study, mut standings) = series(study, false)?;
    let (study, pilots) = series(study, true)?;
    standings.extend(pilots);
    let next_slot = study.pilot(false).next_slot().map_err(failure_of_folder)?;
    let text = match args.format {
        Format::Text => table(&standings, trials, next_slot),
        Format::Json => as_json(&standings, trials, next_slot)?,
    };
    Ok(output::write(None, text.as_bytes())?)
}

fn series(study: Study, pilot: bool) -> Result<(Study, Vec<Standing>), Failure> {
    let study = study.pilot(pilot);
    let standings = study.standings().map_err(failure_of_folder)?;
    Ok((study, standings))
}

/// Does what was asked and gives a sentence on it.
fn decide(args: &Participants, study: &Study) -> Result<Option<String>, RecordError> {
    let reason = args.reason.as_deref().unwrap_or_default();
    let now = OffsetDateTime::now_utc();
    let told = if let Some(id) = &args.release {
        let slot = study.release(&ParticipantId::new(id)?, reason, now)?;
        format!("{id} is released; slot {slot} goes to the next new participant")
    } else if let Some(id) = &args.reject {
        study.reject(&ParticipantId::new(id)?, reason, now)?;
        format!("{id} is rejected; the data stays and is left out of the analysis")
    } else if let Some(id) = &args.reinstate {
        let done = study.reinstate(&ParticipantId::new(id)?, reason, now)?;
        match done.took_slot_back {
            true => format!("{id} is reinstated and has slot {} again", done.slot),
            false => format!("{id} is reinstated; the data counts"),
        }
    } else {
        return Ok(None);
    };
    Ok(Some(told))
}

/// What stands in the last column, the plainest word first.
fn state(standing: &Standing, trials: usize) -> String {
    let mut words = vec![if standing.answered >= trials {
        "finished"
    } else {
        "unfinished"
    }];
    if standing.released.is_some() {
        words.push("released");
    }
    if standing.rejected.is_some() {
        words.push("rejected");
    }
    words.join(", ")
}

fn reasons(standing: &Standing) -> String {
    let released = standing.released.iter().map(|known| &known.reason);
    let rejected = standing.rejected.iter().map(|known| &known.reason);
    let mut all: Vec<&str> = released.chain(rejected).map(String::as_str).collect();
    all.dedup();
    all.join("; ").replace(char::is_control, " ")
}

fn table(standings: &[Standing], trials: usize, next_slot: u32) -> String {
    if standings.is_empty() {
        return String::from("Nobody yet\n");
    }
    let width = standings
        .iter()
        .map(|standing| standing.participant.width())
        .fold("participant".len(), usize::max);
    let mut text = format!(
        "{:<9}  {:<width$}  {:>7}  state\n",
        "slot", "participant", "trials"
    );
    for standing in standings {
        let series = if standing.pilot { "pilot " } else { "" };
        let line = format!(
            "{:<9}  {:<width$}  {:>7}  {:<22}  {}",
            format!("{series}{}", standing.slot),
            standing.participant,
            format!("{}/{trials}", standing.answered),
            state(standing, trials),
            reasons(standing),
        );
        text += line.trim_end();
        text.push('\n');
    }
    text + &format!("The next new participant takes slot {next_slot}\n")
}

fn as_json(standings: &[Standing], trials: usize, next_slot: u32) -> Result<String, Failure> {
    let one = |standing: &Standing| {
        json!({
            "participant": standing.participant,
            "slot": standing.slot,
            "pilot": standing.pilot,
            "trials_on_record": standing.answered,
            "finished": standing.answered >= trials,
            "released": standing.released,
            "rejected": standing.rejected,
        })
    };
    let all: Vec<_> = standings.iter().map(one).collect();
    let text = serde_json::to_string_pretty(&json!({
        "trials": trials,
        "next_slot": next_slot,
        "participants": all,
    }))?;
    Ok(text + "\n")
}
