//! `greyfield cost`: accuracy against time.

mod measure;
mod pictures;
mod sweep_args;
mod written;

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;

use super::{Failure, Verbosity};
use crate::analysis::dataset::Dataset;
use crate::analysis::input::{self, Options};
use crate::cost::input::is_set;
use crate::cost::scaling::{self, ScalingOptions, ScalingRow};
use crate::cost::votes::{self, Preference};
use crate::cost::{CostError, Store};
use crate::embedded;
use crate::stimulus::StimulusSet;
use crate::stimulus::progress::Progress;
pub use measure::measure;
pub use sweep_args::{Opened, SweepArgs};

/// Measure what accuracy costs: every technique at many settings, its time beside its error.
///
/// For each scene: the ray-traced truth, then each technique × samples × resolution × blur at the
/// same camera and reach: time of its passes, error of its occlusion, and what can be seen of it in
/// the image. Writes cost.csv, cost.json, figures, pictures of errors and one page, cost.html. A sweep
/// that was stopped goes on where it stopped.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  greyfield cost stimuli/scenes/atrium.toml\n  greyfield cost stimuli/scenes/atrium.toml --techniques gtao,vbao --samples 8,16,32 --lighting low\n  greyfield cost stimuli/thesis-2010.toml --techniques none --votes results/thesis-2010"
)]
pub struct Cost {
    /// Scene configs, or stimulus sets, whose own settings are measured too.
    #[arg(required = true, value_name = "SCENE_OR_SET")]
    files: Vec<PathBuf>,
    /// Samples a pixel.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "4,8,16,32,64,128,256",
          value_parser = clap::value_parser!(u32).range(1..=4096))]
    samples: Vec<u32>,
    #[command(flatten)]
    sweep: SweepArgs,
    /// Choices of a study of the set: a results folder, or tables as `greyfield analyse` reads
    /// them.
    #[arg(long, value_name = "RESULTS")]
    votes: Option<PathBuf>,
    /// Whose votes they are, for the figures.
    #[arg(long, value_name = "TEXT", requires = "votes")]
    votes_by: Option<String>,
    /// Also measure how time grows with pixels, samples, radius and triangles.
    #[arg(long)]
    scaling: bool,
    /// Pictures of errors: of one setting of each technique, of every setting, or none.
    #[arg(long, value_enum, default_value = "some")]
    pictures: PicturesArg,
}

/// Which settings there are pictures of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum PicturesArg {
    /// Of the setting of each technique that is nearest to 16 samples, at full resolution.
    Some,
    /// Of every setting.
    All,
    /// Of none.
    None,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for wrong scenes, techniques, votes or a folder of another sweep; 1 for adapter and disk.
pub fn run(args: &Cost, verbosity: Verbosity) -> Result<(), Failure> {
    // Votes that cannot be read are said before anything is measured.
    let votes = args
        .votes
        .as_deref()
        .map(|path| Votes::read(path, args))
        .transpose()?;
    let mut opened = args.sweep.open(&args.files, &args.samples, verbosity)?;
    measure(&args.sweep, &mut opened, args.pictures, verbosity).map_err(failure)?;
    let preferences = match &votes {
        Some(votes) => votes.join(&opened.store).map_err(failure)?,
        None => Vec::new(),
    };
    let growth = match args.scaling {
        true => growth(args, &opened, verbosity).map_err(failure)?,
        false => written::kept_growth(&opened.store)?,
    };
    opened.store.finish().map_err(failure)?;
    let votes_source = votes.map_or_else(String::new, |votes| votes.source);
    written::write(&opened.store, &preferences, &votes_source, &growth).map_err(failure)?;
    let store = &opened.store;
    println!(
        "{} rows in {}; everything on one page: {}",
        store.rows.len(),
        store.path("cost.csv").display(),
        store.path("cost.html").display()
    );
    Ok(())
}

/// Choices of a study, and the set that they are about.
struct Votes {
    set: StimulusSet,
    data: Dataset,
    /// Whose they are.
    source: String,
}

impl Votes {
    fn read(path: &Path, args: &Cost) -> Result<Self, Failure> {
        let sets: Vec<&PathBuf> = (args.files.iter())
            .filter(|file| is_set(file).unwrap_or(false))
            .collect();
        let [set] = sets[..] else {
            return Err(Failure::bad_input(anyhow!(
                "votes are about the images of one stimulus set, {} are named; give the set in place of its scenes, as in \
                 greyfield cost stimuli/thesis-2010.toml --votes RESULTS",
                sets.len()
            )));
        };
        let data = input::read(&[path.to_owned()], Options::default());
        let source = args.votes_by.clone().unwrap_or_else(|| whose(path));
        Ok(Self {
            set: StimulusSet::load(set).map_err(Failure::bad_input)?,
            data: data.map_err(Failure::bad_input)?,
            source,
        })
    }

    fn join(&self, store: &Store) -> Result<Vec<Preference>, CostError> {
        votes::join(&self.set, &self.data, &store.rows)
    }
}

/// Whose votes a file has, where nobody says it.
fn whose(path: &Path) -> String {
    let is_shipped = std::fs::read(path).is_ok_and(|found| {
        embedded::FILES
            .iter()
            .any(|(name, text)| *name == embedded::VOTES && text.as_bytes() == found)
    });
    match is_shipped {
        true => {
            String::from("votes of the 36 participants of 2010 on the images of 2010, not on these")
        }
        false => format!("votes of {}", path.display()),
    }
}

/// Measures how time grows, scene by scene.
fn growth(
    args: &Cost,
    opened: &Opened,
    verbosity: Verbosity,
) -> Result<Vec<ScalingRow>, CostError> {
    let techniques = args.sweep.techniques()?;
    let bar = verbosity.spinner();
    let progress = Progress {
        step: &|what| bar.set_message(what.to_owned()),
        pixels: &|_| {},
    };
    let about = &opened.store.record.about;
    let mut rows = Vec::new();
    for sweep in &opened.asked.sweeps {
        let options = ScalingOptions {
            size_px: about.size_px,
            reach_m: sweep.reach_m,
            seed: about.seed,
            repeats: args.sweep.repeats(),
        };
        rows.extend(scaling::measure(
            &opened.renderer,
            &sweep.scene,
            &techniques,
            &options,
            &progress,
        )?);
    }
    bar.finish_and_clear();
    Ok(rows)
}

/// What was asked for wrongly is bad input; the rest failed.
pub(super) fn failure(error: CostError) -> Failure {
    match error {
        CostError::Input(message) => Failure::bad_input(anyhow!(message)),
        CostError::Scene(error) => Failure::bad_input(error),
        other => Failure::from(other),
    }
}
