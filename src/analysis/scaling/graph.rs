//! Which scales exist at all.
//!
//! The maximum-likelihood scale is finite and unique exactly where in every division of the
//! techniques into two sets somebody in each set was preferred to somebody in the other at least
//! once: E. Zermelo (1929), Mathematische Zeitschrift 29, 436–460; L. R. Ford (1957), American
//! Mathematical Monthly 64(8), 28–33. As a graph with an arc from winner to loser: it is strongly
//! connected. Not even connected: there is no common scale, whatever is assumed.

use super::comparison::Pair;

/// For every technique the number of its component, counted from 0 in the order of their first
/// techniques. Techniques without votes are components of their own.
#[must_use]
pub fn components(techniques: usize, pairs: &[Pair]) -> Vec<usize> {
    let mut neighbours = vec![Vec::new(); techniques];
    for pair in pairs.iter().filter(|pair| pair.votes() > 0) {
        neighbours[pair.i].push(pair.j);
        neighbours[pair.j].push(pair.i);
    }
    let mut labels = vec![usize::MAX; techniques];
    let mut next = 0;
    for first in 0..techniques {
        if labels[first] == usize::MAX {
            for (label, reached) in labels.iter_mut().zip(reachable(first, &neighbours)) {
                if reached {
                    *label = next;
                }
            }
            next += 1;
        }
    }
    labels
}

/// For every technique the number of its strongly connected set: within a set there is a chain of
/// wins from each technique to each other one.
#[must_use]
pub fn strong_sets(techniques: usize, pairs: &[Pair]) -> Vec<usize> {
    let mut beats = vec![Vec::new(); techniques];
    let mut beaten_by = vec![Vec::new(); techniques];
    for pair in pairs {
        if pair.i_wins > 0 {
            beats[pair.i].push(pair.j);
            beaten_by[pair.j].push(pair.i);
        }
        if pair.j_wins > 0 {
            beats[pair.j].push(pair.i);
            beaten_by[pair.i].push(pair.j);
        }
    }
    let mut labels = vec![usize::MAX; techniques];
    let mut next = 0;
    for first in 0..techniques {
        if labels[first] == usize::MAX {
            let below = reachable(first, &beats);
            let above = reachable(first, &beaten_by);
            for (at, label) in labels.iter_mut().enumerate() {
                if below[at] && above[at] {
                    *label = next;
                }
            }
            next += 1;
        }
    }
    labels
}

/// Pairs of strongly connected sets that were compared: (the one all votes went to, the other).
#[must_use]
pub fn one_way(sets: &[usize], pairs: &[Pair]) -> Vec<(usize, usize)> {
    let mut found: Vec<(usize, usize)> = pairs
        .iter()
        .filter(|pair| pair.votes() > 0 && sets[pair.i] != sets[pair.j])
        .map(|pair| {
            let (i, j) = (sets[pair.i], sets[pair.j]);
            if pair.i_wins > 0 { (i, j) } else { (j, i) }
        })
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

fn reachable(first: usize, arcs: &[Vec<usize>]) -> Vec<bool> {
    let mut reached = vec![false; arcs.len()];
    let mut open = vec![first];
    reached[first] = true;
    while let Some(at) = open.pop() {
        for &next in &arcs[at] {
            if !reached[next] {
                reached[next] = true;
                open.push(next);
            }
        }
    }
    reached
}
