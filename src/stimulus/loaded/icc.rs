//! Whether an ICC profile (ICC.1:2010) is sRGB: by its numbers, since names can say anything.

use crate::scene::srgb;

/// Red, green and blue of sRGB, adapted to D50, as X Y Z.
const SRGB_COLOURS: [([u8; 4], [f64; 3]); 3] = [
    (*b"rXYZ", [0.4361, 0.2225, 0.0139]),
    (*b"gXYZ", [0.3851, 0.7169, 0.0971]),
    (*b"bXYZ", [0.1431, 0.0606, 0.7141]),
];
const COLOUR_TOLERANCE: f64 = 0.003;
/// Largest difference to sRGB's curve in linear light; a gamma of 2.2 is off by 0.0085.
const CURVE_TOLERANCE: f64 = 0.003;

/// What the profile is, in words, or `None` if it is sRGB (for greys: sRGB's curve).
pub fn describe_unless_srgb(profile: &[u8]) -> Option<String> {
    let profile = Profile { bytes: profile };
    let name = profile.name();
    let other = |why: &str| {
        let name = name.as_deref().unwrap_or("a profile without a name");
        Some(format!("its colour profile ({name}) is not sRGB: {why}"))
    };
    let curves: &[[u8; 4]] = match profile.bytes.get(16..20) {
        Some(b"RGB ") => &[*b"rTRC", *b"gTRC", *b"bTRC"],
        Some(b"GRAY") => &[*b"kTRC"],
        Some(space) => {
            let space = String::from_utf8_lossy(space);
            return other(&format!("it is for {}", space.trim()));
        }
        None => return other("it is cut short"),
    };
    if curves.len() == 3 {
        for (tag, expected) in SRGB_COLOURS {
            let found = profile.tag(tag).and_then(xyz);
            let near = |found: [f64; 3]| {
                let mut both = found.iter().zip(&expected);
                both.all(|(a, b)| (a - b).abs() < COLOUR_TOLERANCE)
            };
            if !found.is_some_and(near) {
                return other("its primaries differ");
            }
        }
    }
    let is_srgb = |tag: &[u8; 4]| {
        profile
            .tag(*tag)
            .and_then(Curve::parse)
            .is_some_and(|curve| curve.is_srgb())
    };
    if curves.iter().all(is_srgb) {
        None
    } else {
        other("its curve differs")
    }
}

struct Profile<'a> {
    bytes: &'a [u8],
}

impl<'a> Profile<'a> {
    fn tag(&self, wanted: [u8; 4]) -> Option<&'a [u8]> {
        let count = u32_at(self.bytes, 128)? as usize;
        let table = self.bytes.get(132..)?;
        let entry = table
            .chunks_exact(12)
            .take(count)
            .find(|entry| entry[..4] == wanted)?;
        let start = u32_at(entry, 4)? as usize;
        let length = u32_at(entry, 8)? as usize;
        self.bytes.get(start..start.checked_add(length)?)
    }

    /// The profile's own name: ASCII (version 2) or UTF-16 (version 4).
    fn name(&self) -> Option<String> {
        let tag = self.tag(*b"desc")?;
        let text = match tag.get(..4)? {
            b"desc" => {
                let length = u32_at(tag, 8)? as usize;
                String::from_utf8_lossy(tag.get(12..)?.get(..length)?).into_owned()
            }
            b"mluc" => {
                let (length, start) = (u32_at(tag, 20)? as usize, u32_at(tag, 24)? as usize);
                let units: Vec<u16> = tag
                    .get(start..start.checked_add(length)?)?
                    .chunks_exact(2)
                    .map(|unit| u16::from_be_bytes([unit[0], unit[1]]))
                    .collect();
                String::from_utf16_lossy(&units)
            }
            _ => return None,
        };
        let shown: String = text.chars().filter(|c| !c.is_control()).take(60).collect();
        (!shown.is_empty()).then_some(shown)
    }
}

fn xyz(tag: &[u8]) -> Option<[f64; 3]> {
    (tag.get(..4)? == b"XYZ ").then_some(())?;
    Some([fixed_at(tag, 8)?, fixed_at(tag, 12)?, fixed_at(tag, 16)?])
}

/// A tone reproduction curve: displayed value to linear light, 0 to 1.
enum Curve {
    Table(Vec<f64>),
    /// `para` of ICC.1:2010, 10.16, brought to the form with all seven parameters.
    Parametric([f64; 7]),
}

impl Curve {
    fn parse(tag: &[u8]) -> Option<Self> {
        match tag.get(..4)? {
            b"curv" => {
                let count = u32_at(tag, 8)? as usize;
                let values = tag.get(12..)?.get(..count.checked_mul(2)?)?;
                let u16s = values
                    .chunks_exact(2)
                    .map(|v| f64::from(u16::from_be_bytes([v[0], v[1]])));
                Some(match count {
                    0 => Self::gamma(1.0),
                    1 => Self::gamma(u16s.sum::<f64>() / 256.0),
                    _ => Self::Table(u16s.map(|v| v / 65_535.0).collect()),
                })
            }
            b"para" => {
                let kind = u16::from_be_bytes([*tag.get(8)?, *tag.get(9)?]);
                let at = |index: usize| fixed_at(tag, 12 + 4 * index);
                let g = at(0)?;
                Some(Self::Parametric(match kind {
                    0 => return Some(Self::gamma(g)),
                    1 => {
                        let (a, b) = (at(1)?, at(2)?);
                        [g, a, b, 0.0, -b / a, 0.0, 0.0]
                    }
                    2 => {
                        let (a, b, c) = (at(1)?, at(2)?, at(3)?);
                        [g, a, b, 0.0, -b / a, c, c]
                    }
                    3 => [g, at(1)?, at(2)?, at(3)?, at(4)?, 0.0, 0.0],
                    4 => [g, at(1)?, at(2)?, at(3)?, at(4)?, at(5)?, at(6)?],
                    _ => return None,
                }))
            }
            _ => None,
        }
    }

