//! A scanned model, where a checkout has it beside it; said and skipped where it has not.

use glam::Vec3;

use super::shapes::seen;
use super::*;
use crate::scene::Camera;
use crate::scene::model::{ModelOptions, load};

/// The dragon's folds are dark and its back is open; and what hides is the same whichever way
/// the triangles are listed.
#[test]
fn the_dragon_is_dark_in_its_folds() {
    let folder = std::env::var_os("GREYFIELD_MODELS").map_or_else(
        || std::path::PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data"),
        std::path::PathBuf::from,
    );
    let path = folder.join("dragon/dragon_vrip_res3.ply.gz");
    if !path.is_file() {
        eprintln!("skipped: there is no {}", path.display());
        return;
    }
    let mut geometry = load(&path, &ModelOptions::default()).unwrap().geometry;
    let (low, high) = geometry.bounds_m().unwrap();
    let (centre, size) = ((low + high) / 2.0, (high - low).max_element());
    let camera = Camera {
        position_m: centre + Vec3::new(0.2, 0.5, 1.6) * size,
        target_m: centre,
        vertical_fov_rad: 0.6,
        near_m: 0.01 * size,
        far_m: 10.0 * size,
    };
    let bvh = SceneBvh::new(&geometry);
    let surfaces = seen(&bvh, camera, (64, 48));
    let settings = OcclusionSettings {
        error: 0.01,
        ..OcclusionSettings::new(1)
    };
    let traced = |bvh: &SceneBvh| {
        let points = RayTraced::of_visible(bvh, &surfaces);
        estimate(&points, &settings, &|_| {}).unwrap()
    };
    let found = traced(&bvh);
    assert!(found.surfaces > 300, "{}", found.surfaces);
    let dark = found.occlusion.iter().filter(|&&k| k < 0.4).count();
    let open = found.occlusion.iter().filter(|&&k| k > 0.9).count() as u64;
    assert!(dark > 20 && open > found.surfaces / 10, "{dark} {open}");
    for mesh in &mut geometry.meshes {
        mesh.indices.reverse();
    }
    let again = traced(&SceneBvh::new(&geometry));
    let changed = |(a, b): (&f32, &f32)| (a - b).abs() > 0.02;
    let changed = found
        .occlusion
        .iter()
        .zip(&again.occlusion)
        .filter(|&(a, b)| changed((a, b)));
    assert!(changed.count() <= 3);
}
