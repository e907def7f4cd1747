//! Every technique on frames at the edge of what can be drawn: is the answer still a number
//! from 0 to 1?

use glam::Vec3;

use super::technique::{Settings, TECHNIQUES};
use super::{FrameRequest, GpuScene, Precision, RenderError, Renderer};
use crate::scene::primitives::{cuboid, of_one_material, quad};
use crate::scene::{Camera, Geometry, Lighting, Material, Mesh};

/// Size of the frames, pixels.
const SIZE_PX: (u32, u32) = (96, 72);

/// What a technique gave on one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct StabilityRow {
    /// The technique.
    pub technique: &'static str,
    /// The frame.
    pub case: &'static str,
    /// How buffers were stored.
    pub precision: Precision,
    /// The smallest occlusion coefficient of any pixel.
    pub lowest: f32,
    /// The largest.
    pub highest: f32,
    /// Pixels that are no number, or infinite.
    pub not_finite: usize,
}

impl StabilityRow {
    /// Whether every pixel is a number from 0 to 1.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.not_finite == 0 && self.lowest >= 0.0 && self.highest <= 1.0
    }
}

/// A frame at the edge.
struct Case {
    name: &'static str,
    geometry: Geometry,
    camera: Camera,
    /// What lengths of a technique are multiplied by.
    lengths: f64,
}

/// Draws every technique that runs on the GPU on every case, in both precisions. `done` is called after each
/// technique with its name.
///
/// # Errors
/// [`RenderError`] of the first frame that cannot be drawn.
pub fn sweep(
    renderer: &Renderer,
    mut done: impl FnMut(&str),
) -> Result<Vec<StabilityRow>, RenderError> {
    let cases = cases();
    let scenes: Vec<_> = cases
        .iter()
        .map(|case| renderer.upload(&case.geometry))
        .collect::<Result<_, _>>()?;
    let mut rows = Vec::new();
    for technique in TECHNIQUES.iter().filter(|t| t.shader.is_some()) {
        for (case, scene) in cases.iter().zip(&scenes) {
            for precision in [Precision::Full, Precision::Thesis] {
                let settings = scaled(Settings::defaults(technique, technique.name), case.lengths);
                let request = request(case.camera, settings, precision);
                let values = drawn(renderer, scene, &request)?;
                let numbers = || values.iter().copied().filter(|value| value.is_finite());
                // As the technique gives it: bringing it to 0 to 1 would hide what is no number.
                let given = drawn(renderer, scene, &as_given(request))?;
                let not_finite = given.iter().filter(|value| !value.is_finite()).count();
                rows.push(StabilityRow {
                    technique: technique.name,
                    case: case.name,
                    precision,
                    lowest: numbers().fold(f32::INFINITY, f32::min),
                    highest: numbers().fold(f32::NEG_INFINITY, f32::max),
                    not_finite: not_finite + values.len() - numbers().count(),
                });
            }
        }
        done(technique.name);
    }
    Ok(rows)
}

fn as_given(request: FrameRequest) -> FrameRequest {
    FrameRequest {
        unbounded_occlusion: true,
        blur_radius_px: 0,
        ..request
    }
}

/// The occlusion of a frame; nothing where the plan needs none.
fn drawn(
    renderer: &Renderer,
    scene: &GpuScene,
    request: &FrameRequest,
) -> Result<Vec<f32>, RenderError> {
    let frame = renderer.render(scene, request)?;
    Ok(frame.occlusion.map_or_else(Vec::new, |image| image.values))
}

/// The worst of each technique and precision, a line each.
#[must_use]
pub fn table(rows: &[StabilityRow]) -> String {
    let mut text = format!(
        "{:<12} {:<7} {:>7}  {:<26} {:>7}  {:<26} {:>10}\n",
        "technique", "stored", "lowest", "there", "highest", "there", "not finite"
    );
    for technique in TECHNIQUES {
        for (precision, stored) in [(Precision::Full, "full"), (Precision::Thesis, "thesis")] {
            let of = || {
                (rows.iter()).filter(|r| r.technique == technique.name && r.precision == precision)
            };
            let lowest = of().min_by(|a, b| a.lowest.total_cmp(&b.lowest));
            let highest = of().max_by(|a, b| a.highest.total_cmp(&b.highest));
            if let (Some(lowest), Some(highest)) = (lowest, highest) {
                let not_finite: usize = of().map(|row| row.not_finite).sum();
                text += &format!(
                    "{:<12} {stored:<7} {:>7.4}  {:<26} {:>7.4}  {:<26} {not_finite:>10}\n",
                    technique.name, lowest.lowest, lowest.case, highest.highest, highest.case
                );
            }
        }
    }
    text
}

