//! Light between the points of a height field: the truth that multi-bounce models are fitted to.
//!
//! Every texel sends rays over its whole hemisphere. Those that meet nothing see the sky, of unit
//! radiance; the others see another texel, and are kept as a link to it. Bounces then run along the
//! links alone: E₀ = (2π/N) Σ_free cosθ, E_{i+1}(x) = (2π/N) Σ_blocked (ρ/π) E_i(x′) cosθ.
//!
//! ```text
//! field       heights, normals, border     march      where a ray meets the field
//! directions  the rays of a texel          links      what each ray has met
//! transport   bounce after bounce          curves     irradiance over openness
//! source      heights and albedos from files, by way of picture
//! procedural  heights that need none
//! ```

mod curves;
mod directions;
mod field;
mod links;
mod march;
mod picture;
pub mod procedural;
mod source;
mod transport;

pub use curves::{BINS, CurvePoint, bin_of, curves};
pub use field::{Border, HeightField, HeightFieldError};
pub use links::{LinkSettings, Links};
pub use picture::PictureError;
pub use source::{HeightMap, HeightSource, MapError, albedo_map};
pub use transport::{Bounces, Stopped, TransportSettings};

#[cfg(test)]
mod tests;
