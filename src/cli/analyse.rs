//! `greyfield analyse`: from choices to a report.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, ValueEnum};

use super::{Failure, output};
use crate::analysis::input::{self, Options};
use crate::analysis::{Alpha, Settings, analyse};
use crate::report::{self, Format};

/// Analyse choices: a results folder, session files, a trial table or a table of counts.
#[derive(Args)]
#[command(after_help = "\
Files are recognised by their columns:
  participant,condition,first_technique,second_technique,chosen[,rt_ms][,hypothesis]
  condition,technique_a,technique_b,votes_a,votes_b[,hypothesis]
and the files that `greyfield run` writes.

Examples:
  greyfield analyse results/thesis-2010
  greyfield analyse votes.csv --format html -o report.html")]
pub struct AnalyseArgs {
    /// Results folders and CSV files; several are one study.
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// How to write the report [default: by the ending of FILE, else text].
    #[arg(long, value_enum)]
    format: Option<FormatName>,
    /// Where to write it [default: standard output].
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Significance level of the family; intervals have confidence 1 − alpha.
    #[arg(long, default_value = "0.05")]
    alpha: Alpha,
    /// Count pilot sessions too.
    #[arg(long)]
    include_pilot: bool,
    /// Count rejected participants too (see `greyfield participants`).
    #[arg(long)]
    include_rejected: bool,
    /// Say on standard error how long each step took.
    #[arg(long)]
    timings: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum FormatName {
    /// Aligned tables.
    Text,
    /// Everything, full precision.
    Json,
    /// The table of conditions, full precision.
    Csv,
    /// One page with figures.
    Html,
}

/// Runs the command.
pub fn run(args: &AnalyseArgs) -> Result<(), Failure> {
    let options = Options {
        include_pilot: args.include_pilot,
        include_rejected: args.include_rejected,
        ..Options::default()
    };
    let settings = Settings {
        alpha: args.alpha,
        ..Settings::default()
    };
    let start = Instant::now();
    let data = input::read(&args.inputs, options).map_err(Failure::bad_input)?;
    let read = Instant::now();
    let analysis = analyse(data, settings);
    let analysed = Instant::now();
    let report = report::render(&analysis, format(args))?;
    output::write(args.output.as_deref(), report.as_bytes())?;
    if args.timings {
        eprintln!(
            "read {:.0} ms, analyse {:.0} ms, report {:.0} ms",
            (read - start).as_secs_f64() * 1e3,
            (analysed - read).as_secs_f64() * 1e3,
            analysed.elapsed().as_secs_f64() * 1e3,
        );
    }
    Ok(())
}

fn format(args: &AnalyseArgs) -> Format {
    match args.format {
        Some(FormatName::Text) => Format::Text,
        Some(FormatName::Json) => Format::Json,
        Some(FormatName::Csv) => Format::Csv,
        Some(FormatName::Html) => Format::Html,
        None => by_ending(args.output.as_deref()),
    }
}

fn by_ending(output: Option<&Path>) -> Format {
    let ending = output
        .and_then(Path::extension)
        .map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("json") => Format::Json,
        Some("csv") => Format::Csv,
        Some("html" | "htm") => Format::Html,
        _ => Format::Text,
    }
}
