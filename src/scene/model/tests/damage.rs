//! Whatever a file's bytes are, the answer is a sound model or an error that names the
//! file: no panic, no endless reading, no allocation that the file does not pay for.

use std::time::{Duration, Instant};

use proptest::prelude::*;
use serde_json::json;

use super::plain_files::{OBJ, PLY};
use super::support::{Gltf, U8, U32, assert_parts, assert_sound, load_bytes};
use crate::scene::model::{AnimationChoice, Limits, ModelOptions};

/// A model that has everything: a texture, a skin, an animation, sparse positions,
/// morph targets and a light, all in under 4 kB.
fn rich() -> Gltf {
    let mut file = Gltf::triangle();
    let texture = file.texture(None);
    file.push(
        "materials",
        json!({
            "normalTexture": {"index": texture},
            "pbrMetallicRoughness": {"baseColorTexture": {"index": texture}},
        }),
    );
    let joints = file.accessor("VEC4", U8, 3, &[0; 12]);
    let weights = file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0].repeat(3));
    let target = file.floats("VEC3", &[0.5; 9]);
    file.primitive()["material"] = json!(0);
    file.primitive()["targets"] = json!([{"POSITION": target}]);
    file.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    file.json["meshes"][0]["weights"] = json!([0.5]);
    let sparse = (file.view(&[1, 2]), file.view(&[0; 24]));
    file.json["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": {"bufferView": sparse.0, "componentType": U8},
        "values": {"bufferView": sparse.1},
    });
    file.push("nodes", json!({"children": [2], "rotation": [0, 0, 0, 1]}));
    file.push(
        "nodes",
        json!({"extensions": {"KHR_lights_punctual": {"light": 0}}}),
    );
    file.push("skins", json!({"joints": [1]}));
    file.json["nodes"][0]["skin"] = json!(0);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    let input = file.floats("SCALAR", &[0.0, 1.0]);
    let output = file.floats("VEC3", &[0.0; 6]);
    file.push(
        "animations",
        json!({
            "samplers": [{"input": input, "output": output}],
            "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
        }),
    );
    file
}

/// So little that an allocation without a reason would be refused at once.
fn strict() -> ModelOptions {
    ModelOptions {
        animation: Some(AnimationChoice::Index(0)),
        time_s: 0.5,
        limits: Limits {
            vertices: 10_000,
            corners: 10_000,
            texture_bytes: 1 << 20,
            texture_side_px: 512,
            json_objects: 10_000,
        },
        ..ModelOptions::default()
    }
}

/// Loads damaged bytes; whatever loads must be sound.
fn probe(name: &str, bytes: &[u8], options: &ModelOptions) {
    let started = Instant::now();
    match load_bytes(name, bytes, options) {
        Ok(model) => assert_sound(&model),
        Err(error) => assert!(error.to_string().contains(name), "{error}"),
    }
    assert!(
        started.elapsed() < Duration::from_secs(5),
        "{name} took too long"
    );
}

fn without_animation() -> ModelOptions {
    ModelOptions {
        animation: None,
        ..strict()
    }
}

#[test]
fn the_rich_model_loads() {
    let model = load_bytes("m.glb", &rich().glb(), &strict()).unwrap();
    assert_sound(&model);
}

