//! What study this is and whether everything is ready for it.

use std::path::Path;

use eframe::egui::{Align, Grid, Label, Layout, Ui};

use super::OnRecord;
use crate::app::display::{DisplayFacts, DisplayTooSmall};
use crate::app::stimuli_check::StimuliCheck;
use crate::app::stimulus_view::SizePx;
use crate::app::theme;
use crate::protocol::Protocol;
use crate::record::ParticipantId;

/// Everything the page states.
pub struct Facts<'a> {
    /// The protocol.
    pub protocol: &'a Protocol,
    /// Its file.
    pub protocol_path: &'a Path,
    /// Where the data goes.
    pub results: &'a Path,
    /// This computer's name in the rows.
    pub station: &'a str,
    /// Rows are marked as pilot data.
    pub pilot: bool,
    /// Trials of a whole session.
    pub trials: usize,
    /// Images in the set, and the size they all fit in.
    pub images: (usize, SizePx),
    /// How the check of the images stands.
    pub stimuli: &'a StimuliCheck,
    /// Lines on the participants so far.
    pub participants: &'a Result<Vec<String>, String>,
    /// The display.
    pub display: &'a DisplayFacts,
    /// Whether it will do.
    pub display_check: &'a Result<(), DisplayTooSmall>,
    /// Looks an id up in the record.
    pub on_record: &'a dyn Fn(&ParticipantId) -> OnRecord,
}

impl Facts<'_> {
    /// What stands in the way of any session, in words.
    #[must_use]
    pub fn blocker(&self) -> Option<String> {
        if let Err(too_small) = self.display_check {
            return Some(format!("No session can start here: {too_small}"));
        }
        match self.stimuli {
            StimuliCheck::Waiting | StimuliCheck::Running(_) => {
                Some(String::from("Checking the images …"))
            }
            StimuliCheck::Failed(detail) => Some(format!("No session can start: {detail}")),
            StimuliCheck::Passed => None,
        }
    }
}

/// Draws the facts.
pub fn show(ui: &mut Ui, facts: &Facts<'_>) {
    ui.add_space(10.0);
    theme::card().show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        Grid::new("facts")
            .num_columns(2)
            .spacing([28.0, 10.0])
            .min_col_width(110.0)
            .min_row_height(0.0)
            .show(ui, |ui| {
                // Nothing to hit here: rows as high as their text.
                ui.spacing_mut().interact_size.y = 0.0;
                for (name, lines) in lines(facts) {
                    ui.with_layout(Layout::top_down(Align::Min), |ui| {
                        ui.label(theme::quiet(name));
                    });
                    ui.vertical(|ui| {
                        ui.spacing_mut().item_spacing.y = 3.0;
                        for line in lines {
                            show_line(ui, &line);
                        }
                    });
                    ui.end_row();
                }
            });
    });
    ui.add_space(10.0);
    ui.label(theme::quiet(format!(
        "To end a session early, hold Ctrl, Shift and {} for one second.",
        facts.protocol.keys.abort_with_ctrl_shift
    )));
}

/// A line of the table: said, or said with a tick or a cross before it.
struct Line {
    good: Option<bool>,
    text: String,
}

impl Line {
    fn plain(text: impl Into<String>) -> Self {
        Self {
            good: None,
            text: text.into(),
        }
    }

    fn checked(good: bool, text: impl Into<String>) -> Self {
        Self {
            good: Some(good),
            text: text.into(),
        }
    }
}

fn show_line(ui: &mut Ui, line: &Line) {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        if let Some(good) = line.good {
            theme::mark(ui, good);
        }
        ui.add(Label::new(line.text.as_str()).wrap());
    });
}

fn lines(facts: &Facts<'_>) -> [(&'static str, Vec<Line>); 6] {
    let participants = match facts.participants {
        Ok(lines) => lines.iter().map(Line::plain).collect(),
        Err(detail) => vec![Line::checked(
            false,
            format!("The results folder cannot be read: {detail}"),
        )],
    };
    let plain = |text: String| vec![Line::plain(text)];
    [
        ("Participants", participants),
        ("Protocol", plain(facts.protocol_path.display().to_string())),
        ("Results", plain(facts.results.display().to_string())),
        ("Station", plain(facts.station.to_owned())),
        ("Images", vec![stimuli(facts)]),
        ("Display", vec![display(facts.display), fit(facts)]),
    ]
}

fn stimuli(facts: &Facts<'_>) -> Line {
    let (count, [columns, rows]) = facts.images;
    let what = format!("{count} images of {columns}×{rows} pixels");
    match facts.stimuli {
        StimuliCheck::Waiting | StimuliCheck::Running(_) => {
            Line::plain(format!("{what}; being checked …"))
        }
        StimuliCheck::Passed => Line::checked(true, format!("{what}, all as they were made")),
        StimuliCheck::Failed(detail) => Line::checked(false, detail),
    }
}

fn display(display: &DisplayFacts) -> Line {
    let size = display.monitor_px.map_or_else(
        || String::from("Monitor of unknown size"),
        |[columns, rows]| format!("Monitor of {columns}×{rows} pixels"),
    );
    let rate = display.refresh_hz.map_or_else(
        || String::from("refresh rate unknown"),
        |hz| format!("{hz:.2} Hz as the system states it"),
    );
    let mode = if display.full_screen {
        "full screen"
    } else {
        "in a window"
    };
    Line::plain(format!(
        "{size}, {rate}, scale factor {}, {mode}",
        display.scale_factor
    ))
}

fn fit(facts: &Facts<'_>) -> Line {
    match facts.display_check {
        Ok(()) => Line::checked(true, "Images are shown in their own pixels"),
        Err(too_small) => Line::checked(false, too_small.to_string()),
    }
}
