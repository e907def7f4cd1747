//! How surfaces reflect: Lambert plus the GGX microfacet term, as `shading/brdf.wgsl` has it.
//!
//! This is the same function for the processor: the environment's prefiltering samples it, and
//! tests hold it to what a physical BRDF must satisfy (reciprocity, no more light out than in).

use glam::Vec3;

use crate::scene::modelling::math;

/// Roughness below which the lobe is narrower than a pixel, and a point light's highlight only
/// aliases.
pub const LEAST_ROUGHNESS: f32 = 0.05;

/// What one surface point is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finish {
    /// Linear RGB base colour: of the diffuse part, or of the metal's reflection.
    pub albedo: Vec3,
    /// Reflectance of a non-metal at normal incidence, 0 to 1 (0.04 for most).
    pub specular: f32,
    /// Perceptual roughness, 0 to 1; the square is GGX' α (Burley 2012).
    pub roughness: f32,
    /// 0 for a non-metal, 1 for a metal.
    pub metallic: f32,
}

impl Finish {
    /// Reflectance at normal incidence, linear RGB.
    #[must_use]
    pub fn reflectance(&self) -> Vec3 {
        Vec3::splat(self.specular).lerp(self.albedo, self.metallic)
    }

    /// The BRDF, per steradian: radiance towards `to_eye` over irradiance from `to_light`; all three unit
    /// vectors. 0 unless both are above the surface.
    ///
    /// Diffuse: Lambert. Specular: Cook and Torrance 1982 with the GGX distribution (Walter et al. 2007),
    /// Smith's height-correlated masking (Heitz 2014, eq. 99) and Schlick's Fresnel term (1994).
    #[must_use]
    pub fn brdf(&self, normal: Vec3, to_eye: Vec3, to_light: Vec3) -> Vec3 {
        let (n_dot_v, n_dot_l) = (normal.dot(to_eye), normal.dot(to_light));
        if n_dot_v <= 0.0 || n_dot_l <= 0.0 {
            return Vec3::ZERO;
        }
        let half = (to_eye + to_light).normalize();
        let roughness = self.roughness.max(LEAST_ROUGHNESS);
        let f0 = self.reflectance();
        let fresnel =
            f0 + (Vec3::ONE - f0) * math::pow(1.0 - to_eye.dot(half).clamp(0.0, 1.0), 5.0);
        let microfacets = distribution(normal.dot(half).clamp(0.0, 1.0), roughness)
            * visibility(n_dot_v, n_dot_l, roughness);
        self.albedo * (1.0 - self.metallic) / std::f32::consts::PI + fresnel * microfacets
    }
}

/// GGX (Trowbridge and Reitz 1975; Walter et al. 2007, eq. 33): share of facets a steradian whose
/// normal has cosine `n_dot_h` to the surface's.
#[must_use]
pub fn distribution(n_dot_h: f32, roughness: f32) -> f32 {
    let alpha2 = math::pow(roughness, 4.0);
    let lobe = n_dot_h * n_dot_h * (alpha2 - 1.0) + 1.0;
    alpha2 / (std::f32::consts::PI * lobe * lobe)
}

/// Masking and shadowing over 4 (n·v)(n·l) (Heitz 2014, eq. 99, for GGX).
#[must_use]
pub fn visibility(n_dot_v: f32, n_dot_l: f32, roughness: f32) -> f32 {
    let alpha2 = math::pow(roughness, 4.0);
    let v = n_dot_l * (n_dot_v * n_dot_v * (1.0 - alpha2) + alpha2).sqrt();
    let l = n_dot_v * (n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2).sqrt();
    0.5 / (v + l).max(1e-6)
}

/// A half vector about +Z with density D(h)·cos θ, from a point of the unit square (Walter et al. 2007,
/// eq. 35 and 36).
#[must_use]
pub fn sample_half_vector((first, second): (f32, f32), roughness: f32) -> Vec3 {
    let alpha2 = math::pow(roughness, 4.0);
    let cos2 = (1.0 - first) / (1.0 + (alpha2 - 1.0) * first);
    let around = math::on_circle(std::f32::consts::TAU * second) * (1.0 - cos2).max(0.0).sqrt();
    around.extend(cos2.max(0.0).sqrt())
}

/// Point `index` of `count` in the unit square (Hammersley 1960; van der Corput's radical inverse by
/// reversing the bits).
#[must_use]
pub fn hammersley(index: u32, count: u32) -> (f32, f32) {
    let first = (index as f32 + 0.5) / count as f32;
    let second = (index.reverse_bits() >> 8) as f32 / (1_u32 << 24) as f32;
    (first, second)
}

