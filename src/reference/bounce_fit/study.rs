//! All that is known of one or several height maps: what the figures show and the files hold.

use super::ALBEDOS;
use super::forms::Fit;
use super::measured::Measured;
use super::validation::{Candidate, MapError, validate};
use crate::multi_bounce::{COEFFICIENTS, Coefficients, MODELS, Openness};
use crate::reference::height_field::{Border, Bounces, CurvePoint, Stopped, curves};

/// Texels of a map that the figures show one by one.
const SHOWN_TEXELS: usize = 2000;

/// A map that light was followed on, at an albedo of 1.
#[derive(Debug, Clone)]
pub struct StudiedMap {
    /// What it is called, with its amplitude where several are looked at.
    pub name: String,
    /// Columns and rows.
    pub size_px: (usize, usize),
    /// From the lowest to the highest, as a share of the map's width.
    pub amplitude: f64,
    /// What lies beyond its edge.
    pub border: Border,
    /// Rays a texel.
    pub rays: usize,
    /// Bounces after the direct light, and why there are no more.
    pub bounces: usize,
    /// Why there are no more.
    pub stopped: Stopped,
    /// Whether models are only tried on it, not fitted to it.
    pub held_out: bool,
    /// Means and deviations by bin of openness, in shares of the light in the open.
    pub curves: Vec<CurvePoint>,
    /// The same by bin, ready to be fitted.
    pub measured: Measured,
    /// Some texels, evenly over the map: openness, direct light, first bounce, sum of all bounces, in
    /// shares of the light in the open.
    pub texels: Vec<[f32; 4]>,
}

/// A map as it was made ready and followed.
#[derive(Debug, Clone)]
pub struct MapSettings {
    /// What it is called.
    pub name: String,
    /// Columns and rows.
    pub size_px: (usize, usize),
    /// From the lowest to the highest, as a share of the map's width.
    pub amplitude: f64,
    /// What lies beyond its edge.
    pub border: Border,
    /// Rays a texel.
    pub rays: usize,
    /// Whether models are only tried on it.
    pub held_out: bool,
}

impl StudiedMap {
    /// What bounces at an albedo of 1 say.
    #[must_use]
    pub fn of(settings: MapSettings, bounces: &Bounces) -> Self {
        let texels = bounces.openness.len();
        let step = texels.div_ceil(SHOWN_TEXELS).max(1);
        let share = |value: f32| value / std::f32::consts::PI;
        let of = |bounce: usize, texel: usize| {
            bounces
                .irradiance
                .get(bounce)
                .map_or(0.0, |irradiance| share(irradiance[texel]))
        };
        Self {
            curves: curves(bounces),
            measured: Measured::of(settings.name.clone(), bounces),
            texels: (0..texels)
                .step_by(step)
                .map(|texel| {
                    let sum = share(bounces.sum(texel));
                    [bounces.openness[texel], of(0, texel), of(1, texel), sum]
                })
                .collect(),
            bounces: bounces.irradiance.len() - 1,
            stopped: bounces.stopped,
            name: settings.name,
            size_px: settings.size_px,
            amplitude: settings.amplitude,
            border: settings.border,
            rays: settings.rays,
            held_out: settings.held_out,
        }
    }
}

/// A picture of a map in its colours, linear RGB, rows from the top, sky radiance 1: what each way
/// of adding light between surfaces makes of it.
#[derive(Debug, Clone)]
pub struct ColourPicture {
    /// Name of the model, or `off`, or `truth`.
    pub name: String,
    /// Columns and rows.
    pub size_px: (usize, usize),
    /// `width · height` of them.
    pub rgb: Vec<[f32; 3]>,
}

