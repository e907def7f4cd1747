//! Blocks with bevelled edges. Real masonry has no razor edges, and it is the
//! bevels that catch the light and hold the small occlusion.

use glam::{Vec2, Vec3};

use super::builder::{MeshBuilder, box_uv_m};
use super::math::Frame;

/// Corners of each face, counter-clockwise from outside. Corner number
/// `x + 2 y + 4 z` with x, y, z 0 on the low side and 1 on the high one.
const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// The face on which the edge a → b runs, other than `not`.
fn face_across(a: usize, b: usize, not: usize) -> Option<usize> {
    (0..6).find(|&f| f != not && FACES[f].contains(&a) && FACES[f].contains(&b))
}

/// The eight corners of a box, in the order [`hexahedron`] wants.
#[must_use]
pub fn box_corners_m(frame: &Frame, low_m: Vec3, high_m: Vec3) -> [Vec3; 8] {
    std::array::from_fn(|i| {
        let pick = |axis: usize| {
            if i & (1 << axis) == 0 {
                low_m[axis]
            } else {
                high_m[axis]
            }
        };
        frame.point(Vec3::new(pick(0), pick(1), pick(2)))
    })
}

/// A box from `low_m` to `high_m` in `frame`, its edges bevelled by `bevel_m`.
pub fn block(builder: &mut MeshBuilder, frame: &Frame, low_m: Vec3, high_m: Vec3, bevel_m: f32) {
    hexahedron(builder, &box_corners_m(frame, low_m, high_m), bevel_m);
}

/// Any convex body with six four-sided faces, its edges bevelled. The faces keep
/// their own normals and the bevels blend between them, so that they read as round.
pub fn hexahedron(builder: &mut MeshBuilder, corners_m: &[Vec3; 8], bevel_m: f32) {
    let normal = |f: usize| {
        let [a, b, c, d] = FACES[f].map(|i| corners_m[i]);
        (c - a).cross(d - b).normalize_or(Vec3::Y)
    };
    let inset = |f: usize, corner: usize| {
        let k = FACES[f].iter().position(|&c| c == corner).unwrap_or(0);
        let p = corners_m[corner];
        let towards = |step: usize| {
            let side = corners_m[FACES[f][(k + step) % 4]] - p;
            side.normalize_or_zero() * bevel_m.min(0.45 * side.length())
        };
        p + towards(1) + towards(3)
    };
    for (f, face) in FACES.iter().enumerate() {
        let n = normal(f);
        let [a, b, c, d] = face.map(|i| {
            let p = inset(f, i);
            builder.corner(p, n, box_uv_m(p, n))
        });
        builder.triangle([a, b, c]);
        builder.triangle([a, c, d]);
        for k in 0..4 {
            let (i, j) = (face[k], face[(k + 1) % 4]);
            let Some(g) = face_across(i, j, f).filter(|&g| g > f) else {
                continue;
            };
            // All four in this face's projection, so that the texture runs over the edge.
            let [a, b, c, d] = [(f, j), (f, i), (g, i), (g, j)].map(|(face, corner)| {
                let p = inset(face, corner);
                builder.corner(p, normal(face), box_uv_m(p, n))
            });
            builder.triangle([a, b, c]);
            builder.triangle([a, c, d]);
        }
    }
    let centre = corners_m.iter().sum::<Vec3>() / 8.0;
    for (i, &tip) in corners_m.iter().enumerate() {
        let mut at = (0..6).filter(|&f| FACES[f].contains(&i));
        let (Some(f), Some(g), Some(h)) = (at.next(), at.next(), at.next()) else {
            continue;
        };
        let points = [f, g, h].map(|face| (inset(face, i), normal(face)));
        let facing = (points[1].0 - points[0].0).cross(points[2].0 - points[0].0);
        let [a, b, c] = points.map(|(p, n)| builder.corner(p, n, box_uv_m(p, points[0].1)));
        if facing.dot(tip - centre) > 0.0 {
            builder.triangle([a, b, c]);
        } else {
            builder.triangle([a, c, b]);
        }
    }
}

