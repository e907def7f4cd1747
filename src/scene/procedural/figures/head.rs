//! Heads: skull, brow, nose, lips, ears and neck; proportions of a face after Loomis
//! (eyes at half the head, nose and mouth at thirds below).

use glam::{Vec2, Vec3};

use super::person::{Build, Layer, Stuff};
use super::pose::Pose;
use crate::scene::modelling::math::{bump, on_circle, smoothstep};
use crate::scene::modelling::sculpture::{Part, Sculpture};
use crate::scene::modelling::{Frame, MeshBuilder, Noise};
use crate::scene::texture::srgb;

/// Radius of an eye, metres.
pub(super) const EYE_RADIUS_M: f32 = 0.0125;
/// Middle of the left eye in the head's frame, metres.
const EYE_M: Vec3 = Vec3::new(0.0315, 0.0, 0.0735);

/// Adds parts in the head's frame, scaled.
struct Sculptor<'a> {
    s: &'a mut Sculpture,
    frame: Frame,
    scale: f32,
}

impl Sculptor<'_> {
    fn point(&self, p: [f32; 3]) -> Vec3 {
        self.frame.point(Vec3::from(p) * self.scale)
    }

    fn egg(&self, at: [f32; 3], radii: [f32; 3], blend: f32) -> Part {
        let frame = Frame {
            origin_m: self.point(at),
            axes: self.frame.axes,
        };
        Part::ellipsoid(frame, Vec3::from(radii) * self.scale).blended(blend * self.scale)
    }

    fn bone(&self, a: [f32; 3], ra: f32, b: [f32; 3], rb: f32, blend: f32) -> Part {
        let k = self.scale;
        Part::limb(
            (self.point(a), ra * k),
            (self.point(b), rb * k),
            self.frame.axes.z_axis,
        )
        .blended(blend * k)
    }

    fn add(&mut self, part: Part) {
        self.s.add(part);
    }
}

pub(super) fn layer(pose: &Pose, build: &Build, noise: Noise) -> Layer {
    let mut s = Sculpture::new();
    let mut c = Sculptor {
        s: &mut s,
        frame: pose.head,
        scale: build.head,
    };
    skull(&mut c, build.woman);
    for side in [-1.0, 1.0] {
        eye_socket(&mut c, side);
        ear(&mut c, side);
    }
    nose(&mut c, build.woman);
    mouth(&mut c, build.woman);
    neck(&mut s, pose, build);
    Layer {
        name: "head",
        stuff: Stuff::Skin,
        sculpture: s,
        cell_m: 0.0028,
        paint: paint(pose.head, *build, noise),
    }
}

fn skull(c: &mut Sculptor, woman: bool) {
    let jaw = if woman { 0.88 } else { 1.0 };
    c.add(c.egg([0.0, 0.036, -0.014], [0.0745, 0.080, 0.094], 0.0));
    c.add(c.egg([0.0, 0.030, 0.030], [0.064, 0.062, 0.060], 0.03));
    c.add(c.egg([0.0, -0.040, 0.030], [0.056 * jaw, 0.072, 0.058], 0.035));
    for x in [-1.0, 1.0] {
        c.add(c.bone(
            [x * 0.056 * jaw, -0.040, 0.0],
            0.016,
            [x * 0.050 * jaw, -0.068, 0.012],
            0.016,
            0.025,
        ));
        c.add(c.bone(
            [x * 0.050 * jaw, -0.068, 0.012],
            0.016,
            [x * 0.016, -0.101, 0.064],
            0.0145,
            0.025,
        ));
        c.add(c.egg([x * 0.045, -0.026, 0.060], [0.019, 0.014, 0.018], 0.026));
        let cheek = if woman { 0.022 } else { 0.018 };
        c.add(c.egg([x * 0.030, -0.056, 0.065], [cheek, 0.022, 0.016], 0.026));
    }
    c.add(c.egg([0.0, -0.104, 0.070], [0.0190 * jaw, 0.0135, 0.0150], 0.020));
    if !woman {
        c.add(c.bone(
            [-0.036, 0.0165, 0.0765],
            0.0085,
            [-0.008, 0.0125, 0.0865],
            0.0085,
            0.014,
        ));
        c.add(c.bone(
            [0.036, 0.0165, 0.0765],
            0.0085,
            [0.008, 0.0125, 0.0865],
            0.0085,
            0.014,
        ));
    }
}

