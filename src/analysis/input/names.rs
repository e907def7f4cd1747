//! Names held once: a table of a million rows has few different ones.

use std::collections::HashMap;

use super::files::Place;

/// Numbers names in order of appearance.
#[derive(Debug, Default)]
pub struct Names {
    numbers: HashMap<Box<[u8]>, u32>,
    names: Vec<String>,
    /// Where each was read first.
    places: Vec<Place>,
    /// The last one asked for: rows of a participant or a condition mostly follow each other.
    last: Option<u32>,
}

impl Names {
    /// The number of a name read at `place`, new or known; `None` if it is new and not UTF-8.
    pub fn number(&mut self, name: &[u8], place: Place) -> Option<u32> {
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
                self.places.push(place);
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
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Where a name was read first.
    pub fn place(&self, number: usize) -> Place {
        self.places[number]
    }

    /// All names, by number.
    pub fn into_names(self) -> Vec<String> {
        self.names
    }
}

/// Names without those of whom nothing is left, and the new number of each that stays.
pub fn only_used(names: Vec<String>, used: &[bool]) -> (Vec<String>, Vec<u32>) {
    let mut next = 0;
    let numbers = used
        .iter()
        .map(|&used| {
            let number = next;
            next += u32::from(used);
            number
        })
        .collect();
    let kept = names.into_iter().zip(used);
    let kept = kept.filter_map(|(name, &used)| used.then_some(name));
    (kept.collect(), numbers)
}
