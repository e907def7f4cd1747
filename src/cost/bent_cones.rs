//! How right an environment's light is through bent cones, beside k_A times the light of an open point:
//! both against rays that look the environment itself up.

use std::collections::BTreeMap;

use glam::Vec3;
use serde::Serialize;

use super::CostError;
use super::error::OcclusionError;
use crate::reference::lit::{self, Lit, luminance};
use crate::reference::{Opening, RayTraced, SceneBvh, Weighting};
use crate::render::technique::Settings;
use crate::render::{AdapterRecord, FrameRequest, Renderer, View};
use crate::scene::{Ambient, Environment, Lighting, SceneConfig, VisibleSurfaces};
use crate::stimulus::progress::Progress;

/// What is measured.
#[derive(Debug, Clone, Serialize)]
pub struct ConeOptions {
    /// Columns and rows.
    pub size_px: (u32, u32),
    /// Rays a pixel by the cosine, as many by the environment's brightness, and as many all alike.
    pub rays: u32,
    /// How far the techniques look for occluders, metres; `None`: as far as the scene has them look.
    /// Rays find whatever there is.
    pub radius_m: Option<f64>,
    /// Seed of rays and kernels.
    pub seed: u64,
}

/// One way to the irradiance of the visible points, and how far it is off. Errors are of luminance, as a share
/// of the true irradiance's mean.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConeRow {
    /// Whose open directions: `ray-traced`, or a technique's label.
    pub source: String,
    /// What is made of them: `k_a`, `cone`, `uniform-cone` or `directions`.
    pub light: &'static str,
    /// Root of the mean squared error.
    pub rmse: f64,
    /// Mean error: above 0 too bright.
    pub bias: f64,
    /// 95th percentile of the absolute error.
    pub p95: f64,
}

/// `bent-cones.json`.
#[derive(Debug, Clone, Serialize)]
pub struct ConeRecord {
    /// Version of this record.
    pub schema_version: u32,
    /// Version of the program.
    pub app_version: &'static str,
    /// The scene's name.
    pub scene: String,
    /// SHA-256 of the environment's file, if it came from one.
    pub environment_sha256: Option<String>,
    /// The adapter that the techniques ran on.
    pub adapter: AdapterRecord,
    /// What was measured.
    pub options: ConeOptions,
    /// Settings of the techniques, by label.
    pub techniques: BTreeMap<String, BTreeMap<String, crate::config::ParameterValue>>,
    /// Pixels with a surface.
    pub surfaces: usize,
    /// Mean luminance of the true irradiance.
    pub mean_irradiance: f64,
    /// Root of the mean squared standard error of the truth, as a share of that mean: what no row can
    /// be told to be better than.
    pub truth_error: f64,
    /// The ways.
    pub rows: Vec<ConeRow>,
}

/// What was found, pixel by pixel.
#[derive(Debug, Clone)]
pub struct ConesMeasured {
    /// Everything but pictures.
    pub record: ConeRecord,
    /// The true irradiance, linear RGB; `None` where there is no surface.
    pub truth: Vec<Option<Vec3>>,
    /// That of each row, in their order.
    pub irradiance: Vec<Vec<Vec3>>,
}

/// What all ways start from.
struct Points<'a> {
    surfaces: VisibleSurfaces,
    lit: Vec<Option<Lit>>,
    nine: crate::scene::environment::Irradiance,
    mean: f64,
    options: &'a ConeOptions,
}

