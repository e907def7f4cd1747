//! The study while it runs, for the experimenter: who took part and how far they are,
//! what drop-outs have done to the design, what the audit finds, what is decided about a
//! participant, and exports.
//!
//! The same page stands in the application, between sessions, and in a window of its own
//! (`greyfield watch`), on a second monitor or another computer, during them. That
//! window is another process: a session's frames never wait for it.

mod actions;
mod people;
mod results;
mod snapshot;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use eframe::egui::{Rect, RichText, ScrollArea, TextStyle, Ui, UiBuilder, vec2};

pub use results::Results;
pub use snapshot::{Person, Snapshot};

use self::actions::Actions;
use super::background::Task;
use super::{stimulus_view, theme};
use crate::record::audit::Severity;

/// Widest the page gets, points.
const WIDTH: f32 = 1100.0;

/// How old what is shown may get, where it follows a running session.
const REFRESH: Duration = Duration::from_secs(1);

/// Findings shown; the rest is a number.
const FINDINGS: usize = 8;

/// What of the study is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tab {
    /// Who took part, and what is decided about them.
    Participants,
    /// What they chose.
    Results,
}

/// The page.
pub struct StudyPage {
    results: PathBuf,
    tab: Tab,
    report: Results,
    /// Reads again by itself.
    follows: bool,
    reading: Option<Task<Snapshot>>,
    shown: Option<Result<Snapshot, String>>,
    read_at: Instant,
    selected: Option<String>,
    actions: Actions,
    can_leave: bool,
    is_left: bool,
}

impl StudyPage {
    /// The page on a results folder; one that `follows` reads it again every second.
    #[must_use]
    pub fn new(results: &Path, follows: bool) -> Self {
        Self {
            results: results.to_owned(),
            tab: Tab::Participants,
            report: Results::new(results, follows),
            follows,
            reading: None,
            shown: None,
            read_at: Instant::now(),
            selected: None,
            actions: Actions::new(results),
            can_leave: false,
            is_left: false,
        }
    }

    /// The same, with a way back to where it was opened from.
    #[must_use]
    pub fn with_way_back(mut self) -> Self {
        self.can_leave = true;
        self
    }

    /// Whether the experimenter has gone back.
    #[must_use]
    pub fn is_left(&self) -> bool {
        self.is_left
    }

    /// What is shown, once it was read.
    #[must_use]
    pub fn shown(&self) -> Option<&Result<Snapshot, String>> {
        self.shown.as_ref()
    }

    /// The report of the results.
    #[must_use]
    pub fn report(&self) -> &Results {
        &self.report
    }

    /// One pass of the interface.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.refresh(ui);
        stimulus_view::paint_grey(ui.ctx(), theme::PAGE);
        let screen = ui.ctx().viewport_rect();
        let width = WIDTH.min(screen.width() - 48.0).max(1.0);
        let size = vec2(width, (screen.height() - 48.0).max(1.0));
        let column = Rect::from_center_size(screen.center() + vec2(0.0, 12.0), size);
        ui.scope_builder(UiBuilder::new().max_rect(column), |ui| {
            ScrollArea::vertical()
                .auto_shrink(false)
                .show(ui, |ui| self.content(ui));
        });
    }

    fn refresh(&mut self, ui: &Ui) {
        if let Some(reading) = &mut self.reading {
            if !reading.poll() {
                return;
            }
            self.shown = match self.reading.take() {
                Some(Task::Done(snapshot)) => Some(Ok(snapshot)),
                Some(Task::Failed(detail)) => Some(Err(detail)),
                _ => None,
            };
            self.read_at = Instant::now();
        }
        let due = self.shown.is_none() || (self.follows && self.read_at.elapsed() >= REFRESH);
        if due {
            let results = self.results.clone();
            self.reading = Some(Task::start(ui.ctx(), move || {
                Snapshot::read(&results).map_err(|error| error.to_string())
            }));
        } else if self.follows {
            ui.ctx().request_repaint_after(REFRESH);
        }
    }

    fn content(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let title = match &self.shown {
                Some(Ok(snapshot)) => snapshot.study_id.clone(),
                _ => String::from("Study"),
            };
            ui.heading(title);
            if self.can_leave && ui.button("Back").clicked() {
                self.is_left = true;
            }
            for (tab, name) in [
                (Tab::Participants, "Participants"),
                (Tab::Results, "Results"),
            ] {
                ui.selectable_value(&mut self.tab, tab, name);
            }
        });
        ui.label(theme::quiet(self.results.display().to_string()));
        ui.add_space(8.0);
        match self.tab {
            Tab::Participants => self.participants(ui),
            Tab::Results => self.report.ui(ui),
        }
    }

    fn participants(&mut self, ui: &mut Ui) {
        let changed = match &self.shown {
            None => {
                ui.label("Reading …");
                false
            }
            Some(Err(detail)) => {
                ui.label(format!("The results folder cannot be read: {detail}"));
                false
            }
            Some(Ok(snapshot)) => {
                card(ui, |ui| overview(ui, snapshot));
                card(ui, |ui| people::show(ui, snapshot, &mut self.selected));
                let person = snapshot
                    .people
                    .iter()
                    .find(|person| Some(&person.standing.participant) == self.selected.as_ref());
                let changed = card(ui, |ui| self.actions.show(ui, &self.results, person));
                card(ui, |ui| findings(ui, snapshot));
                changed
            }
        };
        if changed {
            // What was decided is to be seen at once.
            self.shown = None;
            ui.ctx().request_repaint();
        }
    }
}

fn card<R>(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
    let shown = theme::card().show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        add(ui)
    });
    ui.add_space(8.0);
    shown.inner
}

fn overview(ui: &mut Ui, snapshot: &Snapshot) {
    for line in &snapshot.overview {
        ui.label(line);
    }
}

fn findings(ui: &mut Ui, snapshot: &Snapshot) {
    let [errors, warnings] =
        [Severity::Error, Severity::Warning].map(|severity| snapshot.count(severity));
    ui.horizontal(|ui| {
        theme::mark(ui, errors == 0);
        ui.label(format!("Audit: {errors} errors, {warnings} warnings"));
    });
    let worth = snapshot
        .findings
        .iter()
        .filter(|(severity, _)| *severity != Severity::Note);
    for (_, text) in worth.clone().take(FINDINGS) {
        ui.label(RichText::new(text).text_style(TextStyle::Small));
    }
    let more = worth.count().saturating_sub(FINDINGS);
    if more > 0 {
        ui.label(theme::quiet(format!(
            "and {more} more: greyfield check RESULTS tells all of them, and how to mend them"
        )));
    }
}
