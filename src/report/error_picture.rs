//! A map of numbers as a picture: a colour a pixel, and below it what the colours mean.

use image::ImageEncoder;

use super::canvas::{Canvas, LETTER_PX, width_px, wrapped};
use super::colour_map::{blue_white_red, magma};

/// Columns that a picture has at least, so that the numbers of the bar have room.
const LEAST_WIDTH_PX: u32 = 320;
/// Columns from which on letters are twice as large.
const WIDE_PX: u32 = 640;
const GROUND: [u8; 3] = [255; 3];
const INK: [u8; 3] = [20; 3];
/// For what is no number; neither map has a grey but white and nearly black.
const NO_NUMBER: [u8; 3] = [128; 3];

/// Which numbers get which colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// Sizes, 0 to this: [`magma`].
    Size(f32),
    /// Signed differences, minus this to this, white at 0: [`blue_white_red`].
    Signed(f32),
}

impl Scale {
    fn ends(self) -> (f32, f32) {
        match self {
            Self::Size(top) => (0.0, top),
            Self::Signed(top) => (-top, top),
        }
    }

    /// The colour at a share, 0 to 1, of the way from the lowest to the highest.
    fn at(self, share: f32) -> [u8; 3] {
        match self {
            Self::Size(_) => magma(share),
            Self::Signed(_) => blue_white_red(share),
        }
    }

    fn of(self, value: f32) -> [u8; 3] {
        if value.is_nan() {
            return NO_NUMBER;
        }
        let (low, high) = self.ends();
        self.at((value - low) / (high - low))
    }
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum ErrorPictureError {
    /// Too many or too few numbers.
    #[error("{found} values are not a map of {width_px}×{height_px} pixels")]
    Count {
        /// How many there are.
        found: usize,
        /// Columns asked for.
        width_px: u32,
        /// Rows asked for.
        height_px: u32,
    },
    /// A scale that ends at 0, below it, or nowhere.
    #[error("a scale cannot end at {0}; it needs a number above 0")]
    Scale(f32),
    /// The PNG writer gave up.
    #[error("the picture cannot be encoded: {0}")]
    Png(#[from] image::ImageError),
}

/// Draws a map of `width_px` by `height_px` numbers, rows from the top, with a bar of the scale's
/// colours and the texts below it, each on its own line or lines. Numbers outside the scale get the
/// colour of its end, and the bar then says ≥ or ≤ there; what is no number is grey. The picture is
/// as wide as the map, but at least 320 pixels.
///
/// # Errors
/// [`ErrorPictureError::Count`] or [`ErrorPictureError::Scale`].
pub fn draw(
    values: &[f32],
    (map_width_px, map_height_px): (u32, u32),
    scale: Scale,
    texts: &[&str],
) -> Result<Canvas, ErrorPictureError> {
    if values.len() as u64 != u64::from(map_width_px) * u64::from(map_height_px) {
        return Err(ErrorPictureError::Count {
            found: values.len(),
            width_px: map_width_px,
            height_px: map_height_px,
        });
    }
    let (_, top) = scale.ends();
    if !(top > 0.0 && top.is_finite()) {
        return Err(ErrorPictureError::Scale(top));
    }
    let width = map_width_px.max(LEAST_WIDTH_PX);
    let letter_scale = if width >= WIDE_PX { 2 } else { 1 };
    let gap = LETTER_PX * letter_scale;
    let letters = ((width - 2 * gap) / gap) as usize;
    let lines: Vec<String> = texts
        .iter()
        .flat_map(|text| wrapped(text, letters))
        .collect();
    // From the top: map, gap, bar, ticks, numbers, and lines of text with half a letter between.
    let line_px = gap + gap / 2;
    let below_px = gap + bar_height_px(letter_scale) + lines.len() as u32 * line_px + gap;
    let mut canvas = Canvas::new(width, map_height_px.saturating_add(below_px), GROUND);
    let left = (width - map_width_px) / 2;
    let places = (0..map_height_px).flat_map(|y| (0..map_width_px).map(move |x| (x, y)));
    for ((x, y), &value) in places.zip(values) {
        canvas.set(left + x, y, scale.of(value));
    }
    let bar_top = map_height_px + gap;
    draw_bar(
        &mut canvas,
        bar_top,
        letter_scale,
        scale,
        Clipped::of(values, scale),
    );
    let mut y = bar_top + bar_height_px(letter_scale);
    for line in &lines {
        canvas.write(line, (gap, y), letter_scale, INK);
        y += line_px;
    }
    Ok(canvas)
}

/// A drawn picture as the bytes of a PNG: 8-bit RGB, the same bytes for the same picture.
///
/// # Errors
/// [`ErrorPictureError::Png`]; none is known to occur for a picture of [`draw`].
pub fn encode(picture: &Canvas) -> Result<Vec<u8>, ErrorPictureError> {
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes).write_image(
        &picture.rgb8,
        picture.width_px,
        picture.height_px,
        image::ExtendedColorType::Rgb8,
    )?;
    Ok(bytes)
}

/// Whether numbers lie outside the scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Clipped {
    below: bool,
    above: bool,
}

