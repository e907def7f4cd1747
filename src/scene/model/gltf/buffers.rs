//! Binary data, read where it lies and when it is asked for.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use gltf::json;

use super::super::check_is_file;
use super::super::error::Fault;
use super::super::uri::{self, Reference};
use super::document::look_up;

/// The document's buffers. Only those inside the JSON are in memory.
pub(super) struct Buffers {
    buffers: Vec<Buffer>,
}

struct Buffer {
    source: Source,
    length: u64,
}

enum Source {
    /// From `start` on.
    File {
        file: File,
        start: u64,
        beside: Option<PathBuf>,
    },
    Memory(Vec<u8>),
}

impl Buffers {
    /// Opens the buffers; `binary` is a `.glb`'s file and where its binary chunk lies.
    /// Data URIs are moved out of `root`.
    pub fn open(
        root: &mut json::Root,
        mut binary: Option<(File, (u64, u64))>,
        folder: &Path,
    ) -> Result<Self, Fault> {
        let buffers = root
            .buffers
            .iter_mut()
            .enumerate()
            .map(|(index, json)| {
                let place = format!("buffers[{index}]");
                let (source, available) = match json.uri.take() {
                    Some(text) => open_uri(&text, folder, &place)?,
                    None => {
                        let (file, (start, length)) = binary.take().ok_or_else(|| {
                            let message = "has no `uri`, and the file has no binary chunk for it; \
                                           export the model again";
                            Fault::new(&place, message)
                        })?;
                        let beside = None;
                        let source = Source::File {
                            file,
                            start,
                            beside,
                        };
                        (source, length)
                    }
                };
                let length = json.byte_length.0;
                if length > available {
                    let message = format!(
                        "byteLength is {length}, but its data has {available} bytes; \
                         copy or export the model again"
                    );
                    return Err(Fault::new(place, message));
                }
                Ok(Buffer { source, length })
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { buffers })
    }

    /// The files the buffers are in, beside the model itself.
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files = Vec::new();
        for buffer in &self.buffers {
            if let Source::File {
                beside: Some(path), ..
            } = &buffer.source
                && !files.contains(path)
            {
                files.push(path.clone());
            }
        }
        files
    }

    /// Reads a region that [`Region::of_view`] has checked.
    pub fn read(&self, region: &Region, offset: u64, out: &mut [u8]) -> io::Result<()> {
        let at = region.start + offset;
        match &self.buffers[region.buffer].source {
            Source::File { file, start, .. } => {
                let mut file = file;
                file.seek(SeekFrom::Start(start + at))?;
                file.read_exact(out)
            }
            Source::Memory(bytes) => {
                let data = usize::try_from(at)
                    .ok()
                    .and_then(|at| bytes.get(at..)?.get(..out.len()));
                out.copy_from_slice(data.ok_or(io::ErrorKind::UnexpectedEof)?);
                Ok(())
            }
        }
    }
}

fn open_uri(text: &str, folder: &Path, place: &str) -> Result<(Source, u64), Fault> {
    let place = format!("{place}.uri");
    match uri::resolve(folder, text, &place)? {
        Reference::Data(data) => {
            let bytes = uri::decode(data, &place)?;
            let length = bytes.len() as u64;
            Ok((Source::Memory(bytes), length))
        }
        Reference::File(path) => {
            let at =
                |fault: Fault| Fault::new(&place, format!("{}: {}", path.display(), fault.message));
            check_is_file(&path).map_err(at)?;
            let unreadable = |error| at(Fault::unreadable("", &error));
            let file = File::open(&path).map_err(unreadable)?;
            let length = file.metadata().map_err(unreadable)?.len();
            let beside = Some(path.clone());
            let source = Source::File {
                file,
                start: 0,
                beside,
            };
            Ok((source, length))
        }
    }
}

/// A stretch of a buffer that is really there.
#[derive(Debug, Clone)]
pub(super) struct Region {
    buffer: usize,
    start: u64,
    /// Bytes.
    pub length: u64,
    /// Bytes from one element to the next, where the view says it.
    pub stride: Option<u64>,
}

impl Region {
    /// A buffer view.
    pub fn of_view(
        root: &json::Root,
        buffers: &Buffers,
        view: json::Index<json::buffer::View>,
        place: &str,
    ) -> Result<Self, Fault> {
        let index = view.value();
        let json = look_up(&root.buffer_views, view, "buffer view", place)?;
        let place = format!("bufferViews[{index}]");
        look_up(&root.buffers, json.buffer, "buffer", &place)?;
        let buffer = json.buffer.value();
        let (start, length) = (json.byte_offset.unwrap_or_default().0, json.byte_length.0);
        let available = buffers.buffers[buffer].length;
        if start.checked_add(length).is_none_or(|end| end > available) {
            let message = format!(
                "{length} bytes from byte {start} on are beyond buffer {buffer}, which has {available}"
            );
            return Err(Fault::new(place, message));
        }
        Ok(Self {
            buffer,
            start,
            length,
            // 0 is against the standard and common; it means "packed".
            stride: json.byte_stride.map(|s| s.0 as u64).filter(|&s| s > 0),
        })
    }

    /// All its bytes.
    pub fn bytes(&self, buffers: &Buffers, place: &str) -> Result<Vec<u8>, Fault> {
        let mut bytes = vec![0_u8; self.length as usize];
        buffers
            .read(self, 0, &mut bytes)
            .map_err(|error| Fault::unreadable(place, &error))?;
        Ok(bytes)
    }
}
