//! `greyfield power`: exact power and sample size, and whole studies simulated.

mod simulate;

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Failure, Verbosity, output};
use crate::analysis::Alpha;
use crate::config::quantity;
use crate::planning::sheet::{self, Request};
use crate::report::{self, Format};

/// How many participants a study needs, and what a given number can find.
///
/// Exact: the probabilities of all votes at which the test rejects are summed up. "first" is the
/// smallest number of participants with the power wanted; "from" the smallest from which on it
/// never falls below, for exact power saws; "blocks" is that filled up to full blocks of the
/// design, and the number to plan by. With --conditions the tests are corrected for a family.
///
/// With a protocol, whole studies of it are simulated: scripted observers of a known preference
/// sit its sessions, their answers are analysed as people's are, and it is counted what was found.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  greyfield power --p 0.65 --alpha 0.05 --conditions 7
  greyfield power --p 0.65 --conditions 7 --n 36
  greyfield power --p 0.7 --power 0.95 --format json
  greyfield power protocols/thesis-2010.toml --p 0.65 --order-bias 0.5 --studies 10000

CSV is, without a protocol, the power over participants and shares; with one, the conditions.")]
pub struct Power {
    /// Simulate studies of this protocol [default: exact sums for any study].
    #[arg(value_name = "PROTOCOL.toml")]
    protocol: Option<PathBuf>,
    /// Share of participants who choose one of the two techniques, where there is an effect.
    #[arg(long, value_name = "P", value_parser = probability)]
    p: f64,
    /// Significance level of the family.
    #[arg(long, value_name = "A", default_value = "0.05")]
    alpha: Alpha,
    /// Conditions in the family that is corrected for.
    #[arg(long, value_name = "K", default_value_t = 1, conflicts_with = "protocol", value_parser = clap::value_parser!(u32).range(1..=100))]
    conditions: u32,
    /// Power wanted; several after commas.
    #[arg(long, value_name = "POWER", value_delimiter = ',', default_value = "0.8,0.9", conflicts_with = "protocol", value_parser = probability)]
    power: Vec<f64>,
    /// Participants of a full block of the design [default: twice the conditions].
    #[arg(long, value_name = "B", conflicts_with = "protocol", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    block: Option<u32>,
    /// What this number of participants can find [default: as many as the first power wanted needs].
    #[arg(long, value_name = "N", conflicts_with = "protocol", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    n: Option<u32>,
    #[command(flatten)]
    simulation: simulate::SimulationArgs,
    /// How to write the answer.
    #[arg(long, value_enum, default_value_t = FormatName::Text)]
    format: FormatName,
    /// Where to write it [default: standard output].
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FormatName {
    /// Aligned tables, with what their numbers mean.
    Text,
    /// Everything, full precision.
    Json,
    /// One table, full precision.
    Csv,
}

/// Runs the command.
///
/// # Errors
/// Bad input (exit code 2): numbers out of range, the protocol or its stimulus set.
pub fn run(args: &Power, verbosity: Verbosity) -> Result<(), Failure> {
    let format = match args.format {
        FormatName::Text => Format::Text,
        FormatName::Json => Format::Json,
        FormatName::Csv => Format::Csv,
    };
    let text = if let Some(protocol) = &args.protocol {
        simulate::run(protocol, args, format, verbosity)?
    } else {
        args.simulation.refuse()?;
        let request = Request {
            p: args.p,
            alpha: args.alpha,
            conditions: args.conditions,
            powers: args.power.clone(),
            block: args.block.unwrap_or(2 * args.conditions),
            participants: args.n,
        };
        let sheet = sheet::sheet(&request);
        report::planning::render(&sheet.sections, &sheet.request, &sheet.curve, format)?
    };
    Ok(output::write(args.output.as_deref(), text.as_bytes())?)
}

/// Above 0 and below 1.
fn probability(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    quantity::check(value, 0.001, 0.999, "")?;
    Ok(value)
}

fn number(text: &str) -> Result<f64, String> {
    text.parse()
        .map_err(|_| format!("found `{text}`, a number such as 0.65 is needed"))
}
