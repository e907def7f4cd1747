//! Containers, accessors, primitives and nodes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::Vec3;
use serde_json::json;

use super::support::{Gltf, U8, U16, assert_near, assert_parts, assert_sound, load_bytes, write};
use crate::scene::Vertex;
use crate::scene::model::{ModelOptions, Up, files, load, sha256};

/// Winding as an onlooker sees it: the side a triangle's corners go round
/// counter-clockwise.
fn facing(vertices: &[Vertex], triangle: &[u32]) -> Vec3 {
    let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(vertices[triangle[k] as usize].position_m));
    (b - a).cross(c - a).normalize()
}

#[test]
fn the_triangle_is_read_as_it_is() {
    let model = Gltf::triangle().load().unwrap();
    assert_sound(&model);
    let mesh = &model.geometry.meshes[0];
    assert_eq!(mesh.name, "tri");
    assert_eq!(mesh.indices, [0, 1, 2]);
    assert_eq!(mesh.vertices[2].position_m, [0.0, 1.0, 0.0]);
    assert_eq!(mesh.vertices[2].normal, [0.0, 0.0, 1.0]);
    assert_eq!((model.report.triangles, model.report.vertices), (1, 3));
    assert_eq!(model.report.size_m(), Vec3::new(1.0, 1.0, 0.0));
}

#[test]
fn buffers_may_lie_beside_or_inside_the_json() {
    let file = Gltf::triangle();
    let expected = file.load().unwrap().geometry;
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "data 1.bin", &file.bin);
    let data = format!(
        "data:application/octet-stream;base64,{}",
        STANDARD.encode(&file.bin)
    );
    for uri in ["data%201.bin", &data] {
        let mut json = file.json.clone();
        json["buffers"] = json!([{"byteLength": file.bin.len(), "uri": uri}]);
        let path = write(dir.path(), "m.gltf", json.to_string());
        let model = load(&path, &ModelOptions::default()).unwrap();
        assert_eq!(model.geometry, expected);
    }
}

/// A set must be another set when a file that a model refers to has changed.
#[test]
fn the_hash_covers_what_the_model_refers_to() {
    let mut file = Gltf::triangle();
    file.push("images", json!({"uri": "a.png"}));
    file.json["buffers"] = json!([{"byteLength": file.bin.len(), "uri": "a.bin"}]);
    let dir = tempfile::tempdir().unwrap();
    let buffer = write(dir.path(), "a.bin", &file.bin);
    let image = write(dir.path(), "a.png", "one");
    let path = write(dir.path(), "m.gltf", file.json.to_string());
    assert_eq!(
        files(&path).unwrap(),
        [path.clone(), buffer.clone(), image.clone()]
    );
    let first = sha256(&path).unwrap();
    assert_eq!(first, sha256(&path).unwrap());
    std::fs::write(&image, "two").unwrap();
    let second = sha256(&path).unwrap();
    assert_ne!(first, second);
    let mut bin = file.bin.clone();
    bin[3] ^= 1;
    std::fs::write(&buffer, bin).unwrap();
    assert_ne!(second, sha256(&path).unwrap());
}

#[test]
fn positions_may_be_quantised() {
    let mut file = Gltf::triangle();
    // Three signed 16-bit numbers, padded to 8 bytes, as KHR_mesh_quantization has it.
    let values: [i16; 12] = [0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0];
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let view = file.view(&bytes);
    file.json["bufferViews"][view]["byteStride"] = json!(8);
    let positions = file.push(
        "accessors",
        json!({"bufferView": view, "componentType": 5122, "normalized": true,
               "type": "VEC3", "count": 3}),
    );
    file.primitive()["attributes"]["POSITION"] = json!(positions);
    file.json["nodes"][0]["scale"] = json!([2, 2, 2]);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let vertices = file.vertices();
    assert_near(&vertices[1].position_m, &[2.0, 0.0, 0.0]);
    assert_near(&vertices[2].position_m, &[0.0, -2.0, 0.0]);
}

