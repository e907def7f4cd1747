//! `greyfield order`: the plan of a study as CSV, and how even it is.

mod slots;
mod tables;

use std::io;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use slots::SlotList;

use super::Failure;
use crate::config;
use crate::protocol::design::{self, Design, InnerOrder};
use crate::protocol::{Balance, Condition, Pair, Protocol, SessionPlan, exhibit};
use crate::stimulus::StimulusSet;
use crate::stimulus::set::SetCondition;

/// Print who sees which pairs in which order, as CSV, or how even that is.
///
/// Columns: participant (the slot, from 0), position (from 0), condition, and the
/// two techniques in the order shown. The same protocol and seed give the same plan
/// on any machine.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  greyfield order protocols/thesis-2010.toml --participants 36
  greyfield order protocols/thesis-2010.toml --balance --blocks 1
  greyfield order protocols/thesis-2010.toml --balance --only 0-9,11-13
  greyfield order protocols/thesis-2010.toml --balance --design williams --inner-order within")]
pub struct Order {
    /// The protocol.
    #[arg(value_name = "PROTOCOL.toml")]
    protocol: PathBuf,
    /// How many participants [default: as many as the protocol plans].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    participants: Option<u32>,
    /// As many participants as fill so many blocks of the design.
    #[arg(long, value_name = "B", conflicts_with = "participants",
        value_parser = clap::value_parser!(u32).range(1..=1000))]
    blocks: Option<u32>,
    /// Only these slots, as `0,1,4-6`: what is left where others drop out.
    #[arg(long, value_name = "SLOTS", conflicts_with_all = ["participants", "blocks"])]
    only: Option<SlotList>,
    /// Another seed than the protocol's.
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Another design than the protocol's, to compare: latin, williams, random.
    #[arg(long, value_name = "NAME", value_parser = design::named)]
    design: Option<&'static Design>,
    /// Another inner order than the protocol's, to compare: block, within.
    #[arg(long, value_name = "NAME", value_parser = InnerOrder::named)]
    inner_order: Option<InnerOrder>,
    /// Print how even the plan is, instead of the plan: conditions at positions, inner
    /// orders of conditions and at positions, and what follows what.
    #[arg(long)]
    balance: bool,
    /// Form of the balance; CSV has the columns table, row, column, count.
    #[arg(long, value_enum, default_value = "text", requires = "balance")]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Csv,
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
    protocol.design = args.design.unwrap_or(protocol.design);
    protocol.inner_order = args.inner_order.unwrap_or(protocol.inner_order);
    // Practice and catch trials are not of the design.
    let in_design = conditions
        .iter()
        .filter(|it| !protocol.names(&it.id))
        .count();
    let slots = slots(args, &protocol, in_design)?;
    let output = io::stdout().lock();
    let written = match args.balance {
        true => write_balance(
            &protocol,
            &conditions,
            in_design,
            &slots,
            args.format,
            output,
        ),
        false => write_plan(&protocol, &conditions, &slots, output),
    };
    match written {
        // The reader has seen enough (`… | head`).
        Err(error) if is_broken_pipe(&error) => Ok(()),
        other => other,
    }
}

/// The slots that are asked for.
fn slots(args: &Order, protocol: &Protocol, conditions: usize) -> Result<Vec<u32>, Failure> {
    if let Some(SlotList(slots)) = &args.only {
        return Ok(slots.clone());
    }
    let planned = protocol.planned_participants.get();
    let Some(blocks) = args.blocks else {
        return Ok((0..args.participants.unwrap_or(planned)).collect());
    };
    let Some(block_slots) = (protocol.design.block_slots)(conditions) else {
        return Err(Failure::bad_input(anyhow::anyhow!(
            "--blocks: the design \"{}\" has no blocks; say --participants N instead",
            protocol.design.name
        )));
    };
    let block_slots = u32::try_from(block_slots).map_err(Failure::bad_input)?;
    Ok((0..blocks.saturating_mul(block_slots)).collect())
}

fn write_plan(
    protocol: &Protocol,
    conditions: &[Condition],
    slots: &[u32],
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
    for &slot in slots {
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

fn write_balance(
    protocol: &Protocol,
    conditions: &[Condition],
    in_design: usize,
    slots: &[u32],
    format: Format,
    mut output: impl io::Write,
) -> Result<(), Failure> {
    let mut balance = Balance::default();
    for &slot in slots {
        let plan = SessionPlan::new(protocol, conditions, slot).map_err(Failure::bad_input)?;
        balance.add(&plan);
    }
    match format {
        Format::Csv => tables::csv(&balance, output)?,
        Format::Text => {
            let block = match (protocol.design.block_slots)(in_design) {
                Some(slots) => format!("a block is {slots} slots"),
                None => String::from("no blocks"),
            };
            let heading = format!(
                "{} sessions of {} conditions; design {}, inner order {}, seed {}; {block}.",
                slots.len(),
                in_design,
                protocol.design.name,
                protocol.inner_order.name(),
                protocol.seed,
            );
            output.write_all(tables::text(&balance, &heading).as_bytes())?;
        }
    }
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
pub(super) fn conditions(protocol: &Protocol, set: &Path) -> Result<Vec<Condition>, Failure> {
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