/// Everything.
#[derive(Debug, Clone)]
pub struct Study {
    /// The maps, those fitted to first.
    pub maps: Vec<StudiedMap>,
    /// The same map at several amplitudes, from low to high; empty where none were asked for.
    pub sweep: Vec<StudiedMap>,
    /// The published forms fitted to the maps, and ours last; empty where no fit was asked for.
    pub fits: Vec<Fit>,
    /// Our model with the coefficients that these maps gave; `None` where no fit was asked for.
    pub refitted: Option<Coefficients>,
    /// Every model on every map.
    pub errors: Vec<MapError>,
    /// Off, models and truth of the first map in its colours.
    pub pictures: Vec<ColourPicture>,
    /// Its albedo, linear RGB: one for all texels, or the mean of a map.
    pub albedo: [f64; 3],
}

/// The errors of every model of the registry, and of refitted coefficients, on each map.
#[must_use]
pub fn errors(maps: &[StudiedMap], refitted: Option<&Coefficients>) -> Vec<MapError> {
    let mut errors = Vec::new();
    for model in MODELS {
        // The direct light is measured, so a model that starts from it is given it.
        let value = |alpha: f64, direct: f64, rho: f64| match model.openness {
            Openness::Uniform => (model.f64)(alpha, rho),
            Openness::Cosine => (model.f64)(direct, rho),
        };
        let candidate = Candidate {
            name: model.name.to_owned(),
            value: &value,
        };
        errors.extend(of_maps(&candidate, maps));
    }
    if let Some(refitted) = refitted.filter(|found| **found != COEFFICIENTS) {
        let value = |alpha: f64, _: f64, rho: f64| refitted.value(alpha, rho);
        let candidate = Candidate {
            name: String::from("greyfield, refitted"),
            value: &value,
        };
        errors.extend(of_maps(&candidate, maps));
    }
    let pooled = pooled(maps);
    let value = |alpha: f64, _: f64, rho: f64| pooled.at(alpha, rho);
    let candidate = Candidate {
        name: String::from("mean curve of the maps fitted to"),
        value: &value,
    };
    errors.extend(of_maps(&candidate, maps));
    errors
}

fn of_maps(candidate: &Candidate<'_>, maps: &[StudiedMap]) -> Vec<MapError> {
    maps.iter()
        .flat_map(|map| validate(candidate, &map.measured, map.held_out))
        .collect()
}

/// The mean of the maps' own curves: no function of openness alone that is fitted to them comes much
/// nearer to all of them.
struct Pooled {
    /// Openness and E/E₀ at each of [`ALBEDOS`], by openness.
    bins: Vec<(f64, [f64; 11])>,
}

fn pooled(maps: &[StudiedMap]) -> Pooled {
    const BINS: usize = 50;
    let mut bins = vec![(0.0_f64, 0.0_f64, [0.0_f64; 11]); BINS];
    for bin in maps
        .iter()
        .filter(|map| !map.held_out)
        .flat_map(|map| &map.measured.bins)
    {
        let place = ((bin.openness * BINS as f64) as usize).min(BINS - 1);
        let (count, openness, sums) = &mut bins[place];
        *count += 1.0;
        *openness += bin.openness;
        for (sum, rho) in sums.iter_mut().zip(ALBEDOS) {
            *sum += bin.received(rho);
        }
    }
    let found = bins.into_iter().filter(|(count, ..)| *count > 0.0);
    Pooled {
        bins: found
            .map(|(count, openness, sums)| (openness / count, sums.map(|sum| sum / count)))
            .collect(),
    }
}

impl Pooled {
    /// Between its bins along a straight line; beyond them, none.
    fn at(&self, alpha: f64, rho: f64) -> f64 {
        let column = (rho * 10.0).round() as usize;
        let above = self.bins.partition_point(|(openness, _)| *openness < alpha);
        let of = |place: usize| self.bins.get(place).map(|(a, e)| (*a, e[column]));
        match (above.checked_sub(1).and_then(of), of(above)) {
            (Some((a, low)), Some((b, high))) => low + (high - low) * (alpha - a) / (b - a),
            (Some((_, value)), None) | (None, Some((_, value))) => value,
            (None, None) => f64::NAN,
        }
    }
}
