//! What a technique estimates, on its way to every pixel: estimated, blurred, upsampled.

use super::Gpu;
use super::frame::{FrameRequest, Precision};
use super::plan::{FramePlan, PassKind};
use super::readback::FloatImage;
use super::targets::{handed_occlusion, target};

/// The textures of one quantity that a technique estimates; what no pass writes is not made.
pub(super) struct Estimate {
    /// As the technique gives it, and then as the blur leaves it.
    pub estimated: wgpu::TextureView,
    /// Between the blur's two directions.
    pub half_blurred: Option<wgpu::TextureView>,
    /// Where the estimate is of half resolution: what it comes to a pixel.
    pub upsampled: Option<wgpu::TextureView>,
}

impl Estimate {
    /// The textures that `plan` writes; `None` where no technique runs.
    pub(super) fn new(
        gpu: &Gpu,
        request: &FrameRequest,
        plan: &FramePlan,
        label: &str,
        format: wgpu::TextureFormat,
    ) -> Option<Self> {
        let size = request.occlusion_size();
        let image_size = (request.width_px, request.height_px);
        plan.has(PassKind::Occlusion).then(|| Self {
            estimated: target(gpu, label, size, format),
            half_blurred: (plan.has(PassKind::BlurRows)).then(|| target(gpu, label, size, format)),
            upsampled: (plan.has(PassKind::Upsample))
                .then(|| target(gpu, label, image_size, format)),
        })
    }

    /// An estimate that was made outside of the renderer, of every pixel and as it shall be.
    pub(super) fn handed_in(gpu: &Gpu, image: &FloatImage, precision: Precision) -> Self {
        Self {
            estimated: handed_occlusion(gpu, image, precision),
            half_blurred: None,
            upsampled: None,
        }
    }

    /// What every pixel has.
    pub(super) fn of_pixels(&self) -> &wgpu::TextureView {
        self.upsampled.as_ref().unwrap_or(&self.estimated)
    }
}
