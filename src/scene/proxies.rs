//! Spheres in place of triangles: what of a scene's geometry matters from far away.
//!
//! Points spread evenly over the surfaces are gathered into clusters by k-means (Lloyd 1982), by place and by
//! the way they face, and each cluster becomes a sphere about its mean with the cluster's surface
//! area. By Cauchy's formula a convex body's mean shadow is a quarter of its surface, a sphere's like
//! any other's: so the spheres hide, over all directions, as much as what they stand for. On a flat
//! surface they are centred in it, and on a convex one behind it, so that a surface is not hidden by
//! its own spheres; what faces another way has others, so that none stands before a corner.

use glam::{DVec3, Vec3};
use rand_chacha::ChaCha20Rng;

use super::{Geometry, Mesh};
use crate::seed;

/// Points that stand for a scene's surfaces; enough for 512 clusters of 32.
const POINTS: usize = 16_384;

/// Rounds of k-means. Later ones move the centres of a usual scene by less than a tenth of a radius.
const ROUNDS: usize = 8;

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// World space, metres.
    pub centre_m: Vec3,
    /// Metres.
    pub radius_m: f32,
}

/// A point of a surface.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SurfacePoint {
    /// World space, metres.
    pub position_m: Vec3,
    /// Unit vector out of the triangle.
    pub normal: Vec3,
}

/// Points spread evenly over the triangles of a scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfacePoints {
    /// The points.
    pub points: Vec<SurfacePoint>,
    /// The surface that each point stands for, square metres.
    pub area_each_m2: f64,
}

impl SurfacePoints {
    /// The points of a geometry; none where it has no surface. Every index must be of a vertex.
    #[must_use]
    pub fn of(geometry: &Geometry) -> Self {
        let total_m2: f64 = triangles(geometry).map(|triangle| area_m2(&triangle)).sum();
        if total_m2 <= 0.0 {
            return Self::default();
        }
        let area_each_m2 = total_m2 / POINTS as f64;
        let mut points = Vec::with_capacity(POINTS);
        let mut walked_m2 = 0.0;
        // A point wherever the area walked over passes a half, one and a half, … of a share.
        for triangle in triangles(geometry) {
            walked_m2 += area_m2(&triangle);
            while points.len() < POINTS && (points.len() as f64 + 0.5) * area_each_m2 <= walked_m2 {
                points.push(spread(&triangle, points.len()));
            }
        }
        Self {
            points,
            area_each_m2,
        }
    }

    /// At most `count` spheres in place of the surfaces; fewer where there are fewer points.
    #[must_use]
    pub fn spheres(&self, count: usize, seed: u64) -> Vec<Sphere> {
        let count = count.min(self.points.len());
        if count == 0 {
            return Vec::new();
        }
        let mut rng = seed::generator(seed, "proxy-spheres", 0);
        let mut centres = first_centres(&self.points, count, &mut rng);
        let mut nearest = vec![0; self.points.len()];
        // A right angle between two faces counts like the width of a cluster between two places.
        let share_m2 = self.area_each_m2 * self.points.len() as f64 / count as f64;
        let turn_m2 = 0.5 * share_m2 as f32;
        for _ in 0..ROUNDS {
            assign(&self.points, &centres, turn_m2, &mut nearest);
            for (centre, cluster) in centres.iter_mut().zip(self.clusters(&nearest, count)) {
                // What no point is nearest to stays where it is.
                *centre = cluster.mean().unwrap_or(*centre);
            }
        }
        assign(&self.points, &centres, turn_m2, &mut nearest);
        let mut clusters = self.clusters(&nearest, count);
        for (point, &cluster) in self.points.iter().zip(&nearest) {
            clusters[cluster].measure(point);
        }
        clusters
            .iter()
            .filter_map(|cluster| cluster.sphere(self.area_each_m2))
            .collect()
    }

    fn clusters(&self, nearest: &[usize], count: usize) -> Vec<Cluster> {
        let mut clusters = vec![Cluster::default(); count];
        for (point, &cluster) in self.points.iter().zip(nearest) {
            clusters[cluster].positions_m += point.position_m.as_dvec3();
            clusters[cluster].normals += point.normal.as_dvec3();
            clusters[cluster].points += 1;
        }
        clusters
    }
}

