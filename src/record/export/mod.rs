//! Results in the layouts of other tools. One file a format, one line in [`FORMATS`].
//!
//! An export is made beside its place and renamed, so that under the final name there
//! is a whole one or nothing.

mod bids;
mod csv;
mod material;
mod psych_ds;
mod pwcmp;
#[cfg(test)]
mod tests;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use material::{Material, Selection};

use super::{RecordError, files};

/// A layout that results can be exported to.
#[derive(Debug)]
pub struct Format {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, in one sentence.
    pub summary: &'static str,
    /// Writes the files.
    write: fn(&Material, &mut Draft) -> Result<(), RecordError>,
}

/// Every format there is.
pub const FORMATS: &[&Format] = &[&psych_ds::PSYCH_DS, &bids::BIDS, &pwcmp::PWCMP, &csv::CSV];

/// What an export did.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exported {
    /// Files written, relative to the folder.
    pub files: Vec<PathBuf>,
    /// Rows of the results folder that are in it.
    pub rows: usize,
    /// What was left out, and other things to know.
    pub notes: Vec<String>,
}

/// Exports a results folder to `out`, which must not be there or be empty.
///
/// # Errors
/// [`RecordError`]; there is nothing under the name `out` then that was not there before.
pub fn export(
    results: &Path,
    format: &Format,
    selection: Selection,
    out: &Path,
) -> Result<Exported, RecordError> {
    refuse_taken(out)?;
    let material = Material::read(results, selection)?;
    let mut draft = Draft::new(out)?;
    draft.rows = material.rows().count();
    draft.notes.extend(material.notes.iter().cloned());
    (format.write)(&material, &mut draft)?;
    draft.publish(out)
}

/// A folder with something in it is somebody's.
fn refuse_taken(out: &Path) -> Result<(), RecordError> {
    let taken = match fs::read_dir(out) {
        Ok(mut entries) => entries.next().is_some(),
        Err(error) if error.kind() == io::ErrorKind::NotFound => false,
        Err(error) => return Err(RecordError::io(out, "use as a folder")(error)),
    };
    if taken {
        return Err(RecordError::ExportTaken {
            path: out.to_owned(),
        });
    }
    Ok(())
}

/// An export while it is made; removed unless it is published.
#[derive(Debug)]
struct Draft {
    folder: PathBuf,
    files: Vec<PathBuf>,
    rows: usize,
    notes: Vec<String>,
}

impl Draft {
    fn new(out: &Path) -> Result<Self, RecordError> {
        let name = out.file_name().ok_or_else(|| {
            let message = "an export needs a folder with a name";
            RecordError::io(out, "create the folder")(io::Error::other(message))
        })?;
        let name = format!(".{}.{}.draft", name.to_string_lossy(), std::process::id());
        let folder = out.with_file_name(name);
        files::create_folder(&folder)?;
        Ok(Self {
            folder,
            files: Vec::new(),
            rows: 0,
            notes: Vec::new(),
        })
    }

    /// Writes one file of the export, whole and synced.
    fn file(&mut self, name: impl Into<PathBuf>, content: &[u8]) -> Result<(), RecordError> {
        let name = name.into();
        let path = self.folder.join(&name);
        if let Some(parent) = path.parent() {
            files::create_folder(parent)?;
        }
        files::create_whole(&path, content)?;
        self.files.push(name);
        Ok(())
    }

    /// Says something to the person who exports.
    fn note(&mut self, note: impl Into<String>) {
        self.notes.push(note.into());
    }

    fn publish(mut self, out: &Path) -> Result<Exported, RecordError> {
        // An empty folder of that name gives way; not every system renames over one.
        match fs::remove_dir(out) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(RecordError::io(out, "replace the empty folder")(error));
            }
            _ => {}
        }
        fs::rename(&self.folder, out).map_err(RecordError::io(out, "create the folder"))?;
        self.files.sort();
        Ok(Exported {
            files: std::mem::take(&mut self.files),
            rows: self.rows,
            notes: std::mem::take(&mut self.notes),
        })
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // Gone already where it was published.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// Letters and digits of a text, for labels that may hold nothing else.
fn alphanumeric(text: &str) -> String {
    let plain: String = text.chars().filter(char::is_ascii_alphanumeric).collect();
    if plain.is_empty() {
        String::from("study")
    } else {
        plain
    }
}

/// Any value as indented JSON with a line break at its end.
fn json(value: &serde_json::Value) -> Vec<u8> {
    format!("{value:#}\n").into_bytes()
}
