//! The conditions of a set, each with its two pictures, small.

use std::sync::mpsc::{self, Receiver};

use eframe::egui::{
    Align, Button, Color32, Context, Image, Layout, Rect, ScrollArea, TextureHandle, Ui, Vec2, vec2,
};
use image::imageops::FilterType;

use super::folder::{Folder, images};
use crate::app::stage::upload;
use crate::app::theme;
use crate::stimulus::manifest::{ImageRecord, PairRecord};
use crate::stimulus::{Picture, sheet};

/// Width of a thumbnail, points; two stand side by side.
const WIDTH: f32 = 116.0;
/// Columns of a thumbnail's picture: sharp on screens with two pixels a point.
const COLUMNS_PX: u32 = 232;

type Thumbnail = Result<Picture, String>;

/// The list of conditions.
pub struct Gallery {
    arriving: Receiver<(usize, usize, Thumbnail)>,
    /// For each condition, its two pictures.
    thumbnails: Vec<[Option<Result<TextureHandle, String>>; 2]>,
}

impl Gallery {
    /// Starts making the thumbnails of a folder, one after another, beside the interface.
    #[must_use]
    pub fn load(ctx: &Context, folder: &Folder) -> Self {
        let (sender, arriving) = mpsc::channel();
        let (path, manifest, ctx) = (folder.path.clone(), folder.manifest.clone(), ctx.clone());
        let thumbnails = manifest.pairs.iter().map(|_| [None, None]).collect();
        std::thread::spawn(move || {
            for (index, pair) in manifest.pairs.iter().enumerate() {
                for (which, image) in images(pair).into_iter().enumerate() {
                    let thumbnail = shrink(image, &path);
                    if sender.send((index, which, thumbnail)).is_err() {
                        return;
                    }
                    ctx.request_repaint();
                }
            }
        });
        Self {
            arriving,
            thumbnails,
        }
    }

    /// Draws the list; gives the condition that was clicked.
    pub fn show(&mut self, ui: &mut Ui, folder: &Folder, selected: usize) -> Option<usize> {
        for (index, which, thumbnail) in self.arriving.try_iter() {
            let texture = thumbnail.map(|picture| upload(ui.ctx(), "thumbnail", &picture));
            self.thumbnails[index][which] = Some(texture);
        }
        let mut clicked = None;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (index, pair) in folder.manifest.pairs.iter().enumerate() {
                if self.entry(ui, index, pair, index == selected) {
                    clicked = Some(index);
                }
                ui.add_space(4.0);
            }
        });
        clicked
    }

    fn entry(&self, ui: &mut Ui, index: usize, pair: &PairRecord, is_selected: bool) -> bool {
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            let name = Button::selectable(is_selected, pair.condition.as_str())
                .min_size(vec2(2.0 * WIDTH + 6.0, 0.0));
            let mut clicked = ui.add(name).clicked();
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 6.0;
                for (thumbnail, image) in self.thumbnails[index].iter().zip(images(pair)) {
                    clicked |= picture(ui, thumbnail.as_ref(), image);
                }
            });
            let (first, second) = (&pair.first.technique, &pair.second.technique);
            ui.weak(format!("{}: {first} | {second}", pair.validity));
            clicked
        })
        .inner
    }
}

/// One thumbnail, or the place of it; true if it was clicked.
fn picture(
    ui: &mut Ui,
    thumbnail: Option<&Result<TextureHandle, String>>,
    image: &ImageRecord,
) -> bool {
    let height = WIDTH * image.height_px as f32 / image.width_px.max(1) as f32;
    let size = Vec2::new(WIDTH, height.min(2.0 * WIDTH));
    match thumbnail {
        Some(Ok(texture)) => {
            let image = Image::new(texture).fit_to_exact_size(size);
            ui.add(image.sense(eframe::egui::Sense::click())).clicked()
        }
        other => {
            let (rect, response) = ui.allocate_exact_size(size, eframe::egui::Sense::click());
            empty(ui, rect);
            if let Some(Err(detail)) = other {
                theme::paint_cross(ui.painter(), rect.center(), 20.0, ui.visuals().text_color());
                response.clone().on_hover_text(detail);
            }
            response.clicked()
        }
    }
}

fn empty(ui: &Ui, rect: Rect) {
    let grey = Color32::from_gray(theme::BROWSER_STAGE);
    ui.painter().rect_filled(rect, 0.0, grey);
}

fn shrink(image: &ImageRecord, folder: &std::path::Path) -> Thumbnail {
    let picture = image.load(folder).map_err(|error| error.to_string())?;
    Ok(sheet::shrink(&picture, COLUMNS_PX, FilterType::Triangle))
}
