//! How time grows: what a technique's own passes take at more pixels, samples, reach or
//! triangles, and the exponent of that growth.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::CostError;
use super::configuration::of_scene;
use super::spread::Spread;
use crate::render::technique::{Settings, SettingsError, Technique};
use crate::render::{FrameRequest, GpuScene, Renderer, Repeats};
use crate::scene::SceneConfig;
use crate::stimulus::progress::Progress;

/// What is made more of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Pixels of the picture.
    Pixels,
    /// Looks at the scene a pixel.
    Samples,
    /// Distance up to which occluders count, metres.
    Radius,
    /// Triangles of the same surface.
    Triangles,
}

impl Axis {
    /// In the order of reports.
    pub const ALL: [Self; 4] = [Self::Pixels, Self::Samples, Self::Radius, Self::Triangles];

    /// For people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pixels => "pixels",
            Self::Samples => "samples",
            Self::Radius => "radius",
            Self::Triangles => "triangles",
        }
    }
}

/// One measurement of growth: a line of `scaling.csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ScalingRow {
    /// Scene id.
    pub scene: String,
    /// Registry name of the technique.
    pub technique: String,
    /// What was varied.
    pub axis: Axis,
    /// Its value.
    pub value: f64,
    /// Median time without blur, milliseconds.
    pub ms: f64,
    /// Lower end of the median's 95 % interval.
    pub low_ms: Option<f64>,
    /// Upper end.
    pub high_ms: Option<f64>,
    /// Frames timed.
    pub frames: usize,
}

/// Time as a power of what is varied.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Exponent {
    /// Scene id.
    pub scene: String,
    /// Registry name of the technique.
    pub technique: String,
    /// What was varied.
    pub axis: Axis,
    /// The exponent: 1 grows in proportion, 0 does not grow.
    pub exponent: f64,
    /// Half width of its 95 % interval (Student's t); `None` for fewer than three points.
    pub half_width: Option<f64>,
    /// Points it is fitted to.
    pub points: usize,
}

/// The middle of the sweep of growth, and how far it goes from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScalingOptions {
    /// Largest size of the picture, pixels; smaller ones are ¾, ½ and ¼ of it each way.
    pub size_px: (u32, u32),
    /// Distance up to which occluders count where it is not what is varied, metres.
    pub reach_m: f64,
    /// Seed of kernels and noise.
    pub seed: u64,
    /// How long times are taken.
    pub repeats: Repeats,
}

/// Samples a pixel where they are not what is varied; every technique can take so many.
const SAMPLES: u32 = 16;

/// Quarters of the picture's side.
const QUARTERS: [u32; 4] = [1, 2, 3, 4];

/// Samples a pixel.
const SAMPLE_COUNTS: [u32; 5] = [8, 16, 32, 64, 128];

/// Parts of the reach.
const REACHES: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];

/// How often the triangles are doubled.
const DOUBLINGS: usize = 2;

/// Measures the growth of techniques on a scene.
///
/// # Errors
/// [`CostError`].
pub fn measure(
    renderer: &Renderer,
    scene: &SceneConfig,
    techniques: &[&'static Technique],
    options: &ScalingOptions,
    progress: &Progress<'_>,
) -> Result<Vec<ScalingRow>, CostError> {
    let mut geometry = scene.geometry.load()?;
    let mut rows = Vec::new();
    for doubling in 0..=DOUBLINGS {
        if doubling > 0 {
            geometry = geometry.of_twice_the_triangles();
        }
        let uploaded = renderer.upload(&geometry)?;
        let mut timer = Timer {
            renderer,
            uploaded: &uploaded,
            scene,
            options,
            rows: &mut rows,
            progress,
        };
        if doubling == 0 {
            timer.pixels(techniques)?;
            timer.samples_and_radius(techniques)?;
        }
        timer.triangles(techniques, geometry.triangles())?;
    }
    Ok(rows)
}

struct Timer<'a> {
    renderer: &'a Renderer,
    uploaded: &'a GpuScene,
    scene: &'a SceneConfig,
    options: &'a ScalingOptions,
    rows: &'a mut Vec<ScalingRow>,
    progress: &'a Progress<'a>,
}

