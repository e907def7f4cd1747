//! Skins, animations and morph targets.

use serde_json::json;

use super::support::{Gltf, U8, assert_near, assert_parts, assert_sound};
use crate::scene::model::{AnimationChoice, ModelOptions};

const IDENTITY: [f32; 16] = [
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
];

/// The triangle on two joints: its first corner on joint 0, the second on joint 1, the
/// third half on each. Node 1 is joint 0; node 2, its child and 1 m to the right, is
/// joint 1.
fn skinned() -> Gltf {
    let mut file = Gltf::triangle();
    let joints = file.accessor("VEC4", U8, 3, &[0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0]);
    let weights = file.floats(
        "VEC4",
        &[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0],
    );
    file.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    file.push("nodes", json!({"children": [2]}));
    file.push("nodes", json!({"translation": [1, 0, 0]}));
    let mut bind = IDENTITY;
    bind[12] = -1.0;
    let bind = file.floats("MAT4", &[IDENTITY, bind].concat());
    file.push(
        "skins",
        json!({"joints": [1, 2], "inverseBindMatrices": bind}),
    );
    file.json["nodes"][0]["skin"] = json!(0);
    file
}

/// Adds an animation of one channel.
fn animate(file: &mut Gltf, node: usize, path: &str, how: &str, times: &[f32], values: &[f32]) {
    let kind = match path {
        "rotation" => "VEC4",
        "weights" => "SCALAR",
        _ => "VEC3",
    };
    let input = file.floats("SCALAR", times);
    let output = file.floats(kind, values);
    file.push(
        "animations",
        json!({
            "name": format!("{path} {how}"),
            "samplers": [{"input": input, "output": output, "interpolation": how}],
            "channels": [{"sampler": 0, "target": {"node": node, "path": path}}],
        }),
    );
}

fn at(animation: usize, time_s: f32) -> ModelOptions {
    ModelOptions {
        animation: Some(AnimationChoice::Index(animation)),
        time_s,
        ..ModelOptions::default()
    }
}

#[test]
fn the_bind_pose_is_the_mesh_itself() {
    let mut file = skinned();
    // A skinned mesh stands where its joints are, not where its node is.
    file.json["nodes"][0]["translation"] = json!([50, 0, 0]);
    let vertices = file.vertices();
    assert_near(&vertices[1].position_m, &[1.0, 0.0, 0.0]);
    assert_near(&vertices[2].position_m, &[0.0, 1.0, 0.0]);
}

#[test]
fn joints_carry_their_vertices_at_the_chosen_moment() {
    let mut file = skinned();
    animate(
        &mut file,
        2,
        "translation",
        "LINEAR",
        &[1.0, 3.0],
        &[1.0, 0.0, 0.0, 1.0, 4.0, 0.0],
    );
    // Held before and after; a quarter of the way at 1.5 s.
    for (time_s, height) in [(0.0, 0.0), (1.0, 0.0), (1.5, 1.0), (3.0, 4.0), (9.0, 4.0)] {
        let model = file.load_with(&at(0, time_s)).unwrap();
        assert_sound(&model);
        let vertices = &model.geometry.meshes[0].vertices;
        assert_near(&vertices[0].position_m, &[0.0, 0.0, 0.0]);
        assert_near(&vertices[1].position_m, &[1.0, height, 0.0]);
        assert_near(&vertices[2].position_m, &[0.0, 1.0 + height / 2.0, 0.0]);
    }
    let report = file.load().unwrap().report;
    assert_eq!(report.skins, 1);
    assert_eq!(report.animations[0].name, "translation LINEAR");
    assert_eq!(report.animations[0].duration_s, 3.0);
}

#[test]
fn rotations_turn_and_steps_jump() {
    let mut file = Gltf::triangle();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let turns = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half];
    animate(&mut file, 0, "rotation", "LINEAR", &[0.0, 1.0], &turns);
    animate(&mut file, 0, "rotation", "STEP", &[0.0, 1.0], &turns);
    let eighth = std::f32::consts::FRAC_1_SQRT_2;
    let corner =
        |options| file.load_with(&options).unwrap().geometry.meshes[0].vertices[1].position_m;
    assert_near(&corner(at(0, 0.5)), &[eighth, eighth, 0.0]);
    assert_near(&corner(at(1, 0.99)), &[1.0, 0.0, 0.0]);
    assert_near(&corner(at(1, 1.0)), &[0.0, 1.0, 0.0]);
}

#[test]
fn cubic_splines_pass_their_values() {
    let mut file = Gltf::triangle();
    // In-tangent, value, out-tangent of two keys; y as t² between 0 and 2 s.
    let keys = [
        0.0, 9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
        0.0, 4.0, 0.0, 0.0, 4.0, 0.0, 0.0, 9.0, 0.0,
    ];
    animate(
        &mut file,
        0,
        "translation",
        "CUBICSPLINE",
        &[0.0, 2.0],
        &keys,
    );
    for (time_s, y) in [(0.0, 0.0), (0.5, 0.25), (1.0, 1.0), (2.0, 4.0), (5.0, 4.0)] {
        let model = file.load_with(&at(0, time_s)).unwrap();
        assert_near(
            &model.geometry.meshes[0].vertices[0].position_m,
            &[0.0, y, 0.0],
        );
    }
}

#[test]
fn morph_targets_count_by_their_weights() {
    let mut file = Gltf::triangle();
    let target = file.floats("VEC3", &[0.0, 0.0, 2.0].repeat(3));
    file.primitive()["targets"] = json!([{"POSITION": target}]);
    assert_eq!(file.vertices()[0].position_m, [0.0; 3]);
    file.json["meshes"][0]["weights"] = json!([0.25]);
    assert_eq!(file.vertices()[0].position_m, [0.0, 0.0, 0.5]);
    animate(&mut file, 0, "weights", "LINEAR", &[0.0, 1.0], &[0.0, 1.0]);
    let model = file.load_with(&at(0, 0.75)).unwrap();
    assert_near(
        &model.geometry.meshes[0].vertices[0].position_m,
        &[0.0, 0.0, 1.5],
    );
}

#[test]
fn a_wrong_animation_lists_those_there_are() {
    let mut file = skinned();
    animate(
        &mut file,
        2,
        "translation",
        "STEP",
        &[0.0],
        &[0.0, 0.0, 0.0],
    );
    let options = ModelOptions {
        animation: Some(AnimationChoice::Name(String::from("Walk"))),
        ..ModelOptions::default()
    };
    let message = file.load_with(&options).unwrap_err().to_string();
    assert_parts(&message, &["m.glb", "\"Walk\"", "0 \"translation STEP\""]);
    let message = file.load_with(&at(1, 0.0)).unwrap_err().to_string();
    assert_parts(&message, &["animation 1", "0 \"translation STEP\""]);
}

#[test]
fn a_joint_that_is_not_there_is_named() {
    let mut file = skinned();
    file.json["skins"][0]["joints"] = json!([1]);
    assert_parts(
        &file.message(),
        &["meshes[0].primitives[0]", "joint 1", "1 joints"],
    );
}
