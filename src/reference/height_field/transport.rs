//! Light along the links, bounce after bounce.

use rayon::prelude::*;

use super::links::Links;

/// How far light is followed.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct TransportSettings {
    /// Bounces at most.
    pub bounces: usize,
    /// Irradiance below which a bounce no longer shows anywhere: half a level of 8 bits of the
    /// brightest that there is, π.
    pub least: f32,
}

impl Default for TransportSettings {
    fn default() -> Self {
        Self {
            bounces: 20,
            least: std::f32::consts::PI / 510.0,
        }
    }
}

/// Why no further bounce was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stopped {
    /// As many as asked for.
    Enough,
    /// The last adds less than can be seen, in every texel.
    Unseen,
    /// Nothing is sent back at all.
    Dark,
}

/// Irradiance of every texel, bounce by bounce, for one colour channel.
#[derive(Debug, Clone)]
pub struct Bounces {
    /// The uniform openness of every texel, 0 closed to 1 open.
    pub openness: Vec<f32>,
    /// E₀, E₁, …, each of every texel.
    pub irradiance: Vec<Vec<f32>>,
    /// Why there are no more.
    pub stopped: Stopped,
}

impl Bounces {
    /// Follows light of unit radiance from the sky over a field of these albedos (0 to 1, one a
    /// texel).
    ///
    /// # Panics
    /// If there are not as many albedos as texels.
    #[must_use]
    pub fn follow(links: &Links, albedo: &[f32], settings: &TransportSettings) -> Self {
        assert_eq!(albedo.len(), links.texels(), "one albedo a texel");
        let (openness, direct): (Vec<f32>, Vec<f32>) = (0..links.texels())
            .into_par_iter()
            .map(|texel| links.sky(texel))
            .unzip();
        let mut bounces = Self {
            openness,
            irradiance: vec![direct],
            stopped: Stopped::Enough,
        };
        for _ in 0..settings.bounces {
            let Some(last) = bounces.irradiance.last() else {
                break;
            };
            let sent: Vec<f32> = last.iter().zip(albedo).map(|(e, rho)| e * rho).collect();
            let next: Vec<f32> = (0..links.texels())
                .into_par_iter()
                .map(|texel| links.gathered(texel, &sent))
                .collect();
            let brightest = next.iter().copied().fold(0.0, f32::max);
            if brightest == 0.0 {
                bounces.stopped = Stopped::Dark;
                break;
            }
            bounces.irradiance.push(next);
            if brightest < settings.least {
                bounces.stopped = Stopped::Unseen;
                break;
            }
        }
        bounces
    }

    /// The sum of all bounces of a texel.
    #[must_use]
    pub fn sum(&self, texel: usize) -> f32 {
        self.irradiance.iter().map(|bounce| bounce[texel]).sum()
    }
}
