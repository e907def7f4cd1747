//! The way of a ray through the tree.

use std::cell::RefCell;

use super::node::{LEAF, Leaf, Node, Ray, TRIANGLES};

/// A finished tree; the first node is its root.
#[derive(Debug, Default)]
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    pub leaves: Vec<Leaf>,
    /// The geometry's own number of each leaf's triangles. It stands apart: only the nearest hit asks
    /// for it, and a leaf stays as small as the tests need it.
    pub numbers: Vec<[u32; TRIANGLES]>,
    /// Children that may wait at once while a ray goes through it.
    pub most_waiting: usize,
}

thread_local! {
    /// Children that wait, and where the ray enters each, for trees deeper than usual.
    static DEEP: RefCell<(Vec<u32>, Vec<f32>)> = const { RefCell::new((Vec::new(), Vec::new())) };
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
            // Two lists: for any hit the second is never read, and the compiler drops it.
            let (mut waiting, mut entered) = ([0; USUAL], [0.0; USUAL]);
            return self.walk_with::<ANY>(ray, reach, is_solid, &mut waiting, &mut entered);
        }
        DEEP.with_borrow_mut(|(waiting, entered)| {
            let room = waiting.len().max(self.most_waiting);
            waiting.resize(room, 0);
            entered.resize(room, 0.0);
            self.walk_with::<ANY>(ray, reach, is_solid, waiting, entered)
        })
    }

    #[inline(always)]
    fn walk_with<const ANY: bool>(
        &self,
        ray: &Ray,
        mut reach: f32,
        is_solid: &impl Fn(u32, [f32; 2]) -> bool,
        waiting: &mut [u32],
        entered: &mut [f32],
    ) -> Option<(f32, u32, usize)> {
        let mut found = None;
        // The root is node 0.
        let mut count = 1;
        waiting[0] = 0;
        while count > 0 {
            count -= 1;
            let child = waiting[count];
            if !ANY && entered[count] > reach {
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
            let enter = enter.to_array();
            let first = count;
            while mask != 0 {
                let place = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                let mut at = count;
                // Nearest last, to be taken first.
                while !ANY && at > first && entered[at - 1] < enter[place] {
                    (waiting[at], entered[at]) = (waiting[at - 1], entered[at - 1]);
                    at -= 1;
                }
                waiting[at] = node.child[place];
                if !ANY {
                    entered[at] = enter[place];
                }
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
        let scale = 1.0 / hits.determinant.as_array()[place];
        let distance = hits.distance.as_array()[place] * scale;
        let triangle = leaf.triangle[place];
        let is_nearer = nearest.is_none_or(|(known, _)| distance < known);
        let [weight_1, weight_2] = &hits.weights;
        let weights = [
            weight_1.as_array()[place] * scale,
            weight_2.as_array()[place] * scale,
        ];
        if is_nearer && is_solid(triangle, weights) {
            nearest = Some((distance, place));
        }
    }
    nearest
}
