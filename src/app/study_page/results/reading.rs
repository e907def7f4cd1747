//! A results folder analysed, beside the interface.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use image::RgbaImage;

use crate::analysis::input::{self, Options};
use crate::analysis::{Analysis, Settings, analyse};
use crate::record::DATA_FOLDER;
use crate::report::document::{Block, Part, document};
use crate::report::{self, raster};
use crate::stimulus::files;

/// The report, its figures as pixels.
pub struct Report {
    /// Its parts in order.
    pub parts: Vec<(String, Vec<Piece>)>,
}

/// One thing in a part.
pub enum Piece {
    /// A figure and what is to be read under it.
    Figure(RgbaImage, String),
    /// Anything else.
    Plain(Block),
}

/// What tells that there are new answers: names, sizes and times of the data files, and of the
/// decisions on participants.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fingerprint(Vec<(PathBuf, u64, Option<SystemTime>)>);

impl Fingerprint {
    /// Of a results folder; a folder that cannot be listed has nothing in it.
    pub fn of(results: &Path) -> Self {
        let folders = [results.join(DATA_FOLDER), results.join("slots")];
        let entries = folders
            .iter()
            .filter_map(|folder| std::fs::read_dir(folder).ok())
            .flatten()
            .flatten();
        let mut found: Vec<_> = entries
            .filter_map(|entry| {
                let facts = entry.metadata().ok()?;
                Some((entry.path(), facts.len(), facts.modified().ok()))
            })
            .collect();
        found.sort();
        Self(found)
    }
}

impl Report {
    /// Reads and analyses a results folder; figures get so many pixels a point of the screen.
    ///
    /// # Errors
    /// Why there is nothing to show, in words.
    pub fn read(results: &Path, pixels_per_point: f32) -> Result<Self, String> {
        let analysis = analysed(results)?;
        let parts = document(&analysis).parts.into_iter();
        let parts = parts.map(|Part { title, blocks }| {
            let pieces = blocks
                .into_iter()
                .map(|block| piece(block, pixels_per_point));
            Ok((title, pieces.collect::<Result<_, String>>()?))
        });
        Ok(Self {
            parts: parts.collect::<Result<_, String>>()?,
        })
    }
}

fn piece(block: Block, pixels_per_point: f32) -> Result<Piece, String> {
    let Block::Figure(drawing) = block else {
        return Ok(Piece::Plain(block));
    };
    let caption = drawing.caption.clone();
    let picture = raster::pixels(&drawing.in_page(), pixels_per_point);
    let picture = picture.map_err(|error| error.to_string())?;
    Ok(Piece::Figure(picture, caption))
}

fn analysed(results: &Path) -> Result<Analysis, String> {
    let data = input::read(&[results.to_owned()], Options::default());
    let data = data.map_err(|error| error.to_string())?;
    let settings = Settings::declared(&data);
    Ok(analyse(data, settings))
}

/// Where the report of a results folder is saved: beside it, named like it.
pub fn report_folder(results: &Path) -> PathBuf {
    let name = results.file_name().unwrap_or_default().to_string_lossy();
    results.with_file_name(format!("{name}-report"))
}

/// Writes the report as files; how many.
///
/// # Errors
/// What went wrong, in words.
pub fn save(results: &Path, folder: &Path) -> Result<usize, String> {
    let analysis = analysed(results)?;
    let report = report::files(&analysis).map_err(|error| error.to_string())?;
    let report = report.into_iter().map(|file| (file.path, file.bytes));
    files::write_all(folder, report).map_err(|error| error.to_string())
}
