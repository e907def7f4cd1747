//! The middle of the stimulus browser and of the cost panel: pictures in one place, under one zoom.

pub mod view;

use eframe::egui::{
    Color32, ColorImage, Context, CursorIcon, Mesh, Painter, Pos2, Rect, Response, Sense, Stroke,
    TextureFilter, TextureHandle, TextureOptions, Ui, Vec2, pos2, vec2,
};

use self::view::View;
use super::{stimulus_view, theme};
use crate::stimulus::manifest::Picture;

/// What is painted.
pub enum Content<'a> {
    /// One picture.
    One(&'a TextureHandle),
    /// The first on the left of the divider, the second on its right.
    Split(&'a TextureHandle, &'a TextureHandle),
}

/// How the pictures are looked at; shared by all pictures of a set.
#[derive(Debug)]
pub struct Stage {
    /// Zoom and pan; `None` until a picture was shown.
    pub view: Option<View>,
    /// Place of the divider, 0 at the left edge of the stage and 1 at its right.
    pub divider: f32,
}

impl Default for Stage {
    fn default() -> Self {
        Self {
            view: None,
            divider: 0.5,
        }
    }
}

/// Half the width in which the divider can be grasped, points.
const GRASP: f32 = 6.0;

impl Stage {
    /// Fits the picture to the stage again.
    pub fn fit(&mut self) {
        self.view = None;
    }

    /// One image pixel on one pixel of the screen.
    pub fn one_to_one(&mut self) {
        self.view = self.view.map(View::one_to_one);
    }

    /// Paints, takes wheel and drag; gives the image pixel under the pointer.
    pub fn show(&mut self, ui: &mut Ui, content: &Content<'_>) -> Option<(u32, u32)> {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let painter = ui.painter_at(rect);
        paint_stage(&painter, rect);
        let texture = match content {
            Content::One(texture) | Content::Split(texture, _) => texture,
        };
        let [width, height] = stimulus_view::size_px(texture);
        let image_px = view::size(width, height);
        let scale = ui.ctx().pixels_per_point();
        let stage_px = rect * scale;
        let fitted = View::fit(image_px, stage_px.size());
        let mut view = self.view.filter(|view| !view.fits).unwrap_or(fitted);
        if view.fits || view.zoom == 1.0 {
            // Else the wheel would magnify about a point up to half a pixel beside the pointer.
            view = view.on_whole_pixels(stage_px);
        }
        let view = moved(ui, &response, view, image_px, stage_px, scale);
        self.view = Some(view);
        let place = view.place_px(image_px, stage_px) / scale;
        match content {
            Content::One(texture) => paint(&painter, texture, place, rect),
            Content::Split(first, second) => {
                let x = self.divide(ui, rect, scale);
                let (left, right) = (rect.with_max_x(x), rect.with_min_x(x));
                paint(&painter, first, place, left);
                paint(&painter, second, place, right);
                let line = Stroke::new(1.0 / scale, Color32::WHITE);
                painter.vline(x, rect.y_range(), line);
            }
        }
        let hovered = response.hover_pos()?;
        view.pixel_at((hovered.to_vec2() * scale).to_pos2(), image_px, stage_px)
    }

    /// Lets the divider be dragged; its place, on a whole pixel.
    fn divide(&mut self, ui: &mut Ui, rect: Rect, scale: f32) -> f32 {
        let at = |divider: f32| rect.left() + rect.width() * divider;
        let grasp = Rect::from_x_y_ranges(
            at(self.divider) - GRASP..=at(self.divider) + GRASP,
            rect.y_range(),
        );
        let response = ui
            .interact(grasp, ui.scope_id().with("divider"), Sense::drag())
            .on_hover_cursor(CursorIcon::ResizeHorizontal);
        if response.dragged()
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let share = (pointer.x - rect.left()) / rect.width().max(1.0);
            self.divider = share.clamp(0.0, 1.0);
        }
        (at(self.divider) * scale).round() / scale
    }
}

/// The view after the wheel and the drag of this pass.
fn moved(
    ui: &Ui,
    response: &Response,
    view: View,
    image_px: Vec2,
    stage_px: Rect,
    scale: f32,
) -> View {
    let mut view = view;
    if response.dragged() {
        view = view.panned(response.drag_delta() * scale, image_px);
    }
    let Some(pointer) = response.hover_pos() else {
        return view;
    };
    let (wheel, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
    let factor = (wheel / 200.0).exp() * pinch;
    if (factor - 1.0).abs() > f32::EPSILON {
        let from_centre = pointer.to_vec2() * scale - stage_px.center().to_vec2();
        view = view.zoomed(factor, from_centre);
    }
    view
}

/// The neutral grey the pictures are judged on. A mesh and not a rectangle shape, because egui
/// feathers the edges of shapes.
fn paint_stage(painter: &Painter, rect: Rect) {
    let mut mesh = Mesh::default();
    mesh.add_colored_rect(rect, Color32::from_gray(theme::BROWSER_STAGE));
    painter.add(mesh);
}

fn paint(painter: &Painter, texture: &TextureHandle, place: Rect, clip: Rect) {
    let mut mesh = Mesh::with_texture(texture.id());
    let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    mesh.add_rect_with_uv(place, whole, Color32::WHITE);
    painter
        .with_clip_rect(clip.intersect(painter.clip_rect()))
        .add(mesh);
}

/// A note in the middle of the stage, with a spinner while something is being made.
pub fn note(ui: &mut Ui, text: &str, busy: bool) {
    with_note(ui, |ui| {
        if busy {
            ui.spinner();
        }
        ui.label(text);
    });
}

/// A stage without a picture, with something in its middle.
pub fn with_note(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    let (rect, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    paint_stage(ui.painter(), rect);
    let column = Rect::from_center_size(rect.center(), vec2(rect.width().min(560.0), 120.0));
    ui.scope_builder(eframe::egui::UiBuilder::new().max_rect(column), |ui| {
        ui.vertical_centered(add);
    });
}

/// A texture that shows every pixel when magnified, and averages when made smaller.
pub fn upload(ctx: &Context, name: &str, picture: &Picture) -> TextureHandle {
    let size = [picture.width_px as usize, picture.height_px as usize];
    let image = ColorImage::from_rgba_unmultiplied(size, &picture.rgba8);
    let options = TextureOptions {
        magnification: TextureFilter::Nearest,
        minification: TextureFilter::Linear,
        ..TextureOptions::NEAREST
    };
    ctx.load_texture(name, image, options)
}
