//! Studies of a protocol, simulated: what the command line says of them.

use std::path::Path;

use anyhow::anyhow;
use clap::Args;

use super::{Power, number, probability};
use crate::analysis::statistic::Watch;
use crate::cli::{Failure, Verbosity, order};
use crate::config::{self, quantity};
use crate::planning::preregistration::AnalysisPlan;
use crate::planning::simulate::{Assumptions, simulate};
use crate::protocol::Protocol;
use crate::report::{self, Format};

/// With a protocol: what is assumed of the participants.
#[derive(Debug, Args)]
#[command(next_help_heading = "With PROTOCOL.toml")]
pub struct SimulationArgs {
    /// Preference for the image shown first, on the logit scale (0.5: 62 % where nothing else
    /// counts) [default: 0].
    #[arg(long, value_name = "B", value_parser = bias, allow_negative_numbers = true)]
    order_bias: Option<f64>,
    /// Standard deviation of the participants' own preferences, on the logit scale [default: 0].
    #[arg(long, value_name = "S", value_parser = deviation)]
    participant_sd: Option<f64>,
    /// Probability that a participant leaves before the end; the next takes the slot [default: 0].
    #[arg(long, value_name = "R", value_parser = rate)]
    drop_out: Option<f64>,
    /// Leave the answers of those who left out of the analysis.
    #[arg(long)]
    leave_out_incomplete: bool,
    /// Participants who finish [default: as many as the protocol plans].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    participants: Option<u32>,
    /// Fill the number of participants up to full blocks of the design.
    #[arg(long)]
    full_blocks: bool,
    /// Studies to simulate, with the effect and as many without [default: 1000].
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    studies: Option<u32>,
    /// Seed of the answers; the orders are the protocol's [default: 1].
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
}

impl SimulationArgs {
    /// Refuses what has no meaning without a protocol.
    pub(super) fn refuse(&self) -> Result<(), Failure> {
        let given = [
            ("--order-bias", self.order_bias.is_some()),
            ("--participant-sd", self.participant_sd.is_some()),
            ("--drop-out", self.drop_out.is_some()),
            ("--leave-out-incomplete", self.leave_out_incomplete),
            ("--participants", self.participants.is_some()),
            ("--full-blocks", self.full_blocks),
            ("--studies", self.studies.is_some()),
            ("--seed", self.seed.is_some()),
        ];
        match given.iter().find(|(_, is_given)| *is_given) {
            None => Ok(()),
            Some((name, _)) => Err(Failure::bad_input(anyhow!(
                "{name}: studies are simulated of a protocol; name one, as in `greyfield power protocols/thesis-2010.toml --p 0.65 {name} …`, or leave it out (the number of participants is --n here)"
            ))),
        }
    }
}

/// Simulates, and writes the result out.
pub(super) fn run(
    path: &Path,
    args: &Power,
    format: Format,
    verbosity: Verbosity,
) -> Result<String, Failure> {
    let text = config::read(path).map_err(Failure::bad_input)?;
    let protocol = Protocol::parse(path, &text).map_err(Failure::bad_input)?;
    let conditions = order::conditions(&protocol, &protocol.stimulus_set(path))?;
    let wanted = &args.simulation;
    let main = conditions.iter().filter(|it| !protocol.names(&it.id));
    let planned = wanted
        .participants
        .unwrap_or(protocol.planned_participants.get());
    let assumptions = Assumptions {
        p: args.p,
        order_bias: wanted.order_bias.unwrap_or(0.0),
        participant_sd: wanted.participant_sd.unwrap_or(0.0),
        drop_out: wanted.drop_out.unwrap_or(0.0),
        leave_out_incomplete: wanted.leave_out_incomplete,
        participants: match wanted.full_blocks {
            true => in_full_blocks(planned, &protocol, main.count())?,
            false => planned,
        },
        studies: wanted.studies.unwrap_or(1000),
        alpha: args.alpha,
        family: AnalysisPlan::of(&protocol).family,
        seed: wanted.seed.unwrap_or(1),
    };
    let bar = Bar(verbosity.progress(2 * u64::from(assumptions.studies)));
    let simulated =
        simulate(&protocol, &conditions, &assumptions, &bar).map_err(Failure::bad_input)?;
    bar.0.finish_and_clear();
    let sections = simulated.sections();
    let table = simulated.conditions();
    Ok(report::planning::render(
        &sections,
        &assumptions,
        &table,
        format,
    )?)
}

fn in_full_blocks(planned: u32, protocol: &Protocol, conditions: usize) -> Result<u32, Failure> {
    let block = (protocol.design.block_slots)(conditions)
        .and_then(|slots| u32::try_from(slots).ok())
        .filter(|&slots| slots > 0);
    let Some(block) = block else {
        return Err(Failure::bad_input(anyhow!(
            "--full-blocks: the design \"{}\" has no blocks; leave it out",
            protocol.design.name
        )));
    };
    Ok(planned.div_ceil(block) * block)
}

struct Bar(indicatif::ProgressBar);

impl Watch for Bar {
    fn step(&self) {
        self.0.inc(1);
    }
}

fn bias(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    quantity::check(value, -10.0, 10.0, "")?;
    Ok(value)
}

fn deviation(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    quantity::check(value, 0.0, 10.0, "")?;
    Ok(value)
}

fn rate(text: &str) -> Result<f64, String> {
    if number(text)? == 0.0 {
        return Ok(0.0);
    }
    let value = probability(text)?;
    quantity::check(value, 0.0, 0.9, "")?;
    Ok(value)
}
