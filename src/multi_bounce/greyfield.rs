//! Our own: a direct term that never exceeds 1, a first and a second bounce of their own, and the
//! rest as a geometric series.
//!
//! ```text
//! F₀ = 1 − (1−α)^(k₀ + k₁ α)        what arrives directly
//! g₁ = c₁ (1 − (1−α)^m₁)            share of what does not that arrives after one bounce, at ρ = 1
//! g₂ = f + c₂ (1 − (1−α)^m₂)        share of what is then left that every further bounce brings
//!
//! E/E₀ = F₀ + (1−F₀) [ρ g₁ + (1−g₁) ρ² g₂ / (1 − ρ + ρ g₂)]
//! ```
//!
//! That is F₀ + ρF₁ + ρ²F₂ / (1 − ρτ₂) with F₁ = (1−F₀) g₁, F₂ = (1−F₀−F₁) g₂ and τ₂ = 1 − g₂,
//! written so that nothing is divided by what may be 0: g₂ ≥ f > 0. At ρ = 1 the bracket is 1
//! and so is the sum. F₀, g₁ and g₂ grow with α and lie in [0, 1], hence so does the whole, in α and
//! in ρ.

use num_traits::Float;

use super::{Model, Openness, number as n, unit};

/// The coefficients, which `greyfield bounces --fit` fits to a map.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Coefficients {
    /// Exponent of the direct term where nothing is open.
    pub k0: f64,
    /// By how much it grows to where all is open.
    pub k1: f64,
    /// The first bounce's share of what is left, where all is open.
    pub c1: f64,
    /// How soon it gets there.
    pub m1: f64,
    /// By how much the later bounces' share grows to where all is open.
    pub c2: f64,
    /// How soon it gets there.
    pub m2: f64,
    /// The later bounces' share where nothing is open.
    pub f: f64,
}

/// Steps to the inverse of F₀: each takes off nine tenths of the error or more.
const INVERSE_STEPS: usize = 4;

/// Fitted to height fields; see docs/bounces.md for which, and for those it was tried on.
pub const COEFFICIENTS: Coefficients = Coefficients {
    k0: 1.515_8,
    k1: 0.119_6,
    c1: 0.722_9,
    m1: 4.045,
    c2: 0.95,
    m2: 1.72,
    f: 0.005,
};

impl Coefficients {
    /// F₀, g₁ and g₂ at an openness of 0 to 1.
    fn terms<F: Float>(&self, openness: F) -> [F; 3] {
        let closed = F::one() - openness;
        let rising = |full: f64, power: f64| n::<F>(full) * (F::one() - closed.powf(n(power)));
        let direct = F::one() - closed.powf(n::<F>(self.k0) + n::<F>(self.k1) * openness);
        let (first, later) = (rising(self.c1, self.m1), rising(self.c2, self.m2));
        [direct, first, n::<F>(self.f) + later]
    }

    /// F₀: the cosine-weighted openness that belongs to a uniform one.
    #[must_use]
    pub fn cosine_of<F: Float>(&self, uniform: F) -> F {
        let [direct, ..] = self.terms(unit(uniform));
        direct
    }

    /// The uniform openness that belongs to a cosine-weighted one: the inverse of F₀, as the fixed
    /// point of α = 1 − (1−k_A)^(1/(k₀ + k₁ α)), whose slope is below e⁻¹ k₁/(k₀ + k₁ α).
    #[must_use]
    pub fn uniform_of<F: Float>(&self, cosine: F) -> F {
        let closed = F::one() - unit(cosine);
        (0..INVERSE_STEPS).fold(F::one() - closed, |alpha, _| {
            F::one() - closed.powf((n::<F>(self.k0) + n::<F>(self.k1) * alpha).recip())
        })
    }

    /// E/E₀ at a uniform openness and an albedo; both are brought to 0 to 1.
    #[must_use]
    pub fn value<F: Float>(&self, openness: F, albedo: F) -> F {
        let (openness, albedo) = (unit(openness), unit(albedo));
        let [direct, first, later] = self.terms(openness);
        let further = albedo * albedo * later / (F::one() - albedo + albedo * later);
        let indirect = albedo * first + (F::one() - first) * further;
        direct + (F::one() - direct) * indirect
    }

    /// [`cosine_of`](Self::cosine_of) in WGSL.
    pub(super) fn cosine_of_wgsl(&self) -> String {
        let Self { k0, k1, .. } = self;
        format!(
            "fn cosine_of(openness: f32) -> f32 {{
    let a = clamp(openness, 0.0, 1.0);
    return 1.0 - pow(1.0 - a, {k0:?} + {k1:?} * a);
}}
"
        )
    }

    /// [`uniform_of`](Self::uniform_of) in WGSL.
    pub(super) fn uniform_of_wgsl(&self) -> String {
        let Self { k0, k1, .. } = self;
        format!(
            "fn uniform_of(openness: f32) -> f32 {{
    let k = clamp(openness, 0.0, 1.0);
    var a = k;
    for (var i = 0; i < {INVERSE_STEPS}; i++) {{
        a = 1.0 - pow(1.0 - k, 1.0 / ({k0:?} + {k1:?} * a));
    }}
    return a;
}}
"
        )
    }

    /// The model with these coefficients, in WGSL.
    fn wgsl(&self) -> String {
        let Self {
            k0,
            k1,
            c1,
            m1,
            c2,
            m2,
            f,
        } = self;
        format!(
            "fn multi_bounce(openness: f32, albedo: f32) -> f32 {{
    let rho = clamp(albedo, 0.0, 1.0);
    let alpha = clamp(openness, 0.0, 1.0);
    let closed = 1.0 - alpha;
    let direct = 1.0 - pow(closed, {k0:?} + {k1:?} * alpha);
    let first = {c1:?} * (1.0 - pow(closed, {m1:?}));
    let later = {f:?} + {c2:?} * (1.0 - pow(closed, {m2:?}));
    let further = rho * rho * later / (1.0 - rho + rho * later);
    return direct + (1.0 - direct) * (rho * first + (1.0 - first) * further);
}}
"
        )
    }
}

/// Ours.
pub static GREYFIELD: Model = Model {
    name: "greyfield",
    summary: "a direct term within 1, two bounces of their own and a geometric rest; whole at every openness and albedo",
    citation: "Greyfield, docs/bounces.md",
    openness: Openness::Uniform,
    is_safe: true,
    f64: |openness, albedo| COEFFICIENTS.value(openness, albedo),
    f32: |openness, albedo| COEFFICIENTS.value(openness, albedo),
    wgsl: || COEFFICIENTS.wgsl(),
};