fn eye_socket(c: &mut Sculptor, side: f32) {
    let [x, y, z] = (EYE_M * Vec3::new(side, 1.0, 1.0)).to_array();
    c.add(
        c.egg([x, y - 0.001, z + 0.0165], [0.0185, 0.0120, 0.0135], 0.012)
            .carving(),
    );
    // Lids: a shell round the ball, opened by an almond.
    c.add(c.egg([x, y, z], [0.0150, 0.0142, 0.0140], 0.006));
    c.add(c.bone(
        [x - 0.014, y + 0.0045, z + 0.0085],
        0.0026,
        [x, y + 0.0082, z + 0.0118],
        0.0030,
        0.003,
    ));
    c.add(c.bone(
        [x, y + 0.0082, z + 0.0118],
        0.0030,
        [x + 0.014, y + 0.0045, z + 0.0085],
        0.0026,
        0.003,
    ));
    c.add(
        c.egg(
            [x, y - 0.0012, z + 0.0125],
            [0.0126, 0.0043, 0.0110],
            0.0015,
        )
        .carving(),
    );
    // Brow ridge hair.
    let (a, b, d) = (
        [side * 0.013, y + 0.0195, z + 0.0165],
        [side * 0.034, y + 0.0235, z + 0.0125],
        [side * 0.052, y + 0.0165, z - 0.002],
    );
    c.add(c.bone(a, 0.0034, b, 0.0034, 0.004));
    c.add(c.bone(b, 0.0034, d, 0.0020, 0.004));
}

fn nose(c: &mut Sculptor, woman: bool) {
    let k = if woman { 0.88 } else { 1.0 };
    c.add(c.bone(
        [0.0, 0.010, 0.0835],
        0.0068,
        [0.0, -0.020, 0.0975],
        0.0072 * k,
        0.012,
    ));
    c.add(c.bone(
        [0.0, -0.020, 0.0975],
        0.0072 * k,
        [0.0, -0.0345, 0.1065],
        0.0086 * k,
        0.008,
    ));
    for x in [-1.0, 1.0] {
        c.add(c.egg(
            [x * 0.0118 * k, -0.0395, 0.0925],
            [0.0068, 0.0068, 0.0085],
            0.007,
        ));
    }
    c.add(c.bone(
        [0.0, -0.0400, 0.1020],
        0.0048,
        [0.0, -0.0470, 0.0880],
        0.0048,
        0.005,
    ));
    for x in [-1.0, 1.0] {
        c.add(
            c.egg(
                [x * 0.0062 * k, -0.0465, 0.0960],
                [0.0030, 0.0036, 0.0048],
                0.002,
            )
            .carving(),
        );
    }
}

fn mouth(c: &mut Sculptor, woman: bool) {
    let full = if woman { 1.18 } else { 1.0 };
    c.add(c.egg([0.0, -0.070, 0.074], [0.026, 0.020, 0.014], 0.016));
    for x in [-1.0, 1.0] {
        c.add(c.bone(
            [x * 0.0245, -0.0712, 0.0785],
            0.0026,
            [x * 0.004, -0.0665, 0.0900],
            0.0042 * full,
            0.004,
        ));
        c.add(c.bone(
            [x * 0.0235, -0.0720, 0.0785],
            0.0026,
            [x * 0.004, -0.0765, 0.0885],
            0.0052 * full,
            0.004,
        ));
    }
    for x in [-1.0, 1.0] {
        c.add(
            c.bone(
                [x * 0.0265, -0.0712, 0.0830],
                0.0010,
                [0.0, -0.0712, 0.0985],
                0.0010,
                0.002,
            )
            .carving(),
        );
    }
    c.add(
        c.egg([0.0, -0.0880, 0.0900], [0.016, 0.0050, 0.0045], 0.006)
            .carving(),
    );
}

fn ear(c: &mut Sculptor, side: f32) {
    let x = side * 0.0755;
    c.add(c.egg([x, -0.012, -0.016], [0.0085, 0.0290, 0.0165], 0.006));
    c.add(
        c.egg(
            [x + side * 0.0075, -0.008, -0.0125],
            [0.0062, 0.0190, 0.0095],
            0.003,
        )
        .carving(),
    );
    c.add(c.bone(
        [x + side * 0.003, 0.012, -0.020],
        0.0036,
        [x + side * 0.0045, -0.010, -0.031],
        0.0034,
        0.003,
    ));
    c.add(c.egg(
        [x + side * 0.001, -0.010, -0.002],
        [0.0045, 0.0070, 0.0045],
        0.004,
    ));
}

fn neck(s: &mut Sculpture, pose: &Pose, build: &Build) {
    let k = build.head;
    let girth = if build.woman { 0.82 } else { 1.0 };
    let nape = pose.head.point(Vec3::new(0.0, -0.055, -0.028) * k);
    let front = pose.head.point(Vec3::new(0.0, -0.085, 0.020) * k);
    let base = pose.neck - Vec3::Y * 0.03;
    s.add(Part::limb((nape, 0.053 * girth), (base, 0.060 * girth), Vec3::Z).blended(0.03));
    s.add(
        Part::limb(
            (front, 0.030 * girth),
            (base + Vec3::Z * 0.025, 0.042 * girth),
            Vec3::Z,
        )
        .blended(0.03),
    );
    for side in [-1.0, 1.0] {
        let behind = pose.head.point(Vec3::new(side * 0.058, -0.045, -0.025) * k);
        let pit = base + Vec3::new(side * 0.014, -0.015, 0.055 * girth);
        s.add(Part::limb((behind, 0.014), (pit, 0.010), Vec3::Z).blended(0.022));
    }
    if !build.woman {
        s.add(Part::ball(front.lerp(base, 0.4) + Vec3::Z * 0.030, 0.010).blended(0.018));
    }
    // The chest under the open collar.
    let chest = Frame::at(pose.neck + Vec3::new(0.0, -0.085, 0.018));
    s.add(Part::ellipsoid(chest, Vec3::new(0.085, 0.065, 0.062) * build.girth).blended(0.04));
}

