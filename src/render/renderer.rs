//! Draws frames: a view of a scene, and images from it.

use glam::Vec3;

use super::environment::EnvironmentTextures;
use super::frame::{FrameRequest, SHADOW_SIZE_PX};
use super::pass::Drawable;
use super::plan::{FramePlan, PassKind};
use super::readback::FloatImage;
use super::shading::{self, Drawn, Shaded};
use super::surfaces::{SunVisibility, SurfaceKey, Surfaces};
use super::upload::GpuScene;
use super::{Gpu, RenderError, technique};
use crate::render::{PassRecord, Picture};
use crate::scene::{Environment, Geometry, Sphere};

/// Draws frames on one adapter.
pub struct Renderer {
    gpu: Gpu,
}

/// A drawn frame.
#[derive(Debug, Clone)]
pub struct RenderedFrame {
    /// The image.
    pub picture: Picture,
    /// The occlusion coefficient k_A after the blur, 1 is open; `None` where no technique ran.
    pub occlusion: Option<FloatImage>,
    /// What is closed by direction, where [`FrameRequest::keeps_cone`] asks for it: the mean of all
    /// directions by the cosine, the open ones counted as nought, after the blur; world space, a vector
    /// a pixel, rows from the top. What is open is 2/3 of the normal less this.
    pub closed_directions: Option<Vec<Vec3>>,
    /// What ran, in order, and what it took.
    pub passes: Vec<PassRecord>,
}

impl Renderer {
    /// A renderer on an open adapter.
    #[must_use]
    pub fn new(gpu: Gpu) -> Self {
        Self { gpu }
    }

    /// The adapter.
    #[must_use]
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Puts a scene's surfaces on the GPU.
    ///
    /// # Errors
    /// As [`GpuScene::upload`].
    pub fn upload(&self, geometry: &Geometry) -> Result<GpuScene, RenderError> {
        GpuScene::upload(&self.gpu, geometry)
    }

    /// Draws one frame.
    ///
    /// # Errors
    /// [`RenderError::Unsuitable`] if the adapter's textures are too small for it,
    /// [`RenderError::Device`] if the driver fails.
    pub fn render(
        &self,
        scene: &GpuScene,
        request: &FrameRequest,
    ) -> Result<RenderedFrame, RenderError> {
        self.view(scene).render(request)
    }

    /// Images of one scene that share what they have in common.
    #[must_use]
    pub fn view<'a>(&'a self, scene: &'a GpuScene) -> View<'a> {
        View {
            gpu: &self.gpu,
            scene,
            surfaces: None,
            visibility: None,
            environment: None,
            proxies: None,
        }
    }
}

/// Draws images of one scene. Surfaces, and where the directional light falls on them, are
/// drawn once for all images that have the same: their bytes are those of an image drawn
/// alone, and their times in [`PassRecord`] are marked as shared.
pub struct View<'a> {
    gpu: &'a Gpu,
    scene: &'a GpuScene,
    surfaces: Option<Surfaces>,
    visibility: Option<SunVisibility>,
    /// The environment's textures, and what they are for.
    environment: Option<(EnvironmentKey, EnvironmentTextures)>,
    /// Spheres in place of the triangles (centre and radius, metres), and what they are for.
    proxies: Option<(ProxyKey, Vec<[f32; 4]>)>,
}

/// Number of spheres, and the seed of their fit.
type ProxyKey = (usize, u64);

/// The environment, and whether the skybox and reflections read it.
type EnvironmentKey = (Option<Environment>, [bool; 2]);

