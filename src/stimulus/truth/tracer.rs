//! Ray-traced occlusion for one scene's pictures: from the renderer's points to `reference`
//! and back.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::reference::{OcclusionSettings, RayTraced, SceneBvh, Weighting, estimate};
use crate::render::technique::Settings;
use crate::render::{FloatImage, FrameRequest, RenderError, View};
use crate::scene::Geometry;
use crate::stimulus::progress::Progress;

/// A scene's triangles, ready for rays, and what was found with them so far.
pub struct SceneTracer {
    bvh: SceneBvh,
    /// By the technique's parameters.
    found: BTreeMap<String, Arc<FloatImage>>,
}

impl SceneTracer {
    /// For a scene whose images all are of one camera, size and seed.
    #[must_use]
    pub fn new(geometry: &Geometry) -> Self {
        Self {
            bvh: SceneBvh::new(geometry),
            found: BTreeMap::new(),
        }
    }

    /// The request with its occlusion handed in, if its technique takes it so.
    ///
    /// # Errors
    /// As [`View::visible_surfaces`].
    pub fn complete(
        &mut self,
        view: &mut View<'_>,
        mut request: FrameRequest,
        progress: &Progress<'_>,
    ) -> Result<FrameRequest, RenderError> {
        if !request.occlusion.technique.is_handed_in() {
            return Ok(request);
        }
        let key = format!("{:?}", request.occlusion.values());
        if !self.found.contains_key(&key) {
            let image = self.trace(view, &request, progress)?;
            self.found.insert(key.clone(), Arc::new(image));
        }
        request.handed_occlusion = self.found.get(&key).cloned();
        Ok(request)
    }

    fn trace(
        &self,
        view: &mut View<'_>,
        request: &FrameRequest,
        progress: &Progress<'_>,
    ) -> Result<FloatImage, RenderError> {
        let surfaces = view.visible_surfaces(request)?;
        let settings = of_technique(&request.occlusion, request.seed);
        let points = RayTraced::of_visible(&self.bvh, &surfaces);
        let found = estimate(&points, &settings, progress.pixels)
            .map_err(|error| RenderError::Request(error.to_string()))?;
        Ok(FloatImage {
            width_px: request.width_px,
            height_px: request.height_px,
            values: found.occlusion,
        })
    }
}

/// What the technique `ray-traced` asks for.
fn of_technique(technique: &Settings, seed: u64) -> OcclusionSettings {
    let d_max_m = technique.get("d_max_m") as f32;
    OcclusionSettings {
        weighting: Weighting::Cosine,
        d_max_m: (d_max_m > 0.0).then_some(d_max_m),
        error: technique.get("error"),
        max_rays: technique.get("max_rays") as u32,
        ..OcclusionSettings::new(seed)
    }
}