/// The points nearest to one centre.
#[derive(Debug, Clone, Default)]
struct Cluster {
    /// Sums over the points.
    positions_m: DVec3,
    normals: DVec3,
    points: usize,
    /// The farthest of them from their mean, metres.
    reach_m: f32,
    /// How far the mean stands before the most hidden of them, along its normal, metres.
    before_m: f32,
}

impl Cluster {
    fn mean(&self) -> Option<SurfacePoint> {
        (self.points > 0).then(|| SurfacePoint {
            position_m: (self.positions_m / self.points as f64).as_vec3(),
            normal: (self.normals / self.points as f64).as_vec3(),
        })
    }

    /// Measures the cluster by one of its points; the sums are complete.
    fn measure(&mut self, point: &SurfacePoint) {
        let Some(mean) = self.mean() else {
            return;
        };
        let offset_m = mean.position_m - point.position_m;
        self.reach_m = self.reach_m.max(offset_m.length());
        self.before_m = self.before_m.max(offset_m.dot(point.normal));
    }

    fn sphere(&self, area_each_m2: f64) -> Option<Sphere> {
        let mean = self.mean()?;
        let area_m2 = self.points as f64 * area_each_m2;
        let radius_m = (area_m2 / (4.0 * std::f64::consts::PI)).sqrt() as f32;
        // A crumpled surface is larger than the space it fills.
        let radius_m = radius_m.min(self.reach_m);
        Some(Sphere {
            // Behind all that faces with the mean: a moulding on a wall must not lift the wall's
            // sphere before the wall. What faces all round has no mean to speak of.
            centre_m: mean.position_m - mean.normal * self.before_m.min(radius_m),
            radius_m,
        })
    }
}

fn triangles(geometry: &Geometry) -> impl Iterator<Item = [Vec3; 3]> + '_ {
    let corner = |mesh: &Mesh, index: u32| Vec3::from(mesh.vertices[index as usize].position_m);
    geometry.meshes.iter().flat_map(move |mesh| {
        mesh.indices
            .chunks_exact(3)
            .map(move |c| [corner(mesh, c[0]), corner(mesh, c[1]), corner(mesh, c[2])])
    })
}

/// The area of a triangle; nothing for one whose corners are no numbers.
fn area_m2([a, b, c]: &[Vec3; 3]) -> f64 {
    let area = 0.5 * f64::from((b - a).cross(c - a).length());
    if area.is_finite() { area } else { 0.0 }
}

/// Point number `index` of the R2 sequence (Roberts 2018), folded into a triangle.
fn spread([a, b, c]: &[Vec3; 3], index: usize) -> SurfacePoint {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let number = index as f64 + 1.0;
    let u = (number / PLASTIC).fract() as f32;
    let v = (number / (PLASTIC * PLASTIC)).fract() as f32;
    let (u, v) = if u + v > 1.0 {
        (1.0 - u, 1.0 - v)
    } else {
        (u, v)
    };
    let (along, across) = (b - a, c - a);
    SurfacePoint {
        position_m: a + along * u + across * v,
        normal: along.cross(across).normalize_or_zero(),
    }
}

/// One point out of each of `count` equal runs of the points: those of one mesh follow each other, so
/// that no part of the scene is left without.
fn first_centres(
    points: &[SurfacePoint],
    count: usize,
    rng: &mut ChaCha20Rng,
) -> Vec<SurfacePoint> {
    (0..count)
        .map(|run| {
            let place = (run as f64 + seed::unit_f64(rng)) / count as f64;
            points[(place * points.len() as f64) as usize]
        })
        .collect()
}

