//! The value of a named parameter: a number, or one of a few words.

use std::fmt;

use serde::Serialize;
use serde::de::{self, Deserialize, Deserializer, Visitor};

/// A value as it stands in configs and manifests.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ParameterValue {
    /// A number, in the parameter's unit.
    Number(f64),
    /// A choice.
    Word(String),
}

impl<'de> Deserialize<'de> for ParameterValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ValueVisitor)
    }
}

struct ValueVisitor;

// By hand, because serde's own untagged enums do not say what was found.
impl Visitor<'_> for ValueVisitor {
    type Value = ParameterValue;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a word")
    }

    fn visit_f64<E>(self, number: f64) -> Result<ParameterValue, E> {
        Ok(ParameterValue::Number(number))
    }

    fn visit_i64<E>(self, number: i64) -> Result<ParameterValue, E> {
        Ok(ParameterValue::Number(number as f64))
    }

    fn visit_u64<E>(self, number: u64) -> Result<ParameterValue, E> {
        Ok(ParameterValue::Number(number as f64))
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<ParameterValue, E> {
        Ok(word.into())
    }
}

impl From<f64> for ParameterValue {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for ParameterValue {
    fn from(word: &str) -> Self {
        Self::Word(word.to_owned())
    }
}

impl fmt::Display for ParameterValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Word(word) => write!(f, "{word}"),
        }
    }
}