#[test]
fn files_cut_at_every_byte_are_refused_or_sound() {
    let glb = rich().glb();
    for length in 0..glb.len() {
        let error = load_bytes("m.glb", &glb[..length], &strict()).unwrap_err();
        assert!(error.to_string().contains("m.glb"), "{error}");
    }
    for length in 0..PLY.len() {
        probe("m.ply", &PLY.as_bytes()[..length], &without_animation());
    }
    for length in 0..OBJ.len() {
        probe("m.obj", &OBJ.as_bytes()[..length], &without_animation());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn flipped_bytes_of_glb(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = rich().glb();
        for (at, to) in flips {
            let at = at.index(bytes.len());
            bytes[at] = to;
        }
        probe("m.glb", &bytes, &strict());
    }

    /// Other numbers in the JSON reach deeper than other bytes.
    #[test]
    fn other_numbers_in_gltf(
        which in any::<prop::sample::Index>(),
        number in prop_oneof![
            Just(json!(0)), Just(json!(-1)), Just(json!(1)), Just(json!(7)), Just(json!(255)),
            Just(json!(65536)), Just(json!(1_000_000_000)), Just(json!(4_294_967_295_u32)),
            Just(json!(9_007_199_254_740_993_u64)), Just(json!(u64::MAX)), Just(json!(1e39)),
            Just(json!(1e-39)), Just(json!(null)), Just(json!("x")), Just(json!([])), Just(json!({})),
        ],
    ) {
        let mut file = rich();
        let mut places = Vec::new();
        numbers(&mut file.json, &mut Vec::new(), &mut places);
        let place = &places[which.index(places.len())];
        *file.json.pointer_mut(place).unwrap() = number;
        probe("m.glb", &file.glb(), &strict());
    }

    #[test]
    fn flipped_bytes_of_text(
        flips in prop::collection::vec((any::<prop::sample::Index>(), prop_oneof![any::<u8>(), b'0'..=b'9', Just(b'\n'), Just(b'-')]), 1..4),
    ) {
        for (name, text) in [("m.ply", PLY), ("m.obj", OBJ)] {
            let mut bytes = text.as_bytes().to_vec();
            for (at, to) in &flips {
                let at = at.index(bytes.len());
                bytes[at] = *to;
            }
            probe(name, &bytes, &without_animation());
        }
    }
}

/// JSON pointers of all numbers.
fn numbers(value: &mut serde_json::Value, path: &mut Vec<String>, found: &mut Vec<String>) {
    let escape = |key: &str| key.replace('~', "~0").replace('/', "~1");
    match value {
        serde_json::Value::Number(_) => found.push(format!("/{}", path.join("/"))),
        serde_json::Value::Array(items) => {
            for (index, item) in items.iter_mut().enumerate() {
                path.push(index.to_string());
                numbers(item, path, found);
                path.pop();
            }
        }
        serde_json::Value::Object(items) => {
            for (key, item) in items.iter_mut() {
                path.push(escape(key));
                numbers(item, path, found);
                path.pop();
            }
        }
        _ => {}
    }
}

#[test]
fn a_billion_vertices_in_a_kilobyte_are_not_believed() {
    let mut file = Gltf::triangle();
    file.json["accessors"][0]["count"] = json!(1_000_000_000);
    assert_parts(
        &file.message(),
        &["m.glb", "accessors[0]", "bufferViews[0]", "1000000000"],
    );
    // Without a buffer view they would all be zero, and the file need not be long.
    let sparse = file.json["accessors"][0].as_object_mut().unwrap();
    sparse.remove("bufferView");
    let (indices, values) = (file.view(&[1, 0, 0, 0]), file.view(&[0; 12]));
    file.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": indices, "componentType": U32},
        "values": {"bufferView": values},
    });
    assert_parts(
        &file.message(),
        &["meshes[0].primitives[0]", "50000000 vertices"],
    );
}

/// Many small instances are as large as one large mesh.
#[test]
fn instances_are_counted() {
    let mut file = Gltf::triangle();
    for _ in 0..4000 {
        file.push("nodes", json!({"mesh": 0}));
    }
    let error = file.load_with(&without_animation()).unwrap_err();
    assert_parts(&error.to_string(), &["more than 10000"]);
}

#[test]
fn nodes_that_are_no_tree_are_named() {
    let mut file = Gltf::triangle();
    file.push("nodes", json!({"children": [2]}));
    file.push("nodes", json!({"children": [1]}));
    assert_parts(&file.message(), &["nodes[1]", "its own ancestor"]);
    file.json["nodes"][2]["children"] = json!([0]);
    file.json["nodes"][1]["children"] = json!([0]);
    assert_parts(&file.message(), &["nodes[0]", "node 1 and of node 2"]);
    file.json["nodes"][2]["children"] = json!([3]);
    assert_parts(&file.message(), &["nodes[2].children", "node 3", "has 3"]);
    file.json["nodes"][2]["children"] = json!([2]);
    assert_parts(&file.message(), &["nodes[2]", "its own ancestor"]);
}

#[test]
fn a_chain_of_a_hundred_thousand_nodes_is_only_long() {
    let mut file = Gltf::triangle();
    let last = 100_000;
    let nodes = file.json["nodes"].as_array_mut().unwrap();
    for node in 1..last {
        nodes.push(json!({"children": [node + 1], "translation": [0, 0, 0.001]}));
    }
    nodes.push(json!({"children": [0], "translation": [0, 0, 0.001]}));
    let position = file.vertices()[0].position_m;
    assert!((position[2] - 100.0).abs() < 0.1, "{position:?}");
}

