//! `greyfield analyse`: from choices to a report.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::anyhow;
use clap::{Args, ValueEnum};

use super::output::WatchedByBar;
use super::{Failure, Verbosity, output};
use crate::analysis::input::{self, Options};
use crate::analysis::{Alpha, Dataset, Settings, analyse_watched};
use crate::report::{self, Format};
use crate::stimulus::files;

/// Analyse choices: a results folder, session files, a trial table or a table of counts.
#[derive(Args)]
#[command(after_help = "\
Files are recognised by their columns:
  participant,condition,first_technique,second_technique,chosen[,rt_ms][,hypothesis]
  condition,technique_a,technique_b,votes_a,votes_b[,hypothesis][,scene]
  participant,condition,technique,rank
  participant,condition,technique,scale,rating
and the files that `greyfield run` writes.

Examples:
  greyfield analyse results/thesis-2010
  greyfield analyse votes.csv --format html -o report.html
  greyfield analyse results/my-study --bootstrap 10000 --out my-report")]
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
    /// Write everything into a folder: the page, the text, the numbers, every table as CSV, every
    /// figure as SVG and PNG.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["format", "output"])]
    out: Option<PathBuf>,
    /// Significance level of the family; intervals have confidence 1 − alpha [default: as the
    /// protocol has it, else 0.05].
    #[arg(long)]
    alpha: Option<Alpha>,
    /// The conditions whose tests are corrected together; the others are exploratory [default: as
    /// the protocol has it, else all].
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    family: Vec<String>,
    /// Resamples of the participants for bootstrap intervals of the scale; 0 for none [default:
    /// 2000 for up to 2000 participants, else none].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    bootstrap: Option<u32>,
    /// Seed of the resamples.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Count pilot sessions too.
    #[arg(long)]
    include_pilot: bool,
    /// Count rejected participants too (see `greyfield participants`).
    #[arg(long)]
    include_rejected: bool,
    /// Leave out trials answered faster than this; a results folder's protocol may say more.
    #[arg(long, value_name = "MS")]
    minimum_response_ms: Option<f64>,
    /// Leave out trials answered slower than this.
    #[arg(long, value_name = "MS")]
    maximum_response_ms: Option<f64>,
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
pub fn run(args: &AnalyseArgs, verbosity: Verbosity) -> Result<(), Failure> {
    let options = Options {
        include_pilot: args.include_pilot,
        include_rejected: args.include_rejected,
        minimum_response_ms: args.minimum_response_ms,
        maximum_response_ms: args.maximum_response_ms,
    };
    let start = Instant::now();
    let data = input::read(&args.inputs, options).map_err(Failure::bad_input)?;
    let settings = settings(args, &data)?;
    let read = Instant::now();
    let bar = verbosity.progress(0);
    let analysis = analyse_watched(data, settings, &WatchedByBar(&bar));
    bar.finish_and_clear();
    let analysed = Instant::now();
    match &args.out {
        Some(folder) => {
            let report = report::files(&analysis)?.into_iter();
            let written = files::write_all(folder, report.map(|file| (file.path, file.bytes)))?;
            if !verbosity.quiet {
                println!("{written} files written to {}", folder.display());
            }
        }
        None => {
            let report = report::render(&analysis, format(args))?;
            output::write(args.output.as_deref(), report.as_bytes())?;
        }
    }
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

/// What the command line says, then what the protocol declares.
fn settings(args: &AnalyseArgs, data: &Dataset) -> Result<Settings, Failure> {
    let mut settings = Settings {
        seed: args.seed,
        ..Settings::declared(data)
    };
    if let Some(resamples) = args.bootstrap {
        settings.bootstrap = resamples;
    }
    if let Some(alpha) = args.alpha {
        settings.alpha = alpha;
    }
    if !args.family.is_empty() {
        settings.family.clone_from(&args.family);
    }
    let ids = || {
        data.conditions
            .iter()
            .map(|condition| condition.id.as_str())
    };
    let unknown = (settings.family.iter()).find(|id| !ids().any(|known| known == id.as_str()));
    match unknown {
        None => Ok(settings),
        Some(id) => Err(Failure::bad_input(anyhow!(
            "--family: no condition is called `{id}`; there are {}",
            ids().collect::<Vec<_>>().join(", ")
        ))),
    }
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
