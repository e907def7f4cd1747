//! Names and sentences of figures.

use crate::report::number::width;

/// Each name once, in the order of first appearance.
pub fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found: Vec<&str> = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// A text in lines of so many columns; a word that is longer is broken.
pub fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let mut rest = word;
        while let Some(line) = lines.last_mut() {
            let space = usize::from(!line.is_empty());
            if width(line) + space + width(rest) <= columns {
                line.extend(std::iter::repeat_n(' ', space));
                line.push_str(rest);
                break;
            }
            if line.is_empty() {
                let end = (rest.char_indices().nth(columns / 2)).map_or(rest.len(), |(at, _)| at);
                let (head, tail) = rest.split_at(end);
                line.push_str(head);
                rest = tail;
                if rest.is_empty() {
                    break;
                }
            }
            lines.push(String::new());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn words_stay_whole_where_they_can() {
        assert_eq!(wrapped("one two three", 8), ["one two", "three"]);
        assert_eq!(wrapped("abcdefghijk", 8).concat(), "abcdefghijk");
    }

    proptest! {
        #[test]
        fn no_line_is_wider(text in "\\PC{0,200}") {
            for line in wrapped(&text, 10) {
                prop_assert!(width(&line) <= 10, "{line:?}");
            }
        }
    }
}
