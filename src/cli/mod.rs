//! The command line: one file a subcommand, no logic of its own.

mod advise;
mod analyse;
mod bent_cones;
mod bounces;
mod browse;
mod check;
mod check_config;
mod check_display;
mod check_results;
mod cost;
mod demo;
mod export;
mod inter_reflection;
mod logging;
mod model;
mod observer;
mod order;
mod output;
mod participants;
mod power;
mod render;
mod replay;
mod run;
mod size;
mod techniques;
mod truth;
mod tune;
mod watch;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
pub use output::Verbosity;

/// Psychophysics of ambient occlusion: render pairs, run sessions, analyse choices.
#[derive(Parser)]
#[command(name = "greyfield", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Say less: no progress, only results and errors.
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Say more (twice for everything).
    #[arg(long, short, global = true, action = clap::ArgAction::Count)]
    verbose: u8,
}

#[derive(Subcommand)]
enum Command {
    Demo(demo::Demo),
    #[command(visible_alias = "import")]
    Render(render::RenderArgs),
    Truth(truth::Truth),
    Bounces(bounces::BouncesArgs),
    BentCones(bent_cones::BentCones),
    InterReflection(inter_reflection::InterReflectionArgs),
    Model(model::ModelArgs),
    Techniques(techniques::Techniques),
    Check(check::Check),
    Cost(Box<cost::Cost>),
    Advise(Box<advise::Advise>),
    Browse(browse::Browse),
    Tune(tune::Tune),
    Watch(watch::Watch),
    Run(Box<run::Run>),
    Order(order::Order),
    Participants(participants::Participants),
    Export(export::Export),
    Power(Box<power::Power>),
    Analyse(Box<analyse::AnalyseArgs>),
}

/// A failure with the exit code it ends in.
#[derive(Debug)]
pub struct Failure {
    /// 1: failed with a message. 2: wrong usage or bad input.
    pub code: u8,
    /// What went wrong, with its causes.
    pub error: anyhow::Error,
}

impl Failure {
    /// Wrong usage or bad input: exit code 2.
    pub fn bad_input(error: impl Into<anyhow::Error>) -> Self {
        Self {
            code: 2,
            error: error.into(),
        }
    }
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self {
            code: 1,
            error: error.into(),
        }
    }
}

/// Parses the command line, runs the command, prints a failure as one message.
#[must_use]
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    match run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {}", one_message(&failure.error));
            ExitCode::from(failure.code)
        }
    }
}

/// An error and its causes as one sentence; a cause that the sentence already quotes is not
/// said again.
fn one_message(error: &anyhow::Error) -> String {
    error
        .chain()
        .map(ToString::to_string)
        .fold(String::new(), |message, cause| {
            if message.is_empty() {
                cause
            } else if message.contains(&cause) {
                message
            } else {
                format!("{message}: {cause}")
            }
        })
}

fn run(cli: Cli) -> Result<(), Failure> {
    let verbosity = Verbosity {
        quiet: cli.quiet,
        level: cli.verbose,
    };
    logging::init(verbosity);
    match cli.command {
        Command::Demo(args) => demo::run(&args, verbosity),
        Command::Render(args) => render::run(&args, verbosity),
        Command::Truth(args) => truth::run(&args, verbosity),
        Command::Bounces(args) => bounces::run(&args, verbosity),
        Command::BentCones(args) => bent_cones::run(&args, verbosity),
        Command::InterReflection(args) => inter_reflection::run(&args, verbosity),
        Command::Model(args) => model::run(&args, verbosity),
        Command::Techniques(args) => techniques::run(&args),
        Command::Check(args) => check::run(&args, verbosity),
        Command::Cost(args) => cost::run(&args, verbosity),
        Command::Advise(args) => advise::run(&args, verbosity),
        Command::Browse(args) => browse::run(&args),
        Command::Tune(args) => tune::run(&args),
        Command::Watch(args) => watch::run(&args),
        Command::Run(args) => run::run(&args, verbosity),
        Command::Order(args) => order::run(&args),
        Command::Participants(args) => participants::run(&args),
        Command::Export(args) => export::run(&args, verbosity),
        Command::Power(args) => power::run(&args, verbosity),
        Command::Analyse(args) => analyse::run(&args, verbosity),
    }
}