impl<'a> View<'a> {
    /// Draws one image.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render(&mut self, request: &FrameRequest) -> Result<RenderedFrame, RenderError> {
        let shaded = self.guarded(request)?;
        Ok(RenderedFrame {
            picture: shaded.picture,
            occlusion: shaded.occlusion,
            closed_directions: shaded.cone,
            passes: shaded.passes,
        })
    }

    /// The adapter.
    pub(super) fn gpu(&self) -> &'a Gpu {
        self.gpu
    }

    /// The surfaces of the image drawn last.
    pub(super) fn drawn_surfaces(&self) -> Option<&Surfaces> {
        self.surfaces.as_ref()
    }

    /// Draws an image and keeps what can be read of it.
    pub(super) fn guarded(&mut self, request: &FrameRequest) -> Result<Shaded, RenderError> {
        request.check_handed_image()?;
        self.watched(request, |view| view.draw(request))
    }

    /// The surfaces that an image of this request shows, drawn if they are not there yet, with
    /// their normals.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub(super) fn surfaces_of(&mut self, request: &FrameRequest) -> Result<&Surfaces, RenderError> {
        self.watched(request, |view| {
            let facts = view.scene.facts.clone();
            let filled = request.with_model_lights(&facts.lights).filled_in();
            let plan = FramePlan::new(&request.with_model_lights(&facts.lights), &facts);
            view.surfaces(&filled, &plan);
            Ok(())
        })?;
        (self.surfaces.as_ref())
            .ok_or_else(|| RenderError::Device(String::from("no surfaces were drawn")))
    }

    /// Draws something, and turns what the driver says into an error.
    fn watched<T>(
        &mut self,
        request: &FrameRequest,
        draw: impl FnOnce(&mut Self) -> Result<T, RenderError>,
    ) -> Result<T, RenderError> {
        check_size(self.gpu, request)?;
        let device = &self.gpu.device;
        let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let drawn = draw(self);
        let errors = [
            pollster::block_on(validation.pop()),
            pollster::block_on(memory.pop()),
        ];
        match errors.into_iter().flatten().next() {
            Some(error) => {
                // What was drawn before may be broken too.
                self.surfaces = None;
                self.visibility = None;
                Err(RenderError::Device(error.to_string()))
            }
            None => drawn,
        }
    }

    fn draw(&mut self, request: &FrameRequest) -> Result<Shaded, RenderError> {
        let gpu: &'a Gpu = self.gpu;
        let (filled, plan, mut passes) = self.prepare(request)?;
        let drawn = self.drawn(&plan)?;
        let lights = shading::lights_of(&request.with_model_lights(&self.scene.facts.lights));
        let mut shaded = shading::shade(gpu, &filled, &plan, drawn, lights)?;
        passes.append(&mut shaded.passes);
        Ok(Shaded { passes, ..shaded })
    }

    /// Sees to it that everything is there that an image shares with others. What it then runs,
    /// and what has been run.
    fn prepare(
        &mut self,
        request: &FrameRequest,
    ) -> Result<(FrameRequest, FramePlan, Vec<PassRecord>), RenderError> {
        let gpu: &'a Gpu = self.gpu;
        let mut facts = self.scene.facts.clone();
        let request = &request.with_model_lights(&facts.lights);
        let filled = request.filled_in();
        let mut plan = FramePlan::new(request, &facts);
        let (surfaces, is_new) = self.surfaces(&filled, &plan);
        let mut passes = as_drawn(&surfaces.records, is_new);
        if plan.has(PassKind::Skybox) && !request.all_effects {
            facts.uncovered = Some(surfaces.is_uncovered(gpu)?);
            plan = FramePlan::new(request, &facts);
        }
        self.sun_visibility(&filled, &plan, &mut passes);
        self.environment(&filled, &plan);
        self.proxies(&filled);
        Ok((filled, plan, passes))
    }

    /// What [`prepare`](Self::prepare) has made.
    fn drawn(&self, plan: &FramePlan) -> Result<Drawn<'_>, RenderError> {
        let (Some(surfaces), Some((_, environment))) = (&self.surfaces, &self.environment) else {
            return Err(RenderError::Device(String::from("no surfaces were drawn")));
        };
        let visibility = (self.visibility.as_ref())
            .filter(|_| plan.has(PassKind::ShadowFilter))
            .map(|visibility| &visibility.view);
        Ok(Drawn {
            surfaces,
            visibility,
            environment,
            proxies: (self.proxies.as_ref()).map_or(&[], |(_, spheres)| spheres.as_slice()),
        })
    }

    /// The passes of an image that come to an estimate of occlusion, each ready to be drawn any
    /// number of times.
    pub(super) fn estimating(
        &mut self,
        request: &FrameRequest,
    ) -> Result<Vec<(PassKind, Vec<Drawable>)>, RenderError> {
        request.check_handed_image()?;
        self.watched(request, |view| {
            let (filled, plan, _) = view.prepare(request)?;
            let drawn = view.drawn(&plan)?;
            let lights = shading::lights_of(&request.with_model_lights(&view.scene.facts.lights));
            Ok(shading::estimating(view.gpu, &filled, &plan, drawn, lights))
        })
    }

    /// The surfaces, and whether they were drawn just now.
    fn surfaces(&mut self, request: &FrameRequest, plan: &FramePlan) -> (&mut Surfaces, bool) {
        let key = SurfaceKey::new(request, plan);
        let kept = self.surfaces.take().filter(|surfaces| surfaces.key == key);
        let is_new = kept.is_none();
        let surfaces = kept.unwrap_or_else(|| Surfaces::draw(self.gpu, self.scene, request, plan));
        (self.surfaces.insert(surfaces), is_new)
    }

    /// Sees to it that the textures of the environment that the plan reads are there.
    fn environment(&mut self, request: &FrameRequest, plan: &FramePlan) {
        let environment = request.lighting.environment.clone();
        let read = [PassKind::Skybox, PassKind::Reflections].map(|kind| plan.has(kind));
        let key = (environment, read);
        if self
            .environment
            .as_ref()
            .is_none_or(|(kept, _)| *kept != key)
        {
            let textures = EnvironmentTextures::new(self.gpu, key.0.as_ref(), plan);
            self.environment = Some((key, textures));
        }
    }

    /// Sees to it that the spheres are there that the technique reads, if it reads any.
    fn proxies(&mut self, request: &FrameRequest) {
        let settings = &request.occlusion;
        if !settings.technique.inputs.proxies {
            return;
        }
        let key = (settings.get(technique::PROXIES) as usize, request.seed);
        if self.proxies.as_ref().is_none_or(|(kept, _)| *kept != key) {
            let spheres = self.scene.surface.spheres(key.0, key.1);
            let packed = |sphere: &Sphere| sphere.centre_m.extend(sphere.radius_m).to_array();
            self.proxies = Some((key, spheres.iter().map(packed).collect()));
        }
    }

    /// Sees to it that where the sun falls is there if the plan asks for it.
    fn sun_visibility(
        &mut self,
        request: &FrameRequest,
        plan: &FramePlan,
        passes: &mut Vec<PassRecord>,
    ) {
        let (Some(surfaces), true) = (&self.surfaces, plan.has(PassKind::ShadowFilter)) else {
            return;
        };
        let kept = self
            .visibility
            .take()
            .filter(|visibility| visibility.serves(request, surfaces));
        let is_new = kept.is_none();
        self.visibility =
            kept.or_else(|| SunVisibility::draw(self.gpu, self.scene, request, plan, surfaces));
        if let Some(visibility) = &self.visibility {
            passes.extend(as_drawn(&visibility.records, is_new));
        }
    }
}

/// The records of passes that an image shares with an earlier one, unless they are new.
fn as_drawn(records: &[PassRecord], is_new: bool) -> Vec<PassRecord> {
    let mark = |record: &PassRecord| PassRecord {
        shared: !is_new,
        ..record.clone()
    };
    records.iter().map(mark).collect()
}

fn check_size(gpu: &Gpu, request: &FrameRequest) -> Result<(), RenderError> {
    let largest = gpu.device.limits().max_texture_dimension_2d;
    let (width_px, height_px) = request.shaded_size();
    if width_px == 0 || height_px == 0 {
        return Err(RenderError::Request(String::from(
            "an image needs at least one pixel",
        )));
    }
    if width_px.max(height_px).max(SHADOW_SIZE_PX) > largest {
        return Err(RenderError::Unsuitable {
            adapter: gpu.adapter.name.clone(),
            message: format!(
                "an image of {}×{} with {}×{} samples a pixel needs textures of {width_px}×{height_px}, it takes {largest}; \
                 ask for a smaller image or fewer samples",
                request.width_px, request.height_px, request.supersampling, request.supersampling
            ),
        });
    }
    Ok(())
}
