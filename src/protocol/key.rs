//! Keys a protocol can name.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A key of the keyboard, by its name in a protocol: `Space`, `Enter`, `Left`,
/// `Right`, `Up`, `Down`, or one letter `A`–`Z` or digit `0`–`9`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Key {
    /// The space bar.
    Space,
    /// Return or Enter.
    Enter,
    /// Arrow left.
    Left,
    /// Arrow right.
    Right,
    /// Arrow up.
    Up,
    /// Arrow down.
    Down,
    /// A letter in upper case, or a digit.
    Symbol(char),
}

const NAMED: [(&str, Key); 6] = [
    ("Space", Key::Space),
    ("Enter", Key::Enter),
    ("Left", Key::Left),
    ("Right", Key::Right),
    ("Up", Key::Up),
    ("Down", Key::Down),
];

impl TryFrom<String> for Key {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        if let Some((_, key)) = NAMED.iter().find(|(name, _)| *name == text) {
            return Ok(*key);
        }
        let mut symbols = text.chars();
        match (symbols.next(), symbols.next()) {
            (Some(symbol), None) if symbol.is_ascii_uppercase() || symbol.is_ascii_digit() => {
                Ok(Self::Symbol(symbol))
            }
            _ => Err(format!(
                "found {text:?}, allowed is Space, Enter, Left, Right, Up, Down, one letter A to Z or one digit"
            )),
        }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Symbol(symbol) => write!(f, "{symbol}"),
            named => {
                let name = NAMED.iter().find(|(_, key)| key == named);
                f.write_str(name.map_or("", |(name, _)| name))
            }
        }
    }
}

impl From<Key> for String {
    fn from(key: Key) -> Self {
        key.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_survive_a_round_trip() {
        for name in ["Space", "Enter", "Left", "Right", "Up", "Down", "Q", "7"] {
            assert_eq!(Key::try_from(name.to_owned()).unwrap().to_string(), name);
        }
    }

    #[test]
    fn other_names_are_refused_with_what_is_allowed() {
        for name in ["", "space", "q", "F1", "10", "ä"] {
            let message = Key::try_from(name.to_owned()).unwrap_err();
            assert!(message.contains("Space"), "{message}");
        }
    }
}
