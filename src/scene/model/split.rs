//! Vertices that must be different in different triangles.

use std::collections::HashMap;

use super::error::Fault;
use super::limits::Budget;
use crate::scene::Vertex;

/// Gives every corner its own value, sharing vertices where the values are the same
/// bits. `value` is asked with the position of each corner in `indices`.
///
/// The first value of a vertex stays with it; each further one gets a copy at the end.
pub(super) fn split<const N: usize>(
    place: &str,
    vertices: &mut Vec<Vertex>,
    indices: &mut [u32],
    budget: &mut Budget,
    value: impl Fn(usize) -> [f32; N],
    set: impl Fn(&mut Vertex, [f32; N]),
) -> Result<(), Fault> {
    let mut first: Vec<Option<[u32; N]>> = vec![None; vertices.len()];
    let mut copies: HashMap<(u32, [u32; N]), u32> = HashMap::new();
    for (corner, index) in indices.iter_mut().enumerate() {
        let original = *index as usize;
        let wanted = value(corner);
        let key = wanted.map(f32::to_bits);
        match first[original] {
            None => {
                first[original] = Some(key);
                set(&mut vertices[original], wanted);
            }
            Some(known) if known == key => {}
            Some(_) => {
                if let Some(&copy) = copies.get(&(*index, key)) {
                    *index = copy;
                    continue;
                }
                budget.vertices(place, 1)?;
                let mut vertex = vertices[original];
                set(&mut vertex, wanted);
                // Within the budget, which is far below 2^32.
                let copy = vertices.len() as u32;
                vertices.push(vertex);
                copies.insert((*index, key), copy);
                *index = copy;
            }
        }
    }
    Ok(())
}
