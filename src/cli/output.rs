//! How much a command says, its progress bars, and where its result goes.

use std::io::{self, ErrorKind, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::Context;

use crate::analysis::statistic::Watch;
use crate::stimulus::files;

/// Writes a result to a file, whole or not at all, or to standard output where none is named.
///
/// # Errors
/// What the disk said, with the file's name. A reader that closes the pipe early is no error.
pub fn write(file: Option<&Path>, bytes: &[u8]) -> anyhow::Result<()> {
    if let Some(path) = file {
        return Ok(files::write_whole(path, bytes)?);
    }
    match io::stdout().lock().write_all(bytes) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => other.context("standard output cannot be written"),
    }
}

/// Says on a bar how much of an image of rays is done: it takes minutes, and is a step of the bar
/// alone.
pub struct TracedShare<'a> {
    bar: &'a indicatif::ProgressBar,
    image_px: u64,
    done_px: AtomicU64,
}

impl<'a> TracedShare<'a> {
    /// For images of this size, pixels.
    #[must_use]
    pub fn new(bar: &'a indicatif::ProgressBar, (width_px, height_px): (u32, u32)) -> Self {
        Self {
            bar,
            image_px: u64::from(width_px) * u64::from(height_px),
            done_px: AtomicU64::new(0),
        }
    }

    /// Another step begins.
    pub fn begin(&self) {
        self.done_px.store(0, Ordering::Relaxed);
        self.bar.set_prefix("");
    }

    /// So many more pixels are done.
    pub fn add(&self, count: u64) {
        let done = self.done_px.fetch_add(count, Ordering::Relaxed) + count;
        self.bar.set_prefix(match done < self.image_px {
            true => format!("traced {} % ", 100 * done / self.image_px),
            false => String::new(),
        });
    }
}

/// Shows long work of an analysis on a bar.
pub struct WatchedByBar<'a>(pub &'a indicatif::ProgressBar);

impl Watch for WatchedByBar<'_> {
    fn begin(&self, what: &'static str, steps: u64) {
        self.0.reset();
        self.0.set_length(steps);
        self.0.set_message(what);
    }

    fn step(&self) {
        self.0.inc(1);
    }
}

/// How much is said, as the global flags ask.
#[derive(Debug, Clone, Copy)]
pub struct Verbosity {
    /// Only results and errors.
    pub quiet: bool,
    /// How often `-v` was given.
    pub level: u8,
}

impl Verbosity {
    /// A progress bar on stderr, hidden if the command is to be quiet or nobody watches.
    #[must_use]
    pub fn progress(self, steps: u64) -> indicatif::ProgressBar {
        if self.quiet {
            return indicatif::ProgressBar::hidden();
        }
        let bar = indicatif::ProgressBar::new(steps);
        if let Ok(style) = indicatif::ProgressStyle::with_template(
            "{bar:30} {pos}/{len} {prefix}{msg} ({eta} left)",
        ) {
            bar.set_style(style);
        }
        bar
    }

    /// The same for work whose steps nobody has counted.
    #[must_use]
    pub fn spinner(self) -> indicatif::ProgressBar {
        if self.quiet {
            return indicatif::ProgressBar::hidden();
        }
        let spinner = indicatif::ProgressBar::new_spinner();
        spinner.enable_steady_tick(std::time::Duration::from_millis(200));
        spinner
    }
}