#[test]
fn numbers_that_are_none_are_named() {
    let mut file = Gltf::triangle();
    file.bin[16..20].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_parts(
        &file.message(),
        &["accessors[0]", "element 1", "NaN", "finite"],
    );
    let mut file = Gltf::triangle();
    file.json["nodes"][0]["scale"] = json!([1e38, 1e38, 1]);
    file.push("nodes", json!({"children": [0], "scale": [10, 10, 10]}));
    assert_parts(&file.message(), &["nodes[0]", "not finite"]);
    let mut file = Gltf::triangle();
    file.json["nodes"][0]["translation"] = json!([1e9, 0, 0]);
    assert_parts(&file.message(), &["100000 m", "scale"]);
}

#[test]
fn regions_beyond_their_buffers_are_named() {
    let mut file = Gltf::triangle();
    file.json["accessors"][3]["byteOffset"] = json!(2);
    assert_parts(
        &file.message(),
        &["accessors[3]", "bufferViews[3]", "6 bytes"],
    );
    file.json["accessors"][3]["byteOffset"] = json!(u64::MAX);
    assert_parts(&file.message(), &["accessors[3]", "bufferViews[3]"]);
    file.json["bufferViews"][3]["byteOffset"] = json!(u64::MAX);
    assert_parts(&file.message(), &["bufferViews[3]", "buffer 0"]);
    let mut file = Gltf::triangle();
    file.json["bufferViews"][0]["byteStride"] = json!(u32::MAX);
    assert_parts(&file.message(), &["accessors[0]", "4294967295 apart"]);
    file.json["bufferViews"][0]["byteStride"] = json!(4);
    assert_parts(&file.message(), &["bufferViews[0]", "byteStride is 4"]);
}

#[test]
fn indices_beyond_the_vertices_are_named() {
    let mut file = Gltf::triangle();
    let indices = file.indices(&[0, 1, 3]);
    file.primitive()["indices"] = json!(indices);
    assert_parts(
        &file.message(),
        &["accessors[4]", "index 2 is 3", "3 vertices"],
    );
    file.primitive()["attributes"]["POSITION"] = json!(99);
    assert_parts(
        &file.message(),
        &["meshes[0].primitives[0]", "accessor 99", "has 5"],
    );
}

#[test]
fn required_extensions_that_are_unknown_are_named() {
    let mut file = Gltf::triangle();
    file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let parts = [
        "extensionsRequired[0]",
        "KHR_draco_mesh_compression",
        "KHR_mesh_quantization",
        "without it",
    ];
    assert_parts(&file.message(), &parts);
}

#[test]
fn wrong_references_are_named() {
    let mut file = Gltf::triangle();
    file.push("materials", json!({"emissiveTexture": {"index": 0}}));
    file.primitive()["material"] = json!(0);
    file.push("textures", json!({"source": 0}));
    for (uri, parts) in [
        ("no.png", ["images[0]", "no.png", "no such file"]),
        (
            "http://x.org/a.png",
            ["images[0]", "http://x.org/a.png", "beside the model"],
        ),
        ("/etc/passwd", ["images[0]", "/etc/passwd", "relative"]),
        (
            "data:image/png;base64,!",
            ["images[0]", "data URI", "base64"],
        ),
        (
            "data:image/png;base64,AAAA",
            ["images[0]", "neither PNG nor JPEG", "convert"],
        ),
    ] {
        file.json["images"] = json!([{"uri": uri}]);
        assert_parts(&file.message(), &parts);
    }
}

/// A picture of 4 GiB in a few bytes: the header alone decides.
#[test]
fn picture_bombs_are_refused_by_their_header() {
    let mut file = Gltf::triangle();
    let texture = file.texture(None);
    file.push("materials", json!({"emissiveTexture": {"index": texture}}));
    file.primitive()["material"] = json!(0);
    let png = super::support::png();
    let at = file.bin.windows(png.len()).position(|w| w == png).unwrap();
    // Width and height of the IHDR chunk, and its checksum.
    for (size, part) in [(32_768_u32, "16384 a side"), (16_384, "4294967296")] {
        let mut file = file.clone();
        file.bin[at + 16..at + 20].copy_from_slice(&size.to_be_bytes());
        file.bin[at + 20..at + 24].copy_from_slice(&size.to_be_bytes());
        let checksum = crc32fast::hash(&file.bin[at + 12..at + 29]);
        file.bin[at + 29..at + 33].copy_from_slice(&checksum.to_be_bytes());
        let options = ModelOptions {
            limits: Limits {
                texture_bytes: 4_294_967_296 / 8,
                ..Limits::default()
            },
            ..ModelOptions::default()
        };
        let message = file.load_with(&options).unwrap_err().to_string();
        assert_parts(&message, &["images[0]"]);
        let bytes = part == "4294967296" && message.contains("bytes of decoded textures");
        assert!(bytes || message.contains(part), "{message}");
    }
}
