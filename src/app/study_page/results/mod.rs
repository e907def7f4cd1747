//! The report of a study while it runs: what `greyfield analyse` says of the folder as it stands,
//! behind a note on what looking early does to a p-value.

mod blocks;
mod reading;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{RichText, Ui};

use self::blocks::Shown;
use self::reading::{Fingerprint, Report};
use crate::app::background::Task;
use crate::app::theme;

/// How often the folder is looked at for new answers, where it is followed.
const REFRESH: Duration = Duration::from_secs(1);

/// Why looking is not free. The numbers are those of repeated tests on normal data: P. Armitage,
/// C. K. McPherson, B. C. Rowe (1969), JRSS A 132(2), 235–244, table 2.
const PEEKING: &str = "The p-values below hold at the number of participants that was planned. Whoever looks again and again, and stops when one of them is small, finds differences that are not there: with two looks at the 5 % level in 8 % of the studies, with five in 14 %, with ten in 19 %. The anytime-valid p and its interval (section “Anytime-valid test”) may be looked at after every answer, and a study may stop on them.";

/// What the experimenter sees of the results.
pub struct Results {
    results: PathBuf,
    follows: bool,
    /// The experimenter has read the note and asked for the numbers.
    is_open: bool,
    reading: Option<Task<Report>>,
    shown: Option<Result<Shown, String>>,
    read_of: Option<Fingerprint>,
    looked_at: Instant,
    outcome: Option<String>,
}

impl Results {
    /// Of a results folder; one that `follows` is read again when there are new answers.
    #[must_use]
    pub fn new(results: &Path, follows: bool) -> Self {
        Self {
            results: results.to_owned(),
            follows,
            is_open: false,
            reading: None,
            shown: None,
            read_of: None,
            looked_at: Instant::now(),
            outcome: None,
        }
    }

    /// Whether the report is on the screen, or why there is none.
    #[must_use]
    pub fn is_shown(&self) -> bool {
        self.shown.is_some() && self.reading.is_none()
    }

    /// One pass of the interface.
    pub fn ui(&mut self, ui: &mut Ui) {
        theme::card().show(ui, |ui| {
            ui.set_min_width(ui.available_width());
            ui.label(RichText::new("Before you look").size(22.0));
            ui.label(PEEKING);
            if !self.is_open && ui.button("Show the results").clicked() {
                self.is_open = true;
                ui.ctx().request_repaint();
            }
        });
        if !self.is_open {
            return;
        }
        self.refresh(ui);
        ui.add_space(8.0);
        self.controls(ui);
        ui.add_space(8.0);
        match &mut self.shown {
            None => {
                ui.label("Reading …");
            }
            Some(Err(detail)) => {
                ui.label(detail.as_str());
            }
            Some(Ok(shown)) => shown.ui(ui),
        }
    }

    fn controls(&mut self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            let can_save = matches!(self.shown, Some(Ok(_)));
            if can_save && ui.button("Save the report").clicked() {
                let folder = reading::report_folder(&self.results);
                self.outcome = Some(match reading::save(&self.results, &folder) {
                    Ok(files) => format!("{files} files written to {}", folder.display()),
                    Err(error) => error,
                });
            }
            if !self.follows && ui.button("Read again").clicked() {
                self.read_of = None;
            }
            if let Some(outcome) = &self.outcome {
                ui.label(theme::quiet(outcome.clone()));
            }
        });
    }

    /// Reads the folder where it has changed since, beside the interface.
    fn refresh(&mut self, ui: &Ui) {
        if let Some(reading) = &mut self.reading {
            if !reading.poll() {
                return;
            }
            self.shown = match self.reading.take() {
                Some(Task::Done(report)) => Some(Ok(Shown::new(ui.ctx(), report))),
                Some(Task::Failed(detail)) => Some(Err(detail)),
                _ => None,
            };
        }
        let is_first = self.read_of.is_none();
        if is_first || (self.follows && self.looked_at.elapsed() >= REFRESH) {
            self.looked_at = Instant::now();
            let found = Fingerprint::of(&self.results);
            if self.read_of.as_ref() != Some(&found) {
                self.read_of = Some(found);
                let results = self.results.clone();
                let scale = ui.ctx().pixels_per_point();
                self.reading = Some(Task::start(ui.ctx(), move || Report::read(&results, scale)));
            }
        }
        if self.follows {
            ui.ctx().request_repaint_after(REFRESH);
        }
    }
}
