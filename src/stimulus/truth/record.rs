//! `truth.json`: what each image of the truth is and where it came from.

use std::path::PathBuf;

use serde::Serialize;

use super::super::manifest::AdapterRecord;
use crate::reference::{Estimates, OcclusionSettings};

/// Name of the record in a folder of truth.
pub const FILE_NAME: &str = "truth.json";

/// Version of the record's layout.
pub const SCHEMA_VERSION: u32 = 1;

/// The record of one run.
#[derive(Debug, Clone, Serialize)]
pub struct TruthRecord {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Id of the set.
    pub set_id: String,
    /// SHA-256 of the set and its scenes, as in the set's manifest.
    pub config_sha256: String,
    /// Greyfield's version.
    pub app_version: String,
    /// What drew the points.
    pub adapter: AdapterRecord,
    /// Size of every image, pixels.
    pub size_px: (u32, u32),
    /// What was asked for.
    pub settings: OcclusionSettings,
    /// The images.
    pub images: Vec<TruthImage>,
}

/// How occlusion was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TruthKind {
    /// By rays through the scene.
    RayTraced,
    /// By rays through the depth buffer.
    ScreenSpace,
}

impl TruthKind {
    /// As it stands in file names.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::RayTraced => "ray-traced",
            Self::ScreenSpace => "screen-space",
        }
    }
}

/// One image of the truth.
#[derive(Debug, Clone, Serialize)]
pub struct TruthImage {
    /// Scene id.
    pub scene: String,
    /// How it was found.
    pub kind: TruthKind,
    /// The occlusion to look at.
    pub png: PathBuf,
    /// Occlusion and standard error as floats.
    pub exr: PathBuf,
    /// SHA-256 of the EXR.
    pub exr_sha256: String,
    /// Mean over the pixels with a surface.
    pub mean_occlusion: f64,
    /// Mean standard error over them.
    pub mean_standard_error: f64,
    /// The largest.
    pub largest_standard_error: f64,
    /// Rays a pixel with a surface.
    pub rays_per_pixel: f64,
    /// Million rays a second, directions and bookkeeping included.
    pub mrays_per_s: f64,
    /// What it took.
    pub seconds: f64,
    /// Mean over the pixels with a surface of how far the depth buffer's answer lies from the
    /// scene's, where both are there: what the depth buffer does not know.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub information_loss: Option<f64>,
    /// Of the depth buffer's answer: how deep what is seen goes on, metres; absent for solid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness_m: Option<f32>,
}

impl TruthImage {
    /// The numbers of one image, on a line.
    #[must_use]
    pub fn summary(&self) -> String {
        let loss = self.information_loss.map_or_else(String::new, |loss| {
            format!(", {loss:.4} from the ray-traced on average")
        });
        format!(
            "{} {}: mean occlusion {:.4}{loss}; standard error {:.5} on average, {:.5} at most; {:.0} rays a pixel, {:.2} Mrays/s, {:.1} s",
            self.scene,
            self.kind.name(),
            self.mean_occlusion,
            self.mean_standard_error,
            self.largest_standard_error,
            self.rays_per_pixel,
            self.mrays_per_s,
            self.seconds,
        )
    }
}

/// Mean occlusion, mean and largest standard error over the pixels with a surface.
pub(super) fn statistics(estimates: &Estimates) -> [f64; 3] {
    let count = (estimates.surfaces as f64).max(1.0);
    let errors = || {
        estimates
            .standard_error
            .iter()
            .map(|&error| f64::from(error))
    };
    // Without a surface occlusion is 1 and its error 0.
    let closed: f64 = estimates
        .occlusion
        .iter()
        .map(|&k| 1.0 - f64::from(k))
        .sum();
    [
        1.0 - closed / count,
        errors().sum::<f64>() / count,
        errors().fold(0.0, f64::max),
    ]
}

/// Mean distance of two answers over the pixels with a surface.
pub(super) fn mean_distance(a: &Estimates, b: &Estimates) -> f64 {
    let count = (a.surfaces as f64).max(1.0);
    let apart = a.occlusion.iter().zip(&b.occlusion);
    apart.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / count
}
