//! One scene on the bench: its truth, found once, and techniques measured against it.

use std::sync::Arc;

use super::configuration::Configuration;
use super::spread::Spread;
use super::truth::{Truth, TruthOptions};
use super::{CostError, Measured, Times};
use crate::render::technique::Settings;
use crate::render::{
    Clock, FloatImage, FrameRequest, GpuScene, PassTimes, Picture, RenderError, Renderer, Repeats,
    View,
};
use crate::scene::SceneConfig;
use crate::stimulus::flip::flip;
use crate::stimulus::ssim::ssim;

use super::measured::ImageMeasured;

/// How a scene is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BenchOptions {
    /// Size of the images, pixels.
    pub size_px: (u32, u32),
    /// Seed of kernels, noise and rays.
    pub seed: u64,
    /// What the truth is, and how well it is known.
    pub truth: TruthOptions,
    /// How long times are taken.
    pub repeats: Repeats,
    /// Pixels that a degree of the viewer's field of view spans, for FLIP.
    pub pixels_per_degree: f32,
}

/// A scene with its truth. One view a lighting variant, so that none draws its surfaces or its
/// environment twice.
pub struct SceneBench<'a> {
    scene: &'a SceneConfig,
    options: BenchOptions,
    lit: Vec<Lit<'a>>,
    truth: Truth,
    /// The settings timed last, and what they took.
    timed: Option<(String, PassTimes)>,
}

/// The scene under one of its lighting variants.
struct Lit<'a> {
    lighting: String,
    view: View<'a>,
    /// The image with the true occlusion.
    truth: Picture,
}

impl<'a> SceneBench<'a> {
    /// A scene whose truth is known, under some of its lighting variants, the first of which times
    /// are taken in.
    ///
    /// # Errors
    /// [`CostError::Input`] for no lighting, or one that the scene does not have; otherwise the
    /// renderer's.
    pub fn new(
        renderer: &'a Renderer,
        uploaded: &'a GpuScene,
        scene: &'a SceneConfig,
        lightings: &[String],
        truth: Truth,
        options: BenchOptions,
    ) -> Result<Self, CostError> {
        let mut bench = Self {
            scene,
            options,
            lit: Vec::new(),
            truth,
            timed: None,
        };
        if lightings.is_empty() {
            return Err(CostError::Input(String::from(
                "no lighting variant is to be measured",
            )));
        }
        for lighting in lightings {
            scene.lighting(lighting).map_err(CostError::Input)?;
            let settings = of_truth()?;
            let mut request = bench.request(lighting, &settings, 0);
            request.handed_occlusion = Some(bench.truth.occlusion.clone());
            let mut view = renderer.view(uploaded);
            let truth = view.render(&request)?.picture;
            bench.lit.push(Lit {
                lighting: lighting.clone(),
                view,
                truth,
            });
        }
        Ok(bench)
    }

    /// The truth.
    #[must_use]
    pub fn truth(&self) -> &Truth {
        &self.truth
    }

    /// The images with the true occlusion, by lighting.
    pub fn true_pictures(&self) -> impl Iterator<Item = (&str, &Picture)> {
        (self.lit.iter()).map(|lit| (lit.lighting.as_str(), &lit.truth))
    }

    /// Measures one configuration: its time, its error, and what can be seen of it.
    ///
    /// # Errors
    /// The renderer's.
    pub fn measure(&mut self, configuration: &Configuration) -> Result<Measured, CostError> {
        let times = self.times(configuration)?;
        let (pictures, occlusion) = self.draw(configuration)?;
        let truth = &self.truth;
        let images = (self.lit.iter().zip(pictures))
            .map(|(lit, picture)| {
                let unlike = |error: &dyn std::fmt::Display| CostError::Input(error.to_string());
                let ppd = self.options.pixels_per_degree;
                let flip = flip(&lit.truth, &picture, ppd).map_err(|error| unlike(&error))?;
                let ssim = ssim(&lit.truth, &picture).map_err(|error| unlike(&error))?;
                Ok(ImageMeasured {
                    lighting: lit.lighting.clone(),
                    ssim: ssim.mean(),
                    flip,
                    picture,
                })
            })
            .collect::<Result<Vec<_>, CostError>>()?;
        Ok(Measured {
            times,
            error: truth.error_of(&occlusion),
            estimator_error: truth.estimator_error_of(&occlusion),
            information_loss: truth.known.loss,
            occlusion,
            images,
        })
    }

