//! Small file operations that keep what they promise after a crash.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::RecordError;

/// Creates a file with its whole content, synced, or leaves no file of that name:
/// no other process ever sees a part of it, and of two that try, one succeeds.
///
/// Returns false if the file is there already; it is left as it is.
///
/// # Errors
/// [`RecordError::Io`] naming the file.
pub fn create_whole(path: &Path, content: &[u8]) -> Result<bool, RecordError> {
    create_whole_open(path, content, |_| ()).map(|file| file.is_some())
}

/// The same, and the file stays open for reading and appending; `None` if it is there
/// already. `prepare` sees it before anybody else can: a lock taken there is taken
/// when the name appears.
///
/// # Errors
/// [`RecordError::Io`] naming the file.
pub fn create_whole_open(
    path: &Path,
    content: &[u8],
    prepare: impl Fn(&File),
) -> Result<Option<File>, RecordError> {
    let (draft, file) = draft_beside(path)?;
    prepare(&file);
    let written = write_synced(&file, content).map_err(RecordError::io(&draft, "write"));
    let published = written.and_then(|()| publish((&draft, file), path, content, prepare));
    // The draft's name has served; should this fail, a dot file stays, which nobody reads.
    let _ = fs::remove_file(&draft);
    let created = published?;
    sync_folder(path)?;
    Ok(created)
}

fn write_synced(mut file: &File, content: &[u8]) -> io::Result<()> {
    file.write_all(content)?;
    file.sync_all()
}

fn open_new(path: &Path) -> io::Result<File> {
    OpenOptions::new()
        .read(true)
        .append(true)
        .create_new(true)
        .open(path)
}

/// A new file beside `path` that no reader takes for data.
fn draft_beside(path: &Path) -> Result<(PathBuf, File), RecordError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let process = std::process::id();
    let mut attempt = 0_u32;
    loop {
        let draft = path.with_file_name(format!(".{name}.{process}-{attempt}.draft"));
        match open_new(&draft) {
            Ok(file) => return Ok((draft, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && attempt < 1000 => {
                attempt += 1;
            }
            Err(error) => return Err(RecordError::io(&draft, "create")(error)),
        }
    }
}

/// Gives the draft its name, unless the name is taken.
fn publish(
    (draft, file): (&Path, File),
    path: &Path,
    content: &[u8],
    prepare: impl Fn(&File),
) -> Result<Option<File>, RecordError> {
    match fs::hard_link(draft, path) {
        Ok(()) => Ok(Some(file)),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(None),
        // Some shared folders know no hard links; there the name is still given out
        // once only, but a crash may leave the file empty.
        Err(_) => create_plainly(path, content, prepare),
    }
}

fn create_plainly(
    path: &Path,
    content: &[u8],
    prepare: impl Fn(&File),
) -> Result<Option<File>, RecordError> {
    match open_new(path) {
        Ok(file) => {
            prepare(&file);
            write_synced(&file, content).map_err(RecordError::io(path, "write"))?;
            Ok(Some(file))
        }
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(None),
        Err(error) => Err(RecordError::io(path, "create")(error)),
    }
}

/// Syncs the folder a file stands in, so that its name outlives a crash too.
fn sync_folder(path: &Path) -> Result<(), RecordError> {
    // Windows has no way to sync a folder and needs none.
    if cfg!(unix) {
        let folder = path.parent().unwrap_or_else(|| Path::new("."));
        File::open(folder)
            .and_then(|folder| folder.sync_all())
            .map_err(RecordError::io(folder, "sync"))?;
    }
    Ok(())
}

/// Makes a folder and those above it.
///
/// # Errors
/// [`RecordError::Io`] naming the folder.
pub fn create_folder(path: &Path) -> Result<(), RecordError> {
    fs::create_dir_all(path).map_err(RecordError::io(path, "create the folder"))
}

/// Shows every name of a folder's files, in no order and without a copy of all: a
/// folder of slots is listed at every event.
///
/// # Errors
/// [`RecordError::Io`] naming the folder.
pub fn each_name(folder: &Path, mut look: impl FnMut(&str)) -> Result<(), RecordError> {
    let failed = || RecordError::io(folder, "list");
    for entry in fs::read_dir(folder).map_err(failed())? {
        look(&entry.map_err(failed())?.file_name().to_string_lossy());
    }
    Ok(())
}

/// Names of a folder's files, sorted.
///
/// # Errors
/// [`RecordError::Io`] naming the folder.
pub fn names(folder: &Path) -> Result<Vec<String>, RecordError> {
    let mut names = Vec::new();
    each_name(folder, |name| names.push(name.to_owned()))?;
    names.sort_unstable();
    Ok(names)
}

/// A file's bytes.
///
/// # Errors
/// [`RecordError::Io`] naming the file.
pub fn read(path: &Path) -> Result<Vec<u8>, RecordError> {
    fs::read(path).map_err(RecordError::io(path, "read"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_given_out_once_and_with_its_whole_content() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("slot");
        let wins: Vec<bool> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..8)
                .map(|n| {
                    let path = &path;
                    scope.spawn(move || create_whole(path, format!("{n}").as_bytes()).unwrap())
                })
                .collect();
            threads.into_iter().map(|t| t.join().unwrap()).collect()
        });
        assert_eq!(wins.iter().filter(|&&won| won).count(), 1);
        let winner = wins.iter().position(|&won| won).unwrap();
        assert_eq!(read(&path).unwrap(), winner.to_string().as_bytes());
        assert_eq!(names(folder.path()).unwrap(), ["slot"], "drafts are gone");
    }

    #[test]
    fn a_missing_folder_is_named() {
        let message = create_whole(Path::new("no/such/folder/x"), b"")
            .unwrap_err()
            .to_string();
        assert!(message.contains("no/such/folder"), "{message}");
    }
}
