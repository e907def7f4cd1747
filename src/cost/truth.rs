//! The truth of one scene's picture, and what the depth buffer alone can know of it.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::CostError;
use super::bench::of_truth;
use super::error::OcclusionError;
use crate::reference::{
    Estimates, OcclusionSettings, RayTraced, SceneBvh, ScreenSpace, Thinned, estimate,
};
use crate::render::{FloatImage, FrameRequest, GpuScene, RenderError, Renderer};
use crate::scene::{Geometry, SceneConfig, VisibleSurfaces};
use crate::stimulus::progress::Progress;
use crate::stimulus::truth::{read_exr, write_exr};

/// What the truth is, and how well it is known.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TruthOptions {
    /// Distance from which on nothing occludes, metres: obscurance that falls off evenly up to
    /// there, weighted by the cosine.
    pub reach_m: f64,
    /// Standard error at which a pixel has had rays enough.
    pub error: f64,
    /// Pixels at which the depth buffer's own answer is found.
    pub screen_space_pixels: usize,
}

impl Default for TruthOptions {
    /// Within half a metre, to a standard error of 0.01 a pixel, which a root of the mean squared
    /// error of 0.05 is 2 % larger for.
    fn default() -> Self {
        Self {
            reach_m: 0.5,
            error: 0.01,
            screen_space_pixels: 8192,
        }
    }
}

/// The picture that the truth is of.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// What draws.
    pub renderer: &'a Renderer,
    /// The scene's surfaces.
    pub uploaded: &'a GpuScene,
    /// Its config.
    pub scene: &'a SceneConfig,
    /// Size of the picture, pixels.
    pub size_px: (u32, u32),
    /// Seed of the rays.
    pub seed: u64,
}

/// Rays a pixel has at most.
const MAX_RAYS: u32 = 4096;

/// The true occlusion of a picture.
#[derive(Debug, Clone)]
pub struct Truth {
    /// The coefficient of each pixel, 0 closed to 1 open.
    pub occlusion: Arc<FloatImage>,
    /// Root of its mean squared standard error over the pixels with a surface.
    pub standard_error: f64,
    /// Which pixels show a surface: errors are of these.
    pub has_surface: Vec<bool>,
    /// What the depth buffer alone can know of it.
    pub known: KnownByDepth,
}

/// What the depth buffer alone can know of a picture's occlusion. It does not say how thick
/// anything is; its best answer is that of the thickness, one for the whole picture, at which it
/// comes nearest to the truth.
#[derive(Debug, Clone)]
pub struct KnownByDepth {
    /// Some of the pixels with a surface, and the answer there.
    pub answers: Vec<(usize, f32)>,
    /// The thickness, metres; infinite for solid.
    pub thickness_m: f32,
    /// Of the answer against the truth: the information that is lost.
    pub loss: OcclusionError,
}

impl Truth {
    /// Finds the truth of a scene's picture, or reads the occlusion from `kept`, where that is
    /// of this size; otherwise writes it there.
    ///
    /// # Errors
    /// [`CostError::Input`] for a picture without a surface; otherwise the renderer's or the
    /// disk's.
    pub fn find(
        subject: &Subject<'_>,
        geometry: &Geometry,
        options: &TruthOptions,
        kept: Option<&Path>,
        progress: &Progress<'_>,
    ) -> Result<Self, CostError> {
        let surfaces = subject.surfaces()?;
        let settings = settings(options, subject.seed);
        let (scene, size_px) = (subject.scene, subject.size_px);
        (progress.step)(&format!("{}: ray-traced truth", scene.id));
        let known = kept.and_then(|path| read_exr(path, size_px));
        let traced = match known {
            Some(known) => {
                (progress.pixels)(surfaces.len() as u64);
                known
            }
            None => {
                let bvh = SceneBvh::new(geometry);
                let points = RayTraced::of_visible(&bvh, &surfaces);
                let traced = estimate(&points, &settings, progress.pixels)
                    .map_err(|error| RenderError::Request(error.to_string()))?;
                if let Some(path) = kept {
                    write_exr(path, &traced, size_px)?;
                }
                traced
            }
        };
        (progress.step)(&format!("{}: what the depth buffer can know", scene.id));
        let pixels = spread_pixels(&surfaces, options.screen_space_pixels);
        let known = KnownByDepth::find(&surfaces, &traced, pixels, options, &settings)?;
        let squares = traced.standard_error.iter().map(|&e| f64::from(e).powi(2));
        let standard_error = (squares.sum::<f64>() / (traced.surfaces as f64).max(1.0)).sqrt();
        Ok(Self {
            standard_error,
            known,
            has_surface: (0..surfaces.len())
                .map(|pixel| surfaces.has_surface(pixel))
                .collect(),
            occlusion: Arc::new(FloatImage {
                width_px: surfaces.width_px,
                height_px: surfaces.height_px,
                values: traced.occlusion,
            }),
        })
    }

