//! Bevy's own occlusion passes, with its own pipelines, textures and bind groups, dispatched once
//! more as its `ssao` system does, but with a timestamp between them; and what they wrote.

use bevy::core_pipeline::prepass::ViewPrepassTextures;
use bevy::pbr::{ScreenSpaceAmbientOcclusionResources, SsaoBindGroups};
use bevy::render::render_resource::{
    BindGroup, CachedPipelineState, ComputePipeline, Pipeline, PipelineCache, PipelineDescriptor,
    TextureView,
};
use bevy::render::renderer::{RenderDevice, RenderQueue};

use crate::Failure;
use crate::times::Passes;

/// Before the first pass, and after each of three.
const TIMESTAMPS: u32 = 4;

/// What the passes read and write.
pub struct Bound {
    preprocess: BindGroup,
    occlusion: BindGroup,
    denoise: BindGroup,
    common: BindGroup,
    /// Where the view's own uniform lies.
    offset: u32,
    denoised: TextureView,
    depth: TextureView,
    normals: TextureView,
}

impl Bound {
    pub fn new(
        groups: &SsaoBindGroups,
        offset: u32,
        prepass: &ViewPrepassTextures,
        textures: &ScreenSpaceAmbientOcclusionResources,
    ) -> Result<Self, Failure> {
        let denoised = &textures.screen_space_ambient_occlusion_texture;
        Ok(Self {
            preprocess: groups.preprocess_depth_bind_group.clone(),
            occlusion: groups.ssao_bind_group.clone(),
            denoise: groups.spatial_denoise_bind_group.clone(),
            common: groups.common_bind_group.clone(),
            offset,
            denoised: denoised.default_view.clone(),
            depth: prepass.depth_view().ok_or("Bevy drew no depth")?.clone(),
            normals: (prepass.normal_view())
                .ok_or("Bevy drew no normals")?
                .clone(),
        })
    }
}

/// The three passes.
pub struct OcclusionPasses {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    is_software: bool,
    preprocess: ComputePipeline,
    occlusion: ComputePipeline,
    denoise: ComputePipeline,
    /// Layout of what the denoising reads, to read it, too.
    denoise_layout: wgpu::BindGroupLayout,
    bound: Bound,
}

impl OcclusionPasses {
    /// `None` as long as a pipeline is not there.
    ///
    /// # Errors
    /// For an adapter that cannot time passes.
    pub fn take(
        device: &RenderDevice,
        queue: &RenderQueue,
        cache: &PipelineCache,
        is_software: bool,
        bound: Bound,
    ) -> Result<Option<Self>, Failure> {
        let needed =
            wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
        if !device.features().contains(needed) {
            return Err("the adapter cannot write timestamps between passes".into());
        }
        let found = |label| pipeline(cache, label);
        let (Some(preprocess), Some(occlusion), Some(denoise)) = (
            found("ssao_preprocess_depth_pipeline"),
            found("ssao_ssao_pipeline"),
            found("ssao_spatial_denoise_pipeline"),
        ) else {
            return Ok(None);
        };
        Ok(Some(Self {
            device: device.wgpu_device().clone(),
            queue: (****queue).clone(),
            is_software,
            denoise_layout: denoise.get_bind_group_layout(0),
            preprocess,
            occlusion,
            denoise,
            bound,
        }))
    }

