//! The surface of a [`Sculpture`] as triangles: marching cubes (Lorensen & Cline
//! 1987) with the outline in each cell traced instead of looked up. On a face with
//! four crossings both cells join the same pairs, so the mesh is always closed.

use std::collections::HashMap;

use glam::{IVec3, Vec3};
use rayon::prelude::*;

use super::sculpture::Sculpture;
use super::surface::Surface;

/// Samples along one side of a block.
const SIDE: i32 = 8;

enum Block {
    /// No surface inside: all samples have this sign.
    Uniform(f32),
    Sampled {
        near: Vec<u16>,
        distances_m: Vec<f32>,
    },
}

struct Grid<'a> {
    sculpture: &'a Sculpture,
    low_m: Vec3,
    cell_m: f32,
    blocks_across: IVec3,
    blocks: Vec<Block>,
}

/// Triangles of the surface at a resolution of `cell_m` metres.
#[must_use]
pub fn polygonise(sculpture: &Sculpture, cell_m: f32) -> Surface {
    let grid = Grid::sample(sculpture, cell_m);
    let mut outline = Outline::default();
    for index in 0..grid.blocks.len() {
        if !matches!(grid.blocks[index], Block::Uniform(_)) {
            let base = grid.block_base(index);
            for k in 0..SIDE * SIDE * SIDE {
                let cell = base + IVec3::new(k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE));
                outline.cell(&grid, cell);
            }
        }
    }
    outline.finish(&grid)
}

impl<'a> Grid<'a> {
    fn sample(sculpture: &'a Sculpture, cell_m: f32) -> Self {
        let (low, high) = sculpture.bounds_m();
        let margin = Vec3::splat(2.0 * cell_m);
        let low_m = low - margin;
        let across = ((high + margin - low_m) / (cell_m * SIDE as f32)).ceil();
        let mut grid = Self {
            sculpture,
            low_m,
            cell_m,
            blocks_across: across.as_ivec3() + IVec3::ONE,
            blocks: Vec::new(),
        };
        let count = grid.blocks_across.x * grid.blocks_across.y * grid.blocks_across.z;
        grid.blocks = (0..count.cast_unsigned() as usize)
            .into_par_iter()
            .map(|index| grid.sample_block(index))
            .collect();
        grid
    }

    fn block_base(&self, index: usize) -> IVec3 {
        let (i, n) = (index as i32, self.blocks_across);
        IVec3::new(i % n.x, i / n.x % n.y, i / (n.x * n.y)) * SIDE
    }

    fn point_m(&self, lattice: Vec3) -> Vec3 {
        self.low_m + lattice * self.cell_m
    }

    fn sample_block(&self, index: usize) -> Block {
        let base = self.block_base(index);
        // One cell more than the block, for the cells that reach over its far side.
        let centre_m = self.point_m(base.as_vec3() + Vec3::splat(0.5 * SIDE as f32));
        let radius_m = 0.87 * (SIDE + 2) as f32 * self.cell_m;
        let near = self.sculpture.near(centre_m, radius_m);
        if near.is_empty() {
            return Block::Uniform(1.0);
        }
        // Ellipsoids and reliefs are not exact distances: be generous.
        let centre_distance_m = self.sculpture.distance_among_m(centre_m, &near);
        if centre_distance_m.abs() > 2.0 * radius_m {
            return Block::Uniform(centre_distance_m.signum());
        }
        let distances_m: Vec<f32> = (0..SIDE * SIDE * SIDE)
            .map(|k| {
                let offset = IVec3::new(k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE));
                let p = self.point_m((base + offset).as_vec3());
                self.sculpture.distance_among_m(p, &near)
            })
            .collect();
        Block::Sampled { near, distances_m }
    }

    fn block_of(&self, lattice: IVec3) -> Option<(&Block, usize)> {
        let block = lattice.div_euclid(IVec3::splat(SIDE));
        let n = self.blocks_across;
        if block.cmplt(IVec3::ZERO).any() || block.cmpge(n).any() {
            return None;
        }
        let inner = lattice.rem_euclid(IVec3::splat(SIDE));
        let index = (block.z * n.y + block.y) * n.x + block.x;
        let within = (inner.z * SIDE + inner.y) * SIDE + inner.x;
        Some((
            &self.blocks[index.cast_unsigned() as usize],
            within.cast_unsigned() as usize,
        ))
    }

    /// Distance at a lattice point, metres; where no surface is near, only its sign.
    fn at(&self, lattice: IVec3) -> f32 {
        match self.block_of(lattice) {
            None => f32::MAX,
            Some((Block::Uniform(sign), _)) => sign * f32::MAX,
            Some((Block::Sampled { distances_m, .. }, within)) => distances_m[within],
        }
    }

    /// Whether each corner of a cell is inside.
    fn inside(&self, cell: IVec3) -> [bool; 8] {
        let inner = cell.rem_euclid(IVec3::splat(SIDE));
        if inner.max_element() + 1 < SIDE
            && let Some((Block::Sampled { distances_m, .. }, within)) = self.block_of(cell)
        {
            // All eight in one block: most cells.
            let side = SIDE.cast_unsigned() as usize;
            return std::array::from_fn(|i| {
                let step = (i & 1) + side * ((i >> 1 & 1) + side * (i >> 2 & 1));
                distances_m[within + step] < 0.0
            });
        }
        std::array::from_fn(|i| self.at(cell + corner(i)) < 0.0)
    }

    /// The parts to look at near a lattice point; `None` for all of them.
    fn near(&self, lattice: IVec3) -> Option<&[u16]> {
        match self.block_of(lattice) {
            Some((Block::Sampled { near, .. }, _)) => Some(near),
            _ => None,
        }
    }
}

