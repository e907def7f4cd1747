//! placeholder
use super::Generator;
use crate::scene::{Geometry, Material, primitives};
use glam::Vec3;
/// The atrium.
pub static ATRIUM: Generator = Generator {
    name: "atrium",
    summary: "placeholder",
    generate,
};
fn generate(_seed: u64) -> Geometry {
    primitives::of_one_material(
        Material::default(),
        vec![
            primitives::quad(
                "floor",
                Vec3::new(-5.0, 0.0, 5.0),
                Vec3::X * 10.0,
                Vec3::NEG_Z * 10.0,
            ),
            primitives::cuboid("box", Vec3::new(-1.0, 0.0, -1.0), Vec3::new(0.5, 1.5, 0.3)),
            primitives::cuboid("pole", Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.1, 2.5, 0.1)),
            primitives::quad(
                "wall",
                Vec3::new(-3.0, 0.0, -2.0),
                Vec3::X * 6.0,
                Vec3::Y * 2.0,
            ),
        ],
    )
}
