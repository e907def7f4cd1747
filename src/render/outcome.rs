//! What comes of drawing a frame, as plain data: the picture, what each pass took, and what drew it.

use serde::{Deserialize, Serialize};

/// An image as it goes to the screen: 8-bit sRGB, RGBA, rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// `4 · width_px · height_px` bytes; alpha is 255.
    pub rgba8: Vec<u8>,
}

/// One pass of a frame and what it took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PassRecord {
    /// Name of the pass.
    pub pass: String,
    /// GPU time, milliseconds; absent where the adapter has no timestamps.
    pub gpu_ms: Option<f64>,
    /// Whether it was drawn for an earlier image of the scene and used again.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub shared: bool,
}

/// The adapter that drew a set.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct AdapterRecord {
    /// As the driver names it.
    pub name: String,
    /// Vulkan, Metal, Dx12.
    pub backend: String,
    /// discrete GPU, integrated GPU, CPU, …
    pub kind: String,
    /// Driver and its version.
    pub driver: String,
}