    fn gamma(g: f64) -> Self {
        Self::Parametric([g, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    fn at(&self, x: f64) -> f64 {
        match self {
            Self::Table(values) => {
                let last = values.len() - 1;
                let position = x * last as f64;
                let below = (position as usize).min(last);
                let above = (below + 1).min(last);
                values[below] + (values[above] - values[below]) * (position - below as f64)
            }
            Self::Parametric([g, a, b, c, d, e, f]) => {
                if x >= *d {
                    (a * x + b).max(0.0).powf(*g) + e
                } else {
                    c * x + f
                }
            }
        }
    }

    fn is_srgb(&self) -> bool {
        (0..=32_u8).all(|step| {
            let x = f32::from(step) / 32.0;
            (self.at(f64::from(x)) - f64::from(srgb::decode(x))).abs() < CURVE_TOLERANCE
        })
    }
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_be_bytes(bytes.try_into().ok()?))
}

/// An s15Fixed16Number.
fn fixed_at(bytes: &[u8], at: usize) -> Option<f64> {
    Some(f64::from(u32_at(bytes, at)?.cast_signed()) / 65_536.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A matrix profile with one curve for all channels.
    fn profile(colours: [[f64; 3]; 3], curve: &[u8]) -> Vec<u8> {
        let fixed = |v: f64| ((v * 65_536.0).round() as i32).to_be_bytes();
        let mut tags: Vec<([u8; 4], Vec<u8>)> =
            vec![(*b"desc", b"desc\0\0\0\0\0\0\0\x05Mine\0".to_vec())];
        for ((tag, _), colour) in SRGB_COLOURS.iter().zip(colours) {
            let mut data = b"XYZ \0\0\0\0".to_vec();
            data.extend(colour.iter().flat_map(|&v| fixed(v)));
            tags.push((*tag, data));
        }
        for tag in [*b"rTRC", *b"gTRC", *b"bTRC"] {
            tags.push((tag, curve.to_vec()));
        }
        let mut bytes = vec![0; 128];
        bytes[16..20].copy_from_slice(b"RGB ");
        bytes.extend((tags.len() as u32).to_be_bytes());
        let mut start = 132 + 12 * tags.len();
        for (tag, data) in &tags {
            bytes.extend(tag);
            bytes.extend((start as u32).to_be_bytes());
            bytes.extend((data.len() as u32).to_be_bytes());
            start += data.len();
        }
        bytes.extend(tags.into_iter().flat_map(|(_, data)| data));
        bytes
    }

    fn srgb_colours() -> [[f64; 3]; 3] {
        SRGB_COLOURS.map(|(_, colour)| colour)
    }

    /// IEC 61966-2-1 as `para` of kind 3.
    fn srgb_curve() -> Vec<u8> {
        let parameters = [2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045];
        let mut curve = b"para\0\0\0\0\0\x03\0\0".to_vec();
        for value in parameters {
            curve.extend(((value * 65_536.0_f64).round() as i32).to_be_bytes());
        }
        curve
    }

    fn gamma_curve(gamma: f64) -> Vec<u8> {
        let mut curve = b"curv\0\0\0\0\0\0\0\x01".to_vec();
        curve.extend(((gamma * 256.0).round() as u16).to_be_bytes());
        curve
    }

    fn srgb_table() -> Vec<u8> {
        let mut curve = b"curv\0\0\0\0\0\0\x04\0".to_vec();
        for i in 0..1024_u16 {
            let value = srgb::decode(f32::from(i) / 1023.0);
            curve.extend(((value * 65_535.0).round() as u16).to_be_bytes());
        }
        curve
    }

    #[test]
    fn srgb_is_known_by_its_numbers() {
        for curve in [srgb_curve(), srgb_table()] {
            assert_eq!(describe_unless_srgb(&profile(srgb_colours(), &curve)), None);
        }
    }

    #[test]
    fn others_are_not() {
        // Display P3's colours, and Adobe RGB's gamma.
        let p3 = [
            [0.5151, 0.2412, -0.0011],
            [0.2920, 0.6922, 0.0419],
            [0.1571, 0.0666, 0.7841],
        ];
        let wide = describe_unless_srgb(&profile(p3, &srgb_curve())).unwrap();
        assert!(
            wide.contains("Mine") && wide.contains("primaries"),
            "{wide}"
        );
        for gamma in [1.0, 1.8, 2.2] {
            let found = describe_unless_srgb(&profile(srgb_colours(), &gamma_curve(gamma)));
            assert!(found.is_some_and(|what| what.contains("curve")), "{gamma}");
        }
        let mut print = profile(srgb_colours(), &srgb_curve());
        print[16..20].copy_from_slice(b"CMYK");
        assert!(describe_unless_srgb(&print).unwrap().contains("CMYK"));
    }

    proptest! {
        #[test]
        fn damage_is_survived(cut in 0_usize..400, at in 0_usize..400, value: u8) {
            let mut bytes = profile(srgb_colours(), &srgb_curve());
            let last = bytes.len() - 1;
            bytes[at.min(last)] = value;
            bytes.truncate(cut);
            // Cut short anywhere, a curve or a colour is missing.
            prop_assert!(cut > last || describe_unless_srgb(&bytes).is_some());
        }
    }
}
