//! Figures as pixels: for documents that take no SVG, and for the application's own page.
//!
//! The letters are DejaVu Sans, which the program carries, so that a figure has the same pixels on
//! every machine; letters it lacks are taken from the system's fonts where there are any.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use image::{ImageFormat, RgbaImage};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use super::ReportError;

/// Pixels a unit of the drawing: sharp at half a page's width in print.
const PNG_SCALE: f32 = 2.0;

const FAMILY: &str = "DejaVu Sans";

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    // The first of a name is taken: ours stand before the system's.
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.load_font_data(dejavu::sans::bold().to_vec());
    fonts.load_system_fonts();
    fonts.set_sans_serif_family(FAMILY);
    Arc::new(fonts)
});

/// The figure as a PNG file, in its light colours.
///
/// # Errors
/// [`ReportError::Figure`] for a text that is no SVG.
pub fn png(svg: &str) -> Result<Vec<u8>, ReportError> {
    let picture = pixels(svg, PNG_SCALE)?;
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|error| ReportError::Figure(error.to_string()))?;
    Ok(bytes.into_inner())
}

/// The figure as pixels, so many a unit of the drawing, opaque, in its light colours.
///
/// # Errors
/// [`ReportError::Figure`] for a text that is no SVG.
pub fn pixels(svg: &str, scale: f32) -> Result<RgbaImage, ReportError> {
    let options = Options {
        fontdb: Arc::clone(&FONTS),
        font_family: FAMILY.to_owned(),
        ..Options::default()
    };
    let tree = Tree::from_str(&plain(svg), &options)
        .map_err(|error| ReportError::Figure(error.to_string()))?;
    let side = |length: f32| (length * scale).ceil().clamp(1.0, 16_384.0) as u32;
    let size = (side(tree.size().width()), side(tree.size().height()));
    let too_large = || ReportError::Figure("the drawing is too large".to_owned());
    let mut canvas = Pixmap::new(size.0, size.1).ok_or_else(too_large)?;
    canvas.fill(resvg::tiny_skia::Color::WHITE);
    let transform = Transform::from_scale(scale, scale);
    resvg::render(&tree, transform, &mut canvas.as_mut());
    // Opaque everywhere, so premultiplied is plain.
    RgbaImage::from_raw(size.0, size.1, canvas.take()).ok_or_else(too_large)
}

/// The style in the words that every SVG renderer understands: dark mode left out, variables put
/// in, one family of letters.
fn plain(svg: &str) -> String {
    let without_dark = without_media(svg);
    let values = variables(&without_dark);
    let mut text = without_dark;
    for (name, value) in &values {
        text = text.replace(&format!("var({name})"), value);
    }
    text.replace(
        "font: 12px system-ui, \"Segoe UI\", \"Helvetica Neue\", \"DejaVu Sans\", sans-serif",
        &format!("font-family: '{FAMILY}'; font-size: 12px"),
    )
}

/// Without `@media … { … }`.
fn without_media(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find("@media") {
        kept.push_str(&rest[..start]);
        let mut depth = 0_usize;
        let end = rest[start..].char_indices().find_map(|(at, c)| match c {
            '{' => {
                depth += 1;
                None
            }
            '}' => {
                depth = depth.saturating_sub(1);
                (depth == 0).then_some(start + at + 1)
            }
            _ => None,
        });
        rest = end.map_or("", |end| &rest[end..]);
    }
    kept + rest
}

/// `--name: value;` by name; of a name that is given twice, the first.
fn variables(text: &str) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for piece in text.split(['{', ';', '}']) {
        let Some((name, value)) = piece.trim().split_once(':') else {
            continue;
        };
        if name.starts_with("--") && !name.contains(char::is_whitespace) {
            found
                .entry(name.to_owned())
                .or_insert_with(|| value.trim().to_owned());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_are_made_plain() {
        let svg = "<style>.x { --ink: #123456; --b: #00f; }\n@media (dark) { .x { --ink: #fff; } }\n.x .y { fill: var(--ink); }</style>";
        let plain = plain(svg);
        assert!(plain.contains("fill: #123456"), "{plain}");
        assert!(!plain.contains("@media"), "{plain}");
    }

    #[test]
    fn a_figure_has_the_colours_of_its_style_and_letters() {
        let svg = "<svg class=\"s\" width=\"40\" height=\"20\" viewBox=\"0 0 40 20\" xmlns=\"http://www.w3.org/2000/svg\"><style>.s { --b: #1f6aa5; }\n.s .b { fill: var(--b); } .s text { font: 12px system-ui, \"Segoe UI\", \"Helvetica Neue\", \"DejaVu Sans\", sans-serif; }</style><rect class=\"b\" x=\"0\" y=\"0\" width=\"10\" height=\"20\"/><text x=\"20\" y=\"15\">M</text></svg>";
        let picture = pixels(svg, 1.0).unwrap();
        assert_eq!(picture.dimensions(), (40, 20));
        assert_eq!(picture.get_pixel(4, 10).0, [0x1f, 0x6a, 0xa5, 255]);
        assert_eq!(picture.get_pixel(14, 2).0, [255, 255, 255, 255]);
        let dark = picture
            .enumerate_pixels()
            .filter(|(x, _, pixel)| *x >= 20 && pixel.0[0] < 100)
            .count();
        assert!(dark > 10, "the letter has {dark} dark pixels");
    }

    #[test]
    fn what_is_no_svg_is_said() {
        assert!(pixels("<p>", 1.0).is_err());
    }
}
