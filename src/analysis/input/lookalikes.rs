//! Names that a reader would take for one and the program takes for two: they differ by case, by
//! the spaces around them, or by how Unicode composes their letters.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};

use unicode_normalization::UnicodeNormalization;

use super::files::Files;
use super::names::Names;

/// More notes than this on one kind of name are summed up.
const MOST: usize = 8;

/// One note a pair of neighbours among the names that look alike.
pub fn notes(kind: &str, names: &Names, files: &Files) -> Vec<String> {
    let mut alike = pairs(names.names());
    let more = alike.len().saturating_sub(MOST);
    alike.truncate(MOST);
    let shown = |number: usize| {
        let name = &names.names()[number];
        format!(
            "`{}` ({})",
            name.escape_debug(),
            files.shown(names.place(number))
        )
    };
    let mut notes: Vec<String> = alike
        .into_iter()
        .map(|(one, other)| {
            format!(
                "the {kind}s {} and {} differ only by {}; they count as two.",
                shown(one),
                shown(other),
                difference(&names.names()[one], &names.names()[other]),
            )
        })
        .collect();
    if more > 0 {
        notes.push(format!("{more} pairs more of {kind}s look alike."));
    }
    notes
}

/// Pairs of numbers of names that look alike, each with the one before it, in order of appearance.
fn pairs(names: &[String]) -> Vec<(usize, usize)> {
    let mut hashed: Vec<(u64, u32)> = (0_u32..)
        .zip(names)
        .map(|(number, name)| {
            let mut hasher = DefaultHasher::new();
            if name.is_ascii() {
                for byte in name.trim().bytes() {
                    u32::from(byte.to_ascii_lowercase()).hash(&mut hasher);
                }
            } else {
                for letter in key(name).chars() {
                    u32::from(letter).hash(&mut hasher);
                }
            }
            (hasher.finish(), number)
        })
        .collect();
    hashed.sort_unstable();
    let mut alike: Vec<(usize, usize)> = hashed
        .windows(2)
        .filter(|pair| pair[0].0 == pair[1].0)
        .map(|pair| (pair[0].1 as usize, pair[1].1 as usize))
        .filter(|&(one, other)| key(&names[one]) == key(&names[other]))
        .collect();
    alike.sort_unstable_by_key(|&(one, other)| (other, one));
    alike
}

/// What a reader sees: composed letters, no case, no spaces around.
fn key(name: &str) -> String {
    let composed: String = name.trim().nfc().collect();
    // Lower case may come apart again (İ); once more.
    composed.to_lowercase().nfc().collect()
}

/// By what two names of one [`key`] differ.
fn difference(one: &str, other: &str) -> &'static str {
    let composed = |name: &str| name.nfc().collect::<String>();
    if composed(one) == composed(other) {
        "how their letters are composed (Unicode normal form)"
    } else if one.trim() == other.trim() {
        "the spaces around them"
    } else {
        "upper and lower case, or by that and spaces or composition"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Vec<String> {
        let mut files = Files::default();
        files.begin(std::path::Path::new("t.csv"), 0);
        let mut known = Names::default();
        for (line, name) in (2..).zip(names) {
            known.number(name.as_bytes(), files.here(line));
        }
        notes("participant", &known, &files)
    }

    #[test]
    fn what_looks_alike_is_named_with_both_places() {
        for (names, parts) in [
            (
                ["Zo\u{e9}", "x", "Zoe\u{301}"],
                ["t.csv:2", "t.csv:4", "Unicode normal form"],
            ),
            (
                ["p1", "x", "P1"],
                ["`p1` (t.csv:2)", "`P1` (t.csv:4)", "case"],
            ),
            (
                ["p1", "x", "p1\u{a0}"],
                ["t.csv:2", "t.csv:4", "spaces around"],
            ),
            (
                ["ÄB", "x", "a\u{308}b"],
                ["t.csv:2", "t.csv:4", "composition"],
            ),
        ] {
            let notes = of(&names);
            assert_eq!(notes.len(), 1, "{notes:?}");
            for part in parts {
                assert!(notes[0].contains(part), "{part:?} not in {notes:?}");
            }
        }
    }

    #[test]
    fn other_names_are_left_in_peace() {
        assert!(of(&["P1", "P2", "P 1", "Zoe", "Zo\u{e9}", "ß", "ss"]).is_empty());
    }

    #[test]
    fn many_are_summed_up() {
        let names: Vec<String> = (0..20)
            .flat_map(|i| [format!("p{i}"), format!("P{i}")])
            .collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let notes = of(&names);
        assert_eq!(notes.len(), MOST + 1);
        assert!(notes[MOST].starts_with("12 pairs more"), "{notes:?}");
    }
}
