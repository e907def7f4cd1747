//! Cells that a spreadsheet must not take for a formula.
//!
//! Text that begins with `= + - @`, a tab or a carriage return is executed by
//! common spreadsheets when a CSV is opened (OWASP, "CSV injection"). Such a cell
//! gets an apostrophe in front, and so does one that begins with an apostrophe, so
//! that reading gives back exactly what was written.

use std::borrow::Cow;

use serde::{Deserialize, Deserializer, Serializer};

const DANGEROUS: [char; 7] = ['=', '+', '-', '@', '\t', '\r', '\''];

/// The cell as it goes into a file.
#[must_use]
pub fn neutral(text: &str) -> Cow<'_, str> {
    if text.starts_with(DANGEROUS) {
        Cow::Owned(format!("'{text}"))
    } else {
        Cow::Borrowed(text)
    }
}

/// The text of a cell read from a file: undoes [`neutral`].
#[must_use]
pub fn restored(cell: &str) -> &str {
    match cell.strip_prefix('\'') {
        Some(text) if text.starts_with(DANGEROUS) => text,
        _ => cell,
    }
}

/// For `#[serde(with = …)]` on text that people or configs supply.
pub(super) mod free_text {
    use super::{Deserialize, Deserializer, Serializer, neutral, restored};

    pub fn serialize<S: Serializer>(text: &str, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&neutral(text))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
        String::deserialize(deserializer).map(|cell| restored(&cell).to_owned())
    }
}

/// The same for text that may be absent; an empty cell is `None`.
pub(super) mod optional_free_text {
    use super::{Deserialize, Deserializer, Serializer, neutral, restored};

    #[allow(clippy::ref_option)] // serde's signature
    pub fn serialize<S: Serializer>(
        text: &Option<String>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match text {
            Some(text) => serializer.serialize_some(&*neutral(text)),
            None => serializer.serialize_none(),
        }
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<String>, D::Error> {
        let cell = Option::<String>::deserialize(deserializer)?;
        Ok(cell.map(|cell| restored(&cell).to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn formulas_lose_their_power() {
        for formula in ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1"] {
            assert_eq!(neutral(formula), format!("'{formula}"));
        }
        assert_eq!(neutral("Lab 2"), "Lab 2");
    }

    proptest! {
        #[test]
        fn every_text_comes_back_as_it_was(text in "['=+@-]{0,3}.*") {
            let cell = neutral(&text);
            prop_assert_eq!(restored(&cell), text.as_str());
        }
    }
}
