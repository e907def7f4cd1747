//! What the worker hands back: numbers and pictures, ready to be shown.

use std::sync::Arc;

use crate::cost::{Configuration, Measured, Times, Truth};
use crate::render::FloatImage;
use crate::report::colour_map::{blue_white_red, magma};
use crate::stimulus::manifest::Picture;

/// Error of the occlusion coefficient at the ends of the map's scale.
pub const LARGEST_ERROR: f32 = 0.5;

/// FLIP at the end of the map's scale: all there is would leave the rest dark.
pub const LARGEST_FLIP: f32 = 0.5;

/// What a measurement is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slot {
    /// What the controls say.
    Now,
    /// What is pinned as A.
    A,
    /// What is pinned as B.
    B,
}

impl Slot {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Now, Self::A, Self::B];

    /// For people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Now => "Now",
            Self::A => "A",
            Self::B => "B",
        }
    }
}

/// What is to be measured.
#[derive(Debug, Clone)]
pub struct Request {
    /// Tells it from every other.
    pub number: u64,
    /// The technique and its blur.
    pub configuration: Configuration,
    /// Under which lighting.
    pub lighting: String,
    /// Reach of the truth it is measured against, metres.
    pub reach_m: f64,
}

/// What can be looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// The image.
    Image,
    /// The occlusion, 0 closed to 1 open.
    Occlusion,
    /// Occlusion minus truth.
    Error,
    /// What can be seen of the error.
    Flip,
    /// The image with the true occlusion.
    Truth,
}

impl Look {
    /// All of them, in the order of their keys, with their names.
    pub const ALL: [(Self, &'static str); 5] = [
        (Self::Image, "Image"),
        (Self::Occlusion, "Occlusion"),
        (Self::Error, "Error"),
        (Self::Flip, "FLIP"),
        (Self::Truth, "Truth image"),
    ];
}

/// The numbers of a measured configuration.
#[derive(Debug, Clone)]
pub struct Numbers {
    /// What its passes take; `None` where it runs none.
    pub times: Option<Times>,
    /// Of its occlusion against the truth.
    pub rmse: f64,
    /// Above 0 it is too open.
    pub bias: f64,
    /// Against the best answer that the depth buffer allows.
    pub estimator_rmse: f64,
    /// Of that answer against the truth.
    pub information_loss: f64,
    /// Mean of FLIP against the image with the true occlusion.
    pub flip_mean: f64,
    /// Its 95th percentile.
    pub flip_p95: f64,
    /// Mean structural similarity.
    pub ssim: f64,
    /// Standard error of the truth.
    pub truth_error: f64,
}

/// A measured configuration with its pictures.
#[derive(Debug)]
pub struct Shown {
    /// What was asked for.
    pub request: Request,
    /// Its numbers.
    pub numbers: Numbers,
    pictures: [Arc<Picture>; 5],
    occlusion: Arc<FloatImage>,
    truth: Arc<FloatImage>,
    flip: Vec<f32>,
}

/// What is known of one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pixel {
    /// The technique's occlusion.
    pub occlusion: f32,
    /// The true one.
    pub truth: f32,
    /// FLIP.
    pub flip: f32,
}

impl Shown {
    /// Of a measurement under one lighting; `None` if it has no image.
    pub(super) fn new(
        request: Request,
        measured: Measured,
        truth: &Truth,
        true_picture: &Arc<Picture>,
    ) -> Option<Self> {
        let image = measured.images.into_iter().next()?;
        let occlusion = measured.occlusion;
        let size_px = (image.picture.width_px, image.picture.height_px);
        let error = truth.error_map(&occlusion);
        let grey = |value: f32| [(value.clamp(0.0, 1.0) * 255.0).round() as u8; 3];
        let signed = |value: f32| blue_white_red(0.5 + 0.5 * value / LARGEST_ERROR);
        let seen = |value: f32| magma(value / LARGEST_FLIP);
        Some(Self {
            numbers: Numbers {
                times: measured.times,
                rmse: measured.error.rmse,
                bias: measured.error.bias,
                estimator_rmse: measured.estimator_error.rmse,
                information_loss: measured.information_loss.rmse,
                flip_mean: image.flip.mean(),
                flip_p95: f64::from(image.flip.percentile(0.95)),
                ssim: image.ssim,
                truth_error: truth.standard_error,
            },
            pictures: [
                Arc::new(image.picture),
                picture(&occlusion.values, size_px, grey),
                picture(&error, size_px, signed),
                picture(&image.flip.values, size_px, seen),
                true_picture.clone(),
            ],
            request,
            occlusion,
            truth: truth.occlusion.clone(),
            flip: image.flip.values,
        })
    }

    /// What is to be looked at.
    #[must_use]
    pub fn picture(&self, look: Look) -> &Picture {
        &self.pictures[look as usize]
    }

    /// What is known of a pixel; `None` outside of the picture.
    #[must_use]
    pub fn at(&self, (x, y): (u32, u32)) -> Option<Pixel> {
        let index = (y * self.occlusion.width_px + x) as usize;
        (x < self.occlusion.width_px).then_some(Pixel {
            occlusion: *self.occlusion.values.get(index)?,
            truth: *self.truth.values.get(index)?,
            flip: *self.flip.get(index)?,
        })
    }
}

/// Numbers as colours.
fn picture(
    values: &[f32],
    (width_px, height_px): (u32, u32),
    colour: impl Fn(f32) -> [u8; 3],
) -> Arc<Picture> {
    let opaque = |value: &f32| {
        let [red, green, blue] = colour(*value);
        [red, green, blue, 255]
    };
    Arc::new(Picture {
        width_px,
        height_px,
        rgba8: values.iter().flat_map(opaque).collect(),
    })
}
