//! The GPU: a scene config in, an image out, headless, on any adapter wgpu finds,
//! a software one included. Same config, seed and adapter: same bytes.
//!
//! A frame is planned before it is drawn ([`plan`]): only the passes a scene calls for
//! exist. A technique is one Rust file and one WGSL file ([`technique`]). Everything
//! else is a pass ([`pass`]) that reads and writes named targets.

mod bindings;
mod buffers;
pub mod device;
mod environment;
mod error;
mod estimate;
mod frame;
mod light;
mod material;
mod mips;
mod outcome;
mod pass;
pub mod plan;
mod readback;
mod recorder;
mod renderer;
mod shader;
mod shading;
mod shadow_view;
pub mod stability;
mod surfaces;
mod targets;
pub mod technique;
mod timestamps;
mod timing;
mod upload;
mod visible;

pub use buffers::Buffer;
pub use device::Gpu;
pub use error::RenderError;
pub use frame::{FrameRequest, Precision};
pub use outcome::{AdapterRecord, PassRecord, Picture};
pub use readback::{FloatImage, LinearDepth};
pub use renderer::{RenderedFrame, Renderer, View};
pub use timing::{Clock, PassTimes, Repeats};
pub use upload::GpuScene;

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
