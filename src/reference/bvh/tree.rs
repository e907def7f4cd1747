//! The way of a ray through the tree.

use std::cell::RefCell;

use super::node::{LEAF, Leaf, Node, Ray};

/// A finished tree; the first node is its root.
#[derive(Debug, Default)]
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    pub leaves: Vec<Leaf>,
    /// Children that may wait at once while a ray goes through it.
    pub most_waiting: usize,
}

thread_local! {
    /// Children that wait while a ray goes through a tree, for trees deeper than usual.
    static DEEP: RefCell<Vec<(u32, f32)>> = const { RefCell::new(Vec::new()) };
}

impl Tree {
    /// Goes through the tree: to any hit, or to the nearest. Gives its distance, leaf, and
    /// place in the leaf.
    #[inline]
    pub fn walk<const ANY: bool>(
        &self,
        ray: &Ray,
        reach: f32,
        is_solid: &impl Fn(u32, [f32; 2]) -> bool,
    ) -> Option<(f32, u32, usize)> {
        const USUAL: usize = 128;
        if self.nodes.is_empty() {
            return None;
        }
        if self.most_waiting <= USUAL {
            return self.walk_with::<ANY>(ray, reach, is_solid, &mut [(0, 0.0); USUAL]);
        }
        DEEP.with_borrow_mut(|waiting| {
            waiting.resize(waiting.len().max(self.most_waiting), (0, 0.0));
            self.walk_with::<ANY>(ray, reach, is_solid, waiting)
        })
    }

    #[inline(always)]
    fn walk_with<const ANY: bool>(
        &self,
        ray: &Ray,
        mut reach: f32,
        is_solid: &impl Fn(u32, [f32; 2]) -> bool,
        waiting: &mut [(u32, f32)],
    ) -> Option<(f32, u32, usize)> {
        let mut found = None;
        // The root is node 0.
        let mut count = 1;
        waiting[0] = (0, 0.0);
        while count > 0 {
            count -= 1;
            let (child, entered) = waiting[count];
            if !ANY && entered > reach {
                continue;
            }
            if child & LEAF != 0 {
                let leaf = &self.leaves[(child & !LEAF) as usize];
                if let Some((distance, place)) = hit_in(leaf, ray, reach, is_solid) {
                    found = Some((distance, child & !LEAF, place));
                    reach = distance;
                    if ANY {
                        return found;
                    }
                }
                continue;
            }
            let node = &self.nodes[child as usize];
            let (mut mask, enter) = node.hits(ray, reach);
            let first = count;
            while mask != 0 {
                let place = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                let entry = (node.child[place], enter[place]);
                let mut at = count;
                // Nearest last, to be taken first.
                while !ANY && at > first && waiting[at - 1].1 < entry.1 {
                    waiting[at] = waiting[at - 1];
                    at -= 1;
                }
                waiting[at] = entry;
                count += 1;
            }
        }
        found
    }
}

/// The nearest solid hit in a leaf, with its place.
#[inline(always)]
fn hit_in(
    leaf: &Leaf,
    ray: &Ray,
    reach: f32,
    is_solid: &impl Fn(u32, [f32; 2]) -> bool,
) -> Option<(f32, usize)> {
    let hits = leaf.hits(ray, reach);
    let mut mask = hits.mask;
    let mut nearest: Option<(f32, usize)> = None;
    while mask != 0 {
        let place = mask.trailing_zeros() as usize;
        mask &= mask - 1;
        let scale = 1.0 / hits.determinant[place];
        let distance = hits.distance[place] * scale;
        let triangle = leaf.triangle[place];
        let is_nearer = nearest.is_none_or(|(known, _)| distance < known);
        let weights = hits.weights.map(|weight| weight[place] * scale);
        if is_nearer && is_solid(triangle, weights) {
            nearest = Some((distance, place));
        }
    }
    nearest
}
