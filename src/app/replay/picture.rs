//! The participant's picture of one moment, drawn by what drew it for the participant.

use std::path::PathBuf;

use eframe::egui::{Context, TextureHandle, Ui};

use crate::app::participant::{Look, Page, comparison, grey, question, ranking, rating};
use crate::app::stimulus_view::{self, SizePx};
use crate::protocol::Protocol;
use crate::protocol::procedure::Ask;
use crate::record::row::LIST_SEPARATOR;
use crate::record::{Response, TrialRow};
use crate::session::replay::{ReplayTrial, Shown};
use crate::stimulus::ImageRecord;

/// The images of the trial that is shown; never more than one trial's.
pub(super) struct Pictures {
    folder: PathBuf,
    held: Option<(usize, Result<Vec<TextureHandle>, String>)>,
}

type Trial<'a> = Option<(usize, &'a ReplayTrial)>;

impl Pictures {
    pub fn new(folder: PathBuf) -> Self {
        Self { folder, held: None }
    }

    /// Draws what stood on the screen; the error says why it cannot be drawn.
    pub fn draw(
        &mut self,
        ui: &mut Ui,
        protocol: &Protocol,
        what: Shown,
        trial: Trial<'_>,
    ) -> Result<(), String> {
        let ctx = ui.ctx().clone();
        let (level, surround) = (
            protocol.grey.level_srgb.get(),
            grey::surround(&protocol.grey),
        );
        let Some((index, trial)) = trial else {
            stimulus_view::paint_grey(&ctx, level);
            return Ok(());
        };
        match what {
            Shown::Image { place } => {
                let textures = self.textures(&ctx, index, trial)?;
                let texture = textures.get(place).ok_or("the trial has no such image")?;
                stimulus_view::paint_picture(&ctx, texture, surround)
                    .map_err(|error| error.to_string())
            }
            Shown::Grey => stimulus_view::paint_field(&ctx, size_px(trial), level, surround)
                .map_err(|error| error.to_string()),
            Shown::Question { ask, answered } => {
                self.question(ui, protocol, (index, trial), ask, answered)
            }
            Shown::Between | Shown::Gap => {
                stimulus_view::paint_grey(&ctx, level);
                Ok(())
            }
        }
    }

    /// What the participant pressed is not pressed again: clicks go nowhere.
    fn question(
        &mut self,
        ui: &mut Ui,
        protocol: &Protocol,
        (index, trial): (usize, &ReplayTrial),
        ask: Ask,
        answered: bool,
    ) -> Result<(), String> {
        let ctx = ui.ctx().clone();
        let words = protocol.words(trial.row.language);
        let look = Look {
            level: protocol.grey.level_srgb.get(),
            text_scale: 1.0,
            high_contrast: false,
        };
        let page = Page {
            look,
            words: &words,
        };
        let (keys, cannot_tell) = (&protocol.keys, protocol.cannot_tell);
        let (surface, scale) = (stimulus_view::surface_px(&ctx), ctx.pixels_per_point());
        match ask {
            Ask::Choice => drop(question::show(ui, page, keys, cannot_tell)),
            Ask::Ratings => {
                let mut draft = rating::Draft::default();
                if answered {
                    draft = rating::Draft::of(ratings(&trial.row, protocol));
                }
                drop(rating::show(ui, page, &protocol.scales, &mut draft));
            }
            Ask::CloserToReference => {
                let textures = self.textures(&ctx, index, trial)?;
                let [left, right, reference] = textures else {
                    return Err("the row has no two images and a reference".to_owned());
                };
                let arranged = comparison::arrange(surface, size_px(trial), scale)
                    .map_err(|error| error.to_string())?;
                let pictures = [left, reference, right].into_iter();
                let pictures: Vec<_> = pictures.zip(arranged.corners.iter().copied()).collect();
                stimulus_view::paint_pictures(&ctx, &pictures, look.level);
                drop(comparison::show(ui, page, keys, cannot_tell, &arranged));
            }
            Ask::Ranking => {
                let textures = self.textures(&ctx, index, trial)?;
                let arranged = ranking::arrange(surface, size_px(trial), textures.len(), scale)
                    .map_err(|error| error.to_string())?;
                let corners = arranged.corners.iter().copied();
                let pictures: Vec<_> = textures.iter().zip(corners).collect();
                stimulus_view::paint_pictures(&ctx, &pictures, look.level);
                let mut draft = ranking::Draft::default();
                if answered {
                    draft = ranking::Draft::of(places(&trial.row));
                }
                drop(ranking::show(ui, page, &arranged, &mut draft));
            }
        }
        Ok(())
    }

