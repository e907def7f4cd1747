//! A picture in memory to draw rectangles and plain text on.

use font8x8::{BASIC_FONTS, GREEK_FONTS, LATIN_FONTS, MISC_FONTS, UnicodeFonts};

/// Pixels of a letter at scale 1, both ways.
pub const LETTER_PX: u32 = 8;

/// 8-bit sRGB, rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Canvas {
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// `3 · width_px · height_px` bytes.
    pub rgb8: Vec<u8>,
}

impl Canvas {
    /// One colour all over.
    pub fn new(width_px: u32, height_px: u32, colour: [u8; 3]) -> Self {
        Self {
            width_px,
            height_px,
            rgb8: colour.repeat(width_px as usize * height_px as usize),
        }
    }

    /// Colours a pixel; outside the picture nothing happens.
    pub fn set(&mut self, x: u32, y: u32, colour: [u8; 3]) {
        if x < self.width_px && y < self.height_px {
            let at = 3 * (y as usize * self.width_px as usize + x as usize);
            self.rgb8[at..at + 3].copy_from_slice(&colour);
        }
    }

    /// Colours a rectangle.
    pub fn fill(&mut self, (x, y): (u32, u32), (width, height): (u32, u32), colour: [u8; 3]) {
        for row in y..y.saturating_add(height).min(self.height_px) {
            for column in x..x.saturating_add(width).min(self.width_px) {
                self.set(column, row, colour);
            }
        }
    }

    /// Writes one line, its first letter's upper left corner at (x, y), letters of 8·`scale` pixels.
    pub fn write(&mut self, text: &str, (x, y): (u32, u32), scale: u32, colour: [u8; 3]) {
        for (place, letter) in (0..).zip(text.chars()) {
            let left = x + place * LETTER_PX * scale;
            for (row, bits) in (0..).zip(shape(letter)) {
                for column in (0..LETTER_PX).filter(|column| bits >> column & 1 == 1) {
                    let corner = (left + column * scale, y + row * scale);
                    self.fill(corner, (scale, scale), colour);
                }
            }
        }
    }
}

/// Columns that a line of text takes.
pub fn width_px(text: &str, scale: u32) -> u32 {
    // No line that is drawn comes near 2³² pixels.
    text.chars().count() as u32 * LETTER_PX * scale
}

/// A letter's rows from the top, the lowest bit on the left; a question mark for letters that the
/// font does not have.
fn shape(letter: char) -> [u8; 8] {
    let plain = match letter {
        '−' | '–' | '—' => '-',
        '’' | '‘' => '\'',
        '“' | '”' => '"',
        other => other,
    };
    BASIC_FONTS
        .get(plain)
        .or_else(|| LATIN_FONTS.get(plain))
        .or_else(|| GREEK_FONTS.get(plain))
        .or_else(|| MISC_FONTS.get(plain))
        .or_else(|| BASIC_FONTS.get('?'))
        .unwrap_or_default()
}

/// Breaks a text between words into lines of at most `letters` letters (at least 1); a word that is
/// longer is broken too.
pub fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let letters = letters.max(1);
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let word: Vec<char> = word.chars().collect();
        if let Some(line) = lines.last_mut()
            && line.chars().count() + 1 + word.len() <= letters
        {
            line.push(' ');
            line.extend(word);
            continue;
        }
        lines.extend(word.chunks(letters).map(|piece| piece.iter().collect()));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_are_cut_at_the_edge() {
        let mut canvas = Canvas::new(3, 2, [0; 3]);
        canvas.fill((1, 1), (9, u32::MAX), [7; 3]);
        assert_eq!(canvas.rgb8[..12], [0; 12]);
        assert_eq!(canvas.rgb8[12..], [7; 6]);
    }

    #[test]
    fn letters_stand_where_they_are_put() {
        let mut canvas = Canvas::new(40, 20, [255; 3]);
        canvas.write("I", (8, 4), 1, [0; 3]);
        let black = |canvas: &Canvas| -> Vec<(usize, usize)> {
            let pixels = canvas.rgb8.chunks_exact(3).enumerate();
            let dark = pixels.filter(|(_, colour)| colour[0] == 0);
            dark.map(|(at, _)| (at % 40, at / 40)).collect()
        };
        let small = black(&canvas);
        assert!(!small.is_empty());
        assert!(
            small
                .iter()
                .all(|&(x, y)| (8..16).contains(&x) && (4..12).contains(&y))
        );
        let mut large = Canvas::new(40, 20, [255; 3]);
        large.write("I", (8, 4), 2, [0; 3]);
        assert_eq!(black(&large).len(), 4 * small.len());
    }

    #[test]
    fn every_sign_that_reports_need_is_there() {
        for sign in "≥≤×°µ·äβ−–".chars() {
            assert_ne!(shape(sign), shape('?'), "{sign}");
            assert_ne!(shape(sign), [0; 8], "{sign}");
        }
        assert_eq!(shape('漢'), shape('?'));
    }

    #[test]
    fn lines_break_between_words_where_they_can() {
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(wrapped("abcdefgh ij", 3), ["abc", "def", "gh", "ij"]);
        assert_eq!(wrapped("  ", 5), Vec::<String>::new());
        assert_eq!(wrapped("ab", 0), ["a", "b"]);
    }
}
