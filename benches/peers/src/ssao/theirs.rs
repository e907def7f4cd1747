//! Bevy's side: a headless application that draws the scene, from which the passes of its
//! screen-space ambient occlusion are taken.

use bevy::app::{App, PluginsState};
use bevy::asset::{Assets, RenderAssetUsages};
use bevy::camera::{PerspectiveProjection, Projection, RenderTarget};
use bevy::core_pipeline::prepass::ViewPrepassTextures;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::diagnostic::DiagnosticsStore;
use bevy::image::Image;
use bevy::log::{Level, LogPlugin};
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::pbr::{
    ScreenSpaceAmbientOcclusionQualityLevel, ScreenSpaceAmbientOcclusionResources, SsaoBindGroups,
};
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::RenderPlugin;
use bevy::render::diagnostic::RenderDiagnosticsPlugin;
use bevy::render::render_resource::{PipelineCache, TextureFormat};
use bevy::render::renderer::{RenderAdapterInfo, RenderDevice, RenderQueue};
use bevy::render::settings::{Backends, WgpuSettings};
use bevy::render::view::{Msaa, ViewUniformOffset};
use bevy::window::ExitCondition;
use greyfield::render::{AdapterRecord, Gpu};

use crate::Failure;
use crate::passes::{Bound, OcclusionPasses};
use crate::scene::{Scene, THICKNESS_M};

/// Frames after which shaders that are not there yet will never be.
const MOST_FRAMES: usize = 300;

/// Bevy with the scene in it.
pub struct Theirs {
    app: App,
    is_software: bool,
}

impl Theirs {
    /// Opens the adapter that Greyfield has opened.
    pub fn new(scene: &Scene, gpu: &Gpu) -> Result<Self, Failure> {
        let adapter = &gpu.adapter;
        let mut app = App::new();
        app.add_plugins(
            DefaultPlugins
                .set(WindowPlugin {
                    primary_window: None,
                    exit_condition: ExitCondition::DontExit,
                    ..WindowPlugin::default()
                })
                .set(LogPlugin {
                    level: Level::ERROR,
                    ..LogPlugin::default()
                })
                .set(RenderPlugin {
                    render_creation: WgpuSettings {
                        // OpenGL may have an adapter of the same name.
                        backends: Some(Backends::VULKAN | Backends::METAL | Backends::DX12),
                        adapter_name: Some(adapter.name.clone()),
                        ..WgpuSettings::default()
                    }
                    .into(),
                    synchronous_pipeline_compilation: true,
                    ..RenderPlugin::default()
                }),
        );
        app.add_plugins(RenderDiagnosticsPlugin);
        while app.plugins_state() == PluginsState::Adding {
            std::thread::yield_now();
        }
        app.finish();
        app.cleanup();
        check_adapter(app.world(), adapter)?;
        spawn(app.world_mut(), scene);
        Ok(Self {
            app,
            is_software: gpu.is_software,
        })
    }

    /// Draws frames until the passes are there, and takes them. `progress` is told of every
    /// frame.
    pub fn passes(&mut self, progress: impl Fn()) -> Result<OcclusionPasses, Failure> {
        for _ in 0..MOST_FRAMES {
            self.app.update();
            progress();
            if let Some(passes) = self.take_passes()? {
                // One more with everything in place: meshes come to the GPU over frames, too.
                self.app.update();
                return Ok(self.take_passes()?.unwrap_or(passes));
            }
        }
        Err(self.why_not().into())
    }

    /// What Bevy's own diagnostics say that all of its occlusion took, milliseconds: one number a
    /// frame of `frames`.
    pub fn own_diagnostics_ms(&mut self, frames: usize, progress: impl Fn()) -> Vec<f64> {
        let mut found = Vec::new();
        let mut last = None;
        // They come some frames late.
        for _ in 0..frames + 5 {
            self.app.update();
            progress();
            let Some(store) = self.app.world().get_resource::<DiagnosticsStore>() else {
                continue;
            };
            let span = store.iter().find(|diagnostic| {
                let path = diagnostic.path().as_str();
                path.contains("ssao") && path.ends_with("elapsed_gpu")
            });
            let measured = span.and_then(|diagnostic| diagnostic.measurement());
            if let Some(measured) = measured.filter(|measured| last != Some(measured.time)) {
                last = Some(measured.time);
                found.push(measured.value);
            }
        }
        found
    }

