//! The files of an input, and places in them.

use std::path::{Path, PathBuf};

/// Number of a file, and a line from 1; line 0 is the file as a whole.
pub type Place = (u32, u32);

/// The files that rows came from. A file is of a study, whose protocol says what is left out, or of
/// none.
#[derive(Debug, Default)]
pub struct Files {
    paths: Vec<PathBuf>,
    origins: Vec<u32>,
}

impl Files {
    /// Announces the file that the next rows come from, and the number of what they are of.
    pub fn begin(&mut self, path: &Path, origin: u32) {
        self.paths.push(path.to_owned());
        self.origins.push(origin);
    }

    /// The file announced last.
    pub fn current(&self) -> &Path {
        self.paths.last().map_or(Path::new(""), PathBuf::as_path)
    }

    /// A line of the file announced last.
    pub fn here(&self, line: u64) -> Place {
        let file = u32::try_from(self.paths.len().saturating_sub(1)).unwrap_or(u32::MAX);
        (file, u32::try_from(line).unwrap_or(u32::MAX))
    }

    /// The file of a place.
    pub fn path(&self, (file, _): Place) -> &Path {
        &self.paths[file as usize]
    }

    /// What the file of a place is of.
    pub fn origin(&self, (file, _): Place) -> usize {
        self.origins[file as usize] as usize
    }

    /// Whether any file is of this origin.
    pub fn are_of(&self, origin: usize) -> bool {
        self.origins.iter().any(|&known| known as usize == origin)
    }

    /// `file:line`, or the file alone for line 0.
    pub fn shown(&self, place: Place) -> String {
        let path = self.path(place).display();
        match place.1 {
            0 => path.to_string(),
            line => format!("{path}:{line}"),
        }
    }
}