    /// The trial's images by place, then the reference, from their files as they were.
    fn textures(
        &mut self,
        ctx: &Context,
        index: usize,
        trial: &ReplayTrial,
    ) -> Result<&[TextureHandle], String> {
        if self.held.as_ref().is_none_or(|(held, _)| *held != index) {
            let load = |image: &ImageRecord| -> Result<TextureHandle, String> {
                let picture = image
                    .load(&self.folder)
                    .map_err(|error| error.to_string())?;
                Ok(stimulus_view::upload(ctx, "replay", &picture))
            };
            let images = trial.images.iter().chain(&trial.reference);
            self.held = Some((index, images.map(load).collect()));
        }
        match &self.held {
            Some((_, Ok(textures))) => Ok(textures),
            Some((_, Err(detail))) => Err(detail.clone()),
            None => Err("the image was not decoded".to_owned()),
        }
    }
}

/// Says in place of a picture why it is not there.
pub(super) fn cannot(ui: &mut Ui, detail: &str) {
    stimulus_view::paint_grey(ui.ctx(), crate::app::theme::PAGE);
    ui.vertical_centered(|ui| {
        ui.add_space(60.0);
        ui.label("This cannot be shown as the participant saw it.");
        ui.label(detail);
    });
}

/// Size of the trial's images, which is that of the grey in their place.
fn size_px(trial: &ReplayTrial) -> SizePx {
    let image = trial.images.first();
    image.map_or([0, 0], |image| [image.width_px, image.height_px])
}

/// The points given, in the protocol's order.
fn ratings(row: &TrialRow, protocol: &Protocol) -> Vec<Option<u32>> {
    let given = |id: &str| {
        let mut items = row.ratings.split(LIST_SEPARATOR);
        let points = items.find_map(|item| item.strip_prefix(id)?.strip_prefix('='));
        points.and_then(|points| points.parse().ok())
    };
    protocol
        .scales
        .iter()
        .map(|scale| given(&scale.id))
        .collect()
}

/// Places of the images in the order they were ranked.
fn places(row: &TrialRow) -> Vec<usize> {
    // Two versions stand in the columns of a pair.
    let shown: Vec<&str> = if row.techniques_shown.is_empty() {
        vec![&row.technique_first, &row.technique_second]
    } else {
        row.techniques_shown.split(LIST_SEPARATOR).collect()
    };
    let place = |technique: &str| shown.iter().position(|known| *known == technique);
    row.ranking
        .split(LIST_SEPARATOR)
        .filter_map(place)
        .collect()
}

/// The answer in words, as the participant's own screen has them.
pub(super) fn answer(trial: &ReplayTrial, protocol: &Protocol) -> String {
    let (row, words) = (&trial.row, protocol.words(trial.row.language));
    let chosen = row.chosen_technique.as_deref().unwrap_or_default();
    let beside = trial.ask == Ask::CloserToReference;
    match row.response {
        Some(Response::First) => {
            let said = if beside {
                &words.answer_left
            } else {
                &words.answer_first
            };
            format!("{said} ({chosen})")
        }
        Some(Response::Second) => {
            let said = if beside {
                &words.answer_right
            } else {
                &words.answer_second
            };
            format!("{said} ({chosen})")
        }
        Some(Response::CannotTell) => words.cannot_tell.clone(),
        None => [&*row.ratings, &*row.ranking].concat(),
    }
}
