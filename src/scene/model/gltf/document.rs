//! The JSON of a file, and where its binary chunk lies.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use gltf::json;
use gltf::json::Index;

use super::super::error::Fault;
use super::super::report::Warnings;
use super::super::uri::{self, Reference};
use super::buffers::Buffers;

/// Extensions that are read as their authors mean them.
const KNOWN_EXTENSIONS: [&str; 5] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Chunk types of a `.glb`, as little-endian numbers.
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BIN_CHUNK: u32 = 0x004e_4942;

/// Longest JSON that is parsed. A `.gltf` may carry its buffers in it.
const LONGEST_JSON_BYTES: u64 = 1 << 30;

/// A parsed file.
pub(super) struct Document {
    pub root: json::Root,
    pub buffers: Buffers,
    pub folder: PathBuf,
}

impl Document {
    pub fn open(path: &Path, most_objects: u64) -> Result<Self, Fault> {
        let unreadable = |error| Fault::unreadable("", &error);
        let mut file = File::open(path).map_err(unreadable)?;
        let length = file.metadata().map_err(unreadable)?.len();
        let mut magic = [0_u8; 4];
        file.read_exact(&mut magic).map_err(unreadable)?;
        let (json, binary) = if &magic == b"glTF" {
            let chunks = Chunks::find(&mut file, length)?;
            let json = read_text(&mut file, chunks.json)?;
            (json, chunks.binary.map(|chunk| (file, chunk)))
        } else {
            (read_text(&mut file, (0, length))?, None)
        };
        let objects = json.iter().filter(|&&byte| byte == b'{').count() as u64;
        if objects > most_objects {
            return Err(Fault::whole(format!(
                "its JSON has {objects} objects; allowed are {most_objects}: join its nodes and \
                 meshes in the program it was made with"
            )));
        }
        let mut root: json::Root = json::deserialize::from_slice(&json)
            .map_err(|error| Fault::new("JSON", format!("{error}; is this a glTF 2.0 file?")))?;
        drop(json);
        if !root.asset.version.starts_with("2.") {
            let message = format!("found \"{}\", allowed is 2.0", root.asset.version);
            return Err(Fault::new("asset.version", message));
        }
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let buffers = Buffers::open(&mut root, binary, &folder)?;
        Ok(Self {
            root,
            buffers,
            folder,
        })
    }

    /// A required extension that is not known is an error; one that is merely used is
    /// a warning.
    pub fn check_extensions(&self, warnings: &mut Warnings) -> Result<(), Fault> {
        let unknown = |name: &&String| !KNOWN_EXTENSIONS.contains(&name.as_str());
        let mut required = self.root.extensions_required.iter().enumerate();
        if let Some((index, name)) = required.find(|(_, name)| unknown(name)) {
            return Err(Fault::new(
                format!("extensionsRequired[{index}]"),
                format!(
                    "found {name}, which cannot be read; allowed are {}. Export the model \
                     without it (compressed geometry or textures: decompress them)",
                    KNOWN_EXTENSIONS.join(", ")
                ),
            ));
        }
        for name in self.root.extensions_used.iter().filter(unknown) {
            warnings.say(format!("{name} is used by the file and ignored"));
        }
        Ok(())
    }

    /// The files the document refers to.
    pub fn files(&self) -> Result<Vec<PathBuf>, Fault> {
        let mut files = self.buffers.files();
        for (index, image) in self.root.images.iter().enumerate() {
            if let Some(uri) = &image.uri
                && let Reference::File(path) =
                    uri::resolve(&self.folder, uri, &format!("images[{index}].uri"))?
                && !files.contains(&path)
            {
                files.push(path);
            }
        }
        Ok(files)
    }
}

/// An item of one of the document's lists.
///
/// `place` is where the index stands and `list` the list's name.
pub(super) fn look_up<'a, T>(
    items: &'a [T],
    index: Index<T>,
    list: &str,
    place: &str,
) -> Result<&'a T, Fault> {
    items.get(index.value()).ok_or_else(|| {
        let (index, count) = (index.value(), items.len());
        Fault::new(
            place,
            format!("found {list} {index}, but the file has {count}"),
        )
    })
}

/// Where the chunks of a `.glb` lie: first byte and length.
struct Chunks {
    json: (u64, u64),
    binary: Option<(u64, u64)>,
}

impl Chunks {
    /// Reads the headers of a `.glb` whose magic is known, `length` bytes long.
    fn find(file: &mut File, length: u64) -> Result<Self, Fault> {
        let version = read_u32(file, 4)?;
        if version != 2 {
            let message = format!("found glTF version {version}, allowed is 2");
            return Err(Fault::new("header", message));
        }
        let declared = u64::from(read_u32(file, 8)?);
        if declared > length {
            return Err(Fault::new(
                "header",
                format!(
                    "says the file has {declared} bytes, it has {length}; copy or export it again"
                ),
            ));
        }
        let (kind, json) = chunk(file, 12, declared)?;
        if kind != JSON_CHUNK {
            return Err(Fault::new("chunk 0", "is not JSON; export the file again"));
        }
        let after = json.0 + json.1;
        if after + 8 > declared {
            return Ok(Self { json, binary: None });
        }
        let (kind, binary) = chunk(file, after, declared)?;
        Ok(Self {
            json,
            binary: (kind == BIN_CHUNK).then_some(binary),
        })
    }
}

fn chunk(file: &mut File, at: u64, end: u64) -> Result<(u32, (u64, u64)), Fault> {
    let length = u64::from(read_u32(file, at)?);
    let kind = read_u32(file, at + 4)?;
    let left = end.saturating_sub(at + 8);
    if length > left {
        let message = format!(
            "says it has {length} bytes, the file has {left} left; copy or export it again"
        );
        return Err(Fault::new(format!("chunk at byte {at}"), message));
    }
    Ok((kind, (at + 8, length)))
}

fn read_u32(file: &mut File, at: u64) -> Result<u32, Fault> {
    let mut bytes = [0_u8; 4];
    file.seek(SeekFrom::Start(at))
        .and_then(|_| file.read_exact(&mut bytes))
        .map_err(|error| Fault::unreadable("header", &error))?;
    Ok(u32::from_le_bytes(bytes))
}

/// Reads (first byte, length), which lie within the file.
fn read_text(file: &mut File, (at, length): (u64, u64)) -> Result<Vec<u8>, Fault> {
    if length > LONGEST_JSON_BYTES {
        let message =
            format!("has {length} bytes; allowed are {LONGEST_JSON_BYTES}: save the model as .glb");
        return Err(Fault::new("JSON", message));
    }
    let mut text = vec![0_u8; length as usize];
    file.seek(SeekFrom::Start(at))
        .and_then(|_| file.read_exact(&mut text))
        .map_err(|error| Fault::unreadable("JSON", &error))?;
    Ok(text)
}
