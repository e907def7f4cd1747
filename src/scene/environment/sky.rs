//! A daylight sky: Preetham, Shirley and Smits 1999, "A Practical Analytic Model for
//! Daylight", over a matte ground, with clouds if asked for.
//!
//! Radiance is in kcd/m² of luminance, irradiance in klx, in linear sRGB primaries: the numbers a
//! light meter would show, over a thousand. The sun's disc is **not** in the map: the
//! directional light carries it ([`Sky::sunlight`]), and it must not be counted twice. The glow
//! round the sun is scattered light and is in the map.

use glam::{Mat3, Vec3};

use super::RadianceMap;
use super::clouds::Clouds;
use crate::scene::modelling::math::{self, smoothstep};

/// What a sky is made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Sky {
    /// Height of the sun over the horizon, radians, above 0 up to π/2.
    pub sun_elevation_rad: f32,
    /// Direction of the sun, radians clockwise seen from above: 0 is −Z, π/2 is +X.
    pub sun_azimuth_rad: f32,
    /// How much thicker the air is than clean air: 2 is very clear, 3 clear, 6 hazy, 10 thick.
    /// The model was fitted from 2 to 6 and stays plausible to 10.
    pub turbidity: f32,
    /// Linear RGB albedo of the ground, 0 to 1.
    pub ground: Vec3,
    /// Share of the sky under clouds, 0 to 1.
    pub clouds: f32,
    /// Seed of the clouds.
    pub seed: u64,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            sun_elevation_rad: 45_f32.to_radians(),
            sun_azimuth_rad: 0.0,
            turbidity: 3.0,
            ground: Vec3::new(0.2, 0.18, 0.15),
            clouds: 0.0,
            seed: 0,
        }
    }
}

/// Parallel light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sunlight {
    /// Unit vector towards the sun.
    pub towards: Vec3,
    /// Linear RGB irradiance on a surface that faces it, klx.
    pub irradiance: Vec3,
}

/// Rows of a sky's map: a texel is a third of a degree.
const HEIGHT_PX: usize = 512;

/// Illuminance of the sun outside the atmosphere, klx.
const SOLAR_CONSTANT_KLX: f32 = 128.0;

impl Sky {
    /// The sun that lights this sky, after its way through the air.
    #[must_use]
    pub fn sunlight(&self) -> Sunlight {
        let horizontal = math::cos(self.sun_elevation_rad);
        Sunlight {
            towards: Vec3::new(
                horizontal * math::sin(self.sun_azimuth_rad),
                math::sin(self.sun_elevation_rad),
                -horizontal * math::cos(self.sun_azimuth_rad),
            ),
            irradiance: solar_colour() * SOLAR_CONSTANT_KLX * self.transmittance(),
        }
    }

    /// What the air leaves of the sun's light at the dominant wavelengths of the three primaries
    /// (Preetham et al. 1999, appendix A.1: Rayleigh, aerosol by Ångström's formula, ozone).
    fn transmittance(&self) -> Vec3 {
        const WAVELENGTHS_UM: [f32; 3] = [0.61, 0.55, 0.465];
        const OZONE_PER_CM: [f32; 3] = [0.12, 0.085, 0.0075];
        const OZONE_CM: f32 = 0.35;
        let from_zenith_deg = 90.0 - self.sun_elevation_rad.to_degrees();
        let mass = 1.0
            / (math::sin(self.sun_elevation_rad)
                + 0.15 * math::pow(93.885 - from_zenith_deg, -1.253));
        let aerosol = 0.046_08 * self.turbidity - 0.045_86;
        Vec3::from(std::array::from_fn(|channel| {
            let wavelength_um = WAVELENGTHS_UM[channel];
            let depth = 0.008_735 * math::pow(wavelength_um, -4.08)
                + aerosol * math::pow(wavelength_um, -1.3)
                + OZONE_PER_CM[channel] * OZONE_CM;
            math::exp(-depth * mass)
        }))
    }