    /// Runs the passes and says what they took.
    pub fn frame(&self, (width_px, height_px): (u32, u32)) -> Result<Passes, Failure> {
        let queries = self.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("pass times"),
            ty: wgpu::QueryType::Timestamp,
            count: TIMESTAMPS,
        });
        let size = u64::from(TIMESTAMPS) * 8;
        let resolved = self.buffer(
            size,
            wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
        );
        let mut encoder = self.encoder();
        self.mark(&mut encoder, &queries, 0);
        // Pixels a side of what one workgroup covers, as in Bevy's `ssao` system.
        let steps = [
            (&self.preprocess, &self.bound.preprocess, 16),
            (&self.occlusion, &self.bound.occlusion, 8),
            (&self.denoise, &self.bound.denoise, 8),
        ];
        for (index, (pipeline, group, tile_px)) in (1..).zip(steps) {
            let tiles = [width_px, height_px].map(|px| px.div_ceil(tile_px));
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &**group, &[]);
            pass.set_bind_group(1, &*self.bound.common, &[self.bound.offset]);
            pass.dispatch_workgroups(tiles[0], tiles[1], 1);
            drop(pass);
            self.mark(&mut encoder, &queries, index);
        }
        encoder.resolve_query_set(&queries, 0..TIMESTAMPS, &resolved, 0);
        let bytes = self.submit_and_read(encoder, &resolved, size)?;
        let (ticks, _) = bytes.as_chunks::<8>();
        let tick_ns = f64::from(self.queue.get_timestamp_period());
        let at_ms = |index: usize| u64::from_le_bytes(ticks[index]) as f64 * tick_ns / 1e6;
        let took_ms = |pass: usize| (at_ms(pass + 1) - at_ms(pass)).max(0.0);
        Ok(Passes {
            before_ms: took_ms(0),
            occlusion_ms: took_ms(1),
            denoise_ms: took_ms(2),
        })
    }

    /// Writes a timestamp. Mesa's software adapter puts it off to the next barrier, by when a dispatch
    /// that follows is over: without a barrier in between, before and after would be one time.
    fn mark(&self, encoder: &mut wgpu::CommandEncoder, queries: &wgpu::QuerySet, index: u32) {
        encoder.write_timestamp(queries, index);
        if self.is_software {
            const BYTES: u64 = 4;
            let usage = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
            let [there, back] = [(); 2].map(|()| self.buffer(BYTES, usage));
            encoder.copy_buffer_to_buffer(&there, 0, &back, 0, BYTES);
            encoder.copy_buffer_to_buffer(&back, 0, &there, 0, BYTES);
        }
    }

    pub fn encoder(&self) -> wgpu::CommandEncoder {
        let descriptor = wgpu::CommandEncoderDescriptor::default();
        self.device.create_command_encoder(&descriptor)
    }

    pub fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("beside Bevy"),
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// Submits what was recorded and gives what `source` then holds.
    pub fn submit_and_read(
        &self,
        mut encoder: wgpu::CommandEncoder,
        source: &wgpu::Buffer,
        size: u64,
    ) -> Result<Vec<u8>, Failure> {
        let readable = self.buffer(
            size,
            wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        );
        encoder.copy_buffer_to_buffer(source, 0, &readable, 0, size);
        self.queue.submit([encoder.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        readable.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver outlives the wait below; if it is gone nobody waits.
            let _ = sender.send(result);
        });
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        receiver.recv()??;
        Ok(readable.get_mapped_range(..).to_vec())
    }

    /// What the denoising reads, and its layout.
    pub fn before_denoising(&self) -> (&wgpu::BindGroup, &wgpu::BindGroupLayout) {
        (&self.bound.denoise, &self.denoise_layout)
    }

    /// The occlusion after denoising, the depth and the normals that it is made from.
    pub fn textures(&self) -> [&wgpu::TextureView; 3] {
        [&self.bound.denoised, &self.bound.depth, &self.bound.normals]
    }
}

fn pipeline(cache: &PipelineCache, label: &str) -> Option<ComputePipeline> {
    cache
        .pipelines()
        .find_map(|cached| match (&cached.descriptor, &cached.state) {
            (
                PipelineDescriptor::ComputePipelineDescriptor(descriptor),
                CachedPipelineState::Ok(Pipeline::ComputePipeline(pipeline)),
            ) if descriptor.label.as_deref() == Some(label) => Some(pipeline.clone()),
            _ => None,
        })
}
