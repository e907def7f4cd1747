//! Results as textures, and what their colours mean.

use eframe::egui::{Color32, Context, Mesh, Rect, Sense, TextureHandle, Ui, pos2, vec2};

use super::result::{LARGEST_ERROR, LARGEST_FLIP, Look, Shown};
use crate::app::stage::upload;
use crate::report::colour_map::{blue_white_red, magma};

/// Textures that are kept: every look of three results.
const KEPT: usize = 15;

/// The textures that were shown last.
#[derive(Default)]
pub struct Pictures {
    /// By number of the request and look, the last one used at the end.
    kept: Vec<((u64, Look), TextureHandle)>,
}

impl Pictures {
    /// The texture of a result, made when it is first looked at.
    pub fn texture(&mut self, ctx: &Context, shown: &Shown, look: Look) -> TextureHandle {
        let key = (shown.request.number, look);
        let found = self.kept.iter().position(|(known, _)| *known == key);
        let texture = match found {
            Some(place) => self.kept.remove(place).1,
            None => upload(ctx, "tuner", shown.picture(look)),
        };
        if self.kept.len() == KEPT {
            drop(self.kept.remove(0));
        }
        self.kept.push((key, texture.clone()));
        texture
    }
}

/// A bar that says what the colours of a map mean; nothing for an image.
pub fn scale(ui: &mut Ui, look: Look) {
    let grey = |share: f32| [(share * 255.0).round() as u8; 3];
    let (colour, low, high): (fn(f32) -> [u8; 3], String, String) = match look {
        Look::Image | Look::Truth => return,
        Look::Occlusion => (grey, String::from("0, closed"), String::from("1, open")),
        Look::Error => (
            blue_white_red,
            format!("−{LARGEST_ERROR}, too dark"),
            format!("+{LARGEST_ERROR}, too open"),
        ),
        Look::Flip => (magma, String::from("0, unseen"), format!("{LARGEST_FLIP}")),
    };
    ui.label(low);
    let (rect, _) = ui.allocate_exact_size(vec2(120.0, 12.0), Sense::hover());
    let mut mesh = Mesh::default();
    const STEPS: u16 = 60;
    for step in 0..STEPS {
        let at = |step: u16| rect.left() + rect.width() * f32::from(step) / f32::from(STEPS);
        let [red, green, blue] = colour(f32::from(step) / f32::from(STEPS - 1));
        let part = Rect::from_min_max(
            pos2(at(step), rect.top()),
            pos2(at(step + 1), rect.bottom()),
        );
        mesh.add_colored_rect(part, Color32::from_rgb(red, green, blue));
    }
    ui.painter().add(mesh);
    ui.label(high);
    ui.separator();
}
