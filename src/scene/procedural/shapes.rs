//! Five shapes whose occlusion is known or plain to see, side by side on plates of their own: a
//! plane, a step, a corner of three planes, a thin pole before a wall, and a sphere on a floor. White and
//! without textures, so that a picture shows what a technique does and nothing else.
//!
//! Everything is solid, and every shape is more than a metre from the others. Floors lie at y = 0, and
//! what is to be seen faces +Z.

use std::f32::consts::{FRAC_PI_4, PI, TAU};

use glam::{Quat, Vec3};

use super::Generator;
use crate::scene::geometry::{Geometry, Material, Mesh, Vertex};
use crate::scene::primitives::{cuboid, of_one_material};

/// The registry's entry.
pub const GENERATOR: Generator = Generator {
    name: "shapes",
    summary: "a plane, a step, a corner, a thin pole before a wall and a sphere on a floor, exact and white",
    generate,
};

/// Middle of the plane's upper side, metres.
pub const PLANE_M: Vec3 = Vec3::new(-1.45, 0.0, 1.45);
/// Middle of the step's foot, metres: before it lies the floor, behind and above it the tread.
pub const STEP_M: Vec3 = Vec3::new(-3.0, 0.0, -1.7);
/// Where the corner's three planes meet, metres. Its walls go off at 45° to either side.
pub const CORNER_M: Vec3 = Vec3::new(0.0, 0.0, -2.5);
/// Middle of the pole's foot, metres.
pub const POLE_M: Vec3 = Vec3::new(3.0, 0.0, -1.9);
/// Where the sphere touches its floor, metres.
pub const SPHERE_M: Vec3 = Vec3::new(1.45, 0.0, 1.45);

/// Half the width of plates, metres.
pub const HALF_WIDTH_M: f32 = 0.9;
/// How thick plates and walls are, metres.
const THICKNESS_M: f32 = 0.1;
/// Height of the step's riser, metres.
pub const RISER_M: f32 = 0.5;
/// Length of the corner's walls, and of its floor's sides, metres.
pub const CORNER_LENGTH_M: f32 = 1.4;
/// Height of the corner's walls, metres.
pub const CORNER_HEIGHT_M: f32 = 0.9;
/// Width of the pole, which is square, metres.
pub const POLE_WIDTH_M: f32 = 0.05;
/// Height of the pole, metres.
pub const POLE_HEIGHT_M: f32 = 1.0;
/// From the pole's middle to the wall behind it, metres.
pub const POLE_TO_WALL_M: f32 = 0.4;
/// Height of the wall behind the pole, metres.
const POLE_WALL_HEIGHT_M: f32 = 1.1;
/// Radius of the sphere, metres.
pub const SPHERE_RADIUS_M: f32 = 0.45;

/// Rings and sides of the sphere: no side turns by more than 3.75°.
const RINGS: u32 = 48;
const SIDES: u32 = 96;

/// There is nothing to draw by lot: every seed gives the same.
fn generate(_seed: u64) -> Geometry {
    let white = Material {
        name: "white".to_owned(),
        albedo: [1.0; 3],
        roughness: 1.0,
        specular: 0.0,
        ..Material::default()
    };
    let mut meshes = vec![plate("plane", PLANE_M, [-HALF_WIDTH_M, HALF_WIDTH_M])];
    meshes.extend(step());
    meshes.extend(corner());
    meshes.extend(pole());
    meshes.push(plate(
        "sphere's floor",
        SPHERE_M,
        [-HALF_WIDTH_M, HALF_WIDTH_M],
    ));
    meshes.push(sphere());
    of_one_material(white, meshes)
}

/// A plate whose upper side lies at y = 0, from one z to another, both from the middle of its shape.
fn plate(name: &str, middle_m: Vec3, [back_m, front_m]: [f32; 2]) -> Mesh {
    block(name, middle_m, [back_m, front_m], 0.0)
}

/// A block as wide as a plate, from the plates' underside up to a height.
fn block(name: &str, middle_m: Vec3, [back_m, front_m]: [f32; 2], height_m: f32) -> Mesh {
    cuboid(
        name,
        middle_m + Vec3::new(-HALF_WIDTH_M, -THICKNESS_M, back_m),
        middle_m + Vec3::new(HALF_WIDTH_M, height_m, front_m),
    )
}

