//! Models that people made, where a checkout has them beside it; said and skipped where
//! it has not.

use std::path::PathBuf;

use glam::Vec3;

use super::support::assert_sound;
use crate::scene::model::limits::{Budget, Limits};
use crate::scene::model::{AnimationChoice, Model, ModelOptions, load, tangents};

/// A file of `$GREYFIELD_MODELS`, or of `../shared/data` beside the repository.
fn file(name: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("GREYFIELD_MODELS").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data"),
        PathBuf::from,
    );
    let path = folder.join(name);
    if path.is_file() {
        return Some(path);
    }
    eprintln!("skipped: there is no {}", path.display());
    None
}

fn read(name: &str, options: &ModelOptions) -> Option<Model> {
    let model = load(&file(name)?, options).unwrap();
    assert_sound(&model);
    Some(model)
}

fn assert_size(model: &Model, expected: [f32; 3]) {
    let size = model.report.size_m();
    assert!(
        (size - Vec3::from(expected)).abs().max_element() < 0.02 * size.max_element(),
        "{size}"
    );
}

/// The counts that the models' own sources state.
#[test]
fn triangles_are_all_there() {
    for (name, triangles) in [
        ("sponza/sponza_dabrovic.glb", 66_444),
        ("dragon/dragon_vrip_res2.glb", 202_520),
        ("dragon/dragon_vrip_res3.ply.gz", 47_794),
        ("characters/CesiumMan.glb", 4_672),
    ] {
        if let Some(model) = read(name, &ModelOptions::default()) {
            assert_eq!(model.report.triangles, triangles, "{name}");
        }
    }
}

#[test]
fn a_fox_of_155_metres_is_warned_of() {
    if let Some(model) = read("characters/Fox.glb", &ModelOptions::default()) {
        let warnings = model.report.warnings.join("\n");
        assert!(warnings.contains("centimetres"), "{warnings}");
        let names: Vec<&str> = model
            .report
            .animations
            .iter()
            .map(|a| a.name.as_str())
            .collect();
        assert_eq!(names, ["Survey", "Walk", "Run"]);
    }
}

/// Where the file has tangents, computing them must find the same ones.
#[test]
fn computed_tangents_agree_with_authored_ones() {
    let Some(model) = read(
        "props/FlightHelmet/FlightHelmet.gltf",
        &ModelOptions::default(),
    ) else {
        return;
    };
    for mesh in &model.geometry.meshes {
        let map = model.geometry.materials[mesh.material]
            .normal_texture
            .unwrap();
        let (mut vertices, mut indices) = (mesh.vertices.clone(), mesh.indices.clone());
        let mut budget = Budget::new(Limits::default());
        tangents::mikktspace("p", &mut vertices, &mut indices, map.transform, &mut budget).unwrap();
        let agreeing = mesh
            .indices
            .iter()
            .zip(&indices)
            .filter(|&(&theirs, &ours)| {
                let (theirs, ours) = (mesh.vertices[theirs as usize], vertices[ours as usize]);
                let dot: f32 = (0..3).map(|k| theirs.tangent[k] * ours.tangent[k]).sum();
                dot > 0.9 && theirs.tangent[3] == ours.tangent[3]
            });
        let share = agreeing.count() as f64 / indices.len() as f64;
        assert!(share > 0.9, "{}: {share}", mesh.name);
    }
}

/// Walking legs pass each other, and the man stays a man.
#[test]
fn poses_differ_and_keep_their_size() {
    let pose = |time_s| ModelOptions {
        animation: Some(AnimationChoice::Index(0)),
        time_s,
        ..ModelOptions::default()
    };
    let name = "characters/CesiumMan.glb";
    let (Some(first), Some(second)) = (read(name, &pose(0.2)), read(name, &pose(0.7))) else {
        return;
    };
    assert_ne!(first.geometry, second.geometry);
    for model in [first, second] {
        assert!(
            (1.3..1.8).contains(&model.report.size_m().y),
            "{}",
            model.report.size_line()
        );
    }
}

#[test]
fn the_dragon_is_as_large_in_both_files() {
    let options = ModelOptions::default();
    if let (Some(glb), Some(ply)) = (
        read("dragon/dragon_vrip_res2.glb", &options),
        read("dragon/dragon_vrip_res3.ply.gz", &options),
    ) {
        assert_size(&ply, glb.report.size_m().to_array());
    }
}
