//! PLY, the Stanford polygon format: plain meshes, with colours at the vertices.

mod header;
mod numbers;

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use flate2::bufread::MultiGzDecoder;

use self::header::{Element, Header, Kind, Property};
use self::numbers::Numbers;
use super::error::Fault;
use super::{Loading, plain, plain_material};
use crate::scene::srgb;
use crate::scene::{Mesh, Vertex};

/// What deflate can expand a byte to at most (its longest match, of 258 bytes, in 2 bits).
const MOST_EXPANSION: u64 = 1032;

/// Reads the mesh into `loading`.
pub(super) fn read(path: &Path, gzip: bool, loading: &mut Loading) -> Result<(), Fault> {
    let unreadable = |error| Fault::unreadable("", &error);
    let file = File::open(path).map_err(unreadable)?;
    let length = file.metadata().map_err(unreadable)?.len();
    let reader = BufReader::new(file);
    if gzip {
        let reader = BufReader::new(MultiGzDecoder::new(reader));
        read_mesh(reader, length.saturating_mul(MOST_EXPANSION), loading)
    } else {
        read_mesh(reader, length, loading)
    }
}

/// Reads a file of at most `most_bytes`.
fn read_mesh(
    mut reader: impl BufRead,
    most_bytes: u64,
    loading: &mut Loading,
) -> Result<(), Fault> {
    let header = Header::read(&mut reader)?;
    let mut numbers = Numbers::new(reader, header.encoding, header.lines);
    let mut vertices = Vertices::default();
    let mut indices = Vec::new();
    for element in &header.elements {
        // Before anything is allocated: a count that the file cannot hold is a lie.
        let least = element.least_bytes(header.encoding);
        if element.count.saturating_mul(least) > most_bytes {
            let message = format!(
                "says there are {}, which need {least} bytes each at least; the file has no more \
                 than {most_bytes}: copy or export it again",
                element.count
            );
            return Err(Fault::new(format!("element {}", element.name), message));
        }
        match element.name.as_str() {
            "vertex" => vertices = Vertices::read(element, &mut numbers, loading)?,
            "face" => indices = faces(element, &mut numbers, loading)?,
            _ => skip(element, &mut numbers)?,
        }
    }
    let count = vertices.vertices.len();
    if let Some(at) = indices.iter().position(|&index| index as usize >= count) {
        let message = format!(
            "a face has vertex {}, but there are {count}; export the file again",
            indices[at]
        );
        return Err(Fault::new("element face", message));
    }
    loading
        .geometry
        .materials
        .push(plain_material(loading.options));
    let mesh = Mesh {
        name: String::from("ply"),
        vertices: vertices.vertices,
        indices,
        material: 0,
    };
    plain::add(mesh, vertices.normals_known, "element face", loading)
}

#[derive(Default)]
struct Vertices {
    vertices: Vec<Vertex>,
    normals_known: bool,
}

/// The properties that are read, in the order of a [`Vertex`]'s parts.
const SCALARS: [&[&str]; 10] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx", "normal_x"],
    &["ny", "normal_y"],
    &["nz", "normal_z"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
    &["alpha", "a"],
];

impl Vertices {
    fn read<R: BufRead>(
        element: &Element,
        numbers: &mut Numbers<R>,
        loading: &mut Loading,
    ) -> Result<Self, Fault> {
        // Where each property goes, if it goes anywhere.
        let slot = |property: &Property| {
            let known = |names: &&[&str]| names.contains(&property.name.as_str());
            SCALARS.iter().position(known)
        };
        let slots: Vec<Option<usize>> = element.properties.iter().map(slot).collect();
        let has = |all: std::ops::Range<usize>| all.clone().all(|s| slots.contains(&Some(s)));
        if !has(0..3) {
            let message = "has no x, y and z; they are needed";
            return Err(Fault::new("element vertex", message));
        }
        loading.budget.vertices("element vertex", element.count)?;
        let mut vertices = Vec::with_capacity(element.count as usize);
        for index in 0..element.count {
            let mut values = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
            for (property, slot) in element.properties.iter().zip(&slots) {
                match (property.list, slot) {
                    (None, Some(slot)) => {
                        let value = numbers.next(property.kind)?;
                        values[*slot] = component(value, *slot, property.kind);
                    }
                    _ => skip_property(property, numbers)?,
                }
            }
            if let Some(bad) = values.iter().find(|value| !value.is_finite()) {
                let message = format!("vertex {index} has {bad}; every number must be finite");
                return Err(Fault::new("element vertex", message));
            }
            vertices.push(vertex(values));
        }
        Ok(Self {
            vertices,
            normals_known: has(3..6),
        })
    }
}

/// Whole-number colours are sRGB, as scanners and cameras write them; real ones are
/// linear.
fn component(value: f64, slot: usize, kind: Kind) -> f32 {
    let value = value as f32;
    match (slot, kind.largest()) {
        (6..=8, Some(largest)) => srgb::decode((value / largest).clamp(0.0, 1.0)),
        (9, Some(largest)) => (value / largest).clamp(0.0, 1.0),
        _ => value,
    }
}

fn vertex([x, y, z, nx, ny, nz, r, g, b, a]: [f32; 10]) -> Vertex {
    Vertex {
        position_m: [x, y, z],
        normal: [nx, ny, nz],
        color: [r, g, b, a],
        ..plain::BLANK
    }
}

/// The faces as triangles: polygons are cut into fans.
fn faces<R: BufRead>(
    element: &Element,
    numbers: &mut Numbers<R>,
    loading: &mut Loading,
) -> Result<Vec<u32>, Fault> {
    let is_corners = |property: &Property| {
        property.list.is_some()
            && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
    };
    if !element.properties.iter().any(is_corners) {
        let message = "has no list vertex_indices; it is needed";
        return Err(Fault::new("element face", message));
    }
    let mut triangles = Vec::new();
    for face in 0..element.count {
        for property in &element.properties {
            let Some(length) = property.list.filter(|_| is_corners(property)) else {
                skip_property(property, numbers)?;
                continue;
            };
            let corners = numbers.length(length)?;
            let mut fan = [0_u32; 2];
            for corner in 0..corners {
                let index = numbers.next(property.kind)?;
                if !(0.0..=f64::from(u32::MAX)).contains(&index) || index.fract() != 0.0 {
                    let message = format!("face {face} has vertex {index}; export the file again");
                    return Err(Fault::new("element face", message));
                }
                let index = index as u32;
                match corner {
                    0 => fan[0] = index,
                    1 => fan[1] = index,
                    _ => {
                        loading.budget.corners("element face", 3)?;
                        triangles.extend([fan[0], fan[1], index]);
                        fan[1] = index;
                    }
                }
            }
        }
    }
    Ok(triangles)
}

fn skip<R: BufRead>(element: &Element, numbers: &mut Numbers<R>) -> Result<(), Fault> {
    if element.properties.is_empty() {
        // However many there are of nothing.
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            skip_property(property, numbers)?;
        }
    }
    Ok(())
}

fn skip_property<R: BufRead>(property: &Property, numbers: &mut Numbers<R>) -> Result<(), Fault> {
    let count = match property.list {
        Some(length) => numbers.length(length)?,
        None => 1,
    };
    for _ in 0..count {
        numbers.next(property.kind)?;
    }
    Ok(())
}