/// Measures the techniques of `labels` on a scene under an environment. `progress` is told the steps, and the
/// pixels that rays are traced for.
///
/// # Errors
/// [`CostError`]; [`CostError::Input`] for a technique that gives no bent cone, and for a picture
/// without surface or light.
pub fn measure(
    renderer: &Renderer,
    (scene, environment): (&SceneConfig, &Environment),
    labels: &[String],
    options: &ConeOptions,
    progress: &Progress<'_>,
) -> Result<ConesMeasured, CostError> {
    let settings: Vec<Settings> = (labels.iter())
        .map(|label| of_label(scene, label, options))
        .collect::<Result<_, _>>()?;
    let Some(first) = settings.first() else {
        return Err(CostError::Input(String::from("no technique is named")));
    };
    let geometry = scene.geometry.load()?;
    let uploaded = renderer.upload(&geometry)?;
    let mut view = renderer.view(&uploaded);
    let surfaces = view.visible_surfaces(&request(scene, environment, first, options))?;
    (progress.step)("tracing rays");
    let bvh = SceneBvh::new(&geometry);
    let rays = (options.rays, options.seed);
    let around = RayTraced::of_visible(&bvh, &surfaces);
    let lit = lit::light(&around, environment, rays, progress.pixels);
    let points = Points::new(surfaces, lit, environment, options)?;
    let mut found = points.ray_traced();
    for settings in &settings {
        (progress.step)(&settings.label);
        let request = request(scene, environment, settings, options);
        found.extend(points.technique(&mut view, &request)?);
    }
    let (rows, irradiance) = found.into_iter().unzip();
    Ok(ConesMeasured {
        record: ConeRecord {
            schema_version: 1,
            app_version: env!("CARGO_PKG_VERSION"),
            scene: scene.id.clone(),
            environment_sha256: environment.file_sha256().map(str::to_owned),
            adapter: renderer.gpu().adapter.clone(),
            options: options.clone(),
            techniques: (settings.iter())
                .map(|settings| (settings.label.clone(), settings.values()))
                .collect(),
            surfaces: points.lit.iter().flatten().count(),
            mean_irradiance: points.mean,
            truth_error: points.truth_error(),
            rows,
        },
        truth: (points.lit.iter())
            .map(|lit| lit.map(|lit| lit.irradiance))
            .collect(),
        irradiance,
    })
}

/// A technique as the scene sets it; what its label says stays.
fn of_label(
    scene: &SceneConfig,
    label: &str,
    options: &ConeOptions,
) -> Result<Settings, CostError> {
    let input = |error: crate::render::technique::SettingsError| CostError::Input(error.message);
    let mut settings = Settings::from_label(label).map_err(input)?;
    if !settings.technique.gives_cone {
        return Err(CostError::Input(format!(
            "technique `{label}` gives no bent cone"
        )));
    }
    let values = scene.occlusion.techniques.get(settings.technique.name);
    for (parameter, value) in values.into_iter().flatten() {
        settings
            .set_scene_default(parameter, value.get_ref().clone())
            .map_err(input)?;
    }
    if let Some(radius_m) = options.radius_m {
        settings.set("radius_m", radius_m).map_err(input)?;
    }
    Ok(settings)
}

fn request(
    scene: &SceneConfig,
    environment: &Environment,
    settings: &Settings,
    options: &ConeOptions,
) -> FrameRequest {
    let lighting = Lighting {
        ambient: Ambient::Environment,
        environment: Some(environment.clone()),
        ..Lighting::constant(Vec3::ZERO)
    };
    let (size_px, seed) = (options.size_px, options.seed);
    FrameRequest {
        keeps_cone: true,
        ..FrameRequest::new(scene, &lighting, settings.clone(), size_px, seed)
    }
}

/// A way, and its irradiance a pixel.
type Found = (ConeRow, Vec<Vec3>);

impl<'a> Points<'a> {
    fn new(
        surfaces: VisibleSurfaces,
        lit: Vec<Option<Lit>>,
        environment: &Environment,
        options: &'a ConeOptions,
    ) -> Result<Self, CostError> {
        let all = lit.iter().flatten();
        let sum: f64 = all
            .clone()
            .map(|lit| f64::from(luminance(lit.irradiance)))
            .sum();
        let mean = sum / all.count().max(1) as f64;
        if mean <= 0.0 {
            return Err(CostError::Input(String::from(
                "no visible point receives light of the environment: there is nothing to compare",
            )));
        }
        Ok(Self {
            surfaces,
            lit,
            nine: environment.irradiance(),
            mean,
            options,
        })
    }

    fn truth_error(&self) -> f64 {
        let all = self.lit.iter().flatten();
        let squares: f64 = all
            .clone()
            .map(|lit| f64::from(lit.standard_error).powi(2))
            .sum();
        (squares / all.count() as f64).sqrt() / self.mean
    }

