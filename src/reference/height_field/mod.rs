//! Light between the points of a height field: the truth that multi-bounce models are fitted to.
//!
//! Every texel sends rays over its whole hemisphere. Those that meet nothing see the sky, of unit
//! radiance; the others see another texel, and are kept as a link to it. Bounces then run along the
//! links alone: E₀ = (2π/N) Σ_free cosθ, E_{i+1}(x) = (2π/N) Σ_blocked (ρ/π) E_i(x′) cosθ.
//!
//! ```text
//! field       heights, normals, border     march      where a ray meets the field
//! directions  the rays of a texel          links      what each ray has met
//! transport   bounce after bounce          procedural heights to try it on
//! ```

mod directions;
mod field;
mod links;
mod march;
pub mod procedural;
mod transport;

pub use field::{Border, HeightField, HeightFieldError};
pub use links::{LinkSettings, Links};
pub use transport::{Bounces, Stopped, TransportSettings};

#[cfg(test)]
mod tests;
