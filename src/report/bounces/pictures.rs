//! What each way of adding light between surfaces makes of a map in its colours, beside the truth.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::Figure;
use super::look::{finish, hex};
use crate::reference::bounce_fit::{ColourPicture, Study};
use crate::report::canvas::Canvas;
use crate::report::colour_map::blue_white_red;
use crate::report::error_picture::encode;
use crate::report::figure::numbers::{fixed, significant};
use crate::report::figure::sheet::{MARGIN, Sheet, WIDTH, shortened};
use crate::report::svg::{Anchor, Svg};
use crate::scene::srgb::encode_u8;

/// Name of what is compared with.
const TRUTH: &str = "truth";
const COLUMNS: usize = 4;
const GAP: f64 = 12.0;
/// Columns of a picture inside the figure at most: twice what it is shown at.
const MOST_PX: usize = 384;
/// Brightest that the exposure makes what is darker, as a factor.
const MOST_EXPOSURE: f32 = 4.0;

/// A picture as it is shown: fewer pixels, linear.
struct Shown<'a> {
    name: &'a str,
    size_px: (usize, usize),
    rgb: Vec<[f32; 3]>,
}

/// Pictures, truth first, with their signed differences below; none where there are no pictures,
/// or no truth among them.
pub fn figure(study: &Study) -> Option<Figure> {
    let shown: Vec<Shown> = study.pictures.iter().filter_map(Shown::of).collect();
    let truth = shown.iter().find(|picture| picture.name == TRUTH)?;
    let same = |picture: &&Shown| picture.size_px == truth.size_px && picture.name != TRUTH;
    let others: Vec<&Shown> = shown.iter().filter(same).collect();
    let title = "Light between surfaces in colour: off, models and truth";
    let mut sheet = Sheet::new(title);
    let exposure = exposure(truth);
    let limit = limit(truth, &others);
    bar(&mut sheet.svg, limit);
    let wide = (WIDTH - 2.0 * MARGIN + GAP) / COLUMNS as f64 - GAP;
    let high = wide * truth.size_px.1 as f64 / truth.size_px.0 as f64;
    let step = 2.0 * high + 62.0;
    let all: Vec<&Shown> = std::iter::once(truth).chain(others).collect();
    for (index, picture) in all.iter().enumerate() {
        let left = MARGIN + (index % COLUMNS) as f64 * (wide + GAP);
        let top = 82.0 + (index / COLUMNS) as f64 * step;
        let name = shortened(picture.name, 13.0, wide);
        let svg = &mut sheet.svg;
        svg.text("panel-title", left, top - 7.0, Anchor::Start, &name);
        svg.image((left, top), (wide, high), &picture.png(exposure)?);
        if index == 0 {
            svg.text(
                "tick",
                left,
                top + high + 18.0,
                Anchor::Start,
                "below: minus the truth",
            );
            continue;
        }
        svg.image(
            (left, top + high + 4.0),
            (wide, high),
            &picture.difference(truth, limit)?,
        );
        let missed = format!("rmse {} of linear RGB", fixed(picture.rmse(truth), 4));
        svg.text(
            "tick",
            left,
            top + 2.0 * high + 20.0,
            Anchor::Start,
            &missed,
        );
    }
    let bottom = 82.0 + all.len().div_ceil(COLUMNS) as f64 * step;
    let [red, green, blue] = study.albedo.map(|channel| fixed(channel, 3));
    let map = study.maps.first().map_or("", |map| map.name.as_str());
    let captions = [format!(
        "{map}, albedo (mean, linear RGB) {red}, {green}, {blue}; radiance under a sky of unit radiance, all pictures at an exposure of {}, as sRGB. Differences: relative luminance minus the truth's.",
        significant(f64::from(exposure), 3)
    )];
    let svg = finish(sheet, &captions, bottom - 6.0);
    Some(Figure::new("colour-bleeding", title, svg))
}