/// The technique with every length multiplied, as far as its ranges go.
fn scaled(mut settings: Settings, factor: f64) -> Settings {
    for parameter in settings.technique.parameters {
        if parameter.name.ends_with("_m") {
            let length = settings.get(parameter.name) * factor;
            // A length beyond the range stays what it is.
            let _ = settings.set(parameter.name, length);
        }
    }
    settings
}

fn request(camera: Camera, occlusion: Settings, precision: Precision) -> FrameRequest {
    FrameRequest {
        width_px: SIZE_PX.0,
        height_px: SIZE_PX.1,
        supersampling: 1,
        camera,
        lighting: Lighting::constant(Vec3::ONE),
        occlusion,
        handed_occlusion: None,
        blur_radius_px: 4,
        blur_plane_m: 0.05,
        precision,
        seed: 2010,
        baked_occlusion: false,
        unbounded_occlusion: false,
        keeps_cone: false,
        all_effects: false,
    }
}

fn scene(meshes: Vec<Mesh>) -> Geometry {
    of_one_material(Material::default(), meshes)
}

fn floor(scale: f32) -> Mesh {
    let (corner, side) = (Vec3::new(-6.0, 0.0, 6.0) * scale, 12.0 * scale);
    quad("floor", corner, Vec3::X * side, Vec3::NEG_Z * side)
}

fn wall(scale: f32) -> Mesh {
    let (low, high) = (Vec3::new(-1.5, 0.0, -0.5), Vec3::new(1.5, 1.6, 0.0));
    cuboid("wall", low * scale, high * scale)
}

fn looking(from_m: Vec3, at_m: Vec3, near_m: f32, far_m: f32) -> Camera {
    Camera {
        position_m: from_m,
        target_m: at_m,
        vertical_fov_rad: 0.9,
        near_m,
        far_m,
    }
}

fn cases() -> Vec<Case> {
    let wall_at = |name, scale: f32, lengths| Case {
        name,
        geometry: scene(vec![floor(scale), wall(scale)]),
        camera: looking(
            Vec3::new(0.0, 1.5, 4.0) * scale,
            Vec3::new(0.0, 0.8, 0.0) * scale,
            0.05 * scale,
            50.0 * scale,
        ),
        lengths,
    };
    let grazing = Vec3::new(0.0, 0.001_745, 1.0) * 4.0;
    let near = quad(
        "near",
        Vec3::new(-1.0, 0.5, 3.949),
        Vec3::X * 2.0,
        Vec3::Y * 2.0,
    );
    let pole = cuboid("pole", Vec3::new(0.2, 0.0, 0.0), Vec3::new(0.24, 3.0, 0.04));
    let eye = looking(
        Vec3::new(0.0, 1.5, 4.0),
        Vec3::new(0.0, 0.8, 0.0),
        0.05,
        50.0,
    );
    let unscaled = |name, meshes, camera| Case {
        name,
        geometry: scene(meshes),
        camera,
        lengths: 1.0,
    };
    vec![
        wall_at("wall on a floor", 1.0, 1.0),
        wall_at("no radius", 1.0, 0.0),
        wall_at("radius beyond the scene", 1.0, 1e4),
        wall_at("a centimetre away", 0.0025, 0.0025),
        wall_at("a hundred kilometres away", 25_000.0, 25_000.0),
        unscaled(
            "plane at 89.9 degrees",
            vec![floor(1.0)],
            looking(grazing, Vec3::ZERO, 0.001, 50.0),
        ),
        unscaled("surface at the near plane", vec![floor(1.0), near], eye),
        unscaled("pole one pixel wide", vec![floor(1.0), pole.clone()], eye),
        unscaled("pole before the sky", vec![pole], eye),
        unscaled("sky alone", Vec::new(), eye),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::testing::renderer;

    #[test]
    fn every_technique_is_sound_at_the_edge() {
        let rows = sweep(renderer(), |_| ()).unwrap();
        println!("{}", table(&rows));
        let techniques = TECHNIQUES.iter().filter(|t| t.shader.is_some()).count();
        assert_eq!(rows.len(), techniques * cases().len() * 2);
        for row in &rows {
            assert!(row.is_sound(), "{row:?}");
            if row.case == "sky alone" {
                assert_eq!((row.lowest, row.highest), (1.0, 1.0), "{row:?}");
            }
        }
    }
}
