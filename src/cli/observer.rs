//! What `--observer` names, made; the images are compared for one that asks how they look.

use anyhow::anyhow;

use super::run::Prepared;
use super::{Failure, Verbosity};
use crate::session::observer::{Metric, Needs, Scripted};
use crate::stimulus::flip::Viewing;
use crate::stimulus::{ImageRecord, Picture, quality};

/// The scripted observer of a name. One that asks how the images look has them compared now.
///
/// # Errors
/// Bad input: what was found and what is allowed.
pub(super) fn scripted(
    name: &str,
    prepared: &Prepared,
    verbosity: Verbosity,
) -> Result<Scripted, Failure> {
    let viewing = prepared.protocol.viewing.map(|viewing| Viewing {
        distance_m: viewing.distance_m.get(),
        display_width_m: viewing.display_width_m.get(),
        display_width_px: viewing.display_width_px.get() as f32,
    });
    let pixels_per_degree = viewing.unwrap_or_default().pixels_per_degree();
    let compare = |metric, pairs: &[[&ImageRecord; 2]]| {
        let measure = |first: &Picture, second: &Picture| match metric {
            Metric::Flip => quality::flip_mean(first, second, pixels_per_degree),
            Metric::Error => Ok(quality::lightness_rmse(first, second)?),
        };
        let bar = verbosity.progress(pairs.len() as u64);
        let found = quality::distances(&prepared.stimuli, pairs, &measure, &|| bar.inc(1));
        bar.finish_and_clear();
        found.map_err(|error| format!("images it can compare: {error}"))
    };
    let needs = Needs {
        protocol: &prepared.protocol,
        manifest: &prepared.manifest,
        distances: &compare,
    };
    Scripted::new(name, &needs)
        .map_err(|message| Failure::bad_input(anyhow!("--observer: {message}")))
}
