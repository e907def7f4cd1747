//! All versions of a scene in their own pixels; clicks number them, the best one first.

use eframe::egui::{Align2, Id, InputState, Rect, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};

use super::comparison::{rects, text};
use super::{Given, Page, button, device, pressed};
use crate::app::arrangement::{self, Arrangement, Room};
use crate::app::stimulus_view::{SizePx, TooSmall};
use crate::protocol::Key;
use crate::record::InputDevice;
use crate::session::{Answer, Event};

/// Places in the order they were clicked.
#[derive(Debug, Clone, Default)]
pub struct Draft(Vec<usize>);

impl Draft {
    /// Places as they are on record.
    #[must_use]
    pub fn of(places: Vec<usize>) -> Self {
        Self(places)
    }

    /// Numbers a picture, or takes its number and the later ones back.
    fn toggle(&mut self, place: usize) {
        match self.0.iter().position(|&known| known == place) {
            Some(rank) => self.0.truncate(rank),
            None => self.0.push(place),
        }
    }

    fn whole(&self, count: usize) -> Option<Event> {
        (self.0.len() == count).then(|| Event::Answer(Answer::Ranking(self.0.clone())))
    }
}

/// Where the pictures stand.
///
/// # Errors
/// [`TooSmall`] if they do not fit on the screen together.
pub fn arrange(
    surface_px: SizePx,
    image_px: SizePx,
    count: usize,
    scale: f32,
) -> Result<Arrangement, TooSmall> {
    arrangement::arrange(surface_px, image_px, count, None, Room::at_scale(scale))
}

/// Digits number the pictures as they stand, row by row; Enter or the key that leads on ends.
pub fn input(input: &InputState, go_on: Key, count: usize, draft: &mut Draft) -> Option<Given> {
    for place in 0..count.min(9) {
        let digit = u32::try_from(place + 1)
            .ok()
            .and_then(|n| char::from_digit(n, 10));
        if digit.is_some_and(|digit| pressed(input, Key::Symbol(digit))) {
            draft.toggle(place);
        }
    }
    let ends = pressed(input, Key::Enter) || pressed(input, go_on);
    draft
        .whole(count)
        .filter(|_| ends)
        .map(|event| (event, InputDevice::Keyboard))
}

/// Draws what stands round the pictures and takes clicks on them.
pub fn show(
    ui: &mut Ui,
    page: Page<'_>,
    arranged: &Arrangement,
    draft: &mut Draft,
) -> Option<Given> {
    let rects = rects(ui, arranged);
    let all = rects.iter().copied().reduce(Rect::union)?;
    let over = all.center_top() - vec2(0.0, 46.0);
    text(ui, page, over, Align2::CENTER_BOTTOM, &page.words.question);
    let hint = all.center_top() - vec2(0.0, 14.0);
    text(ui, page, hint, Align2::CENTER_BOTTOM, &page.words.rank_hint);
    for (place, rect) in rects.iter().enumerate() {
        let rank = draft.0.iter().position(|&known| known == place);
        let number = rank.map_or_else(|| "–".to_owned(), |rank| (rank + 1).to_string());
        let below = rect.center_bottom() + vec2(0.0, 12.0);
        text(ui, page, below, Align2::CENTER_TOP, &number);
        let response = ui.interact(*rect, Id::unique(("version", place)), Sense::click());
        let label = format!("{}: {number}", place + 1);
        response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, rank.is_some(), &label));
        if response.clicked() {
            draft.toggle(place);
        }
    }
    let corner = all.center_bottom() + vec2(-100.0, 64.0);
    let place = Rect::from_min_size(corner, vec2(200.0, 52.0));
    let whole = draft.whole(rects.len());
    let next = ui
        .scope_builder(UiBuilder::new().max_rect(place), |ui| {
            ui.add_enabled_ui(whole.is_some(), |ui| {
                button(ui, &page.words.next, vec2(200.0, 48.0))
            })
            .inner
        })
        .inner;
    whole
        .filter(|_| next.clicked())
        .map(|event| (event, device(&next)))
}