#[test]
fn sparse_accessors_replace_single_elements() {
    let mut file = Gltf::triangle();
    let indices = file.view(&[2]);
    let values: Vec<u8> = [5.0_f32, 6.0, 7.0]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let values = file.view(&values);
    let sparse = json!({
        "count": 1,
        "indices": {"bufferView": indices, "componentType": U8},
        "values": {"bufferView": values},
    });
    file.json["accessors"][0]["sparse"] = sparse;
    let vertices = file.vertices();
    assert_eq!(vertices[1].position_m, [1.0, 0.0, 0.0]);
    assert_eq!(vertices[2].position_m, [5.0, 6.0, 7.0]);
    // Without a buffer view, everything else is zero.
    let accessor = file.json["accessors"][0].as_object_mut().unwrap();
    accessor.remove("bufferView");
    let vertices = file.vertices();
    assert_eq!(vertices[1].position_m, [0.0; 3]);
    assert_eq!(vertices[2].position_m, [5.0, 6.0, 7.0]);
}

#[test]
fn colours_are_normalised() {
    let mut file = Gltf::triangle();
    let bytes: Vec<u8> = [0_u16, 65535, 13107, 65535, 0, 0, 0, 0, 0]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let colors = file.accessor("VEC3", U16, 3, &bytes);
    file.json["accessors"][colors]["normalized"] = json!(true);
    file.primitive()["attributes"]["COLOR_0"] = json!(colors);
    assert_near(&file.vertices()[0].color, &[0.0, 1.0, 0.2, 1.0]);
}

#[test]
fn parents_move_their_children() {
    let mut file = Gltf::triangle();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    file.push(
        "nodes",
        json!({"children": [0], "translation": [1, 0, 0], "rotation": [0, half, 0, half]}),
    );
    file.json["nodes"][0]["translation"] = json!([0, 0, 2]);
    let vertices = file.vertices();
    // A quarter turn about +Y brings +Z to +X and +X to −Z.
    assert_near(&vertices[0].position_m, &[3.0, 0.0, 0.0]);
    assert_near(&vertices[1].position_m, &[3.0, 0.0, -1.0]);
    assert_near(&vertices[0].normal, &[1.0, 0.0, 0.0]);
}

/// A mirror must not turn the surface inside out, nor its normal map.
#[test]
fn mirrored_nodes_keep_their_outside() {
    let mut file = Gltf::triangle();
    let tangents = file.floats("VEC4", &[1.0, 0.0, 0.0, 1.0].repeat(3));
    file.primitive()["attributes"]["TANGENT"] = json!(tangents);
    for (scale, normal, tangent) in [
        (
            [-1.0_f32, 1.0, 1.0],
            [0.0, 0.0, 1.0],
            [-1.0, 0.0, 0.0, -1.0],
        ),
        ([1.0, 1.0, -2.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0, -1.0]),
        ([-1.0, -1.0, 1.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0, 1.0]),
    ] {
        file.json["nodes"][0]["scale"] = json!(scale);
        let model = file.load().unwrap();
        let mesh = &model.geometry.meshes[0];
        let vertex = &mesh.vertices[0];
        assert_near(&vertex.normal, &normal);
        assert_near(&vertex.tangent, &tangent);
        assert_near(&facing(&mesh.vertices, &mesh.indices).to_array(), &normal);
        // The bitangent goes where the texture's up went: +Y, times the mirror's.
        let [x, y, z, w] = vertex.tangent;
        let bitangent = Vec3::from(vertex.normal).cross(Vec3::new(x, y, z)) * w;
        assert_near(&bitangent.to_array(), &[0.0, scale[1].signum(), 0.0]);
    }
}

/// Uneven scales tilt normals the other way than the surface's own directions.
#[test]
fn normals_stay_at_right_angles() {
    let mut file = Gltf::triangle();
    let tilted = file.floats("VEC3", &[0.6, 0.0, 0.8].repeat(3));
    file.primitive()["attributes"]["NORMAL"] = json!(tilted);
    file.json["nodes"][0]["scale"] = json!([2, 1, 1]);
    let expected = Vec3::new(0.3, 0.0, 0.8).normalize();
    assert_near(&file.vertices()[0].normal, &expected.to_array());
}