/// Corner `i` of a cell, as an offset.
fn corner(i: usize) -> IVec3 {
    IVec3::new((i & 1) as i32, (i >> 1 & 1) as i32, (i >> 2 & 1) as i32)
}

/// Corners of each face in order, counter-clockwise from outside the cell.
const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// A lattice edge: its lower end and its axis.
type Edge = (IVec3, u8);

fn edge(cell: IVec3, a: usize, b: usize) -> Edge {
    let axis = match a ^ b {
        1 => 0,
        2 => 1,
        _ => 2,
    };
    (cell + corner(a & b), axis)
}

#[derive(Default)]
struct Outline {
    numbers: HashMap<Edge, u32>,
    /// In the order of their numbers.
    edges: Vec<Edge>,
    /// Loops of five and more crossings, to be filled from their middle.
    rings: Vec<Vec<u32>>,
    indices: Vec<u32>,
}

impl Outline {
    fn number(&mut self, edge: Edge) -> u32 {
        let next = u32::try_from(self.edges.len()).unwrap_or(u32::MAX);
        *self.numbers.entry(edge).or_insert_with(|| {
            self.edges.push(edge);
            next
        })
    }

    fn cell(&mut self, grid: &Grid, cell: IVec3) {
        let inside = grid.inside(cell);
        if inside == [false; 8] || inside == [true; 8] {
            return;
        }
        // Each face gives directed segments between crossings, from where the walk round
        // it leaves the solid back to where it entered.
        let mut next: Vec<(Edge, Edge)> = Vec::with_capacity(12);
        for face in FACES {
            for k in 0..4 {
                let (a, b) = (face[k], face[(k + 1) % 4]);
                if inside[a] || !inside[b] {
                    continue;
                }
                // Walk on from the entry to the first exit: this pairs the crossings
                // round each solid corner, the same way from both sides of the face.
                let exit = (1..4)
                    .find(|step| inside[face[(k + step) % 4]] && !inside[face[(k + step + 1) % 4]]);
                if let Some(step) = exit {
                    let (c, d) = (face[(k + step) % 4], face[(k + step + 1) % 4]);
                    next.push((edge(cell, c, d), edge(cell, a, b)));
                }
            }
        }
        while let Some((start, mut here)) = next.pop() {
            let mut ring = vec![self.number(start)];
            while here != start {
                ring.push(self.number(here));
                let Some(k) = next.iter().position(|&(from, _)| from == here) else {
                    break;
                };
                here = next.swap_remove(k).1;
            }
            // The segments run clockwise from outside.
            ring.reverse();
            self.fill(ring);
        }
    }

    fn fill(&mut self, ring: Vec<u32>) {
        match ring[..] {
            [a, b, c] => self.indices.extend([a, b, c]),
            [a, b, c, d] => self.indices.extend([a, b, c, a, c, d]),
            // A fan could lay two edges on top of each other on a cell's face; a middle
            // point cannot.
            _ => self.rings.push(ring),
        }
    }

    fn finish(mut self, grid: &Grid) -> Surface {
        let mut positions_m: Vec<Vec3> = self
            .edges
            .par_iter()
            .map(|&edge| crossing_m(grid, edge))
            .collect();
        let mut lattice: Vec<IVec3> = self.edges.iter().map(|edge| edge.0).collect();
        for ring in &self.rings {
            let middle = u32::try_from(positions_m.len()).unwrap_or(u32::MAX);
            let sum: Vec3 = ring.iter().map(|&i| positions_m[i as usize]).sum();
            positions_m.push(sum / ring.len() as f32);
            lattice.push(lattice[ring[0] as usize]);
            for k in 0..ring.len() {
                self.indices
                    .extend([middle, ring[k], ring[(k + 1) % ring.len()]]);
            }
        }
        let (normals, curvatures_per_m) = positions_m
            .par_iter()
            .zip(&lattice)
            .map(|(&p, &lattice)| shape_at(grid, lattice, p))
            .unzip();
        Surface {
            positions_m,
            normals,
            curvatures_per_m,
            indices: self.indices,
        }
    }
}

