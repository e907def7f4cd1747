//! Names held once: a table of a million rows has few different ones.

use std::collections::HashMap;

/// Numbers names in order of appearance.
#[derive(Debug, Default)]
pub struct Names {
    numbers: HashMap<Box<[u8]>, u32>,
    names: Vec<String>,
    /// The last one asked for: rows of a participant or a condition mostly follow each other.
    last: Option<u32>,
}

impl Names {
    /// The number of a name, new or known; `None` if it is new and not UTF-8.
    pub fn number(&mut self, name: &[u8]) -> Option<u32> {
        if let Some(last) = self.last
            && self.name(last).as_bytes() == name
        {
            return Some(last);
        }
        let number = match self.numbers.get(name) {
            Some(&number) => number,
            None => {
                let text = std::str::from_utf8(name).ok()?;
                let number = u32::try_from(self.names.len()).ok()?;
                self.names.push(text.to_owned());
                self.numbers.insert(name.into(), number);
                number
            }
        };
        self.last = Some(number);
        Some(number)
    }

    /// The name of a number.
    pub fn name(&self, number: u32) -> &str {
        &self.names[number as usize]
    }

    /// All names, by number.
    pub fn into_names(self) -> Vec<String> {
        self.names
    }
}
