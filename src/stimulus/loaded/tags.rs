//! What a file says of its colour space, as far as it says it outside an ICC profile.

use super::icc;

/// What a file says its numbers mean.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Tag {
    /// Nothing: sRGB by convention.
    Untagged,
    /// sRGB.
    Srgb,
    /// Linear light, primaries of Rec. 709.
    Linear,
    /// Something else, in words.
    Other(String),
}

/// Gamma of sRGB as PNG's `gAMA` writes it (1/2.2 · 100000), and how far off it may be.
const SRGB_GAMMA: u32 = 45_455;
const GAMMA_TOLERANCE: u32 = 500;
/// White, red, green, blue of sRGB as PNG's `cHRM` writes them (x and y · 100000).
const SRGB_CHROMATICITIES: [u32; 8] = [
    31_270, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000,
];
const CHROMATICITY_TOLERANCE: u32 = 200;

/// A JPEG's tag: its profile, if it has one.
pub fn of_profile(profile: Option<&[u8]>) -> Tag {
    match profile {
        None => Tag::Untagged,
        Some(profile) => match icc::describe_unless_srgb(profile) {
            None => Tag::Srgb,
            Some(what) => Tag::Other(what),
        },
    }
}

/// A PNG's tag, in the order of precedence of the PNG specification (third edition, 4.3):
/// `cICP`, `iCCP`, `sRGB`, `gAMA` with `cHRM`.
pub fn of_png(bytes: &[u8], profile: Option<&[u8]>) -> Tag {
    let chunks = Chunks {
        rest: bytes.get(8..).unwrap_or_default(),
    };
    let header: Vec<(&[u8], &[u8])> = chunks.take_while(|(name, _)| *name != b"IDAT").collect();
    let find = |wanted: &[u8]| {
        let found = header.iter().find(|(name, _)| *name == wanted);
        found.map(|(_, data)| *data)
    };
    if let Some(points) = find(b"cICP") {
        return of_code_points(points);
    }
    if find(b"iCCP").is_some() {
        return match profile {
            Some(_) => of_profile(profile),
            None => Tag::Other(String::from("its colour profile cannot be read")),
        };
    }
    if find(b"sRGB").is_some() {
        return Tag::Srgb;
    }
    let primaries = find(b"cHRM").map(u32s);
    if let Some(found) = &primaries
        && !near(found, &SRGB_CHROMATICITIES, CHROMATICITY_TOLERANCE)
    {
        return Tag::Other(String::from("its primaries (cHRM) are not those of sRGB"));
    }
    match find(b"gAMA").map(u32s) {
        None if primaries.is_none() => Tag::Untagged,
        None => Tag::Srgb,
        Some(gamma) if near(&gamma, &[SRGB_GAMMA], GAMMA_TOLERANCE) => Tag::Srgb,
        Some(gamma) if near(&gamma, &[100_000], GAMMA_TOLERANCE) => Tag::Linear,
        Some(gamma) => Tag::Other(format!(
            "its gamma (gAMA) is {:.3}, that of sRGB is 0.455",
            f64::from(gamma.first().copied().unwrap_or(0)) / 1e5
        )),
    }
}

/// ITU-T H.273 code points: primaries, transfer, matrix, full range.
fn of_code_points(points: &[u8]) -> Tag {
    match points {
        [1, 13, 0, 1] => Tag::Srgb,
        [1, 8, 0, 1] => Tag::Linear,
        _ => Tag::Other(format!(
            "its code points (cICP) are {points:?}, those of sRGB are [1, 13, 0, 1]"
        )),
    }
}

/// An OpenEXR file's tag: linear, unless it names other primaries than Rec. 709's, which are
/// the ones it has where it names none.
pub fn of_exr(bytes: &[u8]) -> Tag {
    const NAME: &[u8] = b"chromaticities\0chromaticities\0";
    // The attribute's size, then x and y of red, green, blue and white as floats.
    let header = &bytes[..bytes.len().min(1 << 16)];
    let found = header.windows(NAME.len()).position(|name| name == NAME);
    let Some(values) = found.and_then(|at| header.get(at + NAME.len() + 4..at + NAME.len() + 36))
    else {
        return Tag::Linear;
    };
    let rec709 = [0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290_f32];
    let is_near = values.chunks_exact(4).zip(rec709).all(|(bytes, expected)| {
        let value = f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        (value - expected).abs() < 2e-3
    });
    if is_near {
        Tag::Linear
    } else {
        Tag::Other(String::from(
            "its primaries (chromaticities) are not those of sRGB",
        ))
    }
}

/// The chunks of a PNG: name and data.
struct Chunks<'a> {
    rest: &'a [u8],
}

impl<'a> Iterator for Chunks<'a> {
    type Item = (&'a [u8], &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let (length, rest) = self.rest.split_first_chunk()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        let name = rest.get(..4)?;
        let data = rest.get(4..)?.get(..length)?;
        // Four bytes of checksum; the decoder checks it.
        self.rest = rest.get(8 + length..)?;
        Some((name, data))
    }
}

fn u32s(data: &[u8]) -> Vec<u32> {
    data.chunks_exact(4)
        .map(|b| u32::from_be_bytes([b[0], b[1], b[2], b[3]]))
        .collect()
}

fn near(found: &[u32], expected: &[u32], tolerance: u32) -> bool {
    found.len() == expected.len()
        && found
            .iter()
            .zip(expected)
            .all(|(found, expected)| found.abs_diff(*expected) <= tolerance)
}
