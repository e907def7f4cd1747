//! TOML files a person writes: parsed into types that cannot hold a wrong value,
//! with errors that name file, line, field, what was found and what is allowed.
//!
//! Scenes, stimulus sets and protocols are all read through [`parse`]; the
//! quantities in them are the unit types of [`quantity`].

mod error;
mod parameter;
pub mod quantity;

use std::path::Path;

use serde::de::DeserializeOwned;

pub use error::ConfigError;
pub use parameter::ParameterValue;

/// Reads and parses one TOML file.
///
/// # Errors
/// [`ConfigError`] naming the file, and for a syntax or value error its line,
/// column and field.
pub fn load<T: DeserializeOwned>(path: &Path) -> Result<T, ConfigError> {
    parse(path, &read(path)?)
}

/// The text of a config file.
///
/// # Errors
/// [`ConfigError`] naming the file and why it cannot be read.
pub fn read(path: &Path) -> Result<String, ConfigError> {
    let bytes = std::fs::read(path).map_err(|error| ConfigError::unreadable(path, &error))?;
    String::from_utf8(bytes)
        .map_err(|_| ConfigError::whole_file(path, "the file is not UTF-8 text"))
}

/// Parses the text of a TOML file; `path` is only named in errors.
///
/// # Errors
/// [`ConfigError`] naming file, line, column and field.
pub fn parse<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, ConfigError> {
    let deserializer = toml::Deserializer::parse(text)
        .map_err(|error| ConfigError::at(path, text, error.span(), "", error.message()))?;
    serde_path_to_error::deserialize(deserializer).map_err(|error| {
        // The path goes through the wrapper that keeps a value's place in the file.
        let field = (error.path().to_string()).replace("$__serde_spanned_private_value.", "");
        let inner = error.into_inner();
        ConfigError::at(path, text, inner.span(), &field, inner.message())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Example {
        camera: Camera,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Camera {
        near_m: quantity::Metres,
    }

    fn error_of(text: &str) -> String {
        parse::<Example>(Path::new("x.toml"), text)
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn a_good_file_parses() {
        let example: Example = parse(Path::new("x.toml"), "[camera]\nnear_m = 1\n").unwrap();
        assert!((example.camera.near_m.get() - 1.0).abs() < f32::EPSILON);
    }

    #[test]
    fn an_out_of_range_value_names_line_field_and_range() {
        let message = error_of("[camera]\n\nnear_m = -3\n");
        for part in ["x.toml:3", "camera.near_m", "-3", "0 to 100000 m"] {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }

    #[test]
    fn an_unknown_key_names_what_is_expected() {
        let message = error_of("[camera]\nnear_cm = 3\n");
        for part in ["x.toml:2", "near_cm", "near_m"] {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }

    #[test]
    fn a_syntax_error_names_its_line() {
        assert!(error_of("[camera]\nnear_m = = 3\n").contains("x.toml:2"));
    }

    #[test]
    fn a_missing_file_says_so() {
        let message = load::<Example>(Path::new("no/such.toml"))
            .unwrap_err()
            .to_string();
        assert!(message.contains("no/such.toml"), "{message}");
    }
}
