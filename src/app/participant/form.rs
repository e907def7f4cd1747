//! Questions about the participant. Every one may be left out.

use eframe::egui::{TextEdit, Ui, vec2};

use super::{Given, Page, button, device};
use crate::app::theme;
use crate::protocol::options::MetadataField;
use crate::record::AboutAnswer;
use crate::session::Event;

/// Longest free answer, characters.
const LONGEST: usize = 200;

/// What is chosen or typed so far, a question each.
#[derive(Debug, Clone, Default)]
pub struct Draft {
    chosen: Vec<Option<usize>>,
    typed: Vec<String>,
}

/// Draws the questions.
pub fn show(
    ui: &mut Ui,
    page: Page<'_>,
    fields: &[MetadataField],
    draft: &mut Draft,
) -> Option<Given> {
    draft.chosen.resize(fields.len(), None);
    draft.typed.resize(fields.len(), String::new());
    page.show(ui, |ui| {
        ui.heading(&*page.words.form_title);
        ui.label(&*page.words.form_hint);
        ui.add_space(12.0);
        for (index, field) in fields.iter().enumerate() {
            question(ui, page, field, index, draft);
            ui.add_space(8.0);
        }
        ui.add_space(16.0);
        let next = button(ui, &page.words.next, vec2(200.0, 52.0));
        next.clicked()
            .then(|| (Event::Told(answers(fields, draft)), device(&next)))
    })
}

fn question(ui: &mut Ui, page: Page<'_>, field: &MetadataField, index: usize, draft: &mut Draft) {
    let words = page.words.metadata.get(&*field.id);
    let label = ui.label(words.map_or(&*field.id, |words| &*words.label));
    if field.choices.is_empty() {
        let line = TextEdit::singleline(&mut draft.typed[index])
            .char_limit(LONGEST)
            .desired_width(420.0);
        ui.add(line).labelled_by(label.id);
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (choice, own) in field.choices.iter().enumerate() {
            let text = words.and_then(|words| words.choices.get(choice));
            let is_chosen = draft.chosen[index] == Some(choice);
            let size = vec2(0.0, 44.0 * page.look.text_scale);
            if theme::point_button(ui, text.unwrap_or(own), is_chosen, size).clicked() {
                // A second click takes the answer back.
                draft.chosen[index] = (!is_chosen).then_some(choice);
            }
        }
    });
}

/// The answers given, as they stand in the data.
fn answers(fields: &[MetadataField], draft: &Draft) -> Vec<AboutAnswer> {
    let given = |(index, field): (usize, &MetadataField)| {
        let chosen = draft.chosen[index].and_then(|choice| field.choices.get(choice));
        let typed = draft.typed[index].trim();
        let answer = chosen.map_or(typed, |choice| &**choice);
        (!answer.is_empty()).then(|| AboutAnswer {
            id: field.id.to_string(),
            answer: answer.to_owned(),
        })
    };
    fields.iter().enumerate().filter_map(given).collect()
}
