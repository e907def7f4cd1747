//! Greyfield's side: a technique's occlusion, and what its passes take.

use greyfield::render::technique::Settings;
use greyfield::render::{FrameRequest, PassRecord, View};

use crate::Failure;
use crate::scene::{Scene, settings};
use crate::times::Passes;

/// A technique with one blur.
pub struct Contender {
    /// As in Greyfield's configs (`gtao18`).
    pub label: String,
    /// Half width of its blur, pixels.
    pub blur_radius_px: u32,
    request: FrameRequest,
    unblurred: FrameRequest,
}

impl Contender {
    pub fn new(scene: &Scene, label: &str, blur_radius_px: u32) -> Result<Self, Failure> {
        let settings: Settings = settings(label)?;
        if settings.technique.shader.is_none() {
            return Err(format!("technique `{label}` has no pass to time").into());
        }
        Ok(Self {
            label: label.to_owned(),
            blur_radius_px,
            request: scene.request(settings.clone(), blur_radius_px),
            unblurred: scene.request(settings, 0),
        })
    }

    /// The request whose points are everybody's.
    pub fn request(&self) -> &FrameRequest {
        &self.request
    }

    /// Draws a frame and says what its passes took.
    pub fn frame(&self, view: &mut View<'_>) -> Result<Passes, Failure> {
        let drawn = view.render(&self.request)?;
        let total_ms = |wanted: fn(&str) -> bool| -> Result<f64, Failure> {
            let passes = drawn.passes.iter().filter(|pass| wanted(&pass.pass));
            passes
                .map(|pass: &PassRecord| pass.gpu_ms.ok_or("a pass has no time".into()))
                .sum()
        };
        Ok(Passes {
            before_ms: 0.0,
            occlusion_ms: total_ms(|name| name == "occlusion")?,
            denoise_ms: total_ms(|name| name.starts_with("blur") || name == "upsample")?,
        })
    }

    /// The occlusion before and after the blur.
    pub fn occlusion(&self, view: &mut View<'_>) -> Result<[Vec<f32>; 2], Failure> {
        let mut of = |request| -> Result<Vec<f32>, Failure> {
            let image = view.render(request)?.occlusion;
            Ok(image.ok_or("the technique drew no occlusion")?.values)
        };
        Ok([of(&self.unblurred)?, of(&self.request)?])
    }
}