    /// The sky and the ground as a map, without the sun's disc.
    #[must_use]
    pub fn map(&self) -> RadianceMap {
        let sun = self.sunlight();
        let air = ClearSky::new(self, sun.towards);
        let clouds = (self.clouds > 0.0).then(|| Clouds::new(self, &air));
        let above = |towards: Vec3| {
            let clear = air.radiance(towards);
            clouds
                .as_ref()
                .map_or(clear, |clouds| clouds.over(clear, towards))
        };
        // Matte ground under the sky and the sun (radiance = albedo · irradiance / π).
        let from_sky = horizontal_irradiance(above);
        let from_sun = sun.irradiance * sun.towards.y * (1.0 - self.clouds);
        let ground = self.ground * (from_sky + from_sun) / std::f32::consts::PI;
        RadianceMap::from_fn(HEIGHT_PX, |towards| {
            // Haze hides where they meet: distant ground has the colour of the air before it.
            let haze = smoothstep(-0.12, 0.0, towards.y);
            let level = Vec3::new(towards.x, towards.y.max(0.0), towards.z).normalize();
            ground.lerp(above(level), haze)
        })
    }
}

/// Irradiance on a level surface, by a midpoint rule of 32 × 64 directions of equal solid angle.
fn horizontal_irradiance(radiance: impl Fn(Vec3) -> Vec3) -> Vec3 {
    const ROWS: usize = 32;
    const COLUMNS: usize = 64;
    let mut sum = Vec3::ZERO;
    for index in 0..ROWS * COLUMNS {
        let y = ((index / COLUMNS) as f32 + 0.5) / ROWS as f32;
        let azimuth = std::f32::consts::TAU * ((index % COLUMNS) as f32 + 0.5) / COLUMNS as f32;
        let around = math::on_circle(azimuth) * (1.0 - y * y).sqrt();
        sum += radiance(Vec3::new(around.x, y, around.y)) * y;
    }
    sum * std::f32::consts::TAU / (ROWS * COLUMNS) as f32
}

/// The sky without clouds.
pub(super) struct ClearSky {
    towards_sun: Vec3,
    /// Perez' five coefficients of luminance Y and of the chromaticities x, y.
    perez: [[f32; 5]; 3],
    /// Zenith's Y (kcd/m²), x, y over what Perez' function gives there.
    scale: [f32; 3],
}

impl ClearSky {
    fn new(sky: &Sky, towards_sun: Vec3) -> Self {
        let t = sky.turbidity;
        let from_zenith = std::f32::consts::FRAC_PI_2 - sky.sun_elevation_rad;
        let perez = perez_coefficients(t);
        let zenith = [
            zenith_luminance(t, from_zenith),
            zenith_chromaticity(&ZENITH_X, t, from_zenith),
            zenith_chromaticity(&ZENITH_Y, t, from_zenith),
        ];
        Self {
            towards_sun,
            scale: std::array::from_fn(|i| zenith[i] / perez_at(&perez[i], 1.0, from_zenith)),
            perez,
        }
    }

    /// Linear RGB radiance from a unit direction above the horizon, kcd/m².
    pub(super) fn radiance(&self, towards: Vec3) -> Vec3 {
        // The model's denominator ends at the horizon; a degree above it is where it still holds.
        let cos_zenith = towards.y.max(0.017);
        // Not the arc cosine of the dot product, whose digits fail near the sun.
        let from_sun = 2.0
            * math::atan2(
                (towards - self.towards_sun).length(),
                (towards + self.towards_sun).length(),
            );
        let [luminance, x, y] =
            std::array::from_fn(|i| self.scale[i] * perez_at(&self.perez[i], cos_zenith, from_sun));
        rgb_of(luminance, x, y)
    }
}

/// Perez' sky function (Preetham et al. 1999, eq. 3).
fn perez_at([a, b, c, d, e]: &[f32; 5], cos_zenith: f32, from_sun: f32) -> f32 {
    let cos_from_sun = math::cos(from_sun);
    (1.0 + a * math::exp(b / cos_zenith))
        * (1.0 + c * math::exp(d * from_sun) + e * cos_from_sun * cos_from_sun)
}