/// A floor, a riser with a free top edge, and the tread behind it.
fn step() -> [Mesh; 2] {
    [
        plate("step's floor", STEP_M, [0.0, 0.8]),
        block("step", STEP_M, [-0.8, 0.0], RISER_M),
    ]
}

/// A floor and two walls, turned so that their corner lies behind and they open to the front.
fn corner() -> [Mesh; 3] {
    let (long_m, high_m) = (CORNER_LENGTH_M, CORNER_HEIGHT_M);
    let low_m = Vec3::splat(-THICKNESS_M);
    let parts = [
        (
            "corner's floor",
            Vec3::new(0.0, -THICKNESS_M, 0.0),
            Vec3::new(long_m, 0.0, long_m),
        ),
        ("corner's left wall", low_m, Vec3::new(0.0, high_m, long_m)),
        (
            "corner's right wall",
            Vec3::new(0.0, -THICKNESS_M, -THICKNESS_M),
            Vec3::new(long_m, high_m, 0.0),
        ),
    ];
    parts.map(|(name, low_m, high_m)| {
        let mut mesh = cuboid(name, low_m, high_m);
        let turn = Quat::from_rotation_y(-FRAC_PI_4);
        for vertex in &mut mesh.vertices {
            let [x, y, z, handedness] = vertex.tangent;
            vertex.position_m = (turn * Vec3::from(vertex.position_m) + CORNER_M).to_array();
            vertex.normal = (turn * Vec3::from(vertex.normal)).to_array();
            vertex.tangent = (turn * Vec3::new(x, y, z)).extend(handedness).to_array();
        }
        mesh
    })
}

/// A pole that stands free, and a wall some way behind it.
fn pole() -> [Mesh; 3] {
    let wall_m = -POLE_TO_WALL_M;
    let half = Vec3::new(0.5 * POLE_WIDTH_M, 0.0, 0.5 * POLE_WIDTH_M);
    [
        plate("pole's floor", POLE_M, [wall_m, 1.0]),
        block(
            "pole's wall",
            POLE_M,
            [wall_m - THICKNESS_M, wall_m],
            POLE_WALL_HEIGHT_M,
        ),
        cuboid(
            "pole",
            POLE_M - half,
            POLE_M + half + Vec3::Y * POLE_HEIGHT_M,
        ),
    ]
}