/// Skin: redder cheeks, nose and ears, lips, eyebrows, stubble.
fn paint(
    frame: Frame,
    build: Build,
    noise: Noise,
) -> Box<dyn Fn(Vec3, Vec3) -> Vec3 + Send + Sync> {
    let (skin, lips, hair) = (srgb(build.skin), srgb(build.lips), srgb(build.hair));
    Box::new(move |p, _| {
        let q = frame.local(p) / build.head;
        let (x, y) = (q.x.abs(), q.y);
        let ahead = smoothstep(0.03, 0.06, q.z);
        let flush = bump(0.042, 0.030, x) * bump(-0.032, 0.03, y) * ahead
            + bump(0.0, 0.016, x) * bump(-0.036, 0.018, y) * ahead
            + 0.8 * smoothstep(0.070, 0.078, x) * bump(-0.012, 0.04, y);
        let mut color = skin * Vec3::new(1.0, 1.0 - 0.16 * flush, 1.0 - 0.14 * flush);
        color *= 1.0 + 0.06 * noise.fbm(p * 120.0, 2) + 0.10 * noise.fbm(p * 28.0, 3);
        let lip_line = Vec2::new(x / 0.0262, (y + 0.0712) / 0.0092).length();
        let on_lips = smoothstep(1.05, 0.85, lip_line) * smoothstep(0.074, 0.080, q.z);
        color = color.lerp(lips, 0.75 * on_lips);
        let arch = 0.0205 + 0.10 * x - 2.4 * (x - 0.028) * (x - 0.028) - 0.003;
        let brow = smoothstep(0.0054, 0.0030, (y - arch).abs())
            * smoothstep(0.010, 0.015, x)
            * smoothstep(0.055, 0.045, x)
            * ahead;
        color = color.lerp(hair, brow * if build.woman { 0.6 } else { 0.8 });
        // Shadow of lashes round the eye's opening.
        let eye = Vec2::new((x - EYE_M.x) / 0.0150, (y - 0.0015) / 0.0072).length();
        color *= 1.0 - 0.6 * smoothstep(1.3, 0.9, eye) * ahead;
        // Thin skin round the sockets, and beside the wings of the nose.
        let socket = Vec2::new((x - EYE_M.x + 0.004) / 0.022, (y - 0.004) / 0.015).length();
        let wing = Vec2::new((x - 0.0185) / 0.006, (y + 0.038) / 0.009).length();
        let thin = 0.30 * smoothstep(1.2, 0.5, socket) + 0.22 * smoothstep(1.2, 0.3, wing);
        color *= Vec3::ONE - Vec3::new(0.8, 1.0, 0.95) * (thin * ahead);
        if !build.woman {
            let beard = smoothstep(-0.045, -0.062, y) * smoothstep(0.0, 0.03, q.z)
                + 0.8
                    * bump(0.066, 0.014, x)
                    * smoothstep(-0.005, -0.03, y)
                    * smoothstep(-0.01, 0.01, q.z);
            let grain = 0.75 + 0.5 * noise.gradient(p * 420.0);
            let below_jaw = smoothstep(-0.135, -0.115, y);
            color = color.lerp(
                hair * 1.3,
                (0.38 * beard * grain * below_jaw * (1.0 - on_lips)).clamp(0.0, 0.7),
            );
        }
        color
    })
}

/// Frames of the eyes [right, left], z towards what they look at, in the figure's
/// coordinates.
pub(super) fn eyes(pose: &Pose, build: &Build) -> [Frame; 2] {
    [-1.0, 1.0].map(|side| Frame {
        origin_m: pose
            .head
            .point(EYE_M * Vec3::new(side, 1.0, 1.0) * build.head),
        axes: pose.head.axes,
    })
}

/// A ball with iris and pupil towards +z.
pub(super) fn eyeball(mesh: &mut MeshBuilder, frame: &Frame, radius_m: f32, iris: Vec3) {
    const RINGS: [f32; 9] = [0.0, 0.17, 0.18, 0.30, 0.46, 0.50, 0.8, 1.3, 2.2];
    for pair in RINGS.windows(2) {
        let middle = 0.5 * (pair[0] + pair[1]);
        mesh.tint(if middle < 0.175 {
            Vec3::splat(0.01)
        } else if middle < 0.46 {
            iris
        } else if middle < 0.5 {
            iris * 0.4
        } else {
            Vec3::new(0.44, 0.40, 0.37)
        });
        let (inner, outer) = (pair[0], pair[1]);
        mesh.sheet_with_normals(20, 1, |s, t| {
            let angle = inner + (outer - inner) * (1.0 - t);
            let (sine, cosine) = (libm::sinf(angle), libm::cosf(angle));
            let c = on_circle(s * std::f32::consts::TAU) * sine;
            let n = Vec3::new(c.x, c.y, cosine);
            (frame.point(n * radius_m), frame.direction(n), c)
        });
    }
    mesh.tint(Vec3::ONE);
}
