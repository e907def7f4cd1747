//! How the participant's pages of text are to look: language, size of type, contrast.
//! Images and the grey are the same for everybody.

use eframe::egui::{ComboBox, Ui};

use super::Facts;
use crate::protocol::Language;

/// What the experimenter chose for the next session.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screens {
    /// Language of the pages; `None` for the protocol's own.
    pub language: Option<Language>,
    /// Size of type, 1 for the usual.
    pub text_scale: f32,
    /// Black on white with strong edges.
    pub high_contrast: bool,
}

impl Default for Screens {
    fn default() -> Self {
        Self {
            language: None,
            text_scale: 1.0,
            high_contrast: false,
        }
    }
}

const SIZES: [(f32, &str); 4] = [
    (1.0, "usual"),
    (1.25, "large"),
    (1.5, "larger"),
    (2.0, "largest"),
];

/// Draws the choices in one row.
pub fn show(ui: &mut Ui, facts: &Facts<'_>, screens: &mut Screens) {
    let languages: Vec<Language> = facts.protocol.languages().collect();
    ui.horizontal_wrapped(|ui| {
        if languages.len() > 1 {
            let label = ui.label("Language");
            let chosen = screens.language.unwrap_or(languages[0]);
            ComboBox::from_id_salt("language")
                .selected_text(chosen.name())
                .show_ui(ui, |ui| {
                    for language in languages {
                        ui.selectable_value(&mut screens.language, Some(language), language.name());
                    }
                })
                .response
                .labelled_by(label.id);
        }
        let label = ui.label("Size of type");
        let size = SIZES.iter().find(|(scale, _)| *scale == screens.text_scale);
        ComboBox::from_id_salt("type")
            .selected_text(size.map_or("usual", |(_, name)| name))
            .show_ui(ui, |ui| {
                for (scale, name) in SIZES {
                    ui.selectable_value(&mut screens.text_scale, scale, name);
                }
            })
            .response
            .labelled_by(label.id);
        ui.checkbox(&mut screens.high_contrast, "Strong contrast");
    });
}
