//! What one configuration takes, how wrong it is, and what can be seen of it.

use std::sync::Arc;

use super::error::OcclusionError;
use super::spread::Spread;
use crate::render::{Clock, FloatImage, Picture};
use crate::stimulus::flip::FlipMap;

/// A measured configuration.
#[derive(Debug, Clone)]
pub struct Measured {
    /// What its passes take; `None` where it runs none.
    pub times: Option<Times>,
    /// Of its occlusion against the ray-traced truth.
    pub error: OcclusionError,
    /// Of its occlusion against the best answer that the depth buffer allows, at some of the
    /// pixels: what a better estimator would not get wrong.
    pub estimator_error: OcclusionError,
    /// Of that answer against the truth: what the depth buffer does not tell. No strict floor, as
    /// errors of two kinds may cancel.
    pub information_loss: OcclusionError,
    /// Its occlusion, 0 closed to 1 open.
    pub occlusion: Arc<FloatImage>,
    /// Its images, one a lighting variant.
    pub images: Vec<ImageMeasured>,
}

/// Times of the passes of a technique: itself, its blur, its upsampling.
#[derive(Debug, Clone, PartialEq)]
pub struct Times {
    /// What measured them.
    pub clock: Clock,
    /// All together, milliseconds.
    pub total_ms: Spread,
    /// Median of the technique's own pass, milliseconds, where the clock can tell.
    pub occlusion_ms: Option<f64>,
    /// Median of the blur.
    pub blur_ms: Option<f64>,
    /// Median of the upsampling.
    pub upsample_ms: Option<f64>,
}

/// An image beside the one with the true occlusion.
#[derive(Debug, Clone)]
pub struct ImageMeasured {
    /// The lighting variant.
    pub lighting: String,
    /// The image.
    pub picture: Picture,
    /// What a person could see, by FLIP.
    pub flip: FlipMap,
    /// Mean structural similarity, 1 for the same image.
    pub ssim: f64,
}