/// The nearest centre of each point; normals that differ by the diagonal of a square count `2 turn_m2`.
fn assign(points: &[SurfacePoint], centres: &[SurfacePoint], turn_m2: f32, nearest: &mut [usize]) {
    for (point, nearest) in points.iter().zip(nearest) {
        let mut least = f32::INFINITY;
        for (index, centre) in centres.iter().enumerate() {
            let distance = point.position_m.distance_squared(centre.position_m)
                + turn_m2 * point.normal.distance_squared(centre.normal);
            if distance < least {
                (least, *nearest) = (distance, index);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Material;
    use crate::scene::primitives::{cuboid, of_one_material, quad};

    fn floor() -> Geometry {
        let floor = quad("floor", Vec3::ZERO, Vec3::X * 8.0, Vec3::NEG_Z * 4.0);
        of_one_material(Material::default(), vec![floor])
    }

    #[test]
    fn points_are_even_over_the_surface() {
        let found = SurfacePoints::of(&floor());
        assert_eq!(found.points.len(), POINTS);
        assert!((found.area_each_m2 * POINTS as f64 - 32.0).abs() < 1e-4);
        let mut cells = [0; 32];
        for point in found.points.iter().map(|point| point.position_m) {
            let cell = |v: f32, cells: usize| (v as usize).min(cells - 1);
            cells[4 * cell(point.x, 8) + cell(-point.z, 4)] += 1;
        }
        // 512 points a square metre, within a tenth.
        assert!(cells.iter().all(|&n| (460..=564).contains(&n)), "{cells:?}");
    }

    /// Together the spheres have the surface's area, and those of a plane are centred in it.
    #[test]
    fn spheres_have_the_area_of_what_they_stand_for() {
        for count in [1, 64, 512] {
            let spheres = SurfacePoints::of(&floor()).spheres(count, 7);
            assert_eq!(spheres.len(), count);
            let area_m2: f32 = spheres
                .iter()
                .map(|s| 4.0 * std::f32::consts::PI * s.radius_m * s.radius_m)
                .sum();
            assert!((area_m2 - 32.0).abs() < 0.32, "{area_m2} of {count}");
            assert!(spheres.iter().all(|s| s.centre_m.y.abs() < 1e-6));
        }
    }

    /// Cauchy: the mean shadow of a box is a quarter of its surface.
    #[test]
    fn one_sphere_throws_a_boxs_mean_shadow() {
        let body = cuboid("box", Vec3::ZERO, Vec3::new(1.0, 2.0, 1.5));
        let geometry = of_one_material(Material::default(), vec![body]);
        let [sphere] = SurfacePoints::of(&geometry).spheres(1, 0)[..] else {
            panic!("one sphere was asked for");
        };
        let shadow_m2 = std::f32::consts::PI * sphere.radius_m * sphere.radius_m;
        assert!((shadow_m2 - 13.0 / 4.0).abs() < 0.01, "{shadow_m2}");
        let off_m = sphere.centre_m.distance(Vec3::new(0.5, 1.0, 0.75));
        assert!(off_m < 0.01, "{off_m}");
    }

    /// Walls that meet have spheres of their own: none is centred before either.
    #[test]
    fn no_sphere_stands_before_a_corner() {
        let wall = quad("wall", Vec3::ZERO, Vec3::Z * 4.0, Vec3::Y * 4.0);
        let floor = quad("floor", Vec3::ZERO, Vec3::Z * 4.0, Vec3::X * 4.0);
        let geometry = of_one_material(Material::default(), vec![wall, floor]);
        for sphere in SurfacePoints::of(&geometry).spheres(64, 3) {
            let before_m = sphere.centre_m.x.min(sphere.centre_m.y);
            assert!(before_m < 0.02, "{sphere:?}");
        }
    }

    /// A block on a floor lifts their mean by 0.12 m; the sphere stays in the floor, which is most of what
    /// faces up.
    #[test]
    fn a_block_does_not_lift_a_floors_sphere() {
        let mut geometry = floor();
        let low_m = Vec3::new(3.0, 0.0, -2.5);
        let block = cuboid("block", low_m, low_m + Vec3::new(2.0, 1.0, 1.0));
        geometry.meshes.push(block);
        let [sphere] = SurfacePoints::of(&geometry).spheres(1, 3)[..] else {
            panic!("one sphere was asked for");
        };
        assert!((0.0..0.04).contains(&sphere.centre_m.y), "{sphere:?}");
    }

    #[test]
    fn the_seed_decides_and_nothing_else() {
        let points = SurfacePoints::of(&floor());
        assert_eq!(points.spheres(64, 1), points.spheres(64, 1));
        assert_ne!(points.spheres(64, 1), points.spheres(64, 2));
    }

    #[test]
    fn without_a_surface_there_is_no_sphere() {
        let line = quad("line", Vec3::ZERO, Vec3::X, Vec3::X);
        for geometry in [
            Geometry::default(),
            of_one_material(Material::default(), vec![line]),
        ] {
            let points = SurfacePoints::of(&geometry);
            assert_eq!(points, SurfacePoints::default());
            assert_eq!(points.spheres(64, 0), []);
        }
        assert_eq!(SurfacePoints::of(&floor()).spheres(0, 0), []);
    }
}
