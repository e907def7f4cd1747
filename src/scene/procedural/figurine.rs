//! A carved dragon, its body in a loop over rocks and waves: it stands where the Stanford
//! dragon stood in the thesis. One closed surface with deep hollows in the loop, under the
//! jaw, among claws, spines and scales. About 0.3 m tall and 0.45 m long, its foot at y = 0.

mod body;
mod head;
mod limbs;
mod rock;

use glam::Vec3;
use rayon::prelude::*;

use super::Generator;
use crate::scene::geometry::{Geometry, Material, Mesh, ModelLights, Vertex};
use crate::scene::modelling::Noise;
use crate::scene::modelling::math::{perpendicular, smoothstep};
use crate::scene::modelling::polygonise::polygonise;
use crate::scene::modelling::sculpture::Sculpture;
use crate::scene::modelling::surface::Surface;
use crate::scene::texture::srgb;

/// The registry's entry.
pub const GENERATOR: Generator = Generator {
    name: "figurine",
    summary: "carved dragon, looped over rocks and waves: one closed surface with deep hollows",
    generate,
};

/// Size of the marching cubes, metres.
const CELL_M: f32 = 0.0017;

fn generate(seed: u64) -> Geometry {
    let mut sculpture = Sculpture::new();
    rock::carve(&mut sculpture, seed);
    let spine = body::Spine::looped();
    body::carve(&mut sculpture, &spine);
    limbs::carve(&mut sculpture, &spine);
    head::carve(&mut sculpture, &spine);
    let surface = polygonise(&sculpture, CELL_M);
    Geometry {
        meshes: vec![mesh(&surface, seed)],
        materials: vec![Material {
            name: "jade".to_owned(),
            albedo: [1.0; 3],
            roughness: 0.38,
            ..Material::default()
        }],
        textures: Vec::new(),
        lights: ModelLights::default(),
    }
}

/// Jade: clouds of pale and deep green, a little paler where hands have rubbed the
/// ridges. No shading is painted in: occlusion is the renderer's part here.
fn mesh(surface: &Surface, seed: u64) -> Mesh {
    let noise = Noise::new(seed, "figurine jade", 0);
    let (deep, pale, vein) = (srgb(0x8fae90), srgb(0xa9c2a2), srgb(0xb9c2a4));
    let vertices = (0..surface.positions_m.len())
        .into_par_iter()
        .map(|i| {
            let (p, n) = (surface.positions_m[i], surface.normals[i]);
            let cloud = noise.fbm(p * 14.0, 4);
            let streak = noise.fbm(Vec3::new(p.x * 9.0, p.y * 30.0, p.z * 9.0) + cloud, 3);
            let rubbed = smoothstep(60.0, 700.0, surface.curvatures_per_m[i]);
            let color = deep
                .lerp(pale, smoothstep(-0.5, 0.6, cloud))
                .lerp(vein, 0.6 * smoothstep(0.25, 0.6, streak))
                .lerp(pale, 0.3 * rubbed);
            Vertex {
                position_m: p.to_array(),
                normal: n.to_array(),
                tangent: perpendicular(n).extend(1.0).to_array(),
                uv: [0.0; 2],
                color: color.extend(1.0).to_array(),
            }
        })
        .collect();
    Mesh {
        name: "dragon".to_owned(),
        vertices,
        indices: surface.indices.clone(),
        material: 0,
    }
}
