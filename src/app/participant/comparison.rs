//! Two images and the reference between them, all in their own pixels, and the question.

use eframe::egui::{Align2, Color32, Id, Rect, Role, Sense, TextStyle, Ui, WidgetInfo};

use super::{Given, Page};
use crate::app::arrangement::{self, Arrangement, Room};
use crate::app::stimulus_view::{self, SizePx, TooSmall};
use crate::protocol::Position;
use crate::protocol::config::Keys;
use crate::record::InputDevice;
use crate::session::{Answer, Event};

/// Where left, reference and right stand.
///
/// # Errors
/// [`TooSmall`] if they do not fit side by side.
pub fn arrange(surface_px: SizePx, image_px: SizePx, scale: f32) -> Result<Arrangement, TooSmall> {
    arrangement::arrange(surface_px, image_px, 3, Some(3), Room::at_scale(scale))
}

/// Draws what stands round the images and takes clicks on the two that can be chosen.
pub fn show(
    ui: &mut Ui,
    page: Page<'_>,
    keys: &Keys,
    cannot_tell: bool,
    arranged: &Arrangement,
) -> Option<Given> {
    let words = page.words;
    let rects = rects(ui, arranged);
    let top = rects[1].center_top();
    text(
        ui,
        page,
        top - eframe::egui::vec2(0.0, 18.0),
        Align2::CENTER_BOTTOM,
        &words.question,
    );
    let captions = [
        format!("{}  [{}]", words.answer_left, keys.answer_first),
        words.reference.clone(),
        format!("{}  [{}]", words.answer_right, keys.answer_second),
    ];
    for (rect, caption) in rects.iter().zip(&captions) {
        let below = rect.center_bottom() + eframe::egui::vec2(0.0, 12.0);
        text(ui, page, below, Align2::CENTER_TOP, caption);
    }
    let clicked = |ui: &mut Ui, index: usize, label: &str, position: Position| {
        let response = ui.interact(
            rects[index],
            Id::unique(("candidate", index)),
            Sense::click(),
        );
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label));
        response
            .clicked()
            .then_some((Event::Answer(Answer::Choice(position)), InputDevice::Mouse))
    };
    let left = clicked(ui, 0, &words.answer_left, Position::First);
    let right = clicked(ui, 2, &words.answer_right, Position::Second);
    let neither = cannot_tell
        .then(|| cannot_tell_link(ui, page, keys, rects[1]))
        .flatten();
    left.or(right).or(neither)
}

fn cannot_tell_link(ui: &mut Ui, page: Page<'_>, keys: &Keys, middle: Rect) -> Option<Given> {
    let caption = format!("{}  [{}]", page.words.cannot_tell, keys.cannot_tell);
    let at = middle.center_bottom() + eframe::egui::vec2(0.0, 52.0);
    let rect = text(ui, page, at, Align2::CENTER_TOP, &caption);
    let response = ui.interact(rect, Id::unique("cannot tell"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &caption));
    response
        .clicked()
        .then_some((Event::Answer(Answer::CannotTell), InputDevice::Mouse))
}

/// The pictures' places, points.
pub(super) fn rects(ui: &Ui, arranged: &Arrangement) -> Vec<Rect> {
    let corners = arranged.corners.iter();
    corners
        .map(|&corner| stimulus_view::rect_at(ui.ctx(), corner, arranged.picture_px))
        .collect()
}

/// A line of text on the protocol's grey; gives the place it took.
pub(super) fn text(
    ui: &Ui,
    page: Page<'_>,
    at: eframe::egui::Pos2,
    align: Align2,
    text: &str,
) -> Rect {
    let mut font = TextStyle::Body.resolve(ui.style());
    font.size = 20.0 * page.look.text_scale;
    let ink: Color32 = crate::app::theme::ink_on(page.look.level);
    ui.painter().text(at, align, text, font, ink)
}
