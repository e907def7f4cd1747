//! The textures of one frame: those its plan writes, and no others.

use super::Gpu;
use super::frame::{Formats, FrameRequest, SHADOW_SIZE_PX};
use super::plan::{FramePlan, PassKind};

/// The targets a plan writes.
pub(super) struct Targets {
    pub albedo: wgpu::TextureView,
    pub depth_m: wgpu::TextureView,
    pub depth_test: wgpu::TextureView,
    pub normals: Option<wgpu::TextureView>,
    /// Depth, normals and depth test at the occlusion's resolution, where it is another one.
    pub occlusion_surfaces: Option<(wgpu::TextureView, wgpu::TextureView, wgpu::TextureView)>,
    pub occlusion: Option<wgpu::TextureView>,
    /// Between the blur's two directions.
    pub half_blurred: Option<wgpu::TextureView>,
    pub shadow: Option<wgpu::TextureView>,
    pub radiance: wgpu::TextureView,
    pub image: wgpu::TextureView,
}

impl Targets {
    pub(super) fn new(gpu: &Gpu, request: &FrameRequest, plan: &FramePlan) -> Self {
        let formats = Formats::of(request.precision);
        let make = |label, (width, height): (u32, u32), format| {
            gpu.device
                .create_texture(&wgpu::TextureDescriptor {
                    label: Some(label),
                    size: wgpu::Extent3d {
                        width,
                        height,
                        depth_or_array_layers: 1,
                    },
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                        | wgpu::TextureUsages::TEXTURE_BINDING
                        | wgpu::TextureUsages::COPY_SRC,
                    view_formats: &[],
                })
                .create_view(&wgpu::TextureViewDescriptor::default())
        };
        let image_size = (request.width_px, request.height_px);
        let shaded = request.shaded_size();
        Self {
            albedo: make("albedo", shaded, Formats::ALBEDO),
            depth_m: make("linear depth", shaded, Formats::DEPTH),
            depth_test: make("depth test", shaded, Formats::DEPTH_TEST),
            normals: plan
                .reads_normals
                .then(|| make("normals", shaded, formats.normals)),
            occlusion_surfaces: plan.has(PassKind::OcclusionGeometry).then(|| {
                (
                    make("occlusion depth", image_size, Formats::DEPTH),
                    make("occlusion normals", image_size, formats.normals),
                    make("occlusion depth test", image_size, Formats::DEPTH_TEST),
                )
            }),
            occlusion: plan
                .has(PassKind::Occlusion)
                .then(|| make("occlusion", image_size, formats.occlusion)),
            half_blurred: plan
                .has(PassKind::BlurRows)
                .then(|| make("half blurred", image_size, formats.occlusion)),
            shadow: plan.has(PassKind::ShadowMap).then(|| {
                make(
                    "shadow",
                    (SHADOW_SIZE_PX, SHADOW_SIZE_PX),
                    Formats::DEPTH_TEST,
                )
            }),
            radiance: make("radiance", shaded, Formats::RADIANCE),
            image: make("image", image_size, Formats::OUTPUT),
        }
    }
}