/// Preetham et al. 1999, appendix A.2: the coefficients are linear in turbidity.
fn perez_coefficients(turbidity: f32) -> [[f32; 5]; 3] {
    let linear = |pairs: [(f32, f32); 5]| pairs.map(|(slope, offset)| slope * turbidity + offset);
    [
        linear([
            (0.1787, -1.4630),
            (-0.3554, 0.4275),
            (-0.0227, 5.3251),
            (0.1206, -2.5771),
            (-0.0670, 0.3703),
        ]),
        linear([
            (-0.0193, -0.2592),
            (-0.0665, 0.0008),
            (-0.0004, 0.2125),
            (-0.0641, -0.8989),
            (-0.0033, 0.0452),
        ]),
        linear([
            (-0.0167, -0.2608),
            (-0.0950, 0.0092),
            (-0.0079, 0.2102),
            (-0.0441, -1.6537),
            (-0.0109, 0.0529),
        ]),
    ]
}

fn zenith_luminance(turbidity: f32, from_zenith: f32) -> f32 {
    let chi = (4.0 / 9.0 - turbidity / 120.0) * (std::f32::consts::PI - 2.0 * from_zenith);
    let tangent = math::sin(chi) / math::cos(chi);
    // Negative for a sun at the horizon in thick air, where the fit ends.
    ((4.0453 * turbidity - 4.9710) * tangent - 0.2155 * turbidity + 2.4192).max(0.05)
}

/// Rows by falling power of turbidity (2, 1, 0), columns by falling power of the sun's zenith
/// angle (3 to 0).
type ZenithFit = [[f32; 4]; 3];

const ZENITH_X: ZenithFit = [
    [0.001_66, -0.003_75, 0.002_09, 0.0],
    [-0.029_03, 0.063_77, -0.032_02, 0.003_94],
    [0.116_93, -0.211_96, 0.060_52, 0.258_86],
];

const ZENITH_Y: ZenithFit = [
    [0.002_75, -0.006_10, 0.003_17, 0.0],
    [-0.042_14, 0.089_70, -0.041_53, 0.005_16],
    [0.153_46, -0.267_56, 0.066_70, 0.266_88],
];

fn zenith_chromaticity(fit: &ZenithFit, turbidity: f32, from_zenith: f32) -> f32 {
    let horner = |row: &[f32]| row.iter().fold(0.0, |sum, term| sum * from_zenith + term);
    fit.iter()
        .fold(0.0, |sum, row| sum * turbidity + horner(row))
}

/// CIE xyY to linear sRGB (IEC 61966-2-1), nothing below zero.
fn rgb_of(luminance: f32, x: f32, y: f32) -> Vec3 {
    let xyz = Vec3::new(x / y, 1.0, (1.0 - x - y) / y) * luminance;
    let to_rgb = Mat3::from_cols(
        Vec3::new(3.2406, -0.9689, 0.0557),
        Vec3::new(-1.5372, 1.8758, -0.2040),
        Vec3::new(-0.4986, 0.0415, 1.0570),
    );
    (to_rgb * xyz).max(Vec3::ZERO)
}

