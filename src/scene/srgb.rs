//! The sRGB transfer function (IEC 61966-2-1), both ways, the same on every machine.

/// From a displayed value to linear light, 0 to 1.
#[must_use]
pub fn decode(value: f32) -> f32 {
    if value <= 0.040_45 {
        value / 12.92
    } else {
        libm::powf((value + 0.055) / 1.055, 2.4)
    }
}

/// From linear light to a displayed value, 0 to 1.
#[must_use]
pub fn encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055
    }
}

/// From linear light to the nearest of 256 displayed levels; what lies outside 0 to 1 is clipped.
#[must_use]
pub fn encode_u8(linear: f32) -> u8 {
    // Saturating: `as` clamps to 0..=255, and a NaN becomes 0.
    (encode(linear.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8
}

/// Relative luminance (Rec. 709 weights, 0 to 1) of a displayed 8-bit colour.
#[must_use]
pub fn luminance_u8([red, green, blue]: [u8; 3]) -> f32 {
    let linear = |level: u8| decode(f32::from(level) / 255.0);
    0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The standard's own points, and the well-known mid-grey: 18 % light is level 118.
    #[test]
    fn known_values() {
        assert_eq!(encode_u8(0.0), 0);
        assert_eq!(encode_u8(1.0), 255);
        assert_eq!(encode_u8(0.18), 118);
        assert_eq!(encode_u8(7.0), 255);
        assert_eq!(encode_u8(-1.0), 0);
        assert!((decode(0.5) - 0.214_041).abs() < 1e-5);
        assert!((luminance_u8([255; 3]) - 1.0).abs() < 1e-6);
        assert!((luminance_u8([0, 255, 0]) - 0.7152).abs() < 1e-6);
    }

    #[test]
    fn every_level_comes_back() {
        for level in 0..=255_u8 {
            assert_eq!(encode_u8(decode(f32::from(level) / 255.0)), level);
        }
    }
}