/// What a surface reflects of constant light from everywhere, by the cosine of the view's angle and the
/// roughness: (scale, offset) of its reflectance at normal incidence f0, which give f0·scale + offset.
///
/// The second sum of Karis 2013, "Real Shading in Unreal Engine 4". A table, not the fit of Karis 2014
/// for phones, which loses a sixth of what a polished metal reflects.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvironmentTable {
    /// Rows by roughness, columns by cosine; entry i of n is for the value i/(n − 1).
    pub entries: Vec<[f32; 2]>,
}

impl EnvironmentTable {
    /// Columns, and rows.
    pub const SIDE: usize = 32;
    const SAMPLES: u32 = 1024;

    /// Sums the BRDF over a fixed set of half vectors for every entry.
    #[must_use]
    pub fn new() -> Self {
        let value = |index: usize| index as f32 / (Self::SIDE - 1) as f32;
        let entries = (0..Self::SIDE * Self::SIDE)
            .map(|i| {
                // The exact ends, a view along the surface and a mirror, divide nothing by nothing.
                let n_dot_v = value(i % Self::SIDE).max(1e-3);
                Self::entry(n_dot_v, value(i / Self::SIDE).max(LEAST_ROUGHNESS))
            })
            .collect();
        Self { entries }
    }

    fn entry(n_dot_v: f32, roughness: f32) -> [f32; 2] {
        let to_eye = Vec3::new((1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v);
        let (mut scale, mut offset) = (0.0, 0.0);
        for i in 0..Self::SAMPLES {
            let half = sample_half_vector(hammersley(i, Self::SAMPLES), roughness);
            let v_dot_h = to_eye.dot(half);
            let to_light = 2.0 * v_dot_h * half - to_eye;
            if v_dot_h <= 0.0 || to_light.z <= 0.0 {
                continue;
            }
            // D cancels: BRDF · cos / density = V · 4 (n·l)(v·h)/(n·h) · F.
            let weight =
                visibility(n_dot_v, to_light.z, roughness) * 4.0 * to_light.z * v_dot_h / half.z;
            let grazing = math::pow(1.0 - v_dot_h, 5.0);
            scale += weight * (1.0 - grazing);
            offset += weight * grazing;
        }
        [scale, offset].map(|sum| sum / Self::SAMPLES as f32)
    }

    /// (scale, offset), bilinear between the entries.
    #[must_use]
    pub fn at(&self, n_dot_v: f32, roughness: f32) -> (f32, f32) {
        let last = (Self::SIDE - 1) as f32;
        let place = |value: f32| (value * last).clamp(0.0, last);
        let (x, y) = (place(n_dot_v), place(roughness));
        let entry = |column: f32, row: f32| {
            let index = row as usize * Self::SIDE + column as usize;
            glam::Vec2::from(self.entries[index])
        };
        let row = |y: f32| {
            let right = (x.floor() + 1.0).min(last);
            entry(x.floor(), y).lerp(entry(right, y), x.fract())
        };
        let found = row(y.floor()).lerp(row((y.floor() + 1.0).min(last)), y.fract());
        (found.x, found.y)
    }
}

impl Default for EnvironmentTable {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Integral of f over the hemisphere about +Z, by a midpoint rule in both angles.
    fn over_hemisphere(f: impl Fn(Vec3) -> f32) -> f32 {
        const ROWS: usize = 400;
        const COLUMNS: usize = 800;
        let mut sum = 0.0_f64;
        for index in 0..ROWS * COLUMNS {
            let angle =
                std::f32::consts::FRAC_PI_2 * ((index / COLUMNS) as f32 + 0.5) / ROWS as f32;
            let (sin, z) = (math::sin(angle), math::cos(angle));
            let azimuth = std::f32::consts::TAU * ((index % COLUMNS) as f32 + 0.5) / COLUMNS as f32;
            sum += f64::from(f((math::on_circle(azimuth) * sin).extend(z)) * sin);
        }
        let cell = std::f64::consts::TAU * std::f64::consts::FRAC_PI_2 / (ROWS * COLUMNS) as f64;
        (sum * cell) as f32
    }

    fn from_cosine(n_dot_v: f32) -> Vec3 {
        Vec3::new((1.0 - n_dot_v * n_dot_v).sqrt(), 0.0, n_dot_v)
    }

    /// The projected area of all facets is the surface's (Heitz 2014, eq. 8).
    #[test]
    fn facets_cover_the_surface() {
        for roughness in [0.3, 0.5, 0.8, 1.0] {
            let area = over_hemisphere(|h| distribution(h.z, roughness) * h.z);
            assert!((area - 1.0).abs() < 0.01, "{roughness}: {area}");
        }
    }

