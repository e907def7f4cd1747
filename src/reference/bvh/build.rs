//! From triangles to nodes: the `obvhs` crate makes a binary tree of good quality (parallel
//! locally-ordered clustering with reinsertion), which is opened here to eight children a node.

use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle;

use super::node::{CHILDREN, LEAF, Leaf, Node, TRIANGLES};
use super::tree::Tree;

/// Builds a tree over triangles with finite corners; `names` is what each is called, `numbers` its
/// place in the geometry.
pub(super) fn build(corners: &[[Vec3; 3]], names: &[u32], numbers: &[u32]) -> Tree {
    let mut tree = Tree::default();
    if corners.is_empty() {
        return tree;
    }
    let triangles: Vec<Triangle> = corners
        .iter()
        .map(|[a, b, c]| Triangle {
            v0: (*a).into(),
            v1: (*b).into(),
            v2: (*c).into(),
        })
        .collect();
    let params = BvhBuildParams {
        pre_split: false,
        max_prims_per_leaf: TRIANGLES as u32,
        collapse_traversal_cost: 3.0,
        ..BvhBuildParams::slow_build()
    };
    let binary = build_bvh2_from_tris(&triangles, params, &mut std::time::Duration::default());
    let mut opener = Opener {
        binary: &binary,
        corners,
        names,
        numbers,
        tree: &mut tree,
    };
    opener.open();
    tree
}

struct Opener<'a> {
    binary: &'a Bvh2,
    corners: &'a [[Vec3; 3]],
    names: &'a [u32],
    numbers: &'a [u32],
    tree: &'a mut Tree,
}

impl Opener<'_> {
    /// Opens the root, then each child that is not a leaf.
    fn open(&mut self) {
        self.tree.nodes.push(Node::EMPTY);
        // A binary node, the node it becomes, and how many nodes are above.
        let mut waiting = vec![(0, 0, 0)];
        let mut deepest = 0;
        while let Some((from, to, depth)) = waiting.pop() {
            deepest = deepest.max(depth);
            for (place, child) in self.children_of(from).into_iter().enumerate() {
                let name = if self.is_leaf(child) {
                    LEAF | self.leaf(child)
                } else {
                    self.tree.nodes.push(Node::EMPTY);
                    let new = self.tree.nodes.len() - 1;
                    waiting.push((child, new, depth + 1));
                    new as u32
                };
                let bounds = self.binary.nodes[child].aabb;
                let bounds = (bounds.min.into(), bounds.max.into());
                self.tree.nodes[to].set(place, bounds, name);
            }
        }
        self.tree.most_waiting = (deepest + 1) * (CHILDREN - 1) + 1;
    }

    fn is_leaf(&self, node: usize) -> bool {
        self.binary.nodes[node].prim_count > 0
    }

    /// Up to eight nodes below a binary node, by opening the largest again and again.
    fn children_of(&self, node: usize) -> Vec<usize> {
        let mut children = vec![node];
        while children.len() < CHILDREN {
            let largest = (0..children.len())
                .filter(|&place| !self.is_leaf(children[place]))
                .max_by(|&a, &b| {
                    let area = |place: usize| self.binary.nodes[children[place]].aabb.half_area();
                    area(a).total_cmp(&area(b))
                });
            let Some(place) = largest else { break };
            let first = self.binary.nodes[children[place]].first_index as usize;
            children[place] = first;
            children.push(first + 1);
        }
        children
    }

    fn leaf(&mut self, node: usize) -> u32 {
        let node = &self.binary.nodes[node];
        let mut leaf = Leaf::EMPTY;
        let mut numbers = [0; TRIANGLES];
        let first = node.first_index as usize;
        let all = &self.binary.primitive_indices[first..first + node.prim_count as usize];
        for (place, (number, &at)) in numbers.iter_mut().zip(all).enumerate() {
            let at = at as usize;
            leaf.set(place, self.corners[at], self.names[at]);
            *number = self.numbers[at];
        }
        self.tree.leaves.push(leaf);
        self.tree.numbers.push(numbers);
        self.tree.leaves.len() as u32 - 1
    }
}
