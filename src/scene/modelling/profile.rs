//! Mouldings: an outline drawn once, then swept along a wall, round an arch or
//! turned on a lathe.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Mat3, Vec2, Vec3};

use super::builder::MeshBuilder;
use super::math::{Frame, on_circle};

/// An outline in the plane, x outwards (from the wall or the axis), y upwards,
/// drawn from the bottom to the top; the outside is to the right of its direction.
/// Corners sharper than about 35° stay sharp.
#[derive(Debug, Clone)]
pub struct Profile {
    points: Vec<ProfilePoint>,
}

#[derive(Debug, Clone, Copy)]
struct ProfilePoint {
    position_m: Vec2,
    normal: Vec2,
    length_m: f32,
    /// Whether a surface joins this point to the next (not at a sharp corner).
    joined: bool,
}

/// Draws a [`Profile`] with a pen.
#[derive(Debug, Clone)]
pub struct Pen {
    points_m: Vec<Vec2>,
}

impl Pen {
    /// Starts at (out, up), metres.
    #[must_use]
    pub fn at(out_m: f32, up_m: f32) -> Self {
        Self {
            points_m: vec![Vec2::new(out_m, up_m)],
        }
    }

    fn here(&self) -> Vec2 {
        self.points_m.last().copied().unwrap_or_default()
    }

    /// A straight line by (out, up).
    #[must_use]
    pub fn by(mut self, out_m: f32, up_m: f32) -> Self {
        let here = self.here();
        self.points_m.push(here + Vec2::new(out_m, up_m));
        self
    }

    /// A straight line to (out, up).
    #[must_use]
    pub fn to(mut self, out_m: f32, up_m: f32) -> Self {
        self.points_m.push(Vec2::new(out_m, up_m));
        self
    }

    /// A half round that swells outwards by half its height (a torus or bead).
    #[must_use]
    pub fn torus(self, height_m: f32) -> Self {
        self.bulge(height_m, height_m * 0.5)
    }

    /// A round that rises `height_m` and swells by `out_m` in its middle (negative:
    /// a hollow, a scotia).
    #[must_use]
    pub fn bulge(mut self, height_m: f32, out_m: f32) -> Self {
        let start = self.here();
        for i in 1..=6 {
            let c = on_circle(-FRAC_PI_2 + TAU * 0.5 * i as f32 / 6.0);
            self.points_m
                .push(start + Vec2::new(out_m * c.x, height_m * 0.5 * (1.0 + c.y)));
        }
        self
    }

    /// A quarter hollow from vertical to horizontal by (out, up): a cavetto.
    #[must_use]
    pub fn cavetto(mut self, out_m: f32, up_m: f32) -> Self {
        let start = self.here();
        for i in 1..=4 {
            let c = on_circle(FRAC_PI_2 * i as f32 / 4.0);
            self.points_m
                .push(start + Vec2::new(out_m * (1.0 - c.x), up_m * c.y));
        }
        self
    }

    /// A quarter round from horizontal to vertical by (out, up): an ovolo.
    #[must_use]
    pub fn ovolo(mut self, out_m: f32, up_m: f32) -> Self {
        let start = self.here();
        for i in 1..=4 {
            let c = on_circle(FRAC_PI_2 * i as f32 / 4.0);
            self.points_m
                .push(start + Vec2::new(out_m * c.y, up_m * (1.0 - c.x)));
        }
        self
    }

    /// The finished outline.
    #[must_use]
    pub fn profile(self) -> Profile {
        Profile::polyline(&self.points_m)
    }
}

