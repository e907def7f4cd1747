//! Tools for building geometry in code: meshes from grids, lathes, sweeps and
//! bevelled blocks; sculptures from signed distances, turned into closed meshes.
//!
//! Everything here must give the same bytes on every machine. So there is no
//! `f32::sin` (the platform's own C library answers it, and they differ in the
//! last bit) and no SIMD type of glam (its sums are ordered differently by
//! architecture): [`math`] has what is needed instead.

pub mod blocks;
pub mod builder;
pub mod math;
pub mod noise;
pub mod polygonise;
pub mod profile;
pub mod sculpture;
pub mod sdf;
pub mod surface;

pub use builder::MeshBuilder;
pub use math::Frame;
pub use noise::Noise;
pub use profile::Profile;
