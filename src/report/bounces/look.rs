//! Colours, and the keys that say what they stand for.
//!
//! Maps have the colours of techniques elsewhere, which people with any common colour blindness tell
//! apart. What comes in an order, bounces, albedos and amplitudes, has steps of one ramp, from dark
//! to light on white and the other way round on black.

use std::fmt::Write as _;

use crate::report::colour_map::magma;
use crate::report::figure::sheet::{Key, MARGIN, Sheet, WIDTH};
use crate::report::svg::{Anchor, Svg, text_width};

/// Colours of the ramp.
const STEPS: usize = 21;
/// Colours for numbers.
const HEAT: usize = 32;
/// Parts of magma that show on white and on black.
const ON_WHITE: (f32, f32) = (0.12, 0.76);
const ON_BLACK: (f32, f32) = (0.44, 0.98);
/// Share of magma that stands for the least number.
const DARKEST: f32 = 0.14;
/// How many colours of maps `figure.css` has.
const MAPS: usize = 12;

/// Class of one of several things that come in an order.
pub fn step(place: usize, of: usize) -> String {
    let last = of.saturating_sub(1).max(1);
    format!("r{}", (place.min(last) * (STEPS - 1) + last / 2) / last)
}

/// Class of a bounce: the direct light and the first bounce are told apart by hue, those that follow
/// are steps of the ramp.
pub fn bounce(bounce: usize, last: usize) -> String {
    /// Bounces that the notes show.
    const USUAL: usize = 20;
    match bounce {
        0 => String::from("t0"),
        1 => String::from("t1"),
        later => step(later - 2, last.max(USUAL) - 1),
    }
}

/// Class of a map by its place in the study.
pub fn map(place: usize) -> String {
    format!("t{}", place % MAPS)
}

/// Class of the area of a number by its share of a scale, 0 to 1.
pub fn heat(share: f64) -> String {
    format!("h{}", (share.clamp(0.0, 1.0) * (HEAT - 1) as f64).round())
}

/// The style of these figures, besides that of all.
pub fn style() -> String {
    let mut style = String::from(include_str!("bounces.css"));
    let ramp = |style: &mut String, (low, high): (f32, f32)| {
        for step in 0..STEPS {
            let share = low + (high - low) * step as f32 / (STEPS - 1) as f32;
            let _ = writeln!(style, ".bounces .r{step} {{ --c: {}; }}", hex(magma(share)));
        }
    };
    ramp(&mut style, ON_WHITE);
    style.push_str("@media (prefers-color-scheme: dark) {\n");
    ramp(&mut style, ON_BLACK);
    style.push_str("}\n");
    for step in 0..HEAT {
        // Not from black on, in which the lines of a surface would drown.
        let share = DARKEST + (1.0 - DARKEST) * step as f32 / (HEAT - 1) as f32;
        let colour = hex(magma(share));
        let _ = writeln!(style, ".bounces .h{step} {{ fill: {colour}; }}");
    }
    style
}

/// A colour as CSS has it.
pub fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Ends a figure of this room.
pub fn finish(sheet: Sheet, captions: &[String], y: f64) -> String {
    sheet.finish("bounces", captions, y, &style())
}

/// Keys from the left in as many rows as they need, the first at `y`; the height below the last.
pub fn keys(sheet: &mut Sheet, y: f64, keys: &[(Key<'_>, String)]) -> f64 {
    let (mut x, mut y) = (MARGIN, y);
    for (key, text) in keys {
        let wide = 48.0 + text_width(text, 12.0);
        if x > MARGIN && x + wide > WIDTH {
            (x, y) = (MARGIN, y + 19.0);
        }
        sheet.key(x, y, key, text);
        x += wide;
    }
    y + 14.0
}

/// A strip of colours from the left with a word at each end; its right end.
pub fn strip(
    svg: &mut Svg,
    (left, y): (f64, f64),
    ends: [&str; 2],
    classes: impl Iterator<Item = String>,
) -> f64 {
    const WIDE: f64 = 9.0;
    svg.text("key", left, y, Anchor::Start, ends[0]);
    let mut x = left + text_width(ends[0], 12.0) + 6.0;
    for class in classes {
        svg.rect(&format!("area {class}"), x, y - 10.0, WIDE, 11.0);
        x += WIDE;
    }
    svg.text("key", x + 6.0, y, Anchor::Start, ends[1]);
    x + 6.0 + text_width(ends[1], 12.0)
}
