//! Lists, strips and fans of indices, as triangles.

use gltf::json::mesh::Mode;

use super::super::error::Fault;
use super::super::limits::Budget;
use super::accessor::Accessor;

/// Three indices a triangle, all below `vertices`; `None` for points and lines.
pub(super) fn read(
    mode: Mode,
    indices: Option<&Accessor>,
    vertices: u64,
    place: &str,
    budget: &mut Budget,
) -> Result<Option<Vec<u32>>, Fault> {
    let count = indices.map_or(vertices, |accessor| accessor.count);
    let corners = match mode {
        Mode::Triangles => count / 3 * 3,
        Mode::TriangleStrip | Mode::TriangleFan => count.saturating_sub(2).saturating_mul(3),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => return Ok(None),
    };
    budget.corners(place, corners.max(count))?;
    let mut triangles = Vec::with_capacity(corners as usize);
    let mut window = [0_u32; 3];
    let mut take = |i: usize, index: u32| {
        if u64::from(index) >= vertices {
            let of = indices.map_or(place, |accessor| &accessor.place);
            let message = format!(
                "index {i} is {index}, but {place} has {vertices} vertices; export the model again"
            );
            return Err(Fault::new(of, message));
        }
        push(mode, i, index, &mut window, &mut triangles);
        Ok(())
    };
    match indices {
        Some(accessor) => accessor.for_each_uint(|i, [index]| take(i, index))?,
        // Within the budget, which is far below 2^32.
        None => (0..count).try_for_each(|i| take(i as usize, i as u32))?,
    }
    triangles.truncate(corners as usize);
    Ok(Some(triangles))
}

/// Takes the `i`th index. `window` holds the last ones, or a fan's centre first.
fn push(mode: Mode, i: usize, index: u32, window: &mut [u32; 3], triangles: &mut Vec<u32>) {
    match mode {
        Mode::TriangleStrip => {
            let [_, a, b] = *window;
            *window = [a, b, index];
            if i >= 2 {
                // Every other triangle of a strip is wound the other way.
                triangles.extend(if i.is_multiple_of(2) {
                    [a, b, index]
                } else {
                    [b, a, index]
                });
            }
        }
        Mode::TriangleFan => {
            if i == 0 {
                window[0] = index;
            } else {
                if i >= 2 {
                    triangles.extend([window[0], window[1], index]);
                }
                window[1] = index;
            }
        }
        _ => triangles.push(index),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::model::Limits;

    fn triangles(mode: Mode, vertices: u64) -> Vec<u32> {
        let mut budget = Budget::new(Limits::default());
        read(mode, None, vertices, "p", &mut budget)
            .unwrap()
            .unwrap()
    }

    /// The orders of glTF 2.0, section 3.7.2.1.
    #[test]
    fn strips_and_fans_keep_their_winding() {
        assert_eq!(
            triangles(Mode::TriangleStrip, 5),
            [0, 1, 2, 2, 1, 3, 2, 3, 4]
        );
        assert_eq!(triangles(Mode::TriangleFan, 5), [0, 1, 2, 0, 2, 3, 0, 3, 4]);
        assert_eq!(triangles(Mode::Triangles, 7), [0, 1, 2, 3, 4, 5]);
        assert!(triangles(Mode::TriangleStrip, 1).is_empty());
    }
}