#[test]
fn missing_normals_are_flat_as_the_standard_says() {
    let mut file = Gltf::new();
    // Two walls that share the edge x = 0.
    let corners = [[1, 0, 0], [0, 0, 0], [0, 1, 0], [0, 0, 1]];
    let positions: Vec<f32> = corners.iter().flatten().map(|&x| x as f32).collect();
    let positions = file.floats("VEC3", &positions);
    let indices = file.indices(&[1, 0, 2, 1, 2, 3]);
    file.push(
        "meshes",
        json!({"primitives": [{"attributes": {"POSITION": positions}, "indices": indices}]}),
    );
    file.push("nodes", json!({"mesh": 0}));
    let flat = file.load().unwrap();
    assert_sound(&flat);
    let mesh = &flat.geometry.meshes[0];
    for triangle in mesh.indices.chunks_exact(3) {
        for &corner in triangle {
            let normal = mesh.vertices[corner as usize].normal;
            assert_near(&normal, &facing(&mesh.vertices, triangle).to_array());
        }
    }
    assert!(flat.report.warnings.iter().any(|w| w.contains("normals")));
    // The walls turn by 90°: a crease of 60° keeps the edge, one of 120° smooths it.
    for (crease_deg, vertices) in [(60.0_f32, 6), (120.0, 4)] {
        let options = ModelOptions {
            crease_rad: Some(crease_deg.to_radians()),
            ..ModelOptions::default()
        };
        let model = file.load_with(&options).unwrap();
        assert_eq!(model.report.vertices, vertices, "{crease_deg}");
    }
}

#[test]
fn points_and_lines_are_left_out_with_a_warning() {
    let mut file = Gltf::triangle();
    let mut lines = file.primitive().clone();
    lines["mode"] = json!(1);
    let primitives = file.json["meshes"][0]["primitives"].as_array_mut().unwrap();
    primitives.push(lines);
    let model = file.load().unwrap();
    assert_eq!(model.geometry.meshes.len(), 1);
    let warnings = model.report.warnings.join("\n");
    assert_parts(&warnings, &["meshes[0].primitives[1]", "lines"]);
}

#[test]
fn scale_and_axes_go_into_the_scene() {
    let file = Gltf::triangle();
    let options = ModelOptions {
        scale: 0.5,
        up: Up::Z,
        ground: true,
        ..ModelOptions::default()
    };
    let model = file.load_with(&options).unwrap();
    let vertex = &model.geometry.meshes[0].vertices[2];
    // The file's +Z, where the triangle looks, is up; its +Y is away from us.
    assert_near(&vertex.normal, &[0.0, 1.0, 0.0]);
    assert_near(&vertex.position_m, &[-0.25, 0.0, -0.25]);
    let mesh = &model.geometry.meshes[0];
    assert_near(
        &facing(&mesh.vertices, &mesh.indices).to_array(),
        &[0.0, 1.0, 0.0],
    );
}

#[test]
fn sizes_that_are_no_metres_are_told() {
    let file = Gltf::triangle();
    let warnings = |scale| {
        let options = ModelOptions {
            scale,
            ..ModelOptions::default()
        };
        file.load_with(&options).unwrap().report.warnings.join("\n")
    };
    assert_parts(&warnings(155.0), &["155 m", "centimetres", "scale = 0.01"]);
    assert_parts(&warnings(0.001), &["scale = 10"]);
    assert!(!warnings(1.8).contains("scale ="));
}

#[test]
fn other_files_are_named_with_what_is_allowed() {
    let options = ModelOptions::default();
    let message = load_bytes("m.fbx", b"x", &options).unwrap_err().to_string();
    assert_parts(&message, &["m.fbx", ".glb", ".ply.gz"]);
    let dir = tempfile::tempdir().unwrap();
    let missing = load(&dir.path().join("no.glb"), &options).unwrap_err();
    assert_parts(&missing.to_string(), &["no.glb", "there is no such file"]);
    std::fs::create_dir(dir.path().join("d.glb")).unwrap();
    let folder = load(&dir.path().join("d.glb"), &options).unwrap_err();
    assert_parts(&folder.to_string(), &["d.glb", "is not a file"]);
}
