//! Positions, texture coordinates and normals, and the corners that point to them.

use super::super::error::Fault;
use super::super::plain;
use super::lines::at_line;
use crate::scene::Vertex;

/// What the `v`, `vt` and `vn` lines so far have said.
#[derive(Default)]
pub(super) struct Pool {
    positions: Vec<[f32; 3]>,
    /// As many as positions, from the first one that has a colour on.
    colors: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
}

/// Indices of a corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub position: u32,
    pub uv: Option<u32>,
    pub normal: Option<u32>,
}

impl Pool {
    /// Takes the numbers of a `v`, `vt` or `vn` line.
    pub fn push(&mut self, key: &str, numbers: &str, line: usize) -> Result<(), Fault> {
        let mut values = [0.0_f32; 7];
        let mut count = 0;
        for text in numbers.split_ascii_whitespace().take(values.len()) {
            let value = text.parse::<f32>().ok().filter(|value| value.is_finite());
            values[count] = value.ok_or_else(|| {
                Fault::new(
                    at_line(line),
                    format!("found \"{text}\"; a finite number is needed"),
                )
            })?;
            count += 1;
        }
        let [x, y, z, r, g, b, _] = values;
        let least = if key == "vt" { 1 } else { 3 };
        if count < least {
            let message = format!("found {count} numbers; at least {least} are needed");
            return Err(Fault::new(at_line(line), message));
        }
        match key {
            "vt" => self.uvs.push([x, y]),
            "vn" => self.normals.push([x, y, z]),
            _ => {
                self.positions.push([x, y, z]);
                // Six numbers are a position and its colour; four have a weight.
                if count >= 6 {
                    self.colors.resize(self.positions.len() - 1, [1.0; 3]);
                    self.colors.push([r, g, b].map(|c| c.clamp(0.0, 1.0)));
                }
            }
        }
        Ok(())
    }

    /// Parses `position`, `position/uv`, `position//normal` or `position/uv/normal`,
    /// counted from 1, or from the last one backwards.
    pub fn corner(&self, text: &str, line: usize) -> Result<Corner, Fault> {
        let mut parts = text.split('/');
        let mut part = |count: usize, what: &str| -> Result<Option<u32>, Fault> {
            let Some(text) = parts.next().filter(|text| !text.is_empty()) else {
                return Ok(None);
            };
            let found = text.parse::<i64>().ok().and_then(|number| {
                let count = count as i64;
                let index = if number < 0 {
                    count.checked_add(number)?
                } else {
                    number - 1
                };
                (0..count).contains(&index).then_some(index)
            });
            let index = found.and_then(|index| u32::try_from(index).ok());
            index.map(Some).ok_or_else(|| {
                let message = format!(
                    "found {what} {text}; so far there are {count}, counted from 1 (or from -1 \
                     backwards)"
                );
                Fault::new(at_line(line), message)
            })
        };
        let position = part(self.positions.len(), "vertex")?
            .ok_or_else(|| Fault::new(at_line(line), format!("found the corner \"{text}\"")))?;
        Ok(Corner {
            position,
            uv: part(self.uvs.len(), "texture coordinate")?,
            normal: part(self.normals.len(), "normal")?,
        })
    }

    /// The vertex of a corner that [`corner`](Self::corner) has checked.
    pub fn vertex(&self, corner: Corner) -> Vertex {
        let position = corner.position as usize;
        let [u, v] = corner.uv.map_or([0.0; 2], |i| self.uvs[i as usize]);
        let [r, g, b] = self.colors.get(position).copied().unwrap_or([1.0; 3]);
        Vertex {
            position_m: self.positions[position],
            normal: corner.normal.map_or([0.0; 3], |i| self.normals[i as usize]),
            // OBJ counts v from the bottom of the image.
            uv: [u, 1.0 - v],
            color: [r, g, b, 1.0],
            ..plain::BLANK
        }
    }
}
