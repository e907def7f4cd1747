//! Which effects of a scene earn their time: each left out in turn, what it saves and what is
//! then seen.

use serde::{Deserialize, Serialize};

use super::CostError;
use crate::render::technique::Settings;
use crate::render::{FrameRequest, GpuScene, Picture, Renderer};
use crate::scene::Ambient;
use crate::stimulus::flip::flip;

/// Something that a scene may do without.
#[derive(Debug)]
pub struct Effect {
    /// What it is called.
    pub name: &'static str,
    /// What stands in its place when it is left out.
    pub instead: &'static str,
    /// The frame without it; `None` where the frame has none.
    without: fn(&FrameRequest) -> Option<FrameRequest>,
}

/// Every effect that is weighed. Light sources are not among them: what shines is the artist's
/// choice, how exactly it is simulated is a matter of cost.
pub const EFFECTS: &[Effect] = &[
    Effect {
        name: "occlusion",
        instead: "ambient light reaches every surface alike",
        without: |request| {
            let none = Settings::from_label("none").ok()?;
            request
                .occlusion
                .technique
                .occludes()
                .then(|| FrameRequest {
                    occlusion: none,
                    ..request.clone()
                })
        },
    },
    Effect {
        name: "occlusion blur",
        instead: "the estimate keeps its noise",
        without: |request| {
            let is_blurred =
                request.blur_radius_px > 0 && request.occlusion.technique.shader.is_some();
            is_blurred.then(|| FrameRequest {
                blur_radius_px: 0,
                ..request.clone()
            })
        },
    },
    Effect {
        name: "supersampling",
        instead: "one shaded sample a pixel",
        without: |request| {
            (request.supersampling > 1).then(|| FrameRequest {
                supersampling: 1,
                ..request.clone()
            })
        },
    },
    Effect {
        name: "shadows",
        instead: "the directional light goes through everything",
        without: |request| {
            let mut without = request.clone();
            let sun = without
                .lighting
                .sun
                .as_mut()
                .filter(|sun| sun.casts_shadows)?;
            sun.casts_shadows = false;
            Some(without)
        },
    },
    Effect {
        name: "reflections",
        instead: "surfaces mirror nothing",
        without: |request| {
            let mut without = request.clone();
            without.lighting.reflections = false;
            request.lighting.reflections.then_some(without)
        },
    },
    Effect {
        name: "ambient light by direction",
        instead: "the environment's mean comes from everywhere",
        without: |request| {
            let mut without = request.clone();
            let environment = request.lighting.environment.as_ref()?;
            without.lighting.ambient =
                Ambient::Constant(environment.map().mean() * environment.intensity());
            (request.lighting.ambient == Ambient::Environment).then_some(without)
        },
    },
];

/// What an effect costs in one image and what it changes of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EffectCost {
    /// The effect.
    pub effect: String,
    /// What stands in its place when it is left out.
    pub instead: String,
    /// Milliseconds that leaving it out saves, median of pairs of frames; `None` where the
    /// adapter cannot time passes.
    pub saves_ms: Option<f64>,
    /// Smallest and largest saving of a pair.
    pub saves_range_ms: Option<(f64, f64)>,
    /// Median time of the frame with it.
    pub frame_ms: Option<f64>,
    /// Mean FLIP between the images with it and without.
    pub flip_mean: f64,
    /// 95th percentile.
    pub flip_p95: f64,
}

/// Pairs of frames, with the effect and without.
const PAIRS: usize = 5;

/// Weighs each effect that a frame has.
///
/// # Errors
/// The renderer's.
pub fn weigh(
    renderer: &Renderer,
    uploaded: &GpuScene,
    request: &FrameRequest,
    pixels_per_degree: f32,
) -> Result<Vec<EffectCost>, CostError> {
    let called_for = EFFECTS
        .iter()
        .filter_map(|effect| Some((effect, (effect.without)(request)?)));
    called_for
        .map(|(effect, without)| {
            let timer = Timer { renderer, uploaded };
            timer.weigh(effect, request, &without, pixels_per_degree)
        })
        .collect()
}

struct Timer<'a> {
    renderer: &'a Renderer,
    uploaded: &'a GpuScene,
}

impl Timer<'_> {
    fn weigh(
        &self,
        effect: &Effect,
        with: &FrameRequest,
        without: &FrameRequest,
        pixels_per_degree: f32,
    ) -> Result<EffectCost, CostError> {
        // The first frames compile shaders.
        let (picture, _) = self.frame(with)?;
        let (other, _) = self.frame(without)?;
        let map = flip(&picture, &other, pixels_per_degree)
            .map_err(|error| CostError::Input(error.to_string()))?;
        let mut pairs = Vec::new();
        for _ in 0..PAIRS {
            let (Some(with_ms), Some(without_ms)) = (self.frame(with)?.1, self.frame(without)?.1)
            else {
                break;
            };
            pairs.push((with_ms, without_ms));
        }
        let mut savings: Vec<f64> = pairs.iter().map(|(with, without)| with - without).collect();
        let mut frames: Vec<f64> = pairs.iter().map(|(with, _)| *with).collect();
        savings.sort_by(f64::total_cmp);
        frames.sort_by(f64::total_cmp);
        Ok(EffectCost {
            effect: effect.name.to_owned(),
            instead: effect.instead.to_owned(),
            saves_ms: savings.get(savings.len() / 2).copied(),
            saves_range_ms: savings.first().copied().zip(savings.last().copied()),
            frame_ms: frames.get(frames.len() / 2).copied(),
            flip_mean: map.mean(),
            flip_p95: f64::from(map.percentile(0.95)),
        })
    }

    /// A frame with all its passes, none shared with another, and what they took together.
    fn frame(&self, request: &FrameRequest) -> Result<(Picture, Option<f64>), CostError> {
        let frame = self.renderer.view(self.uploaded).render(request)?;
        let times: Option<Vec<f64>> = frame.passes.iter().map(|pass| pass.gpu_ms).collect();
        Ok((frame.picture, times.map(|times| times.iter().sum())))
    }
}