/// Where the surface crosses a lattice edge: linear, then once more with the true
/// distance there (regula falsi). Kept off the ends, so that no triangle vanishes.
fn crossing_m(grid: &Grid, (base, axis): Edge) -> Vec3 {
    let step = IVec3::AXES[axis as usize];
    let (a, b) = (grid.at(base), grid.at(base + step));
    let point = |t: f32| grid.point_m(base.as_vec3() + step.as_vec3() * t);
    let mut t = 0.5;
    if a.abs() < 1e30 && b.abs() < 1e30 {
        t = a / (a - b);
        if let Some(near) = grid.near(base) {
            let d = grid.sculpture.distance_among_m(point(t), near);
            t = if (d < 0.0) == (a < 0.0) {
                t + (1.0 - t) * d / (d - b)
            } else {
                t * a / (a - d)
            };
        }
    }
    point(t.clamp(0.06, 0.94))
}

/// Gradient (unit) and Laplacian of the distance, from its values at the corners of a
/// tetrahedron round `p` (Quilez, "Normals for an SDF").
fn shape_at(grid: &Grid, lattice: IVec3, p: Vec3) -> (Vec3, f32) {
    const CORNERS: [Vec3; 4] = [
        Vec3::new(1.0, 1.0, 1.0),
        Vec3::new(1.0, -1.0, -1.0),
        Vec3::new(-1.0, 1.0, -1.0),
        Vec3::new(-1.0, -1.0, 1.0),
    ];
    let h = 0.4 * grid.cell_m;
    let distance = |p: Vec3| match grid.near(lattice) {
        Some(near) => grid.sculpture.distance_among_m(p, near),
        None => grid.sculpture.distance_m(p),
    };
    let (mut gradient, mut sum) = (Vec3::ZERO, -4.0 * distance(p));
    for corner in CORNERS {
        let d = distance(p + corner * h);
        gradient += corner * d;
        sum += d;
    }
    // Taylor: the sum of the four is 4 d + 2 h² Δd.
    (gradient.normalize_or(Vec3::Y), sum / (2.0 * h * h))
}

#[cfg(test)]
mod tests {
    use super::super::sculpture::Part;
    use super::*;

    fn edges_used(surface: &Surface) -> HashMap<(u32, u32), i32> {
        let mut used = HashMap::new();
        for c in surface.indices.chunks_exact(3) {
            for k in 0..3 {
                let (a, b) = (c[k], c[(k + 1) % 3]);
                *used.entry((a.min(b), a.max(b))).or_insert(0) += if a < b { 1 } else { 100 };
            }
        }
        used
    }

    #[test]
    fn a_ball_is_a_ball() {
        let mut sculpture = Sculpture::new();
        let centre = Vec3::new(0.1, 0.2, 0.3);
        sculpture.add(Part::ball(centre, 0.5));
        let surface = polygonise(&sculpture, 0.03);
        for ((p, n), curvature) in surface
            .positions_m
            .iter()
            .zip(&surface.normals)
            .zip(&surface.curvatures_per_m)
        {
            assert!(((*p - centre).length() - 0.5).abs() < 0.003);
            assert!(n.dot((*p - centre).normalize()) > 0.999);
            assert!((curvature - 4.0).abs() < 0.3, "2 / r is 4, not {curvature}");
        }
        let volume: f32 = surface
            .indices
            .chunks_exact(3)
            .map(|c| {
                let [a, b, c] = [0, 1, 2].map(|k| surface.positions_m[c[k] as usize]);
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!(
            (volume - std::f32::consts::FRAC_PI_6).abs() < 0.005,
            "{volume}"
        );
    }

    /// Many little balls that just touch make every awkward cell there is; still each
    /// edge must be walked once in each direction.
    #[test]
    fn the_surface_is_always_closed() {
        let mut sculpture = Sculpture::new();
        let noise = super::super::Noise::new(7, "test", 0);
        for i in 0..60 {
            let pick = |k| noise.at(IVec3::new(i, k, 5));
            sculpture.add(Part::ball(
                Vec3::new(pick(0), pick(1), pick(2)),
                0.05 + 0.05 * pick(3),
            ));
        }
        let surface = polygonise(&sculpture, 0.02);
        assert!(surface.indices.len() > 3000);
        for (edge, uses) in edges_used(&surface) {
            assert_eq!(uses, 101, "{edge:?}");
        }
    }
}
