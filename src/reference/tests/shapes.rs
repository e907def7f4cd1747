//! Shapes whose occlusion is known, and pictures of them without a renderer.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::super::{SceneBvh, SurfacePoint};
use crate::scene::primitives::{of_one_material, quad};
use crate::scene::{Camera, Geometry, Material, Mesh, VisibleSurfaces};

pub fn geometry(meshes: Vec<Mesh>) -> Geometry {
    of_one_material(Material::default(), meshes)
}

/// A square of the plane y = 0 round the origin.
pub fn floor(half_side_m: f32) -> Mesh {
    let corner = Vec3::new(-half_side_m, 0.0, half_side_m);
    quad(
        "floor",
        corner,
        Vec3::X * 2.0 * half_side_m,
        Vec3::NEG_Z * 2.0 * half_side_m,
    )
}

/// An upright rectangle in the plane z = 0, standing on y = 0.
pub fn wall(half_width_m: f32, height_m: f32) -> Mesh {
    let corner = Vec3::new(-half_width_m, 0.0, 0.0);
    quad(
        "wall",
        corner,
        Vec3::X * 2.0 * half_width_m,
        Vec3::Y * height_m,
    )
}

/// What cosine weighting leaves of the hemisphere on the floor, at a distance from the middle
/// of a [`wall`]: twice the configuration factor of a small area to a rectangle at right
/// angles whose corner lies before it (Howell's catalogue, B-4).
pub fn beside_wall(distance_m: f64, half_width_m: f64, height_m: f64) -> f64 {
    let to_edge_m = distance_m.hypot(height_m);
    let (b, c) = (half_width_m, distance_m);
    let half = (b / c).atan() - c / to_edge_m * (b / to_edge_m).atan();
    1.0 - half / std::f64::consts::PI
}

/// A tube round the y axis, open at both ends, and as inscribed as its sides are many.
pub fn tube(radius_m: f32, height_m: f32, sides: u32) -> Mesh {
    let corner = |k: u32| {
        let angle = TAU * (k % sides) as f32 / sides as f32;
        Vec3::new(radius_m * angle.cos(), 0.0, radius_m * angle.sin())
    };
    merged((0..sides).map(|k| quad("", corner(k), corner(k + 1) - corner(k), Vec3::Y * height_m)))
}

/// The part of a unit sphere below a polar angle from −y, `rings` × 2 `rings` flat pieces.
pub fn bowl(rings: u32, up_to_rad: f32) -> Mesh {
    let point = |i: u32, j: u32| {
        let (polar, azimuth) = (
            up_to_rad * i as f32 / rings as f32,
            PI * j as f32 / rings as f32,
        );
        Vec3::new(
            polar.sin() * azimuth.cos(),
            -polar.cos(),
            polar.sin() * azimuth.sin(),
        )
    };
    let pieces = (0..rings).flat_map(|i| (0..2 * rings).map(move |j| (i, j)));
    merged(pieces.map(|(i, j)| {
        let corners = [
            point(i, j),
            point(i, j + 1),
            point(i + 1, j + 1),
            point(i + 1, j),
        ];
        let mut piece = quad("", Vec3::ZERO, Vec3::X, Vec3::Y);
        for (vertex, corner) in piece.vertices.iter_mut().zip(corners) {
            vertex.position_m = corner.to_array();
        }
        piece
    }))
}

pub fn hemisphere() -> Mesh {
    bowl(128, FRAC_PI_2)
}

pub fn sphere() -> Mesh {
    bowl(192, PI)
}

fn merged(parts: impl Iterator<Item = Mesh>) -> Mesh {
    parts.fold(Mesh::default(), |mut all, part| {
        let first = all.vertices.len() as u32;
        all.vertices.extend(part.vertices);
        all.indices
            .extend(part.indices.iter().map(|index| first + index));
        all
    })
}

/// The first point met from an eye.
pub fn point(geometry: &Geometry, eye_m: Vec3, direction: Vec3) -> SurfacePoint {
    let bvh = SceneBvh::new(geometry);
    let (eye_m, direction) = (eye_m.as_dvec3(), direction.normalize().as_dvec3());
    SurfacePoint::first_met(&bvh, eye_m, direction, 0.0, 1e9).unwrap()
}

/// What a camera sees, by rays through the samples of its pixels.
pub fn seen(bvh: &SceneBvh, camera: Camera, (width_px, height_px): (u32, u32)) -> VisibleSurfaces {
    let pixels = (width_px * height_px) as usize;
    let mut surfaces = VisibleSurfaces {
        camera,
        width_px,
        height_px,
        sample: 0.5,
        depth_m: vec![camera.far_m; pixels],
        normals: vec![Vec3::ZERO; pixels],
        geometric_normals: vec![Vec3::ZERO; pixels],
    };
    let projection = surfaces.projection();
    let eye_m: DVec3 = projection.world_point(0, 0.0);
    let (near, far) = (f64::from(camera.near_m), f64::from(camera.far_m));
    let met: Vec<_> = (0..pixels)
        .into_par_iter()
        .map(|pixel| {
            let direction = projection.world_point(pixel, 1.0) - eye_m;
            let point = SurfacePoint::first_met(bvh, eye_m, direction, near, far)?;
            let along = (point.position_m.as_dvec3() - eye_m).dot(direction);
            Some((point, along / direction.length_squared()))
        })
        .collect();
    for (pixel, met) in met.into_iter().enumerate() {
        if let Some((point, depth_m)) = met {
            surfaces.depth_m[pixel] = depth_m as f32;
            surfaces.normals[pixel] = point.geometric_normal;
            surfaces.geometric_normals[pixel] = point.geometric_normal;
        }
    }
    surfaces
}