    /// A white furnace: a surface that absorbs nothing, in light of 1 from everywhere, never
    /// shows more than 1, and hardly less when it is smooth (what is missing was masked: single
    /// scattering loses it).
    #[test]
    fn a_perfect_metal_in_a_furnace_gives_no_more_than_it_gets() {
        for roughness in [0.3, 0.6, 1.0] {
            for n_dot_v in [0.1, 0.4, 1.0] {
                let metal = Finish {
                    albedo: Vec3::ONE,
                    specular: 0.04,
                    roughness,
                    metallic: 1.0,
                };
                let eye = from_cosine(n_dot_v);
                let out = over_hemisphere(|l| metal.brdf(Vec3::Z, eye, l).x * l.z);
                assert!(out <= 1.005, "{roughness} {n_dot_v}: {out}");
                let smooth = roughness <= 0.3 && n_dot_v >= 0.4;
                assert!(!smooth || out > 0.95, "{roughness} {n_dot_v}: {out}");
            }
        }
    }

    /// Without shadowing of the light, a furnace is exactly white (Heitz 2014, eq. 80): D and the
    /// masking of the view belong together. V = 1/(4 (n·v)(n·l)(1 + Λ(v) + Λ(l))), and Λ(l) is 0 for a light
    /// straight above.
    #[test]
    fn distribution_and_masking_belong_together() {
        for roughness in [0.3, 0.6, 1.0] {
            for n_dot_v in [0.1, 0.5, 0.9] {
                let eye = from_cosine(n_dot_v);
                let masking = 4.0 * n_dot_v * visibility(n_dot_v, 1.0, roughness);
                let out = over_hemisphere_of_half_vectors(roughness, |half| {
                    masking * eye.dot(half).max(0.0) / (n_dot_v * half.z)
                });
                assert!((out - 1.0).abs() < 0.01, "{roughness} {n_dot_v}: {out}");
            }
        }
    }

    /// Mean of f·D(h)·cos θ over half vectors, by sampling them.
    fn over_hemisphere_of_half_vectors(roughness: f32, f: impl Fn(Vec3) -> f32) -> f32 {
        const COUNT: u32 = 1 << 14;
        let sum: f64 = (0..COUNT)
            .map(|i| f64::from(f(sample_half_vector(hammersley(i, COUNT), roughness))))
            .sum();
        (sum / f64::from(COUNT)) as f32
    }

    #[test]
    fn the_table_is_the_integral() {
        let table = EnvironmentTable::new();
        for roughness in [0.3, 0.6, 1.0] {
            for n_dot_v in [0.15, 0.4, 1.0] {
                let eye = from_cosine(n_dot_v);
                let (scale, offset) = table.at(n_dot_v, roughness);
                for f0 in [0.04, 1.0] {
                    let metal = Finish {
                        albedo: Vec3::splat(f0),
                        specular: 0.0,
                        roughness,
                        metallic: 1.0,
                    };
                    let exact = over_hemisphere(|l| metal.brdf(Vec3::Z, eye, l).x * l.z);
                    let found = f0 * scale + offset;
                    assert!(
                        (found - exact).abs() < 0.015,
                        "{roughness} {n_dot_v} {f0}: {found} {exact}"
                    );
                }
            }
        }
    }

    #[test]
    fn samples_follow_the_distribution() {
        // The median of the cosine's distribution: half of D(h) cos θ lies inside it.
        for roughness in [0.3, 0.7, 1.0] {
            let middle = sample_half_vector((0.5, 0.0), roughness).z;
            let inside =
                over_hemisphere(|h| f32::from(h.z > middle) * distribution(h.z, roughness) * h.z);
            assert!((inside - 0.5).abs() < 0.02, "{roughness}: {inside}");
        }
    }

    fn upper() -> impl Strategy<Value = Vec3> {
        (-1.0_f32..1.0, -1.0_f32..1.0, 0.02_f32..1.0)
            .prop_map(|(x, y, z)| Vec3::new(x, y, z).normalize())
    }

    proptest! {
        #[test]
        fn eye_and_light_may_change_places(
            eye in upper(), light in upper(),
            roughness in 0.0_f32..1.0, metallic in 0.0_f32..1.0, albedo in 0.0_f32..1.0,
        ) {
            let finish = Finish { albedo: Vec3::splat(albedo), specular: 0.04, roughness, metallic };
            let there = finish.brdf(Vec3::Z, eye, light).x;
            let back = finish.brdf(Vec3::Z, light, eye).x;
            prop_assert!(there.is_finite() && there >= 0.0);
            prop_assert!((there - back).abs() <= 1e-3 * there.max(1e-3), "{there} {back}");
        }
    }
}
