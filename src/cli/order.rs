//! `greyfield order`: the plan of a study as CSV.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use super::Failure;
use crate::config;
use crate::protocol::{Condition, Pair, Protocol, SessionPlan, exhibit};
use crate::stimulus::StimulusSet;
use crate::stimulus::set::SetCondition;

/// Print who sees which pairs in which order, as CSV.
///
/// Columns: participant (the slot, from 0), position (from 0), condition, and the
/// two techniques in the order shown. The same protocol and seed give the same plan
/// on any machine.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  greyfield order protocols/thesis-2010.toml --participants 36")]
pub struct Order {
    /// The protocol.
    #[arg(value_name = "PROTOCOL.toml")]
    protocol: PathBuf,
    /// How many participants [default: as many as the protocol plans].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    participants: Option<u32>,
    /// Another seed than the protocol's.
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
}

/// Runs the command.
///
/// # Errors
/// Bad input: the protocol or its stimulus set. Otherwise the output.
pub fn run(args: &Order) -> Result<(), Failure> {
    let text = config::read(&args.protocol).map_err(Failure::bad_input)?;
    let mut protocol = Protocol::parse(&args.protocol, &text).map_err(Failure::bad_input)?;
    let conditions = conditions(&protocol, &protocol.stimulus_set(&args.protocol))?;
    protocol.seed = args.seed.unwrap_or(protocol.seed);
    let participants = args
        .participants
        .unwrap_or(protocol.planned_participants.get());
    match write(&protocol, &conditions, participants, io::stdout().lock()) {
        // The reader has seen enough (`… | head`).
        Err(error) if is_broken_pipe(&error) => Ok(()),
        other => other,
    }
}

fn write(
    protocol: &Protocol,
    conditions: &[Condition],
    participants: u32,
    output: impl io::Write,
) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(output);
    csv.write_record([
        "participant",
        "position",
        "condition",
        "first_technique",
        "second_technique",
    ])?;
    for slot in 0..participants {
        let plan = SessionPlan::new(protocol, conditions, slot).map_err(Failure::bad_input)?;
        for trial in &plan.trials {
            let (first, second) = plan.techniques(trial);
            let (slot, position) = (slot.to_string(), trial.index.to_string());
            let condition = &plan.conditions[trial.condition].id;
            csv.write_record([&slot, &position, condition, first, second])?;
        }
    }
    csv.flush()?;
    Ok(())
}

fn is_broken_pipe(failure: &Failure) -> bool {
    let kind = |error: &io::Error| error.kind() == io::ErrorKind::BrokenPipe;
    let direct = failure.error.downcast_ref::<io::Error>().map(kind);
    let by_csv = failure
        .error
        .downcast_ref::<csv::Error>()
        .map(|error| match error.kind() {
            csv::ErrorKind::Io(error) => kind(error),
            _ => false,
        });
    direct.or(by_csv).unwrap_or(false)
}

/// The conditions of a stimulus set, which need not be rendered for this.
fn conditions(protocol: &Protocol, set: &Path) -> Result<Vec<Condition>, Failure> {
    let set = StimulusSet::load(set).map_err(Failure::bad_input)?;
    let pair = |condition: &SetCondition| Pair {
        id: condition.id.clone(),
        scene: condition.scene_id(&set).to_owned(),
        lighting: condition.validity.clone(),
        techniques: condition.labels().map(str::to_owned),
        image_sha256: Default::default(),
        hypothesis: condition.hypothesis.clone(),
    };
    let pairs: Vec<Pair> = set.conditions.iter().map(pair).collect();
    let exhibits = exhibit::exhibits(protocol, &pairs).map_err(Failure::bad_input)?;
    Ok(exhibits.into_iter().map(|it| it.condition).collect())
}
