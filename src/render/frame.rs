//! What is asked of the renderer for one image, and the numbers its shaders are given.

use glam::{Mat4, Vec3};

use super::plan::FramePlan;
use super::technique::Settings;
use crate::scene::{Ambient, Background, Camera, Lighting, SceneConfig};

/// How finely normals and occlusion are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// 16-bit octahedral normals, half-float occlusion.
    #[default]
    Full,
    /// The thesis' tables 1 and 2: 8-bit normals, 8-bit occlusion. (Its depth, a float from 0
    /// to 1 of the far plane, has the same relative precision as metres in a float.)
    Thesis,
}

/// One image to draw.
#[derive(Debug, Clone)]
pub struct FrameRequest {
    /// Columns of the image.
    pub width_px: u32,
    /// Rows of the image.
    pub height_px: u32,
    /// Shaded samples along one side of a pixel. Occlusion is always at the image's own
    /// resolution: its number of samples a pixel means what it says.
    pub supersampling: u32,
    /// Where from.
    pub camera: Camera,
    /// How it is lit.
    pub lighting: Lighting,
    /// What occludes the ambient light.
    pub occlusion: Settings,
    /// Half width of the occlusion blur, pixels; 0 for none.
    pub blur_radius_px: u32,
    /// Distance from a plane at which a blur tap counts 1/e, metres.
    pub blur_plane_m: f32,
    /// How finely buffers are stored.
    pub precision: Precision,
    /// Seed of kernels and noise.
    pub seed: u64,
}

impl FrameRequest {
    /// An image of a scene under one of its lighting variants.
    #[must_use]
    pub fn new(
        scene: &SceneConfig,
        lighting: &Lighting,
        occlusion: Settings,
        (width_px, height_px): (u32, u32),
        seed: u64,
    ) -> Self {
        Self {
            width_px,
            height_px,
            supersampling: scene.supersampling,
            camera: scene.camera,
            lighting: lighting.clone(),
            occlusion,
            blur_radius_px: scene.occlusion.blur_radius_px,
            blur_plane_m: scene.occlusion.blur_plane_m,
            precision: Precision::Full,
            seed,
        }
    }

    pub(super) fn aspect(&self) -> f32 {
        self.width_px as f32 / self.height_px as f32
    }

    /// Size of the targets that are shaded, pixels.
    pub(super) fn shaded_size(&self) -> (u32, u32) {
        (
            self.width_px * self.supersampling,
            self.height_px * self.supersampling,
        )
    }
}

/// The WGSL struct `Frame`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct FrameUniform {
    view: Mat4,
    view_projection: Mat4,
    inverse_view: Mat4,
    eye_m: Vec3,
    near_m: f32,
    half_extent: [f32; 2],
    far_m: f32,
    exposure: f32,
    size_px: [f32; 2],
    occlusion_size_px: [f32; 2],
}

impl FrameUniform {
    pub(super) fn new(request: &FrameRequest, (width_px, height_px): (u32, u32)) -> Self {
        let camera = &request.camera;
        let aspect = request.aspect();
        let view = camera.view();
        Self {
            view,
            view_projection: camera.projection(aspect) * view,
            inverse_view: view.inverse(),
            eye_m: camera.position_m,
            near_m: camera.near_m,
            half_extent: camera.half_extent_at_1m(aspect).into(),
            far_m: camera.far_m,
            exposure: request.lighting.exposure_ev.exp2(),
            size_px: [width_px as f32, height_px as f32],
            occlusion_size_px: [request.width_px as f32, request.height_px as f32],
        }
    }
}

/// The WGSL struct `Light`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct LightUniform {
    irradiance: [[f32; 4]; 9],
    environment: [[f32; 4]; 6],
    constant_ambient: [f32; 4],
    background: [f32; 4],
    sun_towards: [f32; 4],
    sun_irradiance: [f32; 4],
    shadow_from_world: Mat4,
    shadow_texel: [f32; 4],
}

impl LightUniform {
    pub(super) fn new(lighting: &Lighting, shadow: Option<ShadowView>) -> Self {
        let mut uniform: Self = bytemuck::Zeroable::zeroed();
        if let Some(environment) = &lighting.environment {
            let irradiance = crate::scene::Irradiance::project(|d| environment.radiance(d));
            uniform.irradiance = irradiance.coefficients.map(pad);
            uniform.environment = environment.axes.map(pad);
        }
        if let Ambient::Constant(radiance) = lighting.ambient {
            uniform.constant_ambient = pad(radiance);
        }
        if let Background::Colour(radiance) = lighting.background {
            uniform.background = pad(radiance);
        }
        if let Some(sun) = &lighting.sun {
            uniform.sun_towards = pad(sun.towards);
            uniform.sun_irradiance = pad(sun.irradiance);
        }
        if let Some(shadow) = shadow {
            uniform.shadow_from_world = shadow.from_world;
            uniform.shadow_texel = [
                shadow.texel_m,
                1.0 / SHADOW_SIZE_PX as f32,
                shadow.bias,
                0.0,
            ];
        }
        uniform
    }
}

