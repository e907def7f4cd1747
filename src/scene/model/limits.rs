//! What a model may take of the machine, so that a broken or hostile file ends in a
//! message and not in an exhausted memory.

use super::error::Fault;

/// Largest model that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Vertices of all meshes, instances counted each. One takes 64 bytes.
    pub vertices: u64,
    /// Corners of all triangles, instances counted each. One takes 4 bytes.
    pub corners: u64,
    /// Decoded textures together, bytes.
    pub texture_bytes: u64,
    /// Width or height of one texture, pixels.
    pub texture_side_px: u32,
    /// Nodes, accessors, materials and whatever else is an object in a glTF's JSON.
    pub json_objects: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            vertices: 50_000_000,
            corners: 200_000_000,
            texture_bytes: 4 << 30,
            texture_side_px: 16_384,
            json_objects: 2_000_000,
        }
    }
}

/// What is left of the [`Limits`] while a model is read. Everything is asked for
/// before it is allocated.
#[derive(Debug)]
pub(super) struct Budget {
    limits: Limits,
    left: Limits,
}

impl Budget {
    pub fn new(limits: Limits) -> Self {
        Self {
            limits,
            left: limits,
        }
    }

    pub fn limits(&self) -> Limits {
        self.limits
    }

    pub fn vertices(&mut self, place: &str, count: u64) -> Result<(), Fault> {
        let limit = self.limits.vertices;
        take(&mut self.left.vertices, count, limit, place, "vertices")
    }

    pub fn corners(&mut self, place: &str, count: u64) -> Result<(), Fault> {
        let limit = self.limits.corners;
        take(&mut self.left.corners, count, limit, place, "indices")
    }

    pub fn texture_bytes(&mut self, place: &str, count: u64) -> Result<(), Fault> {
        let limit = self.limits.texture_bytes;
        let what = "bytes of decoded textures";
        take(&mut self.left.texture_bytes, count, limit, place, what)
    }
}

fn take(left: &mut u64, count: u64, limit: u64, place: &str, what: &str) -> Result<(), Fault> {
    match left.checked_sub(count) {
        Some(rest) => {
            *left = rest;
            Ok(())
        }
        None => Err(Fault::new(
            place,
            format!(
                "the model has more than {limit} {what} (here are {count}); \
                 simplify it, or the file is damaged"
            ),
        )),
    }
}