impl Profile {
    /// Through these points (metres); two at the same place count as one.
    #[must_use]
    pub fn polyline(points_m: &[Vec2]) -> Self {
        const SHARP_COSINE: f32 = 0.82;
        let mut path: Vec<Vec2> = Vec::with_capacity(points_m.len());
        for &p in points_m {
            if path.last().is_none_or(|&last| last.distance(p) > 1e-5) {
                path.push(p);
            }
        }
        let outward = |i: usize| {
            let along = (path[i + 1] - path[i]).normalize_or(Vec2::Y);
            Vec2::new(along.y, -along.x)
        };
        let last = path.len().saturating_sub(1);
        let mut points = Vec::new();
        let mut length_m = 0.0;
        for i in 0..path.len() {
            let before = (i > 0).then(|| outward(i - 1));
            let after = (i < last).then(|| outward(i));
            if i > 0 {
                length_m += path[i].distance(path[i - 1]);
            }
            let mut push = |normal: Vec2, joined| {
                points.push(ProfilePoint {
                    position_m: path[i],
                    normal,
                    length_m,
                    joined,
                });
            };
            match (before, after) {
                (Some(a), Some(b)) if a.dot(b) < SHARP_COSINE => {
                    push(a, false);
                    push(b, true);
                }
                (Some(a), Some(b)) => push((a + b).normalize_or(a), true),
                (Some(a), None) => push(a, false),
                (None, Some(b)) => push(b, true),
                (None, None) => {}
            }
        }
        Self { points }
    }

    /// Sweeps through `frames`, whose x axis is outwards and y axis upwards; the path
    /// runs along −z of a frame, rightwards for an onlooker outside. The number with
    /// each frame is its place on the path, metres, for the texture.
    fn sweep(&self, builder: &mut MeshBuilder, frames: &[(Frame, f32)]) {
        for pair in self.points.windows(2).filter(|pair| pair[0].joined) {
            let mut previous: Option<[u32; 2]> = None;
            for (frame, along_m) in frames {
                let here = [&pair[0], &pair[1]].map(|p| {
                    builder.corner(
                        frame.point(p.position_m.extend(0.0)),
                        frame.direction(p.normal.extend(0.0)),
                        Vec2::new(*along_m, -p.length_m),
                    )
                });
                if let Some(before) = previous {
                    builder.triangle([before[0], here[0], here[1]]);
                    builder.triangle([before[0], here[1], before[1]]);
                }
                previous = Some(here);
            }
        }
    }

    /// Turned round the vertical axis of `frame` in `segments` steps; the outline's x
    /// is the radius.
    pub fn lathe(&self, builder: &mut MeshBuilder, frame: &Frame, segments: u32) {
        let radius_m = self
            .points
            .iter()
            .map(|p| p.position_m.x)
            .fold(0.0, f32::max);
        let frames: Vec<(Frame, f32)> = (0..=segments)
            .map(|i| {
                let angle = TAU * i as f32 / segments as f32;
                (
                    frame.then(&Frame::turned(Vec3::ZERO, angle)),
                    angle * radius_m,
                )
            })
            .collect();
        self.sweep(builder, &frames);
    }

    /// Round a half circle in the xy plane of `frame`, centred on its origin: the
    /// outline's x becomes "towards the onlooker" (+z of the frame), its y "away from
    /// the centre", beginning `radius_m` from it.
    pub fn arch(&self, builder: &mut MeshBuilder, frame: &Frame, radius_m: f32, segments: u32) {
        let frames: Vec<(Frame, f32)> = (0..=segments)
            .map(|i| {
                let angle = PI * (1.0 - i as f32 / segments as f32);
                let radial = on_circle(angle).extend(0.0);
                let inner = Frame {
                    origin_m: radial * radius_m,
                    axes: Mat3::from_cols(Vec3::Z, radial, Vec3::Z.cross(radial)),
                };
                (frame.then(&inner), -angle * radius_m)
            })
            .collect();
        self.sweep(builder, &frames);
    }

