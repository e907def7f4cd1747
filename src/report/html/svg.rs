//! The little SVG the figures need. Lengths are in the picture's own units, 1 = one CSS pixel at
//! full width; colours come from the page's style by class, so that figures follow its dark mode.

use std::fmt::Write as _;

/// A drawing under way.
pub struct Svg {
    body: String,
    width: f64,
    height: f64,
}

/// Where a text's position is.
#[derive(Clone, Copy)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

impl Svg {
    /// An empty drawing.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            body: String::new(),
            width,
            height,
        }
    }

    pub fn rect(&mut self, class: &str, x: f64, y: f64, width: f64, height: f64) {
        let _ = writeln!(
            self.body,
            "<rect class=\"{class}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
            n(x),
            n(y),
            n(width.max(0.0)),
            n(height)
        );
    }

    pub fn line(&mut self, class: &str, (x1, y1): (f64, f64), (x2, y2): (f64, f64)) {
        let _ = writeln!(
            self.body,
            "<line class=\"{class}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>",
            n(x1),
            n(y1),
            n(x2),
            n(y2)
        );
    }

    pub fn circle(&mut self, class: &str, x: f64, y: f64, radius: f64) {
        let _ = writeln!(
            self.body,
            "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
            n(x),
            n(y),
            n(radius)
        );
    }

    /// A horizontal interval with end caps, on a lighter band so that it shows on any colour.
    pub fn interval(&mut self, low: f64, high: f64, y: f64) {
        const CAP: f64 = 5.0;
        for class in ["halo", "whisker"] {
            self.line(class, (low, y), (high, y));
            self.line(class, (low, y - CAP), (low, y + CAP));
            self.line(class, (high, y - CAP), (high, y + CAP));
        }
    }

    pub fn text(&mut self, class: &str, x: f64, y: f64, anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let _ = writeln!(
            self.body,
            "<text class=\"{class}\" x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\">{}</text>",
            n(x),
            n(y),
            escape(text)
        );
    }

    /// The element, titled for people who cannot see it.
    pub fn finish(self, title: &str) -> String {
        format!(
            "<svg viewBox=\"0 0 {} {}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\">\n<title>{}</title>\n{}</svg>\n",
            n(self.width),
            n(self.height),
            escape(title),
            self.body
        )
    }
}

/// A coordinate with two decimals at most.
fn n(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Text inside an element or a quoted attribute. Control characters other than tab and line breaks
/// are not allowed in either and are shown as �.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push(c),
            c if c.is_control() => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_leave_their_element() {
        assert_eq!(
            escape("<script>\"&\u{0}é"),
            "&lt;script&gt;&quot;&amp;\u{fffd}é"
        );
        let mut svg = Svg::new(10.0, 10.0);
        svg.text("x", 1.0, 1.125, Anchor::Start, "</text><b>");
        let text = svg.finish("</title>");
        assert!(
            !text.contains("<b>") && !text.contains("</title></title>"),
            "{text}"
        );
    }
}
