//! Passes recorded one after another, each timed, and what they took.

use super::Gpu;
use super::plan::PassKind;
use super::timestamps::Timestamps;
use crate::render::PassRecord;

/// Passes on their way to the GPU.
pub(super) struct Recorder<'a> {
    gpu: &'a Gpu,
    pub encoder: wgpu::CommandEncoder,
    timestamps: Option<Timestamps>,
    kinds: Vec<PassKind>,
}

impl<'a> Recorder<'a> {
    /// Room for `passes` passes.
    pub(super) fn new(gpu: &'a Gpu, passes: usize) -> Self {
        Self {
            gpu,
            encoder: gpu
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default()),
            timestamps: Timestamps::new(gpu, passes),
            kinds: Vec::new(),
        }
    }

    /// Records a pass.
    pub(super) fn pass(&mut self, kind: PassKind, record: impl FnOnce(&mut wgpu::CommandEncoder)) {
        let index = self.kinds.len();
        if let Some(timestamps) = &self.timestamps {
            timestamps.mark(&mut self.encoder, index, false);
        }
        record(&mut self.encoder);
        if let Some(timestamps) = &self.timestamps {
            timestamps.mark(&mut self.encoder, index, true);
        }
        self.kinds.push(kind);
    }

    /// Submits everything and waits for its times.
    pub(super) fn finish(mut self) -> Vec<PassRecord> {
        if let Some(timestamps) = &self.timestamps {
            timestamps.resolve(&mut self.encoder);
        }
        self.gpu.queue.submit([self.encoder.finish()]);
        let times = self
            .timestamps
            .and_then(|timestamps| timestamps.read(self.gpu));
        self.kinds
            .iter()
            .enumerate()
            .map(|(index, kind)| PassRecord {
                pass: kind.name().to_owned(),
                gpu_ms: times.as_ref().and_then(|times| times.get(index).copied()),
                shared: false,
            })
            .collect()
    }
}
