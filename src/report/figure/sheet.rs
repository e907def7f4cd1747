//! What all figures have: a size, a title, keys to their lines, and captions.

use super::words::wrapped;
use crate::report::svg::{Anchor, Mark, Svg, text_width};

/// Width of every figure.
pub const WIDTH: f64 = 860.0;
/// Room at the right.
pub const MARGIN: f64 = 14.0;

/// Letters of captions, and how far their lines lie apart.
const CAPTION: (f64, f64) = (11.0, 15.0);

/// The style of all figures; `.CLASS` stands for the class that it keeps to.
const STYLE: &str = include_str!("figure.css");

/// A figure under way.
pub struct Sheet {
    /// What is drawn.
    pub svg: Svg,
    title: String,
}

/// What a line in a figure stands for.
pub enum Key<'a> {
    /// A line of a class.
    Line(&'a str),
    /// A line of a class with a mark of another on it.
    Marked(&'a str, &'a str),
    /// A mark of a class.
    Mark(&'a str),
}

impl Sheet {
    /// With its title at the top.
    pub fn new(title: &str) -> Self {
        let mut svg = Svg::new(WIDTH, 0.0);
        let shown = shortened(title, 15.0, WIDTH - 2.0 * MARGIN);
        svg.text("title", MARGIN, 24.0, Anchor::Start, &shown);
        Self {
            svg,
            title: title.to_owned(),
        }
    }

    /// What the lines stand for, in a row from the left.
    pub fn keys(&mut self, left: f64, y: f64, keys: &[(Key, &str)]) {
        let mut x = left;
        for (key, text) in keys {
            self.key(x, y, key, text);
            x += 34.0 + text_width(text, 12.0) + 14.0;
        }
    }

    /// What one line stands for.
    pub fn key(&mut self, x: f64, y: f64, key: &Key, text: &str) {
        let middle = y - 4.0;
        let ends = [(x, middle), (x + 28.0, middle)];
        let centre = (x + 14.0, middle);
        match key {
            Key::Line(class) => self.svg.polyline(class, &ends),
            Key::Marked(line, mark) => {
                self.svg.polyline(line, &ends);
                self.svg.mark(mark, Mark::Disc, centre, 3.5);
            }
            Key::Mark(class) => self.svg.mark(class, Mark::Disc, centre, 4.0),
        }
        self.svg.text("key", x + 34.0, y, Anchor::Start, text);
    }

    /// The figure as a file: captions below what is drawn, from `y` on. `class` is what its style
    /// keeps to; `more` is style besides that of all figures.
    pub fn finish(mut self, class: &str, captions: &[String], y: f64, more: &str) -> String {
        let (size, step) = CAPTION;
        // Sentences are narrower than names: their letters are small ones and spaces.
        let columns = ((WIDTH - 2.0 * MARGIN) / (0.95 * text_width("x", size))) as usize;
        let mut y = y;
        for sentence in captions {
            for line in wrapped(sentence, columns) {
                self.svg.text("caption", MARGIN, y, Anchor::Start, &line);
                y += step;
            }
        }
        self.svg.set_height(y);
        let style = STYLE.replace(".CLASS", &format!(".{class}")) + more;
        self.svg.finish_alone(class, &self.title, &style)
    }
}

/// A text that is not wider than so much, with … where something is left out.
pub fn shortened(text: &str, size: f64, width: f64) -> String {
    let mut shown = text.to_owned();
    while text_width(&shown, size) > width && shown.pop().is_some() {
        let kept = shown.trim_end_matches('…').to_owned();
        let kept: String = kept
            .chars()
            .take(kept.chars().count().saturating_sub(1))
            .collect();
        shown = kept + "…";
    }
    shown
}