/// A sphere by its rings, from the point it rests on to its top.
fn sphere() -> Mesh {
    let mut mesh = Mesh {
        name: "sphere".to_owned(),
        ..Mesh::default()
    };
    for ring in 0..=RINGS {
        let (sine, cosine) = (PI * ring as f32 / RINGS as f32).sin_cos();
        // Both ends are one point, and the last side ends where the first begins: to the bit.
        let sine = if ring % RINGS == 0 { 0.0 } else { sine };
        for side in 0..=SIDES {
            let (z, x) = (TAU * (side % SIDES) as f32 / SIDES as f32).sin_cos();
            let normal = Vec3::new(sine * x, -cosine, sine * z);
            let position_m = SPHERE_M + SPHERE_RADIUS_M * (normal + Vec3::Y);
            mesh.vertices.push(Vertex {
                position_m: position_m.to_array(),
                normal: normal.to_array(),
                tangent: Vec3::new(-z, 0.0, x).extend(1.0).to_array(),
                uv: [side as f32 / SIDES as f32, ring as f32 / RINGS as f32],
                color: [1.0; 4],
            });
        }
    }
    let at = |ring: u32, side: u32| ring * (SIDES + 1) + side;
    for (ring, side) in (0..RINGS).flat_map(|ring| (0..SIDES).map(move |side| (ring, side))) {
        let (low, high) = (at(ring, side), at(ring + 1, side));
        if ring > 0 {
            mesh.indices.extend([low, high, low + 1]);
        }
        if ring + 1 < RINGS {
            mesh.indices.extend([low + 1, high, high + 1]);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part<'a>(geometry: &'a Geometry, name: &str) -> &'a Mesh {
        let mut named = geometry.meshes.iter().filter(|mesh| mesh.name == name);
        named.next().unwrap()
    }

    fn bounds_m(mesh: &Mesh) -> (Vec3, Vec3) {
        let one = of_one_material(Material::default(), vec![mesh.clone()]);
        one.bounds_m().unwrap()
    }

    #[test]
    fn the_pole_is_thin_and_stands_free_on_its_floor() {
        let scene = generate(0);
        let (low, high) = bounds_m(part(&scene, "pole"));
        let size = high - low;
        assert!(
            (size - Vec3::new(0.05, 1.0, 0.05)).abs().max_element() < 1e-6,
            "{size}"
        );
        assert_eq!(low.y, 0.0);
        let (_, floor) = bounds_m(part(&scene, "pole's floor"));
        assert_eq!(floor.y, 0.0);
        let (_, wall) = bounds_m(part(&scene, "pole's wall"));
        assert!((low.z - wall.z - 0.375).abs() < 1e-6, "{}", low.z - wall.z);
        assert!(wall.y > high.y, "the wall is what is seen behind all of it");
    }

    #[test]
    fn the_sphere_touches_its_floor_and_is_round() {
        let scene = generate(0);
        let sphere = part(&scene, "sphere");
        let (low, high) = bounds_m(sphere);
        assert_eq!(low.y, 0.0);
        assert!((high.y - 0.9).abs() < 1e-6, "{high}");
        let (_, floor) = bounds_m(part(&scene, "sphere's floor"));
        assert_eq!(floor.y, 0.0);
        let centre_m = SPHERE_M + Vec3::Y * SPHERE_RADIUS_M;
        for vertex in &sphere.vertices {
            let out = (Vec3::from(vertex.position_m) - centre_m) / SPHERE_RADIUS_M;
            assert!((out.length() - 1.0).abs() < 1e-5, "{vertex:?}");
            assert!(
                (out - Vec3::from(vertex.normal)).length() < 1e-5,
                "{vertex:?}"
            );
        }
    }

    #[test]
    fn the_corner_is_of_three_planes_that_meet_at_right_angles() {
        let scene = generate(0);
        // The planes that lead through the corner's point, by their normals.
        let mut planes: Vec<Vec3> = Vec::new();
        for mesh in scene.meshes.iter().filter(|m| m.name.starts_with("corner")) {
            for quad in mesh.vertices.chunks_exact(4) {
                let normal = Vec3::from(quad[0].normal);
                let height_m = normal.dot(Vec3::from(quad[0].position_m) - CORNER_M);
                let faces_front = normal.y > 0.5 || normal.z > 0.5;
                if height_m.abs() < 1e-6 && faces_front {
                    planes.push(normal);
                }
            }
        }
        assert_eq!(planes.len(), 3, "{planes:?}");
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            assert!(planes[a].dot(planes[b]).abs() < 1e-6, "{planes:?}");
        }
    }

    #[test]
    fn the_step_has_a_foot_and_a_free_top_edge() {
        let scene = generate(0);
        let (_, floor) = bounds_m(part(&scene, "step's floor"));
        let (_, block) = bounds_m(part(&scene, "step"));
        assert_eq!((floor.y, block.y), (0.0, 0.5));
        assert_eq!(block.z, STEP_M.z);
        assert!(floor.z > block.z);
    }

    /// By more than the reach of stimuli/scenes/shapes.toml, so that none does anything to another.
    #[test]
    fn shapes_stand_apart() {
        let scene = generate(0);
        let shapes = ["plane", "step", "corner", "pole", "sphere"].map(|shape| {
            let of_shape = scene.meshes.iter().filter(|m| m.name.starts_with(shape));
            let boxes = of_shape.map(bounds_m);
            boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap()
        });
        for (index, a) in shapes.iter().enumerate() {
            for b in &shapes[index + 1..] {
                let gap = (a.0 - b.1).max(b.0 - a.1);
                assert!(gap.max_element() > 1.0, "{a:?} {b:?}");
            }
        }
    }
}