/// Sunlight outside the atmosphere at luminance 1 (chromaticity of a 5900 K source).
fn solar_colour() -> Vec3 {
    rgb_of(1.0, 0.3233, 0.3326)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn luminance(rgb: Vec3) -> f32 {
        rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722))
    }

    /// Handbook values of a clear day (IES Lighting Handbook; CIE 108-1994): the sun gives
    /// about 70 to 100 klx on a surface that faces it when it is high and 15 to 45 when it is low;
    /// the blue sky has 2 to 20 kcd/m².
    #[test]
    fn sun_and_sky_are_as_bright_as_a_clear_day() {
        let at = |degrees: f32| Sky {
            sun_elevation_rad: degrees.to_radians(),
            turbidity: 2.5,
            ..Sky::default()
        };
        let high = luminance(at(60.0).sunlight().irradiance);
        let low = luminance(at(10.0).sunlight().irradiance);
        assert!((70.0..100.0).contains(&high), "{high}");
        assert!((15.0..45.0).contains(&low), "{low}");
        let map = at(45.0).map();
        let zenith = luminance(map.at(Vec3::Y));
        assert!((1.0..20.0).contains(&zenith), "{zenith}");
    }

    #[test]
    fn the_sky_is_blue_and_the_low_sun_is_warm() {
        let sky = Sky::default();
        let away = sky.map().at(Vec3::new(0.0, 0.7, 0.7).normalize());
        assert!(away.z > 1.5 * away.x, "{away}");
        let ratio = |degrees: f32| {
            let sun = Sky {
                sun_elevation_rad: degrees.to_radians(),
                ..sky.clone()
            }
            .sunlight()
            .irradiance;
            sun.x / sun.z
        };
        assert!(
            ratio(5.0) > 2.0 * ratio(60.0),
            "{} {}",
            ratio(5.0),
            ratio(60.0)
        );
    }

    #[test]
    fn the_sun_stands_where_it_was_put_and_the_sky_is_brightest_there() {
        let sky = Sky {
            sun_elevation_rad: 30_f32.to_radians(),
            sun_azimuth_rad: std::f32::consts::FRAC_PI_2,
            ..Sky::default()
        };
        let towards = sky.sunlight().towards;
        assert!(
            (towards - Vec3::new(0.75_f32.sqrt(), 0.5, 0.0)).length() < 1e-6,
            "{towards}"
        );
        let map = sky.map();
        let glow = luminance(map.at(towards));
        for other in [Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z] {
            assert!(glow > luminance(map.at(other)));
        }
        // The glow, not the disc, which would have 10^5 times the sky's luminance.
        assert!(glow < 20.0 * luminance(map.at(Vec3::Y)), "{glow}");
    }

    /// Below, the ground reflects what comes from above: albedo times irradiance over π.
    #[test]
    fn the_ground_reflects_the_sky_and_the_sun() {
        let sky = Sky {
            ground: Vec3::splat(0.5),
            ..Sky::default()
        };
        let map = sky.map();
        let mut from_sky = Vec3::ZERO;
        for row in 0..map.height_px() / 2 {
            for column in 0..map.width_px() {
                let towards = map.direction(column, row);
                from_sky += map.at(towards) * towards.y * map.solid_angle(row) as f32;
            }
        }
        let sun = sky.sunlight();
        let expected = (from_sky + sun.irradiance * sun.towards.y) * 0.5 / std::f32::consts::PI;
        let found = map.at(Vec3::NEG_Y);
        assert!(
            (found / expected - 1.0).abs().max_element() < 0.02,
            "{found} {expected}"
        );
    }

    #[test]
    fn the_horizon_has_no_edge() {
        let map = Sky::default().map();
        for column in (0..map.width_px()).step_by(100) {
            for row in 200..320 {
                let texel = |row: usize| map.texels()[row * map.width_px() + column];
                let step = (texel(row + 1) / texel(row) - 1.0).abs().max_element();
                assert!(step < 0.12, "row {row}, column {column}: {step}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn every_sky_is_finite_and_not_negative(
            elevation_deg in 1.0_f32..90.0,
            turbidity in 2.0_f32..10.0,
            clouds in 0.0_f32..1.0,
            x in -1.0_f32..1.0, y in 0.0_f32..1.0, z in -1.0_f32..1.0,
        ) {
            let sky = Sky {
                sun_elevation_rad: elevation_deg.to_radians(),
                turbidity,
                clouds,
                ..Sky::default()
            };
            let sun = sky.sunlight();
            prop_assert!(sun.irradiance.is_finite() && sun.irradiance.min_element() >= 0.0);
            prop_assert!(sun.irradiance.max_element() < 1.2 * SOLAR_CONSTANT_KLX);
            let air = ClearSky::new(&sky, sun.towards);
            let towards = (Vec3::new(x, y, z) + Vec3::Y * 1e-3).normalize();
            for direction in [towards, sun.towards, Vec3::Y] {
                let clear = air.radiance(direction);
                prop_assert!(clear.is_finite() && clear.min_element() >= 0.0, "{}", clear);
                let seen = Clouds::new(&sky, &air).over(clear, direction);
                prop_assert!(seen.is_finite() && seen.min_element() >= 0.0, "{}", seen);
            }
        }
    }
}
