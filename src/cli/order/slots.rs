//! A list of slots on the command line: `0,1,4-6`.

use std::collections::HashSet;
use std::str::FromStr;

/// Most slots that can be listed, as many as a study can have participants.
const MOST: usize = 100_000;

/// Slots in the order written, none twice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SlotList(pub Vec<u32>);

impl FromStr for SlotList {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut slots = Vec::new();
        for part in text.split(',') {
            let (first, last) = part.split_once('-').unwrap_or((part, part));
            let (first, last) = (number(first)?, number(last)?);
            if last < first {
                return Err(format!("\"{part}\" runs backwards; say {last}-{first}"));
            }
            if slots.len() + (last - first) as usize >= MOST {
                return Err(format!("more than {MOST} slots"));
            }
            slots.extend(first..=last);
        }
        let mut seen = HashSet::new();
        match slots.iter().find(|&slot| !seen.insert(slot)) {
            Some(twice) => Err(format!("slot {twice} is there twice; one session fills it")),
            None => Ok(Self(slots)),
        }
    }
}

fn number(text: &str) -> Result<u32, String> {
    text.trim().parse().map_err(|_| {
        format!("found \"{text}\"; slots are whole numbers from 0 with commas, as 0,1,4-6")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_ranges_are_slots() {
        let slots = |text: &str| text.parse::<SlotList>().map(|list| list.0);
        assert_eq!(slots("0,1,4-6"), Ok(vec![0, 1, 4, 5, 6]));
        assert_eq!(slots("7"), Ok(vec![7]));
        assert_eq!(slots("3-3, 1"), Ok(vec![3, 1]));
        assert_eq!(slots("4294967295"), Ok(vec![u32::MAX]));
    }

    #[test]
    fn what_is_no_list_of_slots_is_refused_with_the_reason() {
        for (text, reason) in [
            ("", "whole numbers"),
            ("1,,2", "whole numbers"),
            ("one", "\"one\""),
            ("-1", "whole numbers"),
            ("6-4", "4-6"),
            ("1,0-2", "slot 1 is there twice"),
            ("0-4294967295", "more than 100000"),
        ] {
            let error = text.parse::<SlotList>().unwrap_err();
            assert!(error.contains(reason), "{text:?}: {error}");
        }
    }
}