    /// One way: the irradiance of each point that there is.
    fn row(&self, source: &str, light: &'static str, of: impl Fn(usize, &Lit) -> Vec3) -> Found {
        let irradiance: Vec<Vec3> = (self.lit.iter().enumerate())
            .map(|(pixel, lit)| lit.as_ref().map_or(Vec3::ZERO, |lit| of(pixel, lit)))
            .collect();
        let share = |light: Vec3| (f64::from(luminance(light)) / self.mean) as f32;
        let pairs = (self.lit.iter().zip(&irradiance))
            .filter_map(|(lit, found)| Some((share(*found), share(lit.as_ref()?.irradiance))));
        let error = OcclusionError::of(pairs);
        let row = ConeRow {
            source: source.to_owned(),
            light,
            rmse: error.rmse,
            bias: error.bias,
            p95: error.p95,
        };
        (row, irradiance)
    }

    fn normal(&self, pixel: usize) -> Vec3 {
        self.surfaces.normals[pixel]
    }

    fn ray_traced(&self) -> Vec<Found> {
        let nine = &self.nine;
        let uniform = |pixel: usize, lit: &Lit| {
            lit.uniform
                .cone(Weighting::Uniform)
                .map_or(Vec3::ZERO, |cone| {
                    cone.irradiance(self.normal(pixel), lit.cosine.share, nine)
                })
        };
        let from = "ray-traced";
        vec![
            self.row(from, "k_a", |pixel, lit| {
                nine.at(self.normal(pixel)) * lit.cosine.share
            }),
            self.row(from, "cone", |_, lit| lit.cosine.irradiance(nine)),
            self.row(from, "uniform-cone", uniform),
            self.row(from, "directions", |_, lit| lit.of_nine),
        ]
    }

    fn technique(
        &self,
        view: &mut View<'_>,
        request: &FrameRequest,
    ) -> Result<[Found; 2], CostError> {
        let frame = view.render(request)?;
        let (Some(share), Some(closed)) = (frame.occlusion, frame.closed_directions) else {
            let label = &request.occlusion.label;
            return Err(CostError::Input(format!(
                "technique `{label}` gave no bent cone at {}×{}",
                self.options.size_px.0, self.options.size_px.1
            )));
        };
        let nine = &self.nine;
        let label = &request.occlusion.label;
        let opening = |pixel: usize| Opening {
            share: share.values[pixel],
            moment: Opening::whole(self.normal(pixel), Weighting::Cosine).moment - closed[pixel],
        };
        Ok([
            self.row(label, "k_a", |pixel, _| {
                nine.at(self.normal(pixel)) * share.values[pixel]
            }),
            self.row(label, "cone", |pixel, _| opening(pixel).irradiance(nine)),
        ])
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::render::Gpu;
    use crate::scene::environment::RadianceMap;

    /// Constant light is the same through any opening: all ways by rays agree with the truth, a
    /// technique's cone with its k_A, and what gives no cone is refused.
    #[test]
    fn in_constant_light_a_cone_is_as_good_as_k_a() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("stimuli/scenes/shapes.toml");
        let scene = SceneConfig::load(&path).unwrap();
        let constant = RadianceMap::from_fn(32, |_| Vec3::splat(2.0));
        let lit = (&scene, &Environment::from_map(constant));
        let renderer = Renderer::new(Gpu::open(None).unwrap());
        let options = ConeOptions {
            size_px: (64, 36),
            rays: 256,
            radius_m: Some(1.0),
            seed: 1,
        };
        let progress = Progress {
            step: &|_| (),
            pixels: &|_| (),
        };
        let measured = |labels: &[&str]| {
            let labels: Vec<String> = labels.iter().map(|label| (*label).to_owned()).collect();
            measure(&renderer, lit, &labels, &options, &progress)
        };
        let found = measured(&["gtao", "ssdo16"]).unwrap();
        assert_eq!(found.record.rows.len(), 4 + 2 * 2);
        for row in &found.record.rows[..4] {
            assert!(row.rmse < 0.02, "{row:?}");
        }
        for ways in found.irradiance[4..].chunks_exact(2) {
            for (k_a, cone) in ways[0].iter().zip(&ways[1]) {
                // The coefficients of a map's bands are its projection, 0 to three digits.
                assert!((*k_a - *cone).length() < 0.02, "{k_a} {cone}");
            }
        }
        for label in ["hbao", "nonesuch"] {
            assert!(matches!(measured(&[label]), Err(CostError::Input(_))));
        }
    }
}
