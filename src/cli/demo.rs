//! `greyfield demo`: the main job on the embedded study.

use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::Args;
use time::OffsetDateTime;

use super::{Failure, Verbosity, render, run as session};
use crate::analysis::input::{self, Options};
use crate::analysis::{Settings, analyse};
use crate::report::{self, Format};
use crate::session::headless::Headless;
use crate::session::start;
use crate::stimulus::{Folders, Manifest, StimulusSet, files};
use crate::{app, embedded};

/// Do the whole job on the embedded study: render, run a session, analyse.
///
/// Renders the fourteen images of the 2010 study, opens the application on it (or, without a
/// display, sends scripted observers through the same session), and analyses the choices.
///
/// Example: greyfield demo --headless --out /tmp/demo
#[derive(Debug, Args)]
pub struct Demo {
    /// Folder for everything the demo makes.
    #[arg(long, value_name = "DIR", default_value = "greyfield-demo")]
    out: PathBuf,
    /// Scripted observers, even where there is a display.
    #[arg(long)]
    headless: bool,
    /// How many scripted observers.
    #[arg(long, value_name = "N", default_value_t = 28, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    participants: u32,
    /// Use the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// The seed of the demo's scripted observers.
const OBSERVER: &str = "random:2010";

/// Runs the command.
///
/// # Errors
/// [`Failure`] of the step that failed, with what it was doing.
pub fn run(args: &Demo, verbosity: Verbosity) -> Result<(), Failure> {
    let out = &args.out;
    let kept = embedded::unpack(out).map_err(|(path, error)| {
        anyhow!(
            "{}: {error}; name another folder with --out",
            path.display()
        )
    })?;
    for path in kept {
        eprintln!(
            "note: {} differs from the embedded one and is used as it is",
            path.display()
        );
    }
    let set = StimulusSet::load(&out.join(embedded::STIMULI)).map_err(Failure::bad_input)?;
    let stimuli = stimuli(&set, args, verbosity)?;
    let protocol = out.join(embedded::PROTOCOL);
    let scripted = args.headless || app::check_display().is_err();
    let results = out.join(if scripted {
        "results-scripted"
    } else {
        "results"
    });
    if scripted {
        observe(&protocol, &stimuli, &results, args.participants, verbosity)?;
    } else {
        println!("Opening the application; close its window when you are done.");
        session::window(&protocol, Some(&stimuli), &results, "demo", true)?;
    }
    let report = out.join(if scripted {
        "report-scripted"
    } else {
        "report"
    });
    let analysed = analyse_results(&results, &report)?;
    println!("\nimages  {}", stimuli.display());
    println!("data    {}", results.display());
    if analysed {
        println!("report  {}", report.join("report.html").display());
    }
    if scripted {
        println!(
            "\nThe choices above are coin tosses of scripted observers: they show the tool, and say nothing about people."
        );
    }
    Ok(())
}

/// The rendered set: drawn now, or already there and unchanged.
fn stimuli(set: &StimulusSet, args: &Demo, verbosity: Verbosity) -> Result<PathBuf, Failure> {
    let folder = set.default_folder();
    let whole = |manifest: &Manifest| {
        manifest.config_sha256 == set.sha256
            && manifest.app_version == env!("CARGO_PKG_VERSION")
            && manifest.pairs.len() == set.conditions.len()
            && manifest.verify(&folder).is_ok()
    };
    if Manifest::load(&folder).is_ok_and(|manifest| whole(&manifest)) {
        println!("The {} images are there already.", 2 * set.conditions.len());
        return Ok(folder);
    }
    let started = std::time::Instant::now();
    let manifest = render::draw(
        set,
        Folders::images(&folder),
        None,
        args.adapter.as_deref(),
        verbosity,
    )?
    .manifest;
    let adapter = manifest
        .adapter
        .map_or_else(String::new, |adapter| format!(" on {}", adapter.name));
    println!(
        "Rendered {} images in {:.0} s{adapter}.",
        2 * manifest.pairs.len(),
        started.elapsed().as_secs_f64()
    );
    Ok(folder)
}

fn observe(
    protocol: &Path,
    stimuli: &Path,
    results: &Path,
    participants: u32,
    verbosity: Verbosity,
) -> Result<(), Failure> {
    let prepared = session::prepare(protocol, Some(stimuli))?;
    let scripted = super::observer::scripted(OBSERVER, &prepared, verbosity)?;
    let study = start::open_study(
        results,
        &prepared.protocol,
        &prepared.protocol_text,
        &prepared.manifest,
    )
    .map_err(session::failure_of_opening)?;
    let summary = Headless {
        study: &study,
        protocol: &prepared.protocol,
        manifest: &prepared.manifest,
        scripted: &scripted,
        station: "demo",
    }
    .run(participants, OffsetDateTime::now_utc, |_| {})
    .map_err(session::failure_of_run)?;
    println!(
        "{} scripted observers ({OBSERVER}) finished, {} rows written.",
        summary.finished + summary.resumed + summary.already_finished,
        summary.rows
    );
    Ok(())
}

/// Prints the tables and writes the report; false if there is nothing to analyse yet.
fn analyse_results(results: &Path, folder: &Path) -> Result<bool, Failure> {
    let options = Options {
        include_pilot: true,
        ..Default::default()
    };
    let data = match input::read(&[results.to_owned()], options) {
        Ok(data) => data,
        Err(error) => {
            println!("Nothing to analyse yet: {error}");
            return Ok(false);
        }
    };
    let settings = Settings::declared(&data);
    let analysis = analyse(data, settings);
    println!("\n{}", report::render(&analysis, Format::Text)?);
    let report = report::files(&analysis)?.into_iter();
    files::write_all(folder, report.map(|file| (file.path, file.bytes)))
        .context("writing the report")?;
    Ok(true)
}
