//! What the figures of shares have in common: one row a condition, an axis from 0 to 100 %.

use crate::analysis::dataset::{ConditionData, Votes};
use crate::report::figure::sheet::{MARGIN, WIDTH, shortened};
use crate::report::svg::{Anchor, Svg};

/// Left end of the scale; the names stand before it.
pub const LEFT: f64 = 236.0;
/// Right end of the scale, where nothing stands behind it.
pub const RIGHT: f64 = WIDTH - MARGIN - 10.0;

/// An axis of shares between two places.
#[derive(Clone, Copy)]
pub struct Shares {
    /// Place of 0 %.
    pub left: f64,
    /// Place of 100 %.
    pub right: f64,
}

impl Shares {
    /// Over the whole width.
    pub const WHOLE: Self = Self {
        left: LEFT,
        right: RIGHT,
    };

    /// Where a share lies, 0 to 1.
    pub fn x(self, share: f64) -> f64 {
        self.left + (self.right - self.left) * share
    }

    /// The grid from `top` to `bottom`, with its numbers above and the even split marked.
    pub fn grid(self, svg: &mut Svg, top: f64, bottom: f64) {
        for percent in [0, 25, 50, 75, 100] {
            let at = self.x(f64::from(percent) / 100.0);
            let label = format!("{percent} %");
            svg.text("tick", at, top - 8.0, Anchor::Middle, &label);
            svg.line("grid", (at, top), (at, bottom));
        }
        svg.line("even", (self.x(0.5), top), (self.x(0.5), bottom));
    }

    /// Two parts of a whole as one bar, with their counts at the outer ends; `what` is said where
    /// there is nothing.
    pub fn bar(self, svg: &mut Svg, votes: Votes, (top, height): (f64, f64), what: &str) {
        let Some(share_b) = votes.share_b() else {
            svg.rect("none", self.left, top, self.right - self.left, height);
            let middle = top + height / 2.0 + 4.0;
            svg.text("tick", self.x(0.25), middle, Anchor::Middle, what);
            return;
        };
        let border = self.x(1.0 - share_b);
        svg.rect("a", self.left, top, border - self.left, height);
        svg.rect("b", border, top, self.right - border, height);
        let middle = top + height / 2.0 + 4.5;
        if votes.a > 0 {
            let count = votes.a.to_string();
            svg.text("count-a", self.left + 8.0, middle, Anchor::Start, &count);
        }
        if votes.b > 0 {
            let count = votes.b.to_string();
            svg.text("count-b", self.right - 8.0, middle, Anchor::End, &count);
        }
    }
}

/// A condition's name before its row, with the hypothesis it asks below.
pub fn name(svg: &mut Svg, condition: &ConditionData, y: f64) {
    match condition.hypothesis.as_deref().filter(|h| !h.is_empty()) {
        Some(hypothesis) => {
            text(svg, "label", &condition.id, y - 2.5);
            text(svg, "side", hypothesis, y + 12.0);
        }
        None => text(svg, "label", &condition.id, y + 4.5),
    }
}

/// A text before a row.
pub fn text(svg: &mut Svg, class: &str, text: &str, y: f64) {
    let shown = shortened(text, 13.0, LEFT - 16.0 - MARGIN);
    svg.text(class, LEFT - 16.0, y, Anchor::End, &shown);
}

/// As many conditions as a figure shows, and the sentence on those it does not.
pub fn first_rows(conditions: &[ConditionData]) -> (&[ConditionData], String) {
    let shown = &conditions[..conditions.len().min(super::MOST_ROWS)];
    let rest = conditions.len() - shown.len();
    let note = match rest {
        0 => String::new(),
        _ => format!(" {rest} conditions more are in the table."),
    };
    (shown, note)
}
