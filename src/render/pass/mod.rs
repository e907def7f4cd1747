//! The passes: each one file that makes its pipeline, binds its inputs and draws.

mod blur;
mod fullscreen;
mod geometry;
mod light;
mod mesh;
mod occlusion;
mod output;
mod shadow;
mod upsample;

pub(super) use blur::{BlurInputs, blur};
pub(super) use fullscreen::Drawable;
pub(super) use geometry::{GeometryInputs, GeometryTargets, geometry, is_uncovered};
pub(super) use light::{LightInputs, light};
pub(super) use occlusion::{OcclusionInputs, OcclusionTargets, occlusion};
pub(super) use output::{output, shade};
pub(super) use shadow::{FilterInputs, shadow_filter, shadow_map};
pub(super) use upsample::{UpsampleInputs, upsample};

fn cleared(view: &wgpu::TextureView, colour: wgpu::Color) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(colour),
            store: wgpu::StoreOp::Store,
        },
    }
}

fn cleared_depth(
    view: &wgpu::TextureView,
    depth: f32,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(depth),
            store: wgpu::StoreOp::Store,
        }),
        stencil_ops: None,
    }
}
