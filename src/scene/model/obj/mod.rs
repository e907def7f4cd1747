//! Wavefront OBJ with its `.mtl`: plain meshes, one a material.

mod faces;
mod lines;
mod materials;

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use self::faces::{Corner, Pool};
use self::lines::{Lines, at_line};
use super::error::Fault;
use super::uri::{self, Reference};
use super::{Loading, plain};
use crate::scene::{Mesh, Vertex};

/// Reads the meshes into `loading`.
pub(super) fn read(path: &Path, loading: &mut Loading) -> Result<(), Fault> {
    let mut lines = Lines::open(path)?;
    let mut pool = Pool::default();
    let mut parts: BTreeMap<String, Part> = BTreeMap::new();
    let mut material = String::new();
    let mut libraries = Vec::new();
    while let Some((number, line)) = lines.next_line()? {
        let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match key {
            "v" | "vt" | "vn" => pool.push(key, rest, number)?,
            "f" => {
                let part = parts.entry(material.clone()).or_default();
                part.face(rest, &pool, number, loading)?;
            }
            "usemtl" => rest.trim().clone_into(&mut material),
            "mtllib" => libraries.push(rest.trim().to_owned()),
            "l" | "p" => loading.warnings.say("points and lines are left out"),
            // Names, groups and smoothing groups change no surface that is drawn here.
            _ => {}
        }
    }
    drop(pool);
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut materials = materials::read(folder, &libraries, loading)?;
    for (name, part) in parts {
        let material = materials.index(&name, loading);
        let mesh = Mesh {
            name,
            vertices: part.vertices,
            indices: part.indices,
            material,
        };
        plain::add(mesh, !part.lacks_normals, "faces", loading)?;
    }
    Ok(())
}

/// The material libraries that are there, and their textures.
pub(super) fn files(path: &Path) -> Result<Vec<PathBuf>, Fault> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut lines = Lines::open(path)?;
    let mut files = Vec::new();
    while let Some((number, line)) = lines.next_line()? {
        if let Some(name) = line.strip_prefix("mtllib ") {
            let reference = uri::resolve(folder, name.trim(), &at_line(number))?;
            let Reference::File(library) = reference else {
                continue;
            };
            if library.is_file() && !files.contains(&library) {
                let textures = materials::textures(&library)?;
                files.push(library);
                files.extend(textures);
            }
        }
    }
    Ok(files)
}

/// The faces of one material.
#[derive(Default)]
struct Part {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
    known: HashMap<Corner, u32>,
    lacks_normals: bool,
}

impl Part {
    /// Adds a polygon, cut into a fan.
    fn face(
        &mut self,
        corners: &str,
        pool: &Pool,
        line: usize,
        loading: &mut Loading,
    ) -> Result<(), Fault> {
        let mut fan = [0_u32; 2];
        let mut count = 0;
        for text in corners.split_ascii_whitespace() {
            let corner = pool.corner(text, line)?;
            self.lacks_normals |= corner.normal.is_none();
            let index = match self.known.get(&corner) {
                Some(&known) => known,
                None => {
                    loading.budget.vertices("faces", 1)?;
                    // Within the budget, which is far below 2^32.
                    let index = self.vertices.len() as u32;
                    self.vertices.push(pool.vertex(corner));
                    self.known.insert(corner, index);
                    index
                }
            };
            match count {
                0 => fan[0] = index,
                1 => fan[1] = index,
                _ => {
                    loading.budget.corners("faces", 3)?;
                    self.indices.extend([fan[0], fan[1], index]);
                    fan[1] = index;
                }
            }
            count += 1;
        }
        if count < 3 {
            let message = format!("a face with {count} corners; at least 3 are needed");
            return Err(Fault::new(at_line(line), message));
        }
        Ok(())
    }
}
