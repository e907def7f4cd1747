//! The header of a PLY file: what stands after it.

use std::io::{BufRead, Read};

use super::super::error::Fault;

/// Longest line of a header.
const LONGEST_LINE: u64 = 4096;
/// Most lines of a header.
const MOST_LINES: usize = 10_000;

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes in a binary file.
    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The largest whole number it holds; `None` for real numbers.
    pub fn largest(self) -> Option<f32> {
        match self {
            Self::I8 => Some(127.0),
            Self::U8 => Some(255.0),
            Self::I16 => Some(32_767.0),
            Self::U16 => Some(65_535.0),
            Self::I32 => Some(i32::MAX as f32),
            Self::U32 => Some(u32::MAX as f32),
            Self::F32 | Self::F64 => None,
        }
    }
}

/// One property of an element.
#[derive(Debug, Clone)]
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
    /// The type of a list's length; `None` for a single number.
    pub list: Option<Kind>,
}

/// A table of the file.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

impl Element {
    /// Bytes that one row takes at least; 0 for a row without properties.
    pub fn least_bytes(&self, encoding: Encoding) -> u64 {
        let one = |property: &Property| match encoding {
            // A digit and what parts it from the next.
            Encoding::Ascii => 2,
            _ => property.list.unwrap_or(property.kind).bytes() as u64,
        };
        self.properties.iter().map(one).sum::<u64>()
    }
}

/// What the header says.
#[derive(Debug, Clone)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Its lines.
    pub lines: usize,
}

impl Header {
    pub fn read(reader: &mut impl BufRead) -> Result<Self, Fault> {
        if line(reader, 1)? != "ply" {
            return Err(Fault::new("line 1", "is not \"ply\"; this is no PLY file"));
        }
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        for number in 2..MOST_LINES {
            let line = line(reader, number)?;
            let wrong = |message: String| Err(Fault::new(format!("line {number}"), message));
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            match words.as_slice() {
                ["end_header"] => {
                    return match encoding {
                        Some(encoding) => Ok(Self {
                            encoding,
                            elements,
                            lines: number,
                        }),
                        None => wrong(String::from("the header has no format")),
                    };
                }
                ["comment" | "obj_info", ..] | [] => {}
                ["format", name, "1.0"] => {
                    encoding = match *name {
                        "ascii" => Some(Encoding::Ascii),
                        "binary_little_endian" => Some(Encoding::LittleEndian),
                        "binary_big_endian" => Some(Encoding::BigEndian),
                        other => {
                            return wrong(format!(
                                "found the format {other}; allowed are ascii, binary_little_endian and binary_big_endian"
                            ));
                        }
                    };
                }
                ["element", name, count] => match count.parse() {
                    Ok(count) => elements.push(Element {
                        name: (*name).to_owned(),
                        count,
                        properties: Vec::new(),
                    }),
                    Err(_) => {
                        return wrong(format!("found the count {count}; a whole number is needed"));
                    }
                },
                ["property", rest @ ..] => {
                    let (Some(property), Some(element)) = (property(rest), elements.last_mut())
                    else {
                        return wrong(format!("\"{line}\" is no property of an element"));
                    };
                    element.properties.push(property);
                }
                _ => return wrong(format!("\"{line}\" is not understood")),
            }
        }
        Err(Fault::new("header", "does not end; this is no PLY file"))
    }
}

fn property(words: &[&str]) -> Option<Property> {
    let (list, kind, name) = match words {
        ["list", length, kind, name] => (Some(Kind::parse(length)?), kind, name),
        [kind, name] => (None, kind, name),
        _ => return None,
    };
    Some(Property {
        name: (*name).to_owned(),
        kind: Kind::parse(kind)?,
        list,
    })
}

fn line(reader: &mut impl BufRead, number: usize) -> Result<String, Fault> {
    let place = || format!("line {number}");
    let mut bytes = Vec::new();
    reader
        .by_ref()
        .take(LONGEST_LINE)
        .read_until(b'\n', &mut bytes)
        .map_err(|error| Fault::unreadable(place(), &error))?;
    if bytes.last() != Some(&b'\n') {
        let message = "the header ends too early; this is no PLY file, or it was cut off";
        return Err(Fault::new(place(), message));
    }
    Ok(String::from_utf8_lossy(&bytes).trim().to_owned())
}
