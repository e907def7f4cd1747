//! What is known of a pair: its numbers, where its images came from, and which passes ran.

use eframe::egui::{Grid, RichText, ScrollArea, Ui};

use super::folder::{Folder, images};
use super::pair::Loaded;
use crate::app::background::Task;
use crate::stimulus::manifest::{ImageRecord, PairRecord, SourceRecord};

/// What the side panel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sheet {
    /// What differs, in numbers; what was asked.
    Pair,
    /// Hashes, parameters, adapter.
    Provenance,
    /// Passes, their reasons and times.
    Plan,
}

impl Sheet {
    /// All of them, with what stands on their tabs.
    pub const ALL: [(Self, &'static str); 3] = [
        (Self::Pair, "Pair"),
        (Self::Provenance, "Provenance"),
        (Self::Plan, "Frame plan"),
    ];
}

/// Condition, and how the two images differ.
pub fn pair(ui: &mut Ui, record: &PairRecord, loaded: Option<&Loaded>) {
    rows(ui, "pair", |ui| {
        row(ui, "Condition", &record.condition);
        row(ui, "Scene", &record.scene);
        row(ui, "Validity", &record.validity);
        row(ui, "Hypothesis", &record.hypothesis);
        row(ui, "A", &record.first.technique);
        row(ui, "B", &record.second.technique);
    });
    ui.separator();
    match loaded.map(|loaded| &loaded.difference) {
        None => {}
        Some(Err(message)) => {
            ui.label(message);
        }
        Some(Ok(difference)) => rows(ui, "difference", |ui| {
            let (x, y) = difference.largest_at_px;
            let percent = |share: f64| format!("{:.2} %", 100.0 * share);
            let levels = |value: f64| format!("{value:.3} of 255");
            row(
                ui,
                "Pixels that differ",
                &percent(1.0 - difference.share_within(0)),
            );
            row(
                ui,
                "by more than 1/255",
                &percent(1.0 - difference.share_within(1)),
            );
            row(
                ui,
                "by more than 8/255",
                &percent(1.0 - difference.share_within(8)),
            );
            let largest = format!("{} of 255, at column {x}, row {y}", difference.largest);
            row(ui, "Largest", &largest);
            row(ui, "Mean", &levels(difference.mean_abs));
            row(ui, "RMSE", &levels(difference.rmse));
        }),
    }
}

/// Where the set and both images came from.
pub fn provenance(ui: &mut Ui, folder: &Folder, record: &PairRecord) {
    let manifest = &folder.manifest;
    rows(ui, "set", |ui| {
        row(ui, "Set", &manifest.set_id);
        row(ui, "Folder", &folder.path.display().to_string());
        row(ui, "Seed", &manifest.seed.to_string());
        row(ui, "Config", &manifest.config_sha256);
        row(ui, "Greyfield", &manifest.app_version);
        if let Some(adapter) = &manifest.adapter {
            row(ui, "Adapter", &adapter.name);
            let kind = format!("{}, {}, {}", adapter.backend, adapter.kind, adapter.driver);
            row(ui, "", &kind);
        }
    });
    for (letter, image) in ["A", "B"].into_iter().zip(images(record)) {
        ui.separator();
        ui.strong(format!("{letter}: {}", image.technique));
        rows(ui, letter, |ui| of_image(ui, image));
    }
}

fn of_image(ui: &mut Ui, image: &ImageRecord) {
    row(ui, "File", &image.file.display().to_string());
    row(ui, "SHA-256", &image.sha256);
    row(
        ui,
        "Size",
        &format!("{}×{} px", image.width_px, image.height_px),
    );
    for (name, value) in &image.parameters {
        row(ui, name, &value.to_string());
    }
    if let Some(source) = &image.source {
        of_source(ui, source);
    }
}

fn of_source(ui: &mut Ui, source: &SourceRecord) {
    row(ui, "Made from", &source.file.display().to_string());
    row(ui, "its SHA-256", &source.sha256);
    let declared = if source.colour_space_declared {
        ", as the set says"
    } else {
        ""
    };
    let format = format!(
        "{}, {} bits a channel, {}{declared}",
        source.format, source.bits_per_channel, source.colour_space
    );
    row(ui, "its format", &format);
    if let Some(exposure_ev) = source.exposure_ev {
        let tone_map = source.tone_map.as_deref().unwrap_or("none");
        row(
            ui,
            "shown with",
            &format!("{exposure_ev} EV, tone map {tone_map}"),
        );
        row(
            ui,
            "clipped",
            &format!("{:.2} %", 100.0 * source.clipped_share),
        );
    }
    for (name, value) in &source.metadata {
        row(ui, name, value);
    }
}

/// The passes on record with their times; then the plans with their reasons.
pub fn plan(ui: &mut Ui, record: &PairRecord, plans: Option<&Task<String>>, note: Option<&str>) {
    for (letter, image) in ["A", "B"].into_iter().zip(images(record)) {
        ui.strong(format!("{letter}: {}", image.technique));
        if image.passes.is_empty() {
            ui.label("Made elsewhere: no pass ran here.");
            continue;
        }
        rows(ui, letter, |ui| {
            for pass in &image.passes {
                let time = pass.gpu_ms.map(|ms| format!("{ms:.2} ms"));
                let shared = if pass.shared { ", shared" } else { "" };
                let time = time.unwrap_or_else(|| String::from("not timed"));
                row(ui, &pass.pass, &(time + shared));
            }
        });
        ui.add_space(6.0);
    }
    ui.separator();
    match plans {
        None => {
            ui.label(note.unwrap_or_default());
        }
        Some(Task::Running(_)) => {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label("Reading the scene …");
            });
        }
        Some(Task::Failed(detail)) => {
            ui.label(detail);
        }
        Some(Task::Done(text)) => {
            ScrollArea::horizontal().id_salt("plans").show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                for line in text.lines() {
                    ui.add(eframe::egui::Label::new(RichText::new(line).monospace()).extend());
                }
            });
        }
    }
}

fn rows(ui: &mut Ui, salt: &str, add: impl FnOnce(&mut Ui)) {
    Grid::new(("facts", salt))
        .num_columns(2)
        .spacing([14.0, 4.0])
        .min_row_height(0.0)
        .show(ui, |ui| {
            ui.spacing_mut().interact_size.y = 0.0;
            add(ui);
        });
}

fn row(ui: &mut Ui, name: &str, value: &str) {
    if value.is_empty() {
        return;
    }
    ui.weak(name);
    ui.add(eframe::egui::Label::new(value).wrap());
    ui.end_row();
}
