//! A sweep with someone who waits for it.

use super::pictures::Pictures;
use super::{Opened, PicturesArg, SweepArgs};
use crate::cli::Verbosity;
use crate::cli::output::TracedShare;
use crate::cost::sweep::{self, SceneSweep, Watch};
use crate::cost::{Configuration, CostError, Measured, SceneBench};
use crate::stimulus::progress::Progress;

/// Measures what is left of a sweep.
///
/// # Errors
/// [`CostError`]; what was measured before stays on disk.
pub fn measure(
    args: &SweepArgs,
    opened: &mut Opened,
    pictures: PicturesArg,
    verbosity: Verbosity,
) -> Result<(), CostError> {
    let store = &mut opened.store;
    let of_sweep = |sweep: &SceneSweep| -> u64 { sweep.left(store).map(SceneSweep::weight).sum() };
    let bar = verbosity.progress(opened.asked.sweeps.iter().map(of_sweep).sum());
    let traced = TracedShare::new(&bar, store.record.about.size_px);
    let pictures = Pictures::new(pictures, store)?;
    let watcher = Watcher {
        bar: &bar,
        progress: Progress {
            step: &|what| {
                traced.begin();
                bar.set_message(what.to_owned());
            },
            pixels: &|count| traced.add(count),
        },
        pictures,
    };
    for sweep in &opened.asked.sweeps {
        sweep::run(&opened.renderer, sweep, store, args.repeats(), &watcher)?;
    }
    bar.finish_and_clear();
    Ok(())
}

/// Shows how far a sweep has come.
struct Watcher<'a> {
    bar: &'a indicatif::ProgressBar,
    progress: Progress<'a>,
    pictures: Pictures,
}

impl Watch for Watcher<'_> {
    fn progress(&self) -> &Progress<'_> {
        &self.progress
    }

    fn opened(&self, sweep: &SceneSweep, bench: &SceneBench<'_>) -> Result<(), CostError> {
        self.pictures.truth(sweep, bench)
    }

    fn measured(
        &self,
        sweep: &SceneSweep,
        bench: &SceneBench<'_>,
        configuration: &Configuration,
        measured: &Measured,
    ) -> Result<(), CostError> {
        self.pictures
            .measured(sweep, bench, configuration, measured)?;
        self.bar.inc(SceneSweep::weight(configuration));
        Ok(())
    }
}