impl Clipped {
    fn of(values: &[f32], scale: Scale) -> Self {
        let (low, high) = scale.ends();
        Self {
            below: values.iter().any(|&value| value < low),
            above: values.iter().any(|&value| value > high),
        }
    }
}

/// Bar, ticks, numbers and the space below them.
fn bar_height_px(letter_scale: u32) -> u32 {
    (LETTER_PX * 3 + LETTER_PX / 2) * letter_scale + tick_px(letter_scale)
}

fn tick_px(letter_scale: u32) -> u32 {
    3 * letter_scale
}

/// The bar, framed, across the picture, with ticks and numbers under it.
fn draw_bar(canvas: &mut Canvas, y: u32, letter_scale: u32, scale: Scale, clipped: Clipped) {
    let letter = LETTER_PX * letter_scale;
    let (left, height) = (letter, letter);
    let width = canvas.width_px - 2 * letter;
    canvas.fill((left - 1, y - 1), (width + 2, height + 2), INK);
    let last = width - 1;
    for x in 0..width {
        let colour = scale.at(x as f32 / last as f32);
        canvas.fill((left + x, y), (1, height), colour);
    }
    for step in 0..=4 {
        let x = left + last * step / 4;
        canvas.fill((x, y + height), (1, tick_px(letter_scale)), INK);
    }
    let under = y + height + tick_px(letter_scale) + letter_scale;
    for (start, text) in numbers(scale, clipped, (left, width), letter_scale) {
        canvas.write(&text, (start, under), letter_scale, INK);
    }
}

/// The numbers of a bar that starts at a column and has so many, each with the column where it
/// starts: under the middle of its tick, but not over the ends of the bar. Those of the ends and of
/// the middle are always there, those of the quarters where they have room.
fn numbers(
    scale: Scale,
    clipped: Clipped,
    (left, width): (u32, u32),
    letter_scale: u32,
) -> Vec<(u32, String)> {
    let (low, high) = scale.ends();
    let mut found: Vec<(u32, String)> = Vec::new();
    for step in [0, 4, 2, 1, 3] {
        let sign = match step {
            0 if clipped.below => "≤ ",
            4 if clipped.above => "≥ ",
            _ => "",
        };
        let text = format!("{sign}{}", short(low + (high - low) * step as f32 / 4.0));
        let wide = width_px(&text, letter_scale);
        let latest = (left + width).saturating_sub(wide).max(left);
        let tick = left + (width - 1) * step / 4;
        let start = tick.saturating_sub(wide / 2).clamp(left, latest);
        // Half a letter's width between two numbers.
        let space = LETTER_PX / 2 * letter_scale;
        let free = found.iter().all(|(other, text)| {
            start + wide + space <= *other || other + width_px(text, letter_scale) + space <= start
        });
        if free {
            found.push((start, text));
        }
    }
    found
}