fn pad(v: Vec3) -> [f32; 4] {
    v.extend(0.0).to_array()
}

/// Side of the shadow map.
pub(super) const SHADOW_SIZE_PX: u32 = 4096;

/// How a directional light sees the scene: an orthographic box round all of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShadowView {
    /// World to the light's clip space, depth 0 (near the light) to 1.
    pub from_world: Mat4,
    /// Side of a texel, metres.
    texel_m: f32,
    /// A hundredth of a texel's depth: what rounding may move a depth by.
    bias: f32,
}

impl ShadowView {
    /// A view along `towards` (unit, to the light) that holds the box `bounds_m`.
    pub(super) fn new(towards: Vec3, bounds_m: (Vec3, Vec3)) -> Self {
        let (low, high) = bounds_m;
        let centre = (low + high) / 2.0;
        let up = if towards.y.abs() > 0.99 {
            Vec3::X
        } else {
            Vec3::Y
        };
        let view = glam::camera::rh::view::look_to_mat4(centre, -towards, up);
        let (mut view_low, mut view_high) = (Vec3::MAX, Vec3::MIN);
        for corner in 0..8_u8 {
            let pick = |bit: u8, axis: usize| {
                if corner & bit == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            let seen = view.transform_point3(Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2)));
            view_low = view_low.min(seen);
            view_high = view_high.max(seen);
        }
        // A margin keeps the filter's taps on the map.
        let margin = (view_high - view_low).max_element().max(1e-3) * 0.005;
        view_low -= margin;
        view_high += margin;
        let projection = glam::camera::rh::proj::directx::orthographic(
            view_low.x,
            view_high.x,
            view_low.y,
            view_high.y,
            -view_high.z,
            -view_low.z,
        );
        let extent = view_high - view_low;
        let texel_m = extent.x.max(extent.y) / SHADOW_SIZE_PX as f32;
        Self {
            from_world: projection * view,
            texel_m,
            bias: 0.1 * texel_m / extent.z,
        }
    }
}

/// Formats of the frame's targets.
#[derive(Debug, Clone, Copy)]
pub(super) struct Formats {
    pub normals: wgpu::TextureFormat,
    pub occlusion: wgpu::TextureFormat,
}

impl Formats {
    pub(super) const ALBEDO: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
    pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
    pub(super) const DEPTH_TEST: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
    pub(super) const RADIANCE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    pub(super) const OUTPUT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

    pub(super) fn of(precision: Precision) -> Self {
        match precision {
            Precision::Full => Self {
                normals: wgpu::TextureFormat::Rg32Uint,
                occlusion: wgpu::TextureFormat::R16Float,
            },
            Precision::Thesis => Self {
                normals: wgpu::TextureFormat::Rgba8Unorm,
                occlusion: wgpu::TextureFormat::R8Unorm,
            },
        }
    }
}

/// The WGSL part `normals` for a frame.
pub(super) fn normals_part(plan: &FramePlan, precision: Precision) -> (&'static str, &'static str) {
    let text = match (plan.reads_normals, precision) {
        (false, _) => include_str!("shaders/lighting/normals_none.wgsl"),
        (true, Precision::Full) => include_str!("shaders/normals_full.wgsl"),
        (true, Precision::Thesis) => include_str!("shaders/normals_thesis.wgsl"),
    };
    ("normals", text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shadow_view_holds_the_whole_box() {
        let bounds = (Vec3::new(-3.0, 0.0, -10.0), Vec3::new(5.0, 12.0, 7.0));
        for towards in [Vec3::Y, Vec3::new(0.5, 0.7, -0.3).normalize(), Vec3::X] {
            let view = ShadowView::new(towards, bounds);
            for corner in 0..8_u8 {
                let pick = |bit: u8, axis: usize| {
                    if corner & bit == 0 {
                        bounds.0[axis]
                    } else {
                        bounds.1[axis]
                    }
                };
                let clip =
                    view.from_world
                        .project_point3(Vec3::new(pick(1, 0), pick(2, 1), pick(4, 2)));
                assert!(clip.x.abs() < 1.0 && clip.y.abs() < 1.0, "{clip}");
                assert!((0.0..=1.0).contains(&clip.z), "{clip}");
            }
        }
    }

    #[test]
    fn nearer_the_light_is_a_smaller_depth() {
        let view = ShadowView::new(Vec3::Y, (Vec3::ZERO, Vec3::splat(2.0)));
        let depth = |y: f32| view.from_world.project_point3(Vec3::new(1.0, y, 1.0)).z;
        assert!(depth(1.5) < depth(0.5));
    }
}