impl Timer<'_> {
    fn pixels(&mut self, techniques: &[&'static Technique]) -> Result<(), CostError> {
        for quarter in QUARTERS {
            let (width, height) = self.options.size_px;
            let size_px = ((width * quarter / 4).max(1), (height * quarter / 4).max(1));
            let pixels = f64::from(size_px.0) * f64::from(size_px.1);
            let points = self.settings(techniques)?.into_iter().map(|s| (s, pixels));
            self.times(Axis::Pixels, size_px, points.collect())?;
        }
        Ok(())
    }

    fn samples_and_radius(&mut self, techniques: &[&'static Technique]) -> Result<(), CostError> {
        let size_px = self.options.size_px;
        let (mut by_samples, mut by_reach) = (Vec::new(), Vec::new());
        for settings in self.settings(techniques)? {
            let more = |&count: &u32| Some((settings.with_taps(count).ok()?, f64::from(count)));
            by_samples.extend(SAMPLE_COUNTS.iter().filter_map(more));
            if settings.technique.reach.is_some() {
                for part in REACHES {
                    let reach_m = part * self.options.reach_m;
                    by_reach.push((settings.with_reach_m(reach_m).map_err(said)?, reach_m));
                }
            }
        }
        self.times(Axis::Samples, size_px, by_samples)?;
        self.times(Axis::Radius, size_px, by_reach)
    }

    fn triangles(
        &mut self,
        techniques: &[&'static Technique],
        triangles: usize,
    ) -> Result<(), CostError> {
        let points = self.settings(techniques)?.into_iter();
        let points = points
            .map(|settings| (settings, triangles as f64))
            .collect();
        self.times(Axis::Triangles, self.options.size_px, points)
    }

    /// Every technique that runs a pass, in the middle of what is varied.
    fn settings(&self, techniques: &[&'static Technique]) -> Result<Vec<Settings>, CostError> {
        let of = |technique: &&'static Technique| {
            of_scene(self.scene, technique)?
                .with_reach_m(self.options.reach_m)?
                .with_taps(SAMPLES)
        };
        let shaded = techniques
            .iter()
            .filter(|technique| technique.shader.is_some());
        shaded
            .map(|technique| of(technique).map_err(said))
            .collect()
    }

    fn times(
        &mut self,
        axis: Axis,
        size_px: (u32, u32),
        points: Vec<(Settings, f64)>,
    ) -> Result<(), CostError> {
        let mut view = self.renderer.view(self.uploaded);
        let Some(lighting) = self.scene.lightings.values().next() else {
            return Ok(());
        };
        for (settings, value) in points {
            let technique = settings.technique.name;
            (self.progress.step)(&format!(
                "{}: {technique} by {}",
                self.scene.id,
                axis.name()
            ));
            let seed = self.options.seed;
            let mut request = FrameRequest::new(self.scene, lighting, settings, size_px, seed);
            request.blur_radius_px = 0;
            let times = view.time_occlusion(&request, &self.options.repeats)?;
            let Some(spread) = Spread::of(&times.totals_ms()) else {
                continue;
            };
            self.rows.push(ScalingRow {
                scene: self.scene.id.clone(),
                technique: technique.to_owned(),
                axis,
                value,
                ms: spread.median,
                low_ms: spread.interval.map(|(low, _)| low),
                high_ms: spread.interval.map(|(_, high)| high),
                frames: spread.count,
            });
        }
        Ok(())
    }
}

/// The exponents of what was measured, by scene, axis and technique in the order of the rows.
#[must_use]
pub fn exponents(rows: &[ScalingRow]) -> Vec<Exponent> {
    let key = |row: &ScalingRow| (row.scene.clone(), row.axis, row.technique.clone());
    let mut keys = Vec::new();
    for row in rows {
        if !keys.contains(&key(row)) {
            keys.push(key(row));
        }
    }
    let fit = |key_of: (String, Axis, String)| {
        let points: Vec<(f64, f64)> = (rows.iter())
            .filter(|row| key(row) == key_of)
            .map(|row| (row.value.ln(), row.ms.ln()))
            .collect();
        let (exponent, half_width) = slope(&points)?;
        let (scene, axis, technique) = key_of;
        Some(Exponent {
            scene,
            technique,
            axis,
            exponent,
            half_width,
            points: points.len(),
        })
    };
    keys.into_iter().filter_map(fit).collect()
}

/// The slope of a line through points by least squares, and half its 95 % interval; `None`
/// where all points have one x.
fn slope(points: &[(f64, f64)]) -> Option<(f64, Option<f64>)> {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (mean_x, mean_y) = (mean(|point| point.0), mean(|point| point.1));
    let spread: f64 = points.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    if points.len() < 2 || spread <= 0.0 {
        return None;
    }
    let common = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y));
    let slope = common.sum::<f64>() / spread;
    let off = |(x, y): &(f64, f64)| (y - mean_y - slope * (x - mean_x)).powi(2);
    let freedom = count - 2.0;
    let half_width = StudentsT::new(0.0, 1.0, freedom).ok().map(|student| {
        let variance = points.iter().map(off).sum::<f64>() / freedom / spread;
        student.inverse_cdf(0.975) * variance.sqrt()
    });
    Some((slope, half_width))
}

fn said(error: SettingsError) -> CostError {
    CostError::Input(error.message)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = 3 x^1.5 exactly: the exponent is 1.5 and its interval nothing.
    #[test]
    fn a_power_is_found() {
        let points: Vec<_> = [1.0_f64, 2.0, 5.0, 9.0]
            .map(|x| (x.ln(), (3.0 * x.powf(1.5)).ln()))
            .into();
        let (exponent, half_width) = slope(&points).unwrap();
        assert!((exponent - 1.5).abs() < 1e-12);
        assert!(half_width.unwrap() < 1e-6);
    }

    /// Of (0,0), (1,1), (2,1): slope 1/2, residuals −1/6, 1/3, −1/6, variance of the slope
    /// (1/6)/1/2 = 1/12, t(0.975; 1) = 12.7062.
    #[test]
    fn the_interval_is_students() {
        let (exponent, half_width) = slope(&[(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)]).unwrap();
        assert!((exponent - 0.5).abs() < 1e-12);
        assert!((half_width.unwrap() - 12.706_2 / 12.0_f64.sqrt()).abs() < 1e-3);
        assert_eq!(slope(&[(0.0, 0.0), (1.0, 2.0)]), Some((2.0, None)));
        assert_eq!(slope(&[(1.0, 0.0), (1.0, 2.0)]), None);
    }
}