    fn take_passes(&mut self) -> Result<Option<OcclusionPasses>, Failure> {
        let world = self.app.sub_app_mut(RenderApp).world_mut();
        let mut views = world.query::<(
            &SsaoBindGroups,
            &ViewUniformOffset,
            &ViewPrepassTextures,
            &ScreenSpaceAmbientOcclusionResources,
        )>();
        let Ok((groups, uniform, prepass, textures)) = views.single(world) else {
            return Ok(None);
        };
        let bound = Bound::new(groups, uniform.offset, prepass, textures)?;
        let device = world.resource::<RenderDevice>();
        let queue = world.resource::<RenderQueue>();
        let pipelines = world.resource::<PipelineCache>();
        OcclusionPasses::take(device, queue, pipelines, self.is_software, bound)
    }

    /// Why there is no occlusion, as far as can be told.
    fn why_not(&self) -> String {
        let Some(device) = self.app.world().get_resource::<RenderDevice>() else {
            return String::from("Bevy found no adapter");
        };
        let storage_textures = device.limits().max_storage_textures_per_shader_stage;
        if storage_textures < 5 {
            return format!(
                "Bevy's occlusion needs 5 storage textures a shader, this adapter has {storage_textures}"
            );
        }
        let mut message = format!("Bevy's occlusion was not there after {MOST_FRAMES} frames");
        let render_app = self.app.sub_app(RenderApp);
        for pipeline in render_app.world().resource::<PipelineCache>().pipelines() {
            if let bevy::render::render_resource::CachedPipelineState::Err(error) = &pipeline.state
            {
                message += &format!("; {error}");
            }
        }
        message
    }
}

fn check_adapter(world: &World, wanted: &AdapterRecord) -> Result<(), Failure> {
    let found = world
        .get_resource::<RenderAdapterInfo>()
        .ok_or("Bevy opened no adapter")?;
    let driver = [found.driver.as_str(), found.driver_info.as_str()];
    let driver = driver.join(" ").trim().to_owned();
    let is_same = found.name == wanted.name
        && found.backend.to_string() == wanted.backend
        && driver == wanted.driver;
    if is_same {
        return Ok(());
    }
    Err(format!(
        "Bevy opened {} ({} {driver}), Greyfield {} ({} {}); unset WGPU_ADAPTER_NAME and name one with --adapter",
        found.name, found.backend, wanted.name, wanted.backend, wanted.driver
    )
    .into())
}

/// Triangles, camera, and what the camera draws onto.
fn spawn(world: &mut World, scene: &Scene) {
    let (width_px, height_px) = scene.size_px;
    let target =
        Image::new_target_texture(width_px, height_px, TextureFormat::Rgba8UnormSrgb, None);
    let target = world.resource_mut::<Assets<Image>>().add(target);
    let materials: Vec<_> = (scene.geometry.materials.iter())
        .map(|material| {
            let mut materials = world.resource_mut::<Assets<StandardMaterial>>();
            materials.add(StandardMaterial {
                double_sided: material.double_sided,
                cull_mode: (!material.double_sided)
                    .then_some(bevy::render::render_resource::Face::Back),
                ..StandardMaterial::default()
            })
        })
        .collect();
    for mesh in scene
        .geometry
        .meshes
        .iter()
        .filter(|mesh| !mesh.indices.is_empty())
    {
        let shape = world.resource_mut::<Assets<Mesh>>().add(shape(mesh));
        world.spawn((
            Mesh3d(shape),
            MeshMaterial3d(materials[mesh.material].clone()),
        ));
    }
    let camera = &scene.config.camera;
    let from_view = camera.view().inverse().to_cols_array();
    world.spawn((
        Camera3d::default(),
        RenderTarget::Image(target.into()),
        Tonemapping::None,
        Msaa::Off,
        Projection::Perspective(PerspectiveProjection {
            fov: camera.vertical_fov_rad,
            near: camera.near_m,
            far: camera.far_m,
            near_clip_plane: Vec4::new(0.0, 0.0, -1.0, -camera.near_m),
            ..PerspectiveProjection::default()
        }),
        Transform::from_matrix(Mat4::from_cols_array(&from_view)),
        // It brings the prepasses of depth and normals.
        bevy::pbr::ScreenSpaceAmbientOcclusion {
            quality_level: ScreenSpaceAmbientOcclusionQualityLevel::High,
            constant_object_thickness: THICKNESS_M,
        },
    ));
}

fn shape(mesh: &greyfield::scene::Mesh) -> Mesh {
    let positions: Vec<_> = mesh.vertices.iter().map(|v| v.position_m).collect();
    let normals: Vec<_> = mesh.vertices.iter().map(|v| v.normal).collect();
    Mesh::new(
        PrimitiveTopology::TriangleList,
        RenderAssetUsages::RENDER_WORLD,
    )
    .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
    .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
    .with_inserted_indices(Indices::U32(mesh.indices.clone()))
}
