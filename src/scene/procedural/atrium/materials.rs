//! What the atrium is made of.

use glam::Vec3;

use super::weather::Weather;
use crate::scene::geometry::{Geometry, Material};
use crate::scene::modelling::MeshBuilder;
use crate::scene::texture::{Finish, add_materials, cloth, masonry, plain, srgb};

/// The meshes under construction, one a material.
pub(super) struct Stuff {
    geometry: Geometry,
    finishes: Vec<Finish>,
    hanging: [Finish; 3],
    bronze: Finish,
    iron_finish: Finish,
    leaf: Finish,
    pub ashlar: MeshBuilder,
    pub brick: MeshBuilder,
    pub floor: MeshBuilder,
    pub plaster: MeshBuilder,
    pub carved: MeshBuilder,
    pub wood: MeshBuilder,
    pub terracotta: MeshBuilder,
    /// Red, green and blue cloth.
    pub cloth: [MeshBuilder; 3],
    pub metal: MeshBuilder,
    pub iron: MeshBuilder,
    pub leaves: MeshBuilder,
}

const DYES: [(&str, u32); 3] = [
    ("red hanging", 0x9a3a30),
    ("green hanging", 0x5f7048),
    ("blue hanging", 0x3a547e),
];

impl Stuff {
    /// Paints the textures.
    pub fn new(seed: u64) -> Self {
        let mut geometry = Geometry::default();
        let finishes = add_materials(
            &mut geometry,
            &[
                masonry::ashlar(seed),
                masonry::brick(seed),
                plain::paving(seed),
                plain::plaster(seed),
                plain::carved_stone(seed),
                plain::wood(seed),
                plain::terracotta(seed),
                cloth::hanging(seed),
            ],
        );
        let woven = finishes[7];
        let undyed = geometry.materials[woven.material].clone();
        geometry.materials.truncate(woven.material);
        let hanging = DYES.map(|(name, dye)| {
            geometry.materials.push(Material {
                name: name.to_owned(),
                albedo: srgb(dye).to_array(),
                double_sided: true,
                ..undyed.clone()
            });
            Finish {
                material: geometry.materials.len() - 1,
                ..woven
            }
        });
        let mut untextured = |material: Material| {
            geometry.materials.push(material);
            Finish {
                material: geometry.materials.len() - 1,
                tile_m: 1.0,
            }
        };
        let bronze = untextured(Material {
            name: "bronze".to_owned(),
            albedo: srgb(0x8a6a3c).to_array(),
            roughness: 0.45,
            metallic: 1.0,
            ..Material::default()
        });
        // Painted black against rust, so no bare metal.
        let iron_finish = untextured(Material {
            name: "iron".to_owned(),
            albedo: srgb(0x3a3634).to_array(),
            roughness: 0.6,
            ..Material::default()
        });
        let leaf = untextured(Material {
            name: "leaves".to_owned(),
            albedo: [1.0; 3],
            roughness: 0.6,
            double_sided: true,
            ..Material::default()
        });
        Self {
            geometry,
            finishes,
            hanging,
            bronze,
            iron_finish,
            leaf,
            ashlar: MeshBuilder::new(),
            brick: MeshBuilder::new(),
            floor: MeshBuilder::new(),
            plaster: MeshBuilder::new(),
            carved: MeshBuilder::new(),
            wood: MeshBuilder::new(),
            terracotta: MeshBuilder::new(),
            cloth: std::array::from_fn(|_| MeshBuilder::new()),
            metal: MeshBuilder::new(),
            iron: MeshBuilder::new(),
            leaves: MeshBuilder::new(),
        }
    }

    /// Lays the stains on everything that has stood there for long.
    pub fn weather(&mut self, weather: Weather) {
        for masonry in [&mut self.ashlar, &mut self.brick, &mut self.carved] {
            masonry.stain(|p, n| weather.stone(p, n));
        }
        self.plaster.stain(|p, n| weather.plaster(p, n));
        for floor in [&mut self.floor, &mut self.terracotta] {
            floor.stain(|p, _| weather.floor(p));
        }
    }

    /// A green for leaves, darker where `depth` is near 1.
    pub fn leaf_color(hue: f32, depth: f32) -> Vec3 {
        srgb(0x6f8f3f).lerp(srgb(0x3f6b38), hue) * (1.0 - 0.5 * depth)
    }

    /// The finished scene.
    pub fn finish(self) -> Geometry {
        let mut geometry = self.geometry;
        let [red, green, blue] = self.cloth;
        let meshes = [
            ("walls", self.ashlar, self.finishes[0]),
            ("brickwork", self.brick, self.finishes[1]),
            ("floors", self.floor, self.finishes[2]),
            ("plaster", self.plaster, self.finishes[3]),
            ("carved stone", self.carved, self.finishes[4]),
            ("woodwork", self.wood, self.finishes[5]),
            ("vessels", self.terracotta, self.finishes[6]),
            ("red hangings", red, self.hanging[0]),
            ("green hangings", green, self.hanging[1]),
            ("blue hangings", blue, self.hanging[2]),
            ("bronze", self.metal, self.bronze),
            ("ironwork", self.iron, self.iron_finish),
            ("plants", self.leaves, self.leaf),
        ];
        for (name, builder, finish) in meshes {
            if builder.triangles() > 0 {
                geometry
                    .meshes
                    .push(builder.finish(name, finish.material, finish.tile_m));
            }
        }
        geometry
    }
}
