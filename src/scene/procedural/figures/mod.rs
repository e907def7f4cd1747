//! Two clothed people on a concrete yard, as the game characters stood in the thesis:
//! shading of folds and seams is painted into their colours, so that computed occlusion
//! meets what the painter already darkened. Ground at y = 0; they face +z.

mod accessories;
mod boots;
mod garments;
mod hair;
mod hands;
mod head;
mod paint;
mod person;
mod pose;
mod tops;
mod yard;

use glam::Vec3;

use super::Generator;
use crate::scene::geometry::{Geometry, Material};
use crate::scene::modelling::Frame;
use crate::scene::texture::{add_materials, cloth, masonry, plain};

/// The registry's entry.
pub const GENERATOR: Generator = Generator {
    name: "figures",
    summary: "two clothed people on a yard, cavity shading painted into their colours",
    generate,
};

/// Indices into the scene's materials, and metres a repeat of their textures.
#[derive(Clone, Copy)]
pub(super) struct Materials {
    pub canvas: (usize, f32),
    pub leather: (usize, f32),
    pub skin: usize,
    pub hair: usize,
    pub eye: usize,
    pub metal: usize,
    pub concrete: (usize, f32),
    pub brick: (usize, f32),
    pub wood: (usize, f32),
}

fn generate(seed: u64) -> Geometry {
    let mut geometry = Geometry::default();
    let materials = materials(&mut geometry, seed);
    let man = person::Person::man(seed);
    let woman = person::Person::woman(seed);
    let places = [
        Frame::turned(Vec3::new(-0.46, 0.0, 0.0), 0.22),
        Frame::turned(Vec3::new(0.44, 0.0, 0.10), -0.30),
    ];
    for (person, place) in [man, woman].iter().zip(&places) {
        geometry.meshes.extend(person.meshes(&materials, place));
    }
    geometry.meshes.extend(yard::meshes(&materials, seed));
    geometry
}

fn materials(geometry: &mut Geometry, seed: u64) -> Materials {
    let finishes = add_materials(
        geometry,
        &[
            cloth::canvas(seed),
            cloth::leather(seed),
            plain::concrete(seed),
            masonry::brick(seed),
            plain::wood(seed),
        ],
    );
    let mut plain = |name: &str, roughness: f32, metallic: f32| {
        geometry.materials.push(Material {
            name: name.to_owned(),
            albedo: [1.0; 3],
            roughness,
            metallic,
            ..Material::default()
        });
        geometry.materials.len() - 1
    };
    let (skin, hair) = (plain("skin", 0.55, 0.0), plain("hair", 0.5, 0.0));
    let (eye, metal) = (plain("eyes", 0.15, 0.0), plain("buckles", 0.4, 1.0));
    let of = |i: usize| (finishes[i].material, finishes[i].tile_m);
    Materials {
        canvas: of(0),
        leather: of(1),
        skin,
        hair,
        eye,
        metal,
        concrete: of(2),
        brick: of(3),
        wood: of(4),
    }
}
