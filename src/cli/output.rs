//! Writing a result: to standard output, or to a file that is there whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use anyhow::Context;

/// Writes `bytes` to a file, or to standard output where none is named.
///
/// # Errors
/// What the disk said, with the file's name. A reader that closes the pipe early is no error.
pub fn write(file: Option<&Path>, bytes: &[u8]) -> anyhow::Result<()> {
    match file {
        Some(path) => write_whole(path, bytes)
            .with_context(|| format!("{}: cannot be written", path.display())),
        None => match io::stdout().lock().write_all(bytes) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            other => other.context("standard output cannot be written"),
        },
    }
}

/// Writes beside the file, then takes its name: a full disk leaves the old file as it was.
fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let name = path
        .file_name()
        .ok_or_else(|| io::Error::new(ErrorKind::InvalidInput, "this is not the name of a file"))?;
    let mut part_name = OsString::from(".");
    part_name.push(name);
    part_name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(part_name);
    let written = File::create(&part)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&part, path));
    if written.is_err() {
        // Best effort: the first error is the one to report.
        let _ = fs::remove_file(&part);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_folder_as_it_was() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("report.html");
        write(Some(&path), b"old").unwrap();
        write(Some(&path), b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        // A folder in the place of the file cannot be replaced by it.
        let taken = dir.path().join("taken");
        fs::create_dir(&taken).unwrap();
        fs::write(taken.join("x"), b"").unwrap();
        let message = format!("{:#}", write(Some(&taken), b"new").unwrap_err());
        assert!(message.contains("taken"), "{message}");
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 2);
    }
}
