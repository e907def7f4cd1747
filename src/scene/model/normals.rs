//! Normals for surfaces whose file has none.

use std::collections::HashMap;
use std::f32::consts::PI;

use glam::Vec3;

use super::error::Fault;
use super::limits::Budget;
use super::split::split;
use crate::scene::Vertex;

/// More faces than this round one point are smoothed together whatever their angles:
/// comparing each with each would take for ever on a fan of a million triangles.
const MOST_COMPARED: usize = 256;

/// Normals of the faces, smoothed over edges whose faces turn by at most `crease_rad`
/// (0: flat; π: smooth everywhere). A corner's normal is the mean of the faces round
/// its point, weighted by their angles there (Thürmer & Wüthrich 1998), whether or not
/// the file shares the vertex.
pub(super) fn compute(
    place: &str,
    vertices: &mut Vec<Vertex>,
    indices: &mut [u32],
    crease_rad: f32,
    budget: &mut Budget,
) -> Result<(), Fault> {
    let faces: Vec<Vec3> = indices
        .chunks_exact(3)
        .map(|t| {
            let [a, b, c] = [0, 1, 2].map(|k| position(vertices, t[k]));
            // In double precision: tiny triangles far from the origin still have a side.
            let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
            (b - a).cross(c - a).normalize_or_zero().as_vec3()
        })
        .collect();
    if crease_rad <= 0.0 {
        budget.vertices(place, indices.len() as u64)?;
        unshare(vertices, indices, &faces);
        return Ok(());
    }
    // Those that no triangle uses keep it.
    for vertex in vertices.iter_mut() {
        vertex.normal = Vec3::Y.to_array();
    }
    let around = Around::new(vertices, indices);
    let angles: Vec<f32> = (0..indices.len())
        .map(|corner| angle(vertices, indices, corner))
        .collect();
    let smooth_everywhere = crease_rad >= PI;
    // Not by an acos: cosines keep their order.
    let least_cosine = libm::cosf(crease_rad);
    let smooth = |corner: usize| {
        let own = faces[corner / 3];
        let round = around.corners_at(corner);
        let compare = !smooth_everywhere && round.len() <= MOST_COMPARED;
        let sum: Vec3 = round
            .iter()
            .map(|&other| other as usize)
            .filter(|&other| !compare || faces[other / 3].dot(own) >= least_cosine - 1e-6)
            .map(|other| faces[other / 3] * angles[other])
            .sum();
        upright(sum.normalize_or(own))
    };
    let normals: Vec<[f32; 3]> = (0..indices.len()).map(smooth).collect();
    split(place, vertices, indices, budget, |c| normals[c], set)
}

/// Gives every triangle three vertices of its own, with its normal.
fn unshare(vertices: &mut Vec<Vertex>, indices: &mut [u32], faces: &[Vec3]) {
    let mut own = Vec::with_capacity(indices.len());
    for (corner, index) in indices.iter_mut().enumerate() {
        own.push(Vertex {
            normal: upright(faces[corner / 3]),
            ..vertices[*index as usize]
        });
        *index = corner as u32;
    }
    *vertices = own;
}

fn set(vertex: &mut Vertex, normal: [f32; 3]) {
    vertex.normal = normal;
}

/// A face without an area has no side; any unit vector is as good.
fn upright(normal: Vec3) -> [f32; 3] {
    normal.normalize_or(Vec3::Y).to_array()
}

fn position(vertices: &[Vertex], index: u32) -> Vec3 {
    Vec3::from(vertices[index as usize].position_m)
}

/// The triangle's angle at a corner, radians.
fn angle(vertices: &[Vertex], indices: &[u32], corner: usize) -> f32 {
    let first = corner / 3 * 3;
    let at = |k: usize| position(vertices, indices[first + (corner - first + k) % 3]);
    let to_next = (at(1) - at(0)).normalize_or_zero();
    let to_last = (at(2) - at(0)).normalize_or_zero();
    libm::acosf(to_next.dot(to_last).clamp(-1.0, 1.0))
}

/// The corners at each point of space, whatever vertices the file has there.
struct Around {
    /// The point of each corner.
    point: Vec<u32>,
    /// Where a point's corners begin in `corners`; one more than there are points.
    start: Vec<u32>,
    corners: Vec<u32>,
}

impl Around {
    fn new(vertices: &[Vertex], indices: &[u32]) -> Self {
        let mut points: HashMap<[u32; 3], u32> = HashMap::new();
        let point: Vec<u32> = indices
            .iter()
            .map(|&index| {
                // + 0.0 makes one zero of the two.
                let key = vertices[index as usize]
                    .position_m
                    .map(|x| (x + 0.0).to_bits());
                let next = points.len() as u32;
                *points.entry(key).or_insert(next)
            })
            .collect();
        let mut start = vec![0_u32; points.len() + 1];
        for &p in &point {
            start[p as usize + 1] += 1;
        }
        for p in 0..points.len() {
            start[p + 1] += start[p];
        }
        let mut next = start.clone();
        let mut corners = vec![0_u32; point.len()];
        for (corner, &p) in point.iter().enumerate() {
            corners[next[p as usize] as usize] = corner as u32;
            next[p as usize] += 1;
        }
        Self {
            point,
            start,
            corners,
        }
    }

    fn corners_at(&self, corner: usize) -> &[u32] {
        let p = self.point[corner] as usize;
        &self.corners[self.start[p] as usize..self.start[p + 1] as usize]
    }
}
