//! PLY and OBJ.

use std::io::Write as _;

use glam::Vec3;

use super::support::{assert_near, assert_parts, assert_sound, load_bytes, png, write};
use crate::scene::model::{ModelOptions, load, sha256};

/// A pyramid without its base: four triangles that meet at (0, 1, 0).
pub const PLY: &str = "ply\r
format ascii 1.0
comment by hand
element vertex 5
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element extra 2
property list uchar int junk
element face 4
property uchar flags
property list uchar int vertex_indices
end_header
-1 0 -1 255 0 0
1 0 -1 255 0 0
1 0 1 255 0 0
-1 0 1 188 188 188
0 1 0 0 0 255
2 7 7
0
1 3 0 4 1
1 3 1 4 2
1 3 2 4 3
1 3 3 4 0
";

/// The same in binary.
fn binary_ply(big_endian: bool) -> Vec<u8> {
    let name = if big_endian { "big" } else { "little" };
    let header = PLY.split_inclusive("end_header\n").next().unwrap();
    let mut bytes = header
        .replace("ascii", &format!("binary_{name}_endian"))
        .into_bytes();
    let order = |mut number: [u8; 4]| {
        if big_endian {
            number.reverse();
        }
        number
    };
    let corners: [[f32; 3]; 5] = [
        [-1.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [1.0, 0.0, 1.0],
        [-1.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
    ];
    let colors = [[255, 0, 0], [255, 0, 0], [255, 0, 0], [188; 3], [0, 0, 255]];
    for (corner, color) in corners.iter().zip(colors) {
        bytes.extend(corner.iter().flat_map(|x| order(x.to_le_bytes())));
        bytes.extend(color);
    }
    bytes.push(2);
    bytes.extend([7_i32, 7].iter().flat_map(|x| order(x.to_le_bytes())));
    bytes.push(0);
    for face in [[0_i32, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0]] {
        bytes.extend([1, 3]);
        bytes.extend(face.iter().flat_map(|x| order(x.to_le_bytes())));
    }
    bytes
}

fn options() -> ModelOptions {
    ModelOptions::default()
}

#[test]
fn every_encoding_of_ply_is_the_same_model() {
    let ascii = load_bytes("m.ply", PLY.as_bytes(), &options()).unwrap();
    assert_sound(&ascii);
    assert_eq!((ascii.report.triangles, ascii.report.vertices), (4, 5));
    let mesh = &ascii.geometry.meshes[0];
    assert_eq!(mesh.indices, [0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0]);
    // sRGB 188 is half of the light.
    assert_near(&mesh.vertices[0].color, &[1.0, 0.0, 0.0, 1.0]);
    assert!((mesh.vertices[3].color[0] - 0.5).abs() < 0.005);
    for big_endian in [false, true] {
        let binary = load_bytes("m.ply", &binary_ply(big_endian), &options()).unwrap();
        assert_eq!(binary.geometry, ascii.geometry);
    }
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gzip.write_all(&binary_ply(false)).unwrap();
    let gzip = load_bytes("m.ply.gz", &gzip.finish().unwrap(), &options()).unwrap();
    assert_eq!(gzip.geometry, ascii.geometry);
}

/// The apex of a symmetric pyramid points up, whatever the order of its faces.
#[test]
fn plain_meshes_are_smooth() {
    let model = load_bytes("m.ply", PLY.as_bytes(), &options()).unwrap();
    assert_near(
        &model.geometry.meshes[0].vertices[4].normal,
        &[0.0, 1.0, 0.0],
    );
    let flat = ModelOptions {
        crease_rad: Some(0.0),
        albedo: Some([0.1, 0.2, 0.3]),
        roughness: Some(0.4),
        ..options()
    };
    let model = load_bytes("m.ply", PLY.as_bytes(), &flat).unwrap();
    assert_eq!(model.report.vertices, 12);
    let material = &model.geometry.materials[0];
    assert_eq!(
        (material.albedo, material.roughness),
        ([0.1, 0.2, 0.3], 0.4)
    );
}

#[test]
fn broken_plys_say_where() {
    let message = |from: &str, to: &str| {
        assert!(PLY.contains(from));
        let text = PLY.replacen(from, to, 1);
        let error = load_bytes("m.ply", text.as_bytes(), &options()).unwrap_err();
        error.to_string()
    };
    assert_parts(&message("ply\r", "plx"), &["m.ply", "line 1", "PLY"]);
    assert_parts(&message("uchar red", "byte red"), &["line 8", "byte red"]);
    assert_parts(&message("format ascii 1.0\n", ""), &["no format"]);
    assert_parts(
        &message("\n1 0 -1 255", "\n1 0 x 255"),
        &["line 18", "\"x\"", "number"],
    );
    assert_parts(
        &message("-1 0 1 188", "-1 nan 1 188"),
        &["vertex 3", "NaN", "finite"],
    );
    assert_parts(&message("0 4 1", "0 9 1"), &["vertex 9", "there are 5"]);
    assert_parts(&message("0 4 1", "0 -4 1"), &["face 0", "vertex -4"]);
    let message = message("vertex 5", "vertex 1000000000");
    assert_parts(&message, &["element vertex", "1000000000", "bytes"]);
}

pub const OBJ: &str = "# a wall and a triangle
mtllib m.mtl
v 0 0 0
v 1 0 0 0.5 0.25 1
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 2
usemtl wall
f 1/1/1 2/2/1 \\
  3/3/1 4/4/1
usemtl other
f -4 -3 -1
l 1 2
";

#[test]
fn obj_faces_become_triangles_by_material() {
    let dir = tempfile::tempdir().unwrap();
    let path = write(dir.path(), "m.obj", OBJ);
    let mtl = "newmtl wall\nKd 0.2 0.4 0.6\nmap_Kd -s 1 1 1 a.png\nNs 6\n\
               newmtl other\nKd 0.5 0.5 0.25\nKe 1 0 0\n";
    write(dir.path(), "m.mtl", mtl);
    write(dir.path(), "a.png", png());
    let model = load(&path, &options()).unwrap();
    assert_sound(&model);
    let geometry = &model.geometry;
    let [other, wall] = geometry.meshes.as_slice() else {
        panic!("{:?}", geometry.meshes)
    };
    assert_eq!(wall.indices.len(), 6);
    assert_eq!(wall.vertices[0].uv, [0.0, 1.0]);
    assert_eq!(wall.vertices[1].color, [0.5, 0.25, 1.0, 1.0]);
    assert_eq!(wall.vertices[2].normal, [0.0, 0.0, 1.0]);
    let material = &geometry.materials[wall.material];
    assert_eq!(material.albedo_texture.map(|slot| slot.texture), Some(0));
    // n = 6: α² = 2/8, and the root of α = 1/2.
    assert!((material.roughness - 0.5_f32.sqrt()).abs() < 1e-6);
    assert_eq!(other.indices, [0, 1, 2]);
    assert_eq!(other.vertices[2].position_m, [0.0, 1.0, 0.0]);
    // Computed, for it has none.
    assert_eq!(Vec3::from(other.vertices[0].normal), Vec3::Z);
    let material = &geometry.materials[other.material];
    assert_eq!(material.albedo, [0.5, 0.5, 0.25]);
    assert_eq!(material.emission, [1.0, 0.0, 0.0]);
    let before = sha256(&path).unwrap();
    write(dir.path(), "m.mtl", mtl.replace("0.25", "0.75"));
    assert_ne!(sha256(&path).unwrap(), before);
}

#[test]
fn an_obj_without_its_library_is_grey_and_says_so() {
    let model = load_bytes("m.obj", OBJ.as_bytes(), &options()).unwrap();
    assert_eq!(model.geometry.materials[0].albedo, [0.5; 3]);
    let warnings = model.report.warnings.join("\n");
    assert_parts(&warnings, &["m.mtl", "points and lines"]);
}

#[test]
fn broken_objs_say_where() {
    let message = |from: &str, to: &str| {
        assert!(OBJ.contains(from));
        let text = OBJ.replacen(from, to, 1);
        let error = load_bytes("m.obj", text.as_bytes(), &options()).unwrap_err();
        error.to_string()
    };
    assert_parts(
        &message("v 1 1 0", "v 1 x 0"),
        &["m.obj", "line 5", "\"x\""],
    );
    assert_parts(&message("v 1 1 0", "v 1 inf 0"), &["line 5", "finite"]);
    assert_parts(&message("v 1 1 0", "v 1 1"), &["line 5", "at least 3"]);
    assert_parts(
        &message("1/1/1 2", "9/1/1 2"),
        &["line 14", "vertex 9", "there are 4"],
    );
    assert_parts(
        &message("f -4 -3 -1", "f -4 -5 -1"),
        &["line 16", "vertex -5"],
    );
    assert_parts(&message("f -4 -3 -1", "f 1 2"), &["line 16", "2 corners"]);
}
