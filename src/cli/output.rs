//! How much a command says, and its progress bars.

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
        if let Ok(style) =
            indicatif::ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} ({eta} left)")
        {
            bar.set_style(style);
        }
        bar
    }
}
