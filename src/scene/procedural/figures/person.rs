//! A person: layers of clothing, each a closed sculpture of its own, painted and meshed.

use glam::Vec3;
use rayon::prelude::*;

use super::pose::Pose;
use super::{Materials, accessories, boots, garments, hair, hands, head, paint, tops};
use crate::scene::geometry::Mesh;
use crate::scene::modelling::noise::Noise;
use crate::scene::modelling::polygonise::polygonise;
use crate::scene::modelling::sculpture::Sculpture;
use crate::scene::modelling::{Frame, MeshBuilder};
use crate::scene::texture::srgb;

/// What a layer is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stuff {
    Cloth,
    Leather,
    Skin,
    Hair,
    Metal,
}

/// The colour of a layer at a point and its normal; linear.
pub(super) type Paint = Box<dyn Fn(Vec3, Vec3) -> Vec3 + Send + Sync>;

/// One closed surface of one material.
pub(super) struct Layer {
    pub name: &'static str,
    pub stuff: Stuff,
    pub sculpture: Sculpture,
    /// Size of the marching cubes, metres.
    pub cell_m: f32,
    pub paint: Paint,
}

impl Layer {
    pub fn dyed(
        name: &'static str,
        stuff: Stuff,
        sculpture: Sculpture,
        cell_m: f32,
        dye: u32,
    ) -> Self {
        let color = srgb(dye);
        Self {
            name,
            stuff,
            sculpture,
            cell_m,
            paint: Box::new(move |_, _| color),
        }
    }
}

/// How somebody is built and dressed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Build {
    pub woman: bool,
    /// Sizes against a man of 1.80 m.
    pub girth: f32,
    pub head: f32,
    pub skin: u32,
    pub lips: u32,
    pub hair: u32,
    pub iris: u32,
    pub top: u32,
    pub trousers: u32,
    pub boots: u32,
    pub belts: u32,
}

/// One figure, at its own origin.
pub(super) struct Person {
    layers: Vec<Layer>,
    eyes: [Frame; 2],
    eye_radius_m: f32,
    iris: Vec3,
    noise: Noise,
}

impl Person {
    /// A man in a field jacket with a satchel.
    pub fn man(seed: u64) -> Self {
        let build = Build {
            woman: false,
            girth: 1.0,
            head: 1.0,
            skin: 0xc08f70,
            lips: 0xa5675a,
            hair: 0x3a2a1e,
            iris: 0x3f4c4a,
            top: 0x77785a,
            trousers: 0x5d5a55,
            boots: 0x4a3526,
            belts: 0x6a4a30,
        };
        Self::dress(seed, 0, &Pose::man(), &build)
    }

    /// A woman in a shirt and a leather waistcoat, her hair in a tail.
    pub fn woman(seed: u64) -> Self {
        let build = Build {
            woman: true,
            girth: 0.88,
            head: 0.94,
            skin: 0xcf9f82,
            lips: 0xb2645c,
            hair: 0x5a3720,
            iris: 0x5a4630,
            top: 0x9fa9b0,
            trousers: 0x8d7a5c,
            boots: 0x54392a,
            belts: 0x43301f,
        };
        Self::dress(seed, 1, &Pose::woman(), &build)
    }

    fn dress(seed: u64, index: u64, pose: &Pose, build: &Build) -> Self {
        let noise = Noise::new(seed, "figures folds", index);
        let trousers = garments::trousers(pose, build, noise);
        let top = tops::top(pose, build, noise);
        let body = tops::body(pose, build, noise);
        let mut layers = Vec::new();
        layers.extend(accessories::over(pose, build, noise, &body, &trousers));
        layers.push(Layer::dyed(
            "trousers",
            Stuff::Cloth,
            trousers,
            0.0064,
            build.trousers,
        ));
        layers.push(Layer::dyed("jacket", Stuff::Cloth, top, 0.0055, build.top));
        layers.push(boots::layer(pose, build, noise));
        layers.extend(hands::layers(pose, build));
        layers.push(head::layer(pose, build, noise));
        layers.push(hair::layer(pose, build, noise));
        Self {
            layers,
            eyes: head::eyes(pose, build),
            eye_radius_m: head::EYE_RADIUS_M * build.head,
            iris: srgb(build.iris),
            noise,
        }
    }

    /// Everything, standing in `place`.
    pub fn meshes(&self, materials: &Materials, place: &Frame) -> Vec<Mesh> {
        let volume = paint::Volume::new(self.layers.iter().map(|layer| &layer.sculpture));
        let mut meshes: Vec<Mesh> = self
            .layers
            .par_iter()
            .map(|layer| {
                let surface = polygonise(&layer.sculpture, layer.cell_m);
                let colors = paint::colors(&surface, layer, &volume, self.noise);
                let (material, tile_m) = match layer.stuff {
                    Stuff::Cloth => materials.canvas,
                    Stuff::Leather => materials.leather,
                    Stuff::Skin => (materials.skin, 1.0),
                    Stuff::Hair => (materials.hair, 1.0),
                    Stuff::Metal => (materials.metal, 1.0),
                };
                let mut builder = MeshBuilder::new();
                surface.add_to(&mut builder, &colors, place);
                builder.finish(layer.name, material, tile_m)
            })
            .collect();
        let mut eyes = MeshBuilder::new();
        for eye in &self.eyes {
            head::eyeball(&mut eyes, &place.then(eye), self.eye_radius_m, self.iris);
        }
        meshes.push(eyes.finish("eyes", materials.eye, 1.0));
        meshes
    }
}
