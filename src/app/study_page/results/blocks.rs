//! The report's blocks on the screen.

use eframe::egui::{
    CollapsingHeader, ColorImage, Context, Grid, Image, RichText, ScrollArea, TextStyle,
    TextureHandle, TextureOptions, Ui, vec2,
};

use super::reading::{Piece, Report};
use crate::app::theme;
use crate::report::document::{Block, TableBlock, Term};
use crate::report::number::{reasons, shown};

/// The report, ready to be drawn.
pub struct Shown {
    parts: Vec<(String, Vec<Face>)>,
}

enum Face {
    Figure(TextureHandle, String),
    Table(Rows),
    Plain(Block),
}

/// A table's cells as they are shown.
struct Rows {
    block: TableBlock,
    cells: Vec<Vec<String>>,
}

impl Shown {
    /// Puts the figures where the screen finds them.
    pub fn new(ctx: &Context, report: Report) -> Self {
        let face = |piece| match piece {
            Piece::Figure(picture, caption) => {
                let size = [picture.width() as usize, picture.height() as usize];
                let image = ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
                let texture = ctx.load_texture("figure", image, TextureOptions::LINEAR);
                Face::Figure(texture, caption)
            }
            Piece::Plain(Block::Table(block)) => {
                let cells = cells(&block);
                Face::Table(Rows { block, cells })
            }
            Piece::Plain(block) => Face::Plain(block),
        };
        let parts = report.parts.into_iter();
        Self {
            parts: parts
                .map(|(title, pieces)| (title, pieces.into_iter().map(face).collect()))
                .collect(),
        }
    }

    /// Draws the report, one card a part.
    pub fn ui(&mut self, ui: &mut Ui) {
        for (at, (title, faces)) in self.parts.iter().enumerate() {
            theme::card().show(ui, |ui| {
                ui.set_min_width(ui.available_width());
                ui.push_id(at, |ui| {
                    let title = if title.is_empty() { "Result" } else { title };
                    ui.label(RichText::new(title).size(22.0));
                    for (at, face) in faces.iter().enumerate() {
                        ui.push_id(at, |ui| face.ui(ui));
                    }
                });
            });
            ui.add_space(8.0);
        }
    }
}

fn cells(block: &TableBlock) -> Vec<Vec<String>> {
    let columns = &block.table.columns;
    let mut rows = Vec::new();
    for row in &block.table.rows {
        let cells = row.iter().zip(columns);
        rows.push(
            cells
                .map(|(cell, column)| shown(cell, column.style))
                .collect(),
        );
    }
    rows
}

impl Face {
    fn ui(&self, ui: &mut Ui) {
        match self {
            Self::Figure(texture, caption) => {
                // A drawing's unit is a point; one that is too wide is made smaller.
                let size = texture.size_vec2() / ui.ctx().pixels_per_point();
                let scale = (ui.available_width() / size.x).min(1.0);
                ui.add(Image::new(texture).fit_to_exact_size(size * scale));
                ui.label(theme::quiet(caption.clone()));
            }
            Self::Table(rows) if rows.block.folded => {
                CollapsingHeader::new(rows.block.caption.clone()).show(ui, |ui| grid(ui, rows));
            }
            Self::Table(rows) => {
                ui.label(theme::quiet(rows.block.caption.clone()));
                grid(ui, rows);
            }
            Self::Plain(block) => plain(ui, block),
        }
    }
}

fn grid(ui: &mut Ui, rows: &Rows) {
    let table = &rows.block.table;
    ScrollArea::horizontal().show(ui, |ui| {
        Grid::new("table")
            .striped(true)
            .spacing(vec2(18.0, 3.0))
            .show(ui, |ui| {
                for column in &table.columns {
                    ui.label(theme::quiet(column.title.to_string()));
                }
                ui.end_row();
                for (at, cells) in rows.cells.iter().enumerate() {
                    for cell in cells {
                        let text = RichText::new(cell).text_style(TextStyle::Small);
                        ui.label(match rows.block.is_strong(at) {
                            true => text.strong(),
                            false => text,
                        });
                    }
                    ui.end_row();
                }
            });
    });
    for reason in reasons(table) {
        ui.label(theme::quiet(format!("– {reason}")));
    }
}

fn plain(ui: &mut Ui, block: &Block) {
    match block {
        Block::Paragraph(text) => {
            ui.label(text);
        }
        Block::Note(text) => {
            ui.label(theme::quiet(text.clone()));
        }
        Block::Quote(paragraphs) => {
            for text in paragraphs {
                ui.label(text);
            }
            if ui.button("Copy").clicked() {
                ui.ctx().copy_text(paragraphs.join("\n\n"));
            }
        }
        Block::Terms(terms) => {
            CollapsingHeader::new("Formulas, sources, and where each holds")
                .show(ui, |ui| terms.iter().for_each(|one| term(ui, one)));
        }
        // Both have faces of their own.
        Block::Figure(_) | Block::Table(_) => {}
    }
}

fn term(ui: &mut Ui, term: &Term) {
    ui.label(RichText::new(term.name).strong());
    ui.label(term.formula);
    ui.label(theme::quiet(format!("{}. {}.", term.validity, term.source)));
}