    /// Along the corners of a horizontal path (metres), mitred; the outside is to the
    /// right of the path seen from above.
    pub fn run(&self, builder: &mut MeshBuilder, path_m: &[Vec3], closed: bool) {
        let n = path_m.len();
        let spans = if closed { n } else { n - 1 };
        let direction = |i: usize| (path_m[(i + 1) % n] - path_m[i % n]).normalize_or(Vec3::X);
        let out_of = |d: Vec3| Vec3::new(-d.z, 0.0, d.x);
        // x axis stretched at a mitre so that the outline keeps its depth on both sides.
        let mitre = |i: usize, own: Vec3| {
            let neighbours = (closed || i > 0).then(|| direction((i + n - 1) % n));
            let next = (closed || i + 1 < n).then(|| direction(i % n));
            match (neighbours, next) {
                (Some(a), Some(b)) => {
                    let sum = out_of(a) + out_of(b);
                    sum * (2.0 / sum.length_squared().max(1e-6))
                }
                _ => out_of(own),
            }
        };
        let mut along_m = 0.0;
        for i in 0..spans {
            let d = direction(i);
            let ends = [(i, path_m[i]), ((i + 1) % n, path_m[(i + 1) % n])];
            let length_m = ends[0].1.distance(ends[1].1);
            self.span(
                builder,
                ends.map(|(k, p)| (p, mitre(k, d))),
                out_of(d),
                [along_m, along_m + length_m],
            );
            along_m += length_m;
        }
    }

    fn span(
        &self,
        builder: &mut MeshBuilder,
        ends: [(Vec3, Vec3); 2],
        out: Vec3,
        along_m: [f32; 2],
    ) {
        for pair in self.points.windows(2).filter(|pair| pair[0].joined) {
            let mut corner = |end: usize, p: &ProfilePoint| {
                let (origin, mitre) = ends[end];
                builder.corner(
                    origin + mitre * p.position_m.x + Vec3::Y * p.position_m.y,
                    out * p.normal.x + Vec3::Y * p.normal.y,
                    Vec2::new(along_m[end], -p.length_m),
                )
            };
            let (a, b) = (corner(0, &pair[0]), corner(1, &pair[0]));
            let (c, d) = (corner(1, &pair[1]), corner(0, &pair[1]));
            builder.triangle([a, b, c]);
            builder.triangle([a, c, d]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moulding() -> Profile {
        Pen::at(0.0, 0.0)
            .by(0.1, 0.0)
            .torus(0.1)
            .by(0.0, 0.2)
            .cavetto(0.05, 0.05)
            .by(-0.15, 0.0)
            .profile()
    }

    /// Seen from outside, every triangle is counter-clockwise and agrees with its normals.
    fn faces_outwards(builder: MeshBuilder) {
        let mesh = builder.finish("swept", 0, 1.0);
        assert!(mesh.indices.len() > 300);
        for c in mesh.indices.chunks_exact(3) {
            let v = [0, 1, 2].map(|k| mesh.vertices[c[k] as usize]);
            let p = v.map(|v| Vec3::from(v.position_m));
            let face = (p[1] - p[0]).cross(p[2] - p[0]);
            // (At the axis of a lathe triangles shrink to nothing.)
            if face.length() > 1e-7 {
                for v in v {
                    assert!(face.normalize().dot(v.normal.into()) > 0.3, "{p:?}");
                }
            }
        }
    }

    #[test]
    fn swept_surfaces_face_outwards() {
        let mut lathe = MeshBuilder::new();
        moulding().lathe(&mut lathe, &Frame::at(Vec3::X), 24);
        faces_outwards(lathe);
        let mut arch = MeshBuilder::new();
        moulding().arch(&mut arch, &Frame::WORLD, 1.0, 24);
        faces_outwards(arch);
        let mut run = MeshBuilder::new();
        let square =
            [[0.0, 0.0], [0.0, 5.0], [5.0, 5.0], [5.0, 0.0]].map(|[x, z]| Vec3::new(x, 0.0, z));
        for _ in 0..5 {
            moulding().run(&mut run, &square, true);
        }
        faces_outwards(run);
    }

    /// A turned disc of radius 1 has the area of a 64-gon.
    #[test]
    fn a_lathe_turns_the_radius() {
        let mut builder = MeshBuilder::new();
        Pen::at(1.0, 0.0)
            .to(1.0, 2.0)
            .profile()
            .lathe(&mut builder, &Frame::WORLD, 64);
        let mesh = builder.finish("drum", 0, 1.0);
        for vertex in &mesh.vertices {
            let [x, _, z] = vertex.position_m;
            assert!(((x * x + z * z).sqrt() - 1.0).abs() < 1e-5);
        }
    }
}
