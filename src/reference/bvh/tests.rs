use super::*;
use crate::scene::primitives::{cuboid, of_one_material, quad};
use crate::scene::{Material, Texture, TextureEncoding, Wrap};
use crate::seed;

/// Triangles strewn in a cube, large and small.
fn strewn(count: usize) -> Geometry {
    let mut rng = seed::generator(1, "test", 0);
    let mut vector = || Vec3::from([(); 3].map(|()| seed::unit_f32(&mut rng) - 0.5));
    let mut geometry = of_one_material(
        Material::default(),
        vec![quad("", Vec3::ZERO, Vec3::X, Vec3::Y)],
    );
    let blank = geometry.meshes[0].vertices[0];
    let mesh = &mut geometry.meshes[0];
    mesh.vertices.clear();
    mesh.indices.clear();
    for index in 0..count {
        let centre = vector() * 4.0;
        let size = if index % 50 == 0 { 2.0 } else { 0.2 };
        for _ in 0..3 {
            mesh.indices.push(mesh.vertices.len() as u32);
            let position_m = (centre + vector() * size).to_array();
            mesh.vertices.push(crate::scene::Vertex {
                position_m,
                ..blank
            });
        }
    }
    geometry
}

/// The distance to a triangle in double precision (Cramer's rule), the slow way.
fn distance_to(corners: [Vec3; 3], origin: Vec3, direction: Vec3) -> Option<f64> {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (origin, direction) = (origin.as_dvec3(), direction.as_dvec3());
    let matrix = glam::DMat3::from_cols(b - a, c - a, -direction);
    let solved = matrix.inverse() * (origin - a);
    let inside = solved.x >= 0.0 && solved.y >= 0.0 && solved.x + solved.y <= 1.0;
    (inside && solved.z > 0.0).then_some(solved.z)
}

/// Rays that pass an edge closer than rounding tells apart may differ.
#[test]
fn rays_hit_what_testing_every_triangle_finds() {
    let geometry = strewn(2000);
    let bvh = SceneBvh::new(&geometry);
    let corners: Vec<[Vec3; 3]> = geometry.meshes[0]
        .vertices
        .chunks(3)
        .map(|t| [0, 1, 2].map(|k| Vec3::from(t[k].position_m)))
        .collect();
    let mut rng = seed::generator(2, "test", 0);
    let mut vector = || Vec3::from([(); 3].map(|()| seed::unit_f32(&mut rng) - 0.5));
    let mut different = 0;
    for _ in 0..2000 {
        let (origin, direction) = (vector() * 4.0, vector().normalize());
        let nearest = corners
            .iter()
            .filter_map(|&triangle| distance_to(triangle, origin, direction))
            .fold(f64::INFINITY, f64::min);
        let found = bvh.nearest(origin, direction, f32::INFINITY);
        let distance = found.map_or(f64::INFINITY, |hit| f64::from(hit.distance));
        different += u32::from((distance - nearest).abs() > 1e-4);
        assert_eq!(
            bvh.is_blocked(origin, direction, f32::INFINITY),
            found.is_some()
        );
        let short = 0.7;
        assert_eq!(
            bvh.is_blocked(origin, direction, short),
            distance <= f64::from(short)
        );
    }
    assert!(different <= 2, "{different}");
}

#[test]
fn nothing_blocks_in_an_empty_scene() {
    let bvh = SceneBvh::new(&Geometry::default());
    assert!(!bvh.is_blocked(Vec3::ZERO, Vec3::Y, f32::INFINITY));
    assert_eq!(bvh.triangles(), 0);
}

#[test]
fn both_sides_block_and_axes_are_no_exception() {
    let box_mesh = cuboid("box", Vec3::NEG_ONE, Vec3::ONE);
    let bvh = SceneBvh::new(&of_one_material(Material::default(), vec![box_mesh]));
    for direction in [Vec3::X, Vec3::NEG_Y, Vec3::Z] {
        let inside = bvh.nearest(Vec3::ZERO, direction, f32::INFINITY).unwrap();
        assert!((inside.distance - 1.0).abs() < 1e-6);
        assert!(bvh.is_blocked(direction * -3.0, direction, f32::INFINITY));
        assert!(!bvh.is_blocked(direction * 3.0, direction, f32::INFINITY));
    }
}

/// A pane whose left half is cut out, by a texture and by a cutoff.
#[test]
fn rays_pass_where_a_material_is_cut_out() {
    let pane = quad("pane", Vec3::ZERO, Vec3::X, Vec3::Y);
    let mut geometry = of_one_material(Material::default(), vec![pane]);
    geometry.textures.push(Texture {
        name: String::from("half"),
        width_px: 2,
        height_px: 1,
        rgba8: vec![255, 255, 255, 0, 255, 255, 255, 200],
        encoding: TextureEncoding::Srgb,
        wrap: [Wrap::Clamp; 2],
    });
    let hits = |geometry: &Geometry| {
        let bvh = SceneBvh::new(geometry);
        [0.25, 0.75].map(|x| bvh.is_blocked(Vec3::new(x, 0.3, 1.0), Vec3::NEG_Z, 2.0))
    };
    geometry.materials[0].albedo_texture = Some(0.into());
    assert_eq!(hits(&geometry), [true, true]);
    geometry.materials[0].alpha_cutoff = Some(0.5);
    assert_eq!(hits(&geometry), [false, true]);
    geometry.materials[0].alpha = 0.6;
    assert_eq!(hits(&geometry), [false, false]);
}
