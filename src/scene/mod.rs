//! What a picture is made of: geometry, materials, light and camera, as plain
//! data. Nothing here knows of a GPU.
//!
//! Conventions: metres, right-handed, +Y up, a camera looks along its own −Z;
//! triangles are counter-clockwise seen from outside; colours are linear unless a
//! name says sRGB.

pub mod brdf;
pub mod camera;
pub mod config;
pub mod environment;
pub mod geometry;
pub mod lighting;
pub mod model;
pub mod modelling;
pub mod primitives;
pub mod procedural;
pub mod proxies;
pub mod source;
pub mod srgb;
mod subdivide;
pub mod texture;
pub mod visible;

pub use camera::Camera;
pub use config::{SceneConfig, SceneError};
pub use environment::{Environment, Irradiance};
pub use geometry::{
    Geometry, Material, Mesh, ModelLights, Texture, TextureEncoding, TextureUse, Vertex, Wrap,
};
pub use lighting::{Ambient, Background, Cone, Lighting, PointLight, Sun, ToneMap};
pub use proxies::{Sphere, SurfacePoint, SurfacePoints};
pub use source::GeometrySource;
pub use visible::VisibleSurfaces;
