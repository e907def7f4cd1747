//! Light over many bounces at the points that a scene's picture shows, and what models of it are
//! told of these points: how open they are, and their albedo.

use crate::reference::{
    Albedos, Estimates, InterReflectionSettings, InterReflections, OcclusionSettings, RayTraced,
    SceneBvh, Weighting, estimate, follow,
};
use crate::render::technique::Settings;
use crate::render::{FrameRequest, RenderError, Renderer};
use crate::scene::SceneConfig;
use crate::stimulus::produce::ProduceError;
use crate::stimulus::progress::Progress;

/// Light between the surfaces of one picture, pixel by pixel, rows from the top.
#[derive(Debug, Clone)]
pub struct PictureInterReflection {
    /// Columns and rows.
    pub size_px: (u32, u32),
    /// Which pixels show a surface.
    pub has_surface: Vec<bool>,
    /// Uniform openness α, whatever the distance of what hides the sky.
    pub openness: Estimates,
    /// E/E₀ in a sky of the same radiance everywhere, and k_A along the same paths.
    pub light: InterReflections,
    /// The pixels' own albedo as the renderer draws it: linear RGB, 0 to 1.
    pub albedo: Vec<[f32; 3]>,
    /// Mean distance of that from the albedo that light is followed with at the same points. The
    /// renderer filters its textures, paths do not; of textures it is some hundredths, else 0.
    pub albedo_apart: f64,
}

/// Finds them. Both kinds of rays go on to the same standard error.
///
/// # Errors
/// [`ProduceError`] of the scene and the renderer; [`RenderError::Request`] for settings out of range
/// or a picture without a surface.
pub fn of_picture(
    renderer: &Renderer,
    scene: &SceneConfig,
    size_px: (u32, u32),
    settings: &InterReflectionSettings,
    progress: &Progress<'_>,
) -> Result<PictureInterReflection, ProduceError> {
    let said = |message: String| RenderError::Request(message);
    let file = scene.path.display();
    // What is drawn here is the same in any light; but a frame needs one.
    let Some(lighting) = scene.lightings.values().next() else {
        return Err(said(format!("{file} has no lighting variant")).into());
    };
    (progress.step)("drawing the points");
    let geometry = scene.geometry.load()?;
    let uploaded = renderer.upload(&geometry)?;
    let technique = Settings::from_label("ray-traced").map_err(|error| said(error.message))?;
    let request = FrameRequest::new(scene, lighting, technique, size_px, settings.seed);
    let mut view = renderer.view(&uploaded);
    let surfaces = view.visible_surfaces(&request)?;
    let albedo = view.visible_albedo(&request)?;
    let has_surface: Vec<bool> = (0..surfaces.len())
        .map(|pixel| surfaces.has_surface(pixel))
        .collect();
    if !has_surface.contains(&true) {
        return Err(said(format!(
            "{file}: its camera sees no surface; mend `geometry` or `camera`"
        ))
        .into());
    }
    (progress.step)("building the tree");
    let (bvh, albedos) = (SceneBvh::new(&geometry), Albedos::of(&geometry));
    let points = RayTraced::of_visible(&bvh, &surfaces);
    (progress.step)("openness");
    let asked = OcclusionSettings {
        weighting: Weighting::Uniform,
        error: settings.error,
        max_rays: settings.max_paths,
        ..OcclusionSettings::new(settings.seed)
    };
    let openness = estimate(&points, &asked, progress.pixels).map_err(|e| said(e.to_string()))?;
    (progress.step)("following light");
    let light =
        follow(&points, &albedos, settings, progress.pixels).map_err(|e| said(e.to_string()))?;
    Ok(PictureInterReflection {
        size_px,
        has_surface,
        openness,
        light,
        albedo_apart: albedo_apart(&points, &albedos, &albedo),
        albedo,
    })
}

/// Mean distance, over channels and the points whose triangle is known, of the drawn albedo from that
/// of the geometry.
fn albedo_apart(points: &RayTraced<'_>, albedos: &Albedos<'_>, drawn: &[[f32; 3]]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0_f64);
    for (point, drawn) in points.points().iter().zip(drawn) {
        let Some((point, triangle)) = point.and_then(|point| Some((point, point.triangle?))) else {
            continue;
        };
        let own = albedos.at(triangle, point.position_m).to_array();
        let apart = own
            .iter()
            .zip(drawn)
            .map(|(own, drawn)| (own - drawn).abs());
        sum += f64::from(apart.sum::<f32>() / 3.0);
        count += 1.0;
    }
    sum / count.max(1.0)
}

impl PictureInterReflection {
    /// Mean over the pixels with a surface of what a pixel has, given by its number.
    #[must_use]
    pub fn mean(&self, of: impl Fn(usize) -> f64) -> f64 {
        let seen = (0..self.has_surface.len()).filter(|&pixel| self.has_surface[pixel]);
        let (sum, count) = seen.fold((0.0, 0.0_f64), |(sum, count), pixel| {
            (sum + of(pixel), count + 1.0)
        });
        sum / count.max(1.0)
    }

    /// E/E₀ minus the truth, the mean of the channels of each pixel; 0 where there is no surface.
    ///
    /// # Panics
    /// If there are fewer values than pixels.
    #[must_use]
    pub fn signed_error(&self, model: &[[f32; 3]]) -> Vec<f32> {
        let difference = |pixel: usize| {
            let truth = self.light.irradiance[pixel];
            let apart = [0, 1, 2].map(|channel| model[pixel][channel] - truth[channel]);
            apart.iter().sum::<f32>() / 3.0
        };
        (0..self.has_surface.len())
            .map(|pixel| match self.has_surface[pixel] {
                true => difference(pixel),
                false => 0.0,
            })
            .collect()
    }
}
