//! What surfaces are made of, and the lights that come with them.

use glam::{Vec2, Vec3};
use serde_json::json;

use super::support::{Gltf, assert_near, assert_parts, assert_sound};
use crate::scene::{TextureEncoding, Wrap};

/// The triangle with a material of its own.
fn with_material(material: serde_json::Value) -> Gltf {
    let mut file = Gltf::triangle();
    file.push("materials", material);
    file.primitive()["material"] = json!(0);
    file
}

#[test]
fn factors_are_read() {
    let file = with_material(json!({
        "name": "brass",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.25, 0.125, 0.75],
            "metallicFactor": 0.5,
            "roughnessFactor": 0.25,
        },
        "emissiveFactor": [0.5, 0, 1],
        "extensions": {
            "KHR_materials_emissive_strength": {"emissiveStrength": 8},
            "KHR_materials_unlit": {},
        },
        "alphaMode": "MASK",
        "doubleSided": true,
    }));
    let model = file.load().unwrap();
    let material = &model.geometry.materials[0];
    assert_eq!(material.name, "brass");
    assert_eq!(material.albedo, [0.5, 0.25, 0.125]);
    assert_eq!((material.metallic, material.roughness), (0.5, 0.25));
    assert_eq!((material.alpha, material.alpha_cutoff), (0.75, Some(0.5)));
    assert_eq!(material.emission, [4.0, 0.0, 8.0]);
    assert!(material.unlit && material.double_sided);
}

/// One image as colours and as numbers is two textures, and with another wrapping a
/// third; twice the same way is one.
#[test]
fn an_image_is_decoded_once_for_each_way_it_is_used() {
    let mut file = with_material(json!({}));
    let clamped = file.push("samplers", json!({"wrapS": 33071, "wrapT": 33648}));
    let plain = file.texture(None);
    let image = json!(file.json["textures"][plain]["source"]);
    let other = file.push("textures", json!({"source": image, "sampler": clamped}));
    file.json["materials"][0] = json!({
        "pbrMetallicRoughness": {
            "baseColorTexture": {"index": plain},
            "metallicRoughnessTexture": {"index": plain},
        },
        "emissiveTexture": {"index": plain},
        "normalTexture": {"index": other, "scale": 0.5},
        "occlusionTexture": {"index": plain, "strength": 0.75},
    });
    let model = file.load().unwrap();
    assert_sound(&model);
    let geometry = &model.geometry;
    assert_eq!(geometry.textures.len(), 3);
    let material = &geometry.materials[0];
    let texture =
        |slot: Option<crate::scene::TextureUse>| &geometry.textures[slot.unwrap().texture];
    assert_eq!(material.albedo_texture, material.emission_texture);
    assert_eq!(material.roughness_texture, material.occlusion_texture);
    assert_eq!(
        texture(material.albedo_texture).encoding,
        TextureEncoding::Srgb
    );
    assert_eq!(
        texture(material.roughness_texture).encoding,
        TextureEncoding::Linear
    );
    assert_eq!(
        texture(material.normal_texture).wrap,
        [Wrap::Clamp, Wrap::Mirror]
    );
    assert_eq!(
        texture(material.albedo_texture).rgba8,
        [255, 0, 0, 255, 0, 0, 255, 128]
    );
    assert_eq!(
        (material.normal_scale, material.occlusion_strength),
        (0.5, 0.75)
    );
}

#[test]
fn texture_transforms_are_read_in_every_slot() {
    let transform = json!({"KHR_texture_transform": {"offset": [0.5, 0.25], "scale": [2, 4]}});
    let mut file = with_material(json!({}));
    let texture = file.texture(None);
    file.json["materials"][0] = json!({
        "pbrMetallicRoughness": {"baseColorTexture": {"index": texture, "extensions": transform}},
        "normalTexture": {"index": texture, "extensions": transform},
        "occlusionTexture": {"index": texture, "extensions": transform},
    });
    let model = file.load().unwrap();
    let material = &model.geometry.materials[0];
    let mut slots = 0;
    for slot in material.textures() {
        let found = slot.transform.transform_point2(Vec2::new(1.0, 1.0));
        assert_near(&found.to_array(), &[2.5, 4.25]);
        slots += 1;
    }
    assert_eq!(slots, 3);
}

/// A wall with its texture upright: u to the right, v down, so the tangent is +X and
/// the bitangent, where a map's green points, is up.
#[test]
fn missing_tangents_point_along_the_texture() {
    let mut file = with_material(json!({}));
    let texture = file.texture(None);
    file.json["materials"][0] = json!({"normalTexture": {"index": texture}});
    for vertex in file.vertices() {
        assert_near(&vertex.tangent, &[1.0, 0.0, 0.0, 1.0]);
    }
    // Mirrored on the wall, u runs left, and the handedness keeps green up.
    let mirrored = file.floats("VEC2", &[1.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
    file.primitive()["attributes"]["TEXCOORD_0"] = json!(mirrored);
    for vertex in file.vertices() {
        assert_near(&vertex.tangent, &[-1.0, 0.0, 0.0, -1.0]);
    }
}

#[test]
fn what_is_not_drawn_as_meant_is_told() {
    let mut file = with_material(json!({}));
    let texture = file.texture(None);
    file.json["materials"][0] = json!({
        "alphaMode": "BLEND",
        "pbrMetallicRoughness": {"baseColorTexture": {"index": texture}},
        "occlusionTexture": {"index": texture, "texCoord": 1},
    });
    file.json["extensionsUsed"] = json!(["KHR_materials_clearcoat"]);
    let model = file.load().unwrap();
    assert_eq!(model.geometry.materials[0].alpha_cutoff, Some(0.5));
    let warnings = model.report.warnings.join("\n");
    let parts = [
        "materials[0] is transparent",
        "materials[0].occlusionTexture uses a second set",
        "KHR_materials_clearcoat",
    ];
    assert_parts(&warnings, &parts);
}

#[test]
fn lights_stand_and_shine_where_their_nodes_do() {
    let mut file = Gltf::triangle();
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": 3, "color": [1, 0.5, 0]},
        {"type": "spot", "intensity": 10, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
        {"type": "point"},
    ]}});
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (light, translation) in [(0, [0, 0, 0]), (1, [1, 2, 3]), (2, [4, 5, 6])] {
        // Turned by −90° about +X: what shone along −Z shines down.
        file.push(
            "nodes",
            json!({"rotation": [-half, 0, 0, half], "translation": translation,
                   "extensions": {"KHR_lights_punctual": {"light": light}}}),
        );
    }
    let lights = file.load().unwrap().geometry.lights;
    assert_eq!(lights.suns.len(), 1);
    assert_near(&lights.suns[0].towards.to_array(), &[0.0, 1.0, 0.0]);
    assert_eq!(lights.suns[0].irradiance, Vec3::new(3.0, 1.5, 0.0));
    let cone = lights.points[0].cone.unwrap();
    assert_near(&cone.along.to_array(), &[0.0, -1.0, 0.0]);
    assert_eq!((cone.inner_rad, cone.outer_rad), (0.25, 0.5));
    assert_eq!(lights.points[1].position_m, Vec3::new(4.0, 5.0, 6.0));
    assert_eq!(lights.points[1].intensity, Vec3::ONE);
    assert!(lights.points[1].cone.is_none());
}
