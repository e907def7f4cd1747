//! glTF 2.0: `.gltf` with its buffers and images beside or inside it, and `.glb`.
//!
//! The JSON is the `gltf` crate's; everything it points to is looked up and checked
//! here, because its own readers trust counts and offsets.

mod accessor;
mod animation;
mod buffers;
mod document;
mod light;
mod material;
mod node;
mod primitive;
mod skin;
mod texture;
mod triangles;
mod world;

use std::path::{Path, PathBuf};

use self::document::Document;
use self::material::Materials;
use self::node::Nodes;
use super::Loading;
use super::error::Fault;

/// Reads the default scene into `loading`.
pub(super) fn read(path: &Path, loading: &mut Loading) -> Result<(), Fault> {
    let document = Document::open(path, loading.options.limits.json_objects)?;
    document.check_extensions(&mut loading.warnings)?;
    loading.skins = document.root.skins.len();
    loading.animations = animation::reports(&document)?;
    let mut pose = node::rest_pose(&document);
    if let Some(choice) = &loading.options.animation {
        let animation = animation::find(&document, choice)?;
        animation::apply(&document, animation, loading.options.time_s, &mut pose)?;
    }
    let nodes = Nodes::new(&document, &pose)?;
    let mut materials = Materials::new(&document);
    for &node in &nodes.in_scene {
        let json = &document.root.nodes[node];
        if let Some(mesh) = json.mesh {
            let instance = primitive::Instance {
                node,
                world: nodes.world[node],
                skin: match json.skin {
                    Some(skin) => Some(skin::joint_matrices(&document, skin.value(), &nodes)?),
                    None => None,
                },
                weights: pose[node].weights.as_deref(),
            };
            primitive::read_mesh(&document, mesh.value(), &instance, &mut materials, loading)?;
        }
        light::read(&document, node, &nodes, &mut loading.geometry.lights)?;
    }
    Ok(())
}

/// The buffers and images beside the file.
pub(super) fn files(path: &Path) -> Result<Vec<PathBuf>, Fault> {
    Document::open(path, u64::MAX)?.files()
}
