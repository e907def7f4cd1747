//! A closed surface of triangles, and its way into a mesh.

use std::collections::HashMap;

use glam::Vec3;

use super::builder::{MeshBuilder, box_uv_m};
use super::math::Frame;

/// A closed surface.
#[derive(Debug, Clone, Default)]
pub struct Surface {
    /// Points, metres.
    pub positions_m: Vec<Vec3>,
    /// Unit normals: the gradient of the distance.
    pub normals: Vec<Vec3>,
    /// Sum of the principal curvatures, 1/m: positive on ridges, negative in hollows.
    pub curvatures_per_m: Vec<f32>,
    /// Three a triangle, counter-clockwise from outside.
    pub indices: Vec<u32>,
}

impl Surface {
    /// Adds the surface, placed in `frame`, with a linear colour for each point and
    /// box-projected texture coordinates: each triangle takes the axis it faces most,
    /// and points between two such regions are doubled.
    pub fn add_to(&self, builder: &mut MeshBuilder, colors: &[Vec3], frame: &Frame) {
        let mut numbers: HashMap<(u32, [i8; 3]), u32> = HashMap::new();
        for corners in self.indices.chunks_exact(3) {
            let sum: Vec3 = corners.iter().map(|&i| self.normals[i as usize]).sum();
            let axis = main_axis(sum);
            let key = axis.to_array().map(|a| a as i8);
            let placed = [0, 1, 2].map(|k| {
                let i = corners[k] as usize;
                *numbers.entry((corners[k], key)).or_insert_with(|| {
                    let p = self.positions_m[i];
                    builder.tint(colors[i]);
                    let normal = frame.direction(self.normals[i]);
                    builder.corner(frame.point(p), normal, box_uv_m(p, axis))
                })
            });
            builder.triangle(placed);
        }
        builder.tint(Vec3::ONE);
    }
}

/// The signed axis nearest to `n`.
fn main_axis(n: Vec3) -> Vec3 {
    let a = n.abs();
    if a.y >= a.x && a.y >= a.z {
        Vec3::Y * n.y.signum()
    } else if a.x >= a.z {
        Vec3::X * n.x.signum()
    } else {
        Vec3::Z * n.z.signum()
    }
}