    /// Error of an estimate of the same picture.
    #[must_use]
    pub fn error_of(&self, found: &FloatImage) -> OcclusionError {
        let pairs = found.values.iter().zip(&self.occlusion.values);
        let seen = pairs.zip(&self.has_surface).filter(|(_, seen)| **seen);
        OcclusionError::of(seen.map(|((&found, &truth), _)| (found, truth)))
    }

    /// Error of an estimate against what the depth buffer alone answers.
    #[must_use]
    pub fn estimator_error_of(&self, found: &FloatImage) -> OcclusionError {
        let pairs = self.known.answers.iter();
        OcclusionError::of(pairs.map(|&(pixel, answer)| (found.values[pixel], answer)))
    }

    /// The signed error of every pixel; 0 where there is no surface.
    #[must_use]
    pub fn error_map(&self, found: &FloatImage) -> Vec<f32> {
        let pairs = found.values.iter().zip(&self.occlusion.values);
        pairs
            .zip(&self.has_surface)
            .map(|((found, truth), seen)| if *seen { found - truth } else { 0.0 })
            .collect()
    }
}

fn settings(options: &TruthOptions, seed: u64) -> OcclusionSettings {
    OcclusionSettings {
        d_max_m: (options.reach_m > 0.0).then_some(options.reach_m as f32),
        error: options.error,
        max_rays: MAX_RAYS,
        ..OcclusionSettings::new(seed)
    }
}

impl Subject<'_> {
    /// The points that its pictures show.
    fn surfaces(&self) -> Result<VisibleSurfaces, CostError> {
        let file = self.scene.path.display();
        let Some(lighting) = self.scene.lightings.values().next() else {
            return Err(CostError::Input(format!("{file} has no lighting variant")));
        };
        let request = FrameRequest::new(self.scene, lighting, of_truth()?, self.size_px, self.seed);
        let surfaces = self
            .renderer
            .view(self.uploaded)
            .visible_surfaces(&request)?;
        if (0..surfaces.len()).any(|pixel| surfaces.has_surface(pixel)) {
            return Ok(surfaces);
        }
        Err(CostError::Input(format!(
            "{file}: its camera sees no surface, so that there is no occlusion to measure; mend `geometry` or `camera`"
        )))
    }
}

impl KnownByDepth {
    fn find(
        surfaces: &VisibleSurfaces,
        traced: &Estimates,
        pixels: Vec<usize>,
        options: &TruthOptions,
        settings: &OcclusionSettings,
    ) -> Result<Self, CostError> {
        let answer = |thickness_m: f32, pixels: &[usize]| {
            let field = ScreenSpace::new(surfaces).with_thickness_m(thickness_m);
            let asked = estimate(&Thinned::new(&field, pixels.to_vec()), settings, &|_| {})
                .map_err(|error| RenderError::Request(error.to_string()))?;
            let pairs = asked.occlusion.iter().zip(pixels);
            let loss = OcclusionError::of(pairs.map(|(k, pixel)| (*k, traced.occlusion[*pixel])));
            Ok::<_, CostError>(Self {
                answers: pixels.iter().copied().zip(asked.occlusion).collect(),
                thickness_m,
                loss,
            })
        };
        // A quarter of the pixels tells which thickness it is.
        let some: Vec<usize> = pixels.iter().copied().step_by(4).collect();
        let mut best = answer(f32::INFINITY, &some)?;
        for part in THICKNESSES {
            let other = answer((part * options.reach_m.max(1e-3)) as f32, &some)?;
            if other.loss.rmse < best.loss.rmse {
                best = other;
            }
        }
        answer(best.thickness_m, &pixels)
    }
}

/// The thicknesses that are tried beside solid, in parts of the reach.
const THICKNESSES: [f64; 5] = [1.0 / 32.0, 0.125, 0.25, 0.5, 1.0];

/// About `count` pixels with a surface, spread evenly and in no step with any grid: the R2
/// sequence of Roberts 2018.
fn spread_pixels(surfaces: &VisibleSurfaces, count: usize) -> Vec<usize> {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let (width, height) = (surfaces.width_px as usize, surfaces.height_px as usize);
    let place = |index: usize, power: i32, size: usize| {
        let at = (0.5 + (index + 1) as f64 * PLASTIC.powi(-power)).fract();
        ((at * size as f64) as usize).min(size - 1)
    };
    let mut pixels: Vec<usize> = (0..count)
        .map(|index| place(index, 2, height) * width + place(index, 1, width))
        .filter(|&pixel| surfaces.has_surface(pixel))
        .collect();
    pixels.sort_unstable();
    pixels.dedup();
    pixels
}
