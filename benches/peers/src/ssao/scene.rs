//! One scene for both renderers: its triangles in plain white, without normal maps, and a camera.

use std::path::Path;

use greyfield::render::FrameRequest;
use greyfield::render::technique::Settings;
use greyfield::scene::{Geometry, Lighting, Material, SceneConfig};

use crate::Failure;

/// Radius of Bevy's occlusion, metres: `effect_radius` in bevy_pbr's `ssao.wgsl`, where it is
/// fixed.
pub const RADIUS_M: f32 = 0.5 * 1.457;

/// Thickness of what Bevy's depth buffer shows, metres: its default.
pub const THICKNESS_M: f32 = 0.25;

/// What is seen, and from where.
pub struct Scene {
    /// Camera and blur.
    pub config: SceneConfig,
    /// Lighting that asks for least; occlusion does not depend on it.
    lighting: Lighting,
    /// Triangles, white.
    pub geometry: Geometry,
    /// Columns and rows of the picture.
    pub size_px: (u32, u32),
}

impl Scene {
    /// Reads a scene config and makes its geometry.
    pub fn load(path: &Path, size_px: (u32, u32)) -> Result<Self, Failure> {
        let config = SceneConfig::load(path)?;
        let lightings = config.lightings.values();
        let lighting = lightings
            .min_by_key(|lighting| {
                let effects = [lighting.environment.is_some(), lighting.sun.is_some()];
                effects.map(usize::from).iter().sum::<usize>() + lighting.points.len()
            })
            .ok_or("the scene has no lighting")?
            .clone();
        let geometry = white(config.geometry.load()?);
        Ok(Self {
            config,
            lighting,
            geometry,
            size_px,
        })
    }

    /// A picture with one sample a pixel, in its middle, where Bevy's is.
    pub fn request(&self, occlusion: Settings, blur_radius_px: u32) -> FrameRequest {
        let seed = 1;
        FrameRequest {
            supersampling: 1,
            blur_radius_px,
            ..FrameRequest::new(&self.config, &self.lighting, occlusion, self.size_px, seed)
        }
    }
}

/// A technique with what it shares with Bevy's, radius and thickness, and then with what its label
/// says beyond its name: `gtao18:falloff=0:step_power=1`.
pub fn settings(label: &str) -> Result<Settings, Failure> {
    let mut parts = label.split(':');
    let mut settings = Settings::from_label(parts.next().unwrap_or_default())?;
    let has = settings.values();
    for (name, value_m) in [("radius_m", RADIUS_M), ("thickness_m", THICKNESS_M)] {
        if has.contains_key(name) {
            settings.set(name, f64::from(value_m))?;
        }
    }
    for part in parts {
        let (name, value) = part
            .split_once('=')
            .ok_or_else(|| format!("found `{part}` in `{label}`, allowed is NAME=VALUE"))?;
        match value.parse::<f64>() {
            Ok(number) => settings.set(name, number)?,
            Err(_) => settings.set(name, value)?,
        }
    }
    Ok(settings)
}

/// The triangles without what Bevy would draw otherwise: colours, normal maps, holes by alpha.
fn white(geometry: Geometry) -> Geometry {
    let plain = |material: Material| Material {
        name: material.name,
        albedo: [1.0; 3],
        double_sided: material.double_sided,
        ..Material::default()
    };
    Geometry {
        materials: geometry.materials.into_iter().map(plain).collect(),
        textures: Vec::new(),
        ..geometry
    }
}
