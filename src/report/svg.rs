//! The little SVG the figures need. Lengths are in the picture's own units, 1 = one CSS pixel at
//! full width; colours come from a style by class, the page's or the figure's own, so that figures
//! follow its dark mode.

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

    /// A text that reads upwards, along an axis at the left.
    pub fn text_upwards(&mut self, class: &str, x: f64, y: f64, anchor: Anchor, text: &str) {
        let before = self.body.len();
        self.text(class, x, y, anchor, text);
        let turn = format!("<text transform=\"rotate(-90 {} {})\"", n(x), n(y));
        self.body
            .replace_range(before..before + "<text".len(), &turn);
    }

    /// A line through points; nothing for fewer than two.
    pub fn polyline(&mut self, class: &str, points: &[(f64, f64)]) {
        if points.len() > 1 {
            let points = pairs(points);
            let _ = writeln!(
                self.body,
                "<polyline class=\"{class}\" points=\"{points}\"/>"
            );
        }
    }

    /// An area with these corners; nothing for fewer than three.
    pub fn polygon(&mut self, class: &str, corners: &[(f64, f64)]) {
        if corners.len() > 2 {
            let points = pairs(corners);
            let _ = writeln!(
                self.body,
                "<polygon class=\"{class}\" points=\"{points}\"/>"
            );
        }
    }

    /// A rectangle of a colour that is data, the same in light and dark.
    pub fn filled(&mut self, colour: &str, (x, y): (f64, f64), (width, height): (f64, f64)) {
        let _ = writeln!(
            self.body,
            "<rect fill=\"{colour}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
            n(x),
            n(y),
            n(width),
            n(height)
        );
    }

    /// Many dots in one element, round where the class has round line caps.
    pub fn dots(&mut self, class: &str, points: &[(f64, f64)]) {
        if points.is_empty() {
            return;
        }
        let dot = |(x, y): &(f64, f64)| format!("M{} {}h0", n(*x), n(*y));
        let path: String = points.iter().map(dot).collect();
        let _ = writeln!(self.body, "<path class=\"{class}\" d=\"{path}\"/>");
    }

    /// A picture inside the drawing, `base64` the bytes of a PNG.
    pub fn image(&mut self, (x, y): (f64, f64), (width, height): (f64, f64), base64: &str) {
        let _ = writeln!(
            self.body,
            "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{base64}\"/>",
            n(x),
            n(y),
            n(width),
            n(height)
        );
    }

    /// A mark around a point.
    pub fn mark(&mut self, class: &str, mark: Mark, (x, y): (f64, f64), radius: f64) {
        if mark == Mark::Disc {
            return self.circle(class, x, y, radius);
        }
        let corners: Vec<_> = (mark.corners().iter())
            .map(|(dx, dy)| (x + radius * dx, y + radius * dy))
            .collect();
        let corners = pairs(&corners);
        let _ = writeln!(
            self.body,
            "<polygon class=\"{class}\" points=\"{corners}\"/>"
        );
    }

    /// Makes the drawing as high as what is in it.
    pub fn set_height(&mut self, height: f64) {
        self.height = height;
    }

    /// The element, titled for people who cannot see it, with a style and a background of its own,
    /// good as a file, too. The style is
    /// to keep to what is inside `class`: in a page it reaches everything.
    pub fn finish_alone(self, class: &str, title: &str, style: &str) -> String {
        let size = (n(self.width), n(self.height));
        let before = format!(
            "<style>\n{style}</style>\n<rect class=\"paper\" x=\"0\" y=\"0\" width=\"{}\" height=\"{}\"/>\n",
            size.0, size.1
        );
        let attributes = format!(
            " class=\"{class}\" width=\"{}\" height=\"{}\"",
            size.0, size.1
        );
        self.element(&attributes, title, &before)
    }

    fn element(self, attributes: &str, title: &str, before: &str) -> String {
        format!(
            "<svg{attributes} viewBox=\"0 0 {} {}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\">\n<title>{}</title>\n{before}{}</svg>\n",
            n(self.width),
            n(self.height),
            escape(title),
            self.body
        )
    }
}

/// The shape of a mark; what can be told apart without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    Disc,
    Square,
    Up,
    Diamond,
    Down,
    Plus,
    Star,
    Cross,
    Pentagon,
    Hourglass,
    Left,
    Right,
}

impl Mark {
    /// All, those that are easiest told apart first.
    pub const ALL: [Self; 12] = [
        Self::Disc,
        Self::Square,
        Self::Up,
        Self::Diamond,
        Self::Down,
        Self::Plus,
        Self::Star,
        Self::Cross,
        Self::Pentagon,
        Self::Hourglass,
        Self::Left,
        Self::Right,
    ];

    /// Corners around the middle. They reach about as far as a disc of radius 1, and further
    /// where the shape has less inside.
    fn corners(self) -> Vec<(f64, f64)> {
        const ARM: f64 = 0.38;
        const LONG: f64 = 1.15;
        let ring = |count: usize, from_degrees: f64, radius: fn(usize) -> f64| {
            let corner = |k: usize| {
                let angle = (from_degrees + 360.0 * k as f64 / count as f64).to_radians();
                (radius(k) * angle.cos(), radius(k) * angle.sin())
            };
            (0..count).map(corner).collect::<Vec<_>>()
        };
        let plus = [
            (-ARM, -LONG),
            (ARM, -LONG),
            (ARM, -ARM),
            (LONG, -ARM),
            (LONG, ARM),
            (ARM, ARM),
            (ARM, LONG),
            (-ARM, LONG),
            (-ARM, ARM),
            (-LONG, ARM),
            (-LONG, -ARM),
            (-ARM, -ARM),
        ];
        match self {
            Self::Disc => ring(24, 0.0, |_| 1.0),
            Self::Square => ring(4, 45.0, |_| 1.25),
            Self::Diamond => ring(4, 0.0, |_| 1.25),
            Self::Up => ring(3, -90.0, |_| 1.3),
            Self::Down => ring(3, 90.0, |_| 1.3),
            Self::Left => ring(3, 180.0, |_| 1.3),
            Self::Right => ring(3, 0.0, |_| 1.3),
            Self::Pentagon => ring(5, -90.0, |_| 1.15),
            Self::Star => ring(10, -90.0, |k| if k % 2 == 0 { 1.45 } else { 0.6 }),
            Self::Plus => plus.to_vec(),
            Self::Cross => {
                let half = std::f64::consts::FRAC_1_SQRT_2;
                let turned = plus.map(|(x, y)| (half * (x - y), half * (x + y)));
                turned.to_vec()
            }
            Self::Hourglass => vec![(-1.0, -1.1), (1.0, -1.1), (-1.0, 1.1), (1.0, 1.1)],
        }
    }
}

fn pairs(points: &[(f64, f64)]) -> String {
    let pair = |(x, y): &(f64, f64)| format!("{},{}", n(*x), n(*y));
    points.iter().map(pair).collect::<Vec<_>>().join(" ")
}

/// About how wide a text is in a sans-serif of this size, rather too wide than too narrow.
pub fn text_width(text: &str, size: f64) -> f64 {
    0.58 * size * crate::report::number::width(text) as f64
}

/// A coordinate with two decimals at most.
fn n(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0",
        _ => text,
    }
    .to_owned()
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
        let text = svg.finish_alone("x", "</title>", "");
        assert!(
            !text.contains("<b>") && !text.contains("</title></title>"),
            "{text}"
        );
    }
}
