//! GPU time by pass, where the adapter can tell.

use super::Gpu;

/// Timestamps round each pass of one frame.
pub(super) struct Timestamps {
    period_ns: f32,
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
    count: u32,
}

impl Timestamps {
    /// Room for `passes` passes; `None` where the adapter has no timestamps.
    pub(super) fn new(gpu: &Gpu, passes: usize) -> Option<Self> {
        let period_ns = gpu.timestamp_period_ns?;
        let count = u32::try_from(2 * passes).ok()?;
        let buffer = |label, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(count) * 8,
                usage,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            period_ns,
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("pass times"),
                ty: wgpu::QueryType::Timestamp,
                count,
            }),
            resolved: buffer(
                "pass times",
                wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            ),
            readable: buffer(
                "pass times, read",
                wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            ),
            count,
        })
    }

    /// Marks the start (`end = false`) or end of a pass.
    pub(super) fn mark(&self, encoder: &mut wgpu::CommandEncoder, pass: usize, end: bool) {
        let index = 2 * pass + usize::from(end);
        encoder.write_timestamp(&self.queries, index as u32);
    }

    /// Ends the frame's recording.
    pub(super) fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..self.count, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(
            &self.resolved,
            0,
            &self.readable,
            0,
            u64::from(self.count) * 8,
        );
    }

    /// Milliseconds of each pass, in order, after the frame was submitted.
    pub(super) fn read(&self, gpu: &Gpu) -> Option<Vec<f64>> {
        let bytes = super::readback::map(gpu, &self.readable).ok()?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        Some(
            ticks
                .chunks_exact(2)
                .map(|pair| {
                    pair[1].saturating_sub(pair[0]) as f64 * f64::from(self.period_ns) / 1e6
                })
                .collect(),
        )
    }
}
