//! The truth that approximations are measured against: occlusion by rays through the scene,
//! on all processor cores, each value with its standard error.
//!
//! [`RayTraced`] asks the scene's triangles, [`ScreenSpace`] asks a depth buffer, with the same
//! directions and the same weighting: what the second lacks against the first is information
//! that a depth buffer does not hold. [`estimate`] asks either at every visible point. [`follow`] goes
//! on from there: light over any number of bounces, which models of it are measured against.

mod albedo;
pub mod bent_cone;
pub mod bounce_fit;
pub mod bright;
pub mod bvh;
pub mod directions;
mod error;
pub mod height_field;
mod inter_reflected;
pub mod lit;
mod occlusion;
mod ray_traced;
mod screen_space;
pub mod sobol;
mod thinned;

pub use albedo::Albedos;
pub use bent_cone::{BentCone, Opening};
pub use bvh::SceneBvh;
pub use directions::Weighting;
pub use error::ReferenceError;
pub use inter_reflected::{InterReflectionSettings, InterReflections, follow};
pub use occlusion::{Estimates, OcclusionSettings, Surroundings, estimate};
pub use ray_traced::{RayTraced, SurfacePoint};
pub use screen_space::ScreenSpace;
pub use thinned::Thinned;

#[cfg(test)]
mod tests;
