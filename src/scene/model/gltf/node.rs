//! The tree of nodes: where everything stands.

use glam::{Affine3A, Mat4, Quat, Vec3};
use gltf::json;

use super::super::error::Fault;
use super::document::{Document, look_up};

/// How a node stands in its parent, and its morph weights if an animation says them.
#[derive(Debug, Clone)]
pub(super) struct NodePose {
    pub placement: Placement,
    pub weights: Option<Vec<f32>>,
}

/// A transform as a file states it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Placement {
    Matrix(Affine3A),
    Parts {
        translation: Vec3,
        rotation: Quat,
        scale: Vec3,
    },
}

impl Placement {
    fn of(node: &json::Node) -> Self {
        if let Some(matrix) = node.matrix {
            return Self::Matrix(Affine3A::from_mat4(Mat4::from_cols_array(&matrix)));
        }
        Self::Parts {
            translation: node.translation.map_or(Vec3::ZERO, Vec3::from),
            rotation: Quat::from_array(node.rotation.unwrap_or_default().0),
            scale: node.scale.map_or(Vec3::ONE, Vec3::from),
        }
    }

    /// The parts, to be moved one by one; a matrix, which the standard does not let
    /// an animation move, starts from nothing.
    pub fn parts(&mut self) -> (&mut Vec3, &mut Quat, &mut Vec3) {
        if let Self::Matrix(matrix) = self {
            let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
            *self = Self::Parts {
                translation,
                rotation,
                scale,
            };
        }
        match self {
            Self::Parts {
                translation,
                rotation,
                scale,
            } => (translation, rotation, scale),
            Self::Matrix(_) => unreachable!("it has just been taken apart"),
        }
    }

    fn affine(&self) -> Affine3A {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Parts {
                translation,
                rotation,
                scale,
            } => {
                // Files round their quaternions; a zero one turns nothing.
                let length = rotation.length();
                let rotation = if length > 1e-6 {
                    rotation / length
                } else {
                    Quat::IDENTITY
                };
                Affine3A::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }
}

/// The pose the nodes are stored in.
pub(super) fn rest_pose(document: &Document) -> Vec<NodePose> {
    let pose = |node| NodePose {
        placement: Placement::of(node),
        weights: None,
    };
    document.root.nodes.iter().map(pose).collect()
}

/// Every node's place in the world.
pub(super) struct Nodes {
    /// From node to world, by node.
    pub world: Vec<Affine3A>,
    /// The nodes of the scene, parents before children.
    pub in_scene: Vec<usize>,
}

impl Nodes {
    /// Without recursion: a chain of a million nodes is only a long list.
    pub fn new(document: &Document, pose: &[NodePose]) -> Result<Self, Fault> {
        let children = children(document)?;
        let parents = parents(&children)?;
        let mut world = vec![Affine3A::IDENTITY; pose.len()];
        let roots: Vec<usize> = (0..pose.len()).filter(|&n| parents[n].is_none()).collect();
        let order = depth_first(&roots, &children);
        for &node in &order {
            let parent = parents[node].map_or(Affine3A::IDENTITY, |parent| world[parent]);
            world[node] = parent * pose[node].placement.affine();
            if !world[node].is_finite() {
                let message = "its place in the world is not finite; look at its transform and at \
                               those of its parents";
                return Err(Fault::new(format!("nodes[{node}]"), message));
            }
        }
        if order.len() < pose.len() {
            let mut reached = vec![false; pose.len()];
            for node in order {
                reached[node] = true;
            }
            let lost = reached.iter().position(|&r| !r).unwrap_or_default();
            let message = "is its own ancestor; nodes must form trees: export the model again";
            return Err(Fault::new(format!("nodes[{lost}]"), message));
        }
        let roots = match scene(document)? {
            Some(scene) => scene_roots(document, scene)?,
            None => roots,
        };
        Ok(Self {
            world,
            in_scene: depth_first(&roots, &children),
        })
    }
}

fn children(document: &Document) -> Result<Vec<Vec<usize>>, Fault> {
    let nodes = &document.root.nodes;
    nodes
        .iter()
        .enumerate()
        .map(|(index, node)| {
            let place = format!("nodes[{index}].children");
            node.children
                .iter()
                .flatten()
                .map(|&child| look_up(nodes, child, "node", &place).map(|_| child.value()))
                .collect()
        })
        .collect()
}

fn parents(children: &[Vec<usize>]) -> Result<Vec<Option<usize>>, Fault> {
    let mut parents = vec![None; children.len()];
    for (node, own) in children.iter().enumerate() {
        for &child in own {
            if let Some(other) = parents[child].replace(node) {
                let message = format!(
                    "is a child of node {other} and of node {node}; a node has one parent: \
                     export the model again"
                );
                return Err(Fault::new(format!("nodes[{child}]"), message));
            }
        }
    }
    Ok(parents)
}

/// All nodes from `roots` down, each once, parents before children.
fn depth_first(roots: &[usize], children: &[Vec<usize>]) -> Vec<usize> {
    let mut seen = vec![false; children.len()];
    let mut order = Vec::new();
    let mut waiting: Vec<usize> = roots.iter().rev().copied().collect();
    while let Some(node) = waiting.pop() {
        if !std::mem::replace(&mut seen[node], true) {
            order.push(node);
            waiting.extend(children[node].iter().rev());
        }
    }
    order
}

/// The scene that is shown: the default one, or the first.
fn scene(document: &Document) -> Result<Option<usize>, Fault> {
    let root = &document.root;
    match root.scene {
        Some(scene) => {
            look_up(&root.scenes, scene, "scene", "scene")?;
            Ok(Some(scene.value()))
        }
        None => Ok((!root.scenes.is_empty()).then_some(0)),
    }
}

fn scene_roots(document: &Document, scene: usize) -> Result<Vec<usize>, Fault> {
    let place = format!("scenes[{scene}].nodes");
    let nodes = &document.root.nodes;
    document.root.scenes[scene]
        .nodes
        .iter()
        .map(|&node| look_up(nodes, node, "node", &place).map(|_| node.value()))
        .collect()
}