    fn request(&self, lighting: &str, settings: &Settings, blur_radius_px: u32) -> FrameRequest {
        let lighting = &self.scene.lightings[lighting];
        let options = &self.options;
        let mut request = FrameRequest::new(
            self.scene,
            lighting,
            settings.clone(),
            options.size_px,
            options.seed,
        );
        request.blur_radius_px = blur_radius_px;
        request
    }

    /// The images under every lighting, and the occlusion. What is found under the first light
    /// is handed to the others, unless the technique looks at the light itself.
    fn draw(
        &mut self,
        configuration: &Configuration,
    ) -> Result<(Vec<Picture>, Arc<FloatImage>), CostError> {
        let settings = &configuration.settings;
        let mut occlusion: Option<Arc<FloatImage>> = None;
        let mut pictures = Vec::new();
        for index in 0..self.lit.len() {
            let lighting = self.lit[index].lighting.clone();
            let mut request = self.request(&lighting, settings, configuration.blur_radius_px);
            if let Some(found) = &occlusion
                && settings.technique.shader.is_some()
                && !settings.technique.inputs.light
                && !settings.is("bent_cone", "on")
            {
                request = self.request(&lighting, &of_truth()?, 0);
                request.handed_occlusion = Some(found.clone());
            }
            let frame = self.lit[index].view.render(&request)?;
            if occlusion.is_none() {
                occlusion = Some(Arc::new(frame.occlusion.unwrap_or_else(|| self.open())));
            }
            pictures.push(frame.picture);
        }
        Ok((pictures, occlusion.unwrap_or_else(|| Arc::new(self.open()))))
    }

    /// No occlusion anywhere.
    fn open(&self) -> FloatImage {
        let (width_px, height_px) = self.options.size_px;
        FloatImage {
            width_px,
            height_px,
            values: vec![1.0; width_px as usize * height_px as usize],
        }
    }

    /// Times under the first lighting. Timestamps of a blurred configuration tell what the same
    /// takes without the blur, so that it is not timed twice.
    fn times(&mut self, configuration: &Configuration) -> Result<Option<Times>, CostError> {
        let key = format!("{:?}", configuration.settings);
        let blur_radius_px = configuration.blur_radius_px;
        if let Some((timed, times)) = &self.timed
            && *timed == key
            && blur_radius_px == 0
            && times.clock == Clock::GpuTimestamps
        {
            return Ok(Times::of(times, |pass| !is_blur(pass)));
        }
        let Some(lighting) = self.lit.first().map(|lit| lit.lighting.clone()) else {
            return Ok(None);
        };
        let request = self.request(&lighting, &configuration.settings, blur_radius_px);
        let repeats = self.options.repeats;
        let times = self.lit[0].view.time_occlusion(&request, &repeats)?;
        let found = Times::of(&times, |_| true);
        self.timed = Some((key, times));
        Ok(found)
    }
}

fn is_blur(pass: &str) -> bool {
    pass.starts_with("blur")
}

impl Times {
    /// Of the frames of some passes; `None` of no frame.
    fn of(times: &PassTimes, counts: impl Fn(&str) -> bool) -> Option<Self> {
        let (clock, is_wall) = (times.clock, times.clock == Clock::WallClock);
        let totals = match is_wall {
            true => times.totals_ms(),
            false => times.of_ms(&counts),
        };
        let part = |is_part: &dyn Fn(&str) -> bool| {
            // Of a pass that does not run there is no time, not even 0.
            (times.passes.iter()).find(|pass| counts(pass) && is_part(pass))?;
            let part = times.of_ms(|pass| counts(pass) && is_part(pass));
            Spread::of(&part).map(|spread| spread.median)
        };
        Some(Self {
            clock,
            total_ms: Spread::of(&totals)?,
            occlusion_ms: part(&|pass| pass == "occlusion"),
            blur_ms: part(&is_blur),
            upsample_ms: part(&|pass| pass == "upsample"),
        })
    }
}

/// The technique whose occlusion is handed in.
pub(super) fn of_truth() -> Result<Settings, RenderError> {
    Settings::from_label("ray-traced").map_err(|error| RenderError::Request(error.message))
}
