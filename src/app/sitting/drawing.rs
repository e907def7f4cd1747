//! What stands on the screen, and what the keys mean on it.

use std::rc::Rc;

use eframe::egui::{Context, Ui};

use super::Sitting;
use crate::app::participant::{
    Given, Page, closing, comparison, consent, form, grey, image, instructions, pair_menu, pause,
    question, ranking, rating, saving, trouble,
};
use crate::app::stimulus_view;
use crate::protocol::Pause;
use crate::record::InputDevice;
use crate::session::{Event, Screen};

/// What is chosen or typed on the screen that stands, before it is an answer.
#[derive(Debug, Default)]
pub struct Draft {
    form: form::Draft,
    rating: rating::Draft,
    ranking: ranking::Draft,
    /// Serial of the screen it belongs to.
    screen: u64,
}

impl Sitting {
    pub(super) fn keys(&mut self, ctx: &Context) -> Option<Given> {
        let protocol = Rc::clone(&self.protocol);
        let (keys, cannot_tell) = (&protocol.keys, protocol.cannot_tell);
        self.fresh_draft();
        match *self.session.screen() {
            Screen::Image { .. } => ctx.input(|input| image::input(input, keys)),
            Screen::Question { .. } | Screen::Comparison { .. } => {
                ctx.input(|input| question::input(input, keys, cannot_tell))
            }
            Screen::Rating { .. } => {
                let draft = &mut self.draft.rating;
                ctx.input(|input| rating::input(input, keys.go_on, &protocol.scales, draft))
            }
            Screen::Ranking { trial } => {
                let count = self.session.plan().trials[trial].places.len();
                let draft = &mut self.draft.ranking;
                ctx.input(|input| ranking::input(input, keys.go_on, count, draft))
            }
            _ => None,
        }
    }

    /// A screen begins with nothing filled in.
    fn fresh_draft(&mut self) {
        let serial = self.session.screen_serial();
        if self.draft.screen != serial {
            self.draft = Draft {
                screen: serial,
                ..Draft::default()
            };
        }
    }

    /// Decodes the next trial's images while a page stands before it.
    pub(super) fn prepare_pictures(&mut self, ctx: &Context) {
        match *self.session.screen() {
            Screen::Instructions
            | Screen::Pause(_)
            | Screen::PairMenu { .. }
            | Screen::Ready { .. }
            | Screen::Grey { .. } => {
                let next = self.session.stored();
                if next < self.session.plan().trials.len() {
                    self.pictures.prepare(ctx, next);
                }
            }
            Screen::Closing | Screen::Declined | Screen::Aborted => self.pictures.release(),
            _ => {}
        }
    }

    pub(super) fn draw(&mut self, ui: &mut Ui) -> Option<Given> {
        self.fresh_draft();
        let (protocol, words) = (Rc::clone(&self.protocol), Rc::clone(&self.words));
        let page = Page {
            look: self.look,
            words: &words,
        };
        let cannot_tell = protocol.cannot_tell;
        match self.session.screen().clone() {
            Screen::Consent => consent::show(ui, page),
            Screen::Form => form::show(ui, page, &protocol.metadata, &mut self.draft.form),
            Screen::Instructions => instructions::show(ui, page),
            Screen::Pause(which) => {
                let text = match which {
                    Pause::PracticeOver => &words.practice_over,
                    Pause::Break => &words.pause,
                };
                pause::show(ui, page, text, Event::Begin)
            }
            Screen::PairMenu { next, total } => pair_menu::show(ui, page, next, total),
            Screen::Ready { next, total } => pause::show(
                ui,
                page,
                &words.ready_for(next, total),
                Event::StartPair(next),
            ),
            Screen::Question { .. } => question::show(ui, page, &protocol.keys, cannot_tell),
            Screen::Rating { .. } => {
                rating::show(ui, page, &protocol.scales, &mut self.draft.rating)
            }
            Screen::Saving => {
                saving::show(ui, page);
                None
            }
            Screen::StorageTrouble { detail } => {
                trouble::show(ui, page, &detail).then_some((Event::RetryStore, InputDevice::Mouse))
            }
            Screen::Closing => self.last_page(ui, page, &words.closing),
            Screen::Declined => self.last_page(ui, page, &words.declined),
            Screen::Aborted => self.last_page(ui, page, &words.aborted),
            Screen::Image { .. }
            | Screen::Grey { .. }
            | Screen::Comparison { .. }
            | Screen::Ranking { .. } => self.draw_stimulus_or_trouble(ui, page),
        }
    }

    fn last_page(&mut self, ui: &mut Ui, page: Page<'_>, text: &str) -> Option<Given> {
        self.left |= closing::show(ui, page, text);
        None
    }

    fn draw_stimulus_or_trouble(&mut self, ui: &mut Ui, page: Page<'_>) -> Option<Given> {
        match self.draw_stimulus(ui, page) {
            Ok(given) => given,
            Err(detail) => {
                if trouble::show(ui, page, &detail) {
                    self.pictures.retry(ui.ctx());
                    ui.ctx().request_repaint();
                }
                self.obstacle = Some(detail);
                None
            }
        }
    }

    /// Draws images or the grey; the error is for the experimenter.
    fn draw_stimulus(&mut self, ui: &mut Ui, page: Page<'_>) -> Result<Option<Given>, String> {
        let (ctx, surround) = (ui.ctx().clone(), self.surround());
        match *self.session.screen() {
            Screen::Image { trial, place } => {
                let textures = self.pictures.textures(&ctx, trial)?;
                let texture = textures.get(place).ok_or("the trial has no such image")?;
                image::show(&ctx, texture, surround).map_err(|error| error.to_string())?;
                Ok(None)
            }
            Screen::Comparison { trial } => {
                let textures = self.pictures.textures(&ctx, trial)?;
                let [left, right, reference] = textures else {
                    return Err("the trial needs two images and a reference".to_owned());
                };
                let surface = stimulus_view::surface_px(&ctx);
                let scale = ctx.pixels_per_point();
                let arranged = comparison::arrange(surface, self.image_px, scale)
                    .map_err(|error| error.to_string())?;
                let pictures: Vec<_> = [left, reference, right]
                    .into_iter()
                    .zip(arranged.corners.iter().copied())
                    .collect();
                stimulus_view::paint_pictures(&ctx, &pictures, page.look.level);
                let keys = self.protocol.keys;
                let cannot_tell = self.protocol.cannot_tell;
                Ok(comparison::show(ui, page, &keys, cannot_tell, &arranged))
            }
            Screen::Ranking { trial } => {
                let textures = self.pictures.textures(&ctx, trial)?;
                let surface = stimulus_view::surface_px(&ctx);
                let scale = ctx.pixels_per_point();
                let arranged = ranking::arrange(surface, self.image_px, textures.len(), scale)
                    .map_err(|error| error.to_string())?;
                let corners = arranged.corners.iter().copied();
                let pictures: Vec<_> = textures.iter().zip(corners).collect();
                stimulus_view::paint_pictures(&ctx, &pictures, page.look.level);
                Ok(ranking::show(ui, page, &arranged, &mut self.draft.ranking))
            }
            _ => {
                let level = self.look.level;
                grey::show(&ctx, self.image_px, level, surround)
                    .map_err(|error| error.to_string())?;
                Ok(None)
            }
        }
    }
}
