//! Physical quantities of the configs. Each type is a number with a unit and an
//! allowed range; a value outside it never gets past the parser.

/// Declares a number type with a unit and an inclusive range.
macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident: $number:ty, $low:expr, $high:expr, $unit:expr) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd, serde::Serialize, serde::Deserialize)]
        #[serde(try_from = "f64", into = "f64")]
        pub struct $name($number);

        impl $name {
            /// Smallest value allowed.
            pub const LOW: $number = $low;
            /// Largest value allowed.
            pub const HIGH: $number = $high;
            /// The unit, as it stands in messages; empty for a plain number.
            pub const UNIT: &'static str = $unit;

            /// The number, in the type's unit.
            #[must_use]
            pub fn get(self) -> $number {
                self.0
            }
        }

        impl TryFrom<f64> for $name {
            type Error = String;

            #[allow(clippy::cast_possible_truncation, clippy::cast_lossless, clippy::cast_sign_loss)]
            fn try_from(value: f64) -> Result<Self, String> {
                $crate::config::quantity::check(value, Self::LOW as f64, Self::HIGH as f64, Self::UNIT)?;
                let number = value as $number;
                if <$number>::MAX as f64 > 1e30 || number as f64 == value {
                    Ok(Self(number))
                } else {
                    Err(format!("found {value}, a whole number is needed"))
                }
            }
        }

        impl From<$name> for f64 {
            #[allow(clippy::cast_lossless)]
            fn from(value: $name) -> f64 {
                value.0 as f64
            }
        }
    };
}
pub(crate) use quantity;

/// Checks a number against an inclusive range; NaN is never inside.
///
/// # Errors
/// What was found and what is allowed, with the unit.
pub fn check(value: f64, low: f64, high: f64, unit: &str) -> Result<(), String> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    let space = if unit.is_empty() { "" } else { " " };
    Err(format!(
        "found {value}, allowed is {low} to {high}{space}{unit}"
    ))
}

quantity! {
    /// A length in metres, not negative.
    Metres: f32, 0.0, 100_000.0, "m"
}
quantity! {
    /// A time in milliseconds, up to ten minutes.
    Milliseconds: u32, 0, 600_000, "ms"
}
quantity! {
    /// An angle in degrees, a full turn either way.
    Degrees: f32, -360.0, 360.0, "degrees"
}
quantity! {
    /// A number from 0 to 1.
    Unit: f32, 0.0, 1.0, ""
}
quantity! {
    /// An 8-bit sRGB level.
    SrgbLevel: u8, 0, 255, ""
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_at_their_ends() {
        assert!(Unit::try_from(0.0).is_ok());
        assert!(Unit::try_from(1.0).is_ok());
        assert!(Unit::try_from(1.0 + 1e-12).is_err());
        assert!(Unit::try_from(f64::NAN).is_err());
    }

    #[test]
    fn whole_numbers_are_not_rounded_silently() {
        assert_eq!(SrgbLevel::try_from(128.0).unwrap().get(), 128);
        let message = SrgbLevel::try_from(127.5).unwrap_err();
        assert!(message.contains("whole number"), "{message}");
    }
}