/// A number with three digits that count, without zeros at the end.
fn short(value: f32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let power = value.abs().log10().floor();
    if !(-4.0..6.0).contains(&power) {
        return format!("{value:.1e}");
    }
    let decimals = (2.0 - power).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(canvas: &Canvas, x: u32, y: u32) -> [u8; 3] {
        let at = 3 * (y * canvas.width_px + x) as usize;
        [0, 1, 2].map(|channel| canvas.rgb8[at + channel])
    }

    #[test]
    fn numbers_get_the_colours_of_the_scale() {
        let mut values = vec![0.0; 400 * 2];
        values[..5].copy_from_slice(&[-0.5, 0.25, 0.5, 9.0, f32::NAN]);
        let drawn = draw(&values, (400, 2), Scale::Signed(0.5), &[]).unwrap();
        let found = [0, 1, 2, 3, 4, 5].map(|x| pixel(&drawn, x, 0));
        let expected = [0.0, 0.75, 1.0, 1.0].map(blue_white_red);
        assert_eq!(found[..4], expected);
        assert_eq!(found[4..], [NO_NUMBER, [255; 3]]);
        let sizes = draw(&values, (400, 2), Scale::Size(0.5), &[]).unwrap();
        let found = [0, 1, 2].map(|x| pixel(&sizes, x, 0));
        assert_eq!(found, [0.0, 0.5, 1.0].map(magma));
    }

    /// Only the two letters "≥ " and the shifted number differ, so a clipped map has more ink.
    #[test]
    fn the_bar_says_what_was_clipped() {
        let ink = |values: &[f32]| {
            let drawn = draw(values, (400, 1), Scale::Size(0.5), &[]).unwrap();
            let below = drawn.rgb8[3 * 400..].chunks_exact(3);
            below.filter(|colour| **colour == INK).count()
        };
        let [inside, above, below] = [0.5, 0.6, -0.1].map(|value| ink(&[value; 400]));
        assert!(above > inside && below > inside);
        let both = [vec![0.6; 200], vec![-0.1; 200]].concat();
        assert_eq!(ink(&both) - inside, above - inside + below - inside);
    }

    /// At 320 pixels "≤ -0.025" and "-0.0125" would run into each other; the quarters go.
    #[test]
    fn numbers_do_not_run_into_each_other() {
        let clipped = Clipped {
            below: true,
            above: true,
        };
        let shown = |top: f32| {
            let mut found = numbers(Scale::Signed(top), clipped, (8, 304), 1);
            found.sort();
            found
        };
        let texts = |top: f32| shown(top).into_iter().map(|(_, text)| text);
        assert!(texts(0.5).eq(["≤ -0.5", "-0.25", "0", "0.25", "≥ 0.5"]));
        assert!(texts(0.025).eq(["≤ -0.025", "0", "≥ 0.025"]));
        for top in [0.5, 0.025, 1.0, 1e-7, 123_456.0] {
            let found = shown(top);
            assert_eq!(found[0].0, 8);
            let ends = |(start, text): &(u32, String)| start + width_px(text, 1);
            assert!(found.windows(2).all(|pair| ends(&pair[0]) + 4 <= pair[1].0));
            assert_eq!(found.last().map(ends), Some(312));
        }
    }

    #[test]
    fn small_maps_stand_in_the_middle_and_texts_wrap() {
        let short = draw(&[1.0], (1, 1), Scale::Size(1.0), &["one line"]).unwrap();
        assert_eq!(short.width_px, LEAST_WIDTH_PX);
        assert_eq!(pixel(&short, 159, 0), magma(1.0));
        assert_eq!(pixel(&short, 158, 0), GROUND);
        let long = "gtao 16, full: occlusion minus truth, drawn by an adapter with a long name";
        let wrapped = draw(&[1.0], (1, 1), Scale::Size(1.0), &[long]).unwrap();
        assert_eq!(
            wrapped.height_px,
            short.height_px + LETTER_PX + LETTER_PX / 2
        );
        let wide = draw(&[1.0; 1280], (1280, 1), Scale::Size(1.0), &["one line"]).unwrap();
        assert_eq!(wide.height_px - 1, 2 * (short.height_px - 1));
    }

    #[test]
    fn nonsense_is_refused() {
        let count = draw(&[0.0; 5], (2, 3), Scale::Size(1.0), &[]);
        assert!(matches!(
            count,
            Err(ErrorPictureError::Count { found: 5, .. })
        ));
        for top in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            let scale = draw(&[0.0], (1, 1), Scale::Signed(top), &[]);
            assert!(matches!(scale, Err(ErrorPictureError::Scale(_))), "{top}");
        }
        let empty = draw(&[], (0, 0), Scale::Size(1.0), &[]).unwrap();
        assert!(encode(&empty).is_ok());
    }

    #[test]
    fn a_png_decodes_to_the_same_pixels() {
        let drawn = draw(&[0.1, 0.9], (2, 1), Scale::Size(1.0), &["two"]).unwrap();
        let decoded = image::load_from_memory(&encode(&drawn).unwrap()).unwrap();
        assert_eq!(decoded.to_rgb8().into_raw(), drawn.rgb8);
    }

    #[test]
    fn numbers_are_short() {
        let known = [
            (0.5, "0.5"),
            (-0.0125, "-0.0125"),
            (0.1 + 0.2, "0.3"),
            (1.0 / 3.0, "0.333"),
            (1.0, "1"),
            (150.0, "150"),
            (62.5, "62.5"),
            (1e-7, "1.0e-7"),
            (3e9, "3.0e9"),
        ];
        for (value, text) in known {
            assert_eq!(short(value), text);
        }
    }
}
