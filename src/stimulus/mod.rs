//! Stimuli: sets of image pairs, where each image came from, and whether it is
//! still the image that was made.

pub mod manifest;

pub use manifest::{ImageRecord, Manifest, PairRecord};