impl<'a> Shown<'a> {
    /// With as many pixels averaged as leaves few enough; none of a picture that is not whole.
    fn of(picture: &'a ColourPicture) -> Option<Self> {
        let (width, height) = picture.size_px;
        if width == 0 || height == 0 || picture.rgb.len() != width * height {
            return None;
        }
        let side = width.max(height).div_ceil(MOST_PX);
        let size_px = (width.div_ceil(side), height.div_ceil(side));
        let mean = |place: usize| {
            let (x, y) = (place % size_px.0 * side, place / size_px.0 * side);
            let (right, bottom) = ((x + side).min(width), (y + side).min(height));
            let mut sum = [0.0_f32; 3];
            for row in y..bottom {
                for rgb in &picture.rgb[row * width + x..row * width + right] {
                    sum = [sum[0] + rgb[0], sum[1] + rgb[1], sum[2] + rgb[2]];
                }
            }
            sum.map(|sum| sum / ((right - x) * (bottom - y)) as f32)
        };
        Some(Self {
            name: &picture.name,
            size_px,
            rgb: (0..size_px.0 * size_px.1).map(mean).collect(),
        })
    }

    fn png(&self, exposure: f32) -> Option<String> {
        self.drawn(|place| self.rgb[place].map(|channel| encode_u8(exposure * channel)))
    }

    fn difference(&self, truth: &Self, limit: f32) -> Option<String> {
        self.drawn(|place| {
            let apart = luminance(self.rgb[place]) - luminance(truth.rgb[place]);
            blue_white_red(0.5 + 0.5 * apart / limit)
        })
    }

    fn drawn(&self, colour: impl Fn(usize) -> [u8; 3]) -> Option<String> {
        // At most `MOST_PX` each way.
        let (width, height) = (self.size_px.0 as u32, self.size_px.1 as u32);
        let canvas = Canvas {
            width_px: width,
            height_px: height,
            rgb8: (0..self.rgb.len()).flat_map(colour).collect(),
        };
        encode(&canvas).ok().map(|bytes| STANDARD.encode(bytes))
    }

    /// Root mean square over pixels and channels.
    fn rmse(&self, truth: &Self) -> f64 {
        let both = self.rgb.iter().flatten().zip(truth.rgb.iter().flatten());
        let squares: f64 = both.map(|(a, b)| f64::from(a - b).powi(2)).sum();
        (squares / (3 * truth.rgb.len()) as f64).sqrt()
    }
}

fn luminance([red, green, blue]: [f32; 3]) -> f32 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// A number that so great a share of others does not exceed.
fn quantile(numbers: impl Iterator<Item = f32>, share: f64) -> f32 {
    let mut numbers: Vec<f32> = numbers.filter(|number| number.is_finite()).collect();
    numbers.sort_by(f32::total_cmp);
    let place = (share * numbers.len() as f64) as usize;
    numbers
        .get(place.min(numbers.len().saturating_sub(1)))
        .copied()
        .unwrap_or(0.0)
}

/// Brings nearly all of the truth to what a screen can show, and makes it darker never.
fn exposure(truth: &Shown) -> f32 {
    let brightest = quantile(truth.rgb.iter().flatten().copied(), 0.995);
    (1.0 / brightest.max(1e-3)).clamp(1.0, MOST_EXPOSURE)
}

/// How far the colours of differences reach: nearly all of every picture's, in round numbers.
fn limit(truth: &Shown, others: &[&Shown]) -> f32 {
    let apart = others.iter().flat_map(|other| {
        let both = other.rgb.iter().zip(&truth.rgb);
        both.map(|(a, b)| (luminance(*a) - luminance(*b)).abs())
    });
    let most = quantile(apart, 0.98);
    let steps = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5];
    steps.into_iter().find(|step| *step >= most).unwrap_or(1.0)
}

/// What the colours of differences mean.
fn bar(svg: &mut Svg, limit: f32) {
    const CELLS: u16 = 41;
    svg.text(
        "key",
        MARGIN,
        46.0,
        Anchor::Start,
        "luminance minus the truth's:",
    );
    let (mut x, low) = (MARGIN + 180.0, format!("−{limit} or less"));
    svg.text("key", x + 80.0, 46.0, Anchor::End, &low);
    x += 88.0;
    for cell in 0..CELLS {
        let share = f32::from(cell) / f32::from(CELLS - 1);
        svg.filled(&hex(blue_white_red(share)), (x, 36.0), (4.2, 11.0));
        x += 4.0;
    }
    svg.text(
        "key",
        x + 8.0,
        46.0,
        Anchor::Start,
        &format!("+{limit} or more"),
    );
}
