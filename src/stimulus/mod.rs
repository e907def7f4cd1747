//! Stimuli: sets of image pairs, where each image came from, and whether it is
//! still the image that was made.

pub mod check;
pub mod difference;
pub mod files;
pub mod flip;
mod folders;
pub mod loaded;
pub mod manifest;
pub mod pair_check;
mod plane;
pub mod produce;
pub mod progress;
pub mod quality;
pub mod set;
pub mod sheet;
pub mod ssim;
#[cfg(test)]
mod test_pictures;
pub mod truth;

pub use folders::Folders;
pub use manifest::{ImageRecord, Manifest, PairRecord, Picture, StimulusError};
pub use set::StimulusSet;