/// A slab with a convex outline (x, z in metres, turning from +x towards +z), its upper
/// edge bevelled. The top is `top_m` high at the outline's middle and rises by
/// `slant` metres a metre; it has no under side.
pub fn prism(
    builder: &mut MeshBuilder,
    outline_m: &[Vec2],
    top_m: f32,
    slant: Vec2,
    thickness_m: f32,
    bevel_m: f32,
) {
    let n = outline_m.len();
    let middle = outline_m.iter().sum::<Vec2>() / n as f32;
    let up = Vec3::new(-slant.x, 1.0, -slant.y).normalize();
    let at = |p: Vec2, drop_m: f32| Vec3::new(p.x, top_m + slant.dot(p - middle) - drop_m, p.y);
    let inset = |p: Vec2| p + (middle - p).normalize_or_zero() * (1.4 * bevel_m);
    let top: Vec<u32> = outline_m
        .iter()
        .map(|&p| {
            let p = at(inset(p), 0.0);
            builder.corner(p, up, box_uv_m(p, up))
        })
        .collect();
    for k in 1..n - 1 {
        builder.triangle([top[0], top[k + 1], top[k]]);
    }
    for i in 0..n {
        let (p, q) = (outline_m[i], outline_m[(i + 1) % n]);
        let out = Vec3::new(q.y - p.y, 0.0, p.x - q.x).normalize_or(Vec3::X);
        let rim = [(at(inset(p), 0.0), up), (at(inset(q), 0.0), up)];
        let edge = [(at(q, bevel_m), out), (at(p, bevel_m), out)];
        let foot = [(at(q, thickness_m), out), (at(p, thickness_m), out)];
        for strip in [
            [rim[0], rim[1], edge[0], edge[1]],
            [edge[1], edge[0], foot[0], foot[1]],
        ] {
            let [a, b, c, d] = strip.map(|(p, n)| builder.corner(p, n, box_uv_m(p, up)));
            builder.triangle([a, b, c]);
            builder.triangle([a, c, d]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from above, the top of a prism covers its outline but for the bevel, and all
    /// of it faces where its normals say.
    #[test]
    fn a_prism_faces_up_and_outwards() {
        let mut builder = MeshBuilder::new();
        let outline = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(Vec2::from);
        prism(&mut builder, &outline, 0.0, Vec2::ZERO, 0.1, 0.01);
        let mesh = builder.finish("prism", 0, 1.0);
        let mut seen_from_above = 0.0;
        for c in mesh.indices.chunks_exact(3) {
            let v = [0, 1, 2].map(|k| mesh.vertices[c[k] as usize]);
            let p = v.map(|v| Vec3::from(v.position_m));
            let face = (p[1] - p[0]).cross(p[2] - p[0]);
            let mean: Vec3 = v.iter().map(|v| Vec3::from(v.normal)).sum();
            assert!(face.dot(mean) > 0.0, "{face} {mean}");
            seen_from_above += 0.5 * face.y.max(0.0);
        }
        assert!((seen_from_above - 2.0).abs() < 1e-4, "{seen_from_above}");
    }

    /// Divergence theorem: the volume of a closed, outward-facing mesh. A unit cube
    /// loses a prism of ½ b² along each edge and more at the corners.
    #[test]
    fn a_bevelled_block_is_closed_and_faces_outwards() {
        let mut builder = MeshBuilder::new();
        let frame = Frame::turned(Vec3::new(3.0, -1.0, 2.0), 0.7);
        block(&mut builder, &frame, Vec3::ZERO, Vec3::ONE, 0.01);
        assert_eq!(builder.triangles(), 12 + 24 + 8);
        let mesh = builder.finish("block", 0, 1.0);
        let volume: f32 = mesh
            .indices
            .chunks_exact(3)
            .map(|c| {
                let [a, b, c] = [0, 1, 2]
                    .map(|k| frame.local(Vec3::from(mesh.vertices[c[k] as usize].position_m)));
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        let expected = 1.0 - 12.0 * 0.5 * 0.01_f32.powi(2);
        assert!((volume - expected).abs() < 2e-5, "{volume} {expected}");
    }
}
