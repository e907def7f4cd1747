//! Material libraries (`.mtl`), as far as a matt or glossy plastic goes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::super::error::Fault;
use super::super::limits::Budget;
use super::super::uri::{self, Reference};
use super::super::{Loading, check_is_file, image, plain_material};
use super::lines::{Lines, at_line};
use crate::scene::{Material, Texture, TextureEncoding, Wrap};

/// The materials by name, and which of them are in use.
pub(super) struct Materials {
    known: BTreeMap<String, Material>,
    used: BTreeMap<String, usize>,
}

impl Materials {
    /// The geometry's material of that name; a plain one where no library has it.
    pub fn index(&mut self, name: &str, loading: &mut Loading) -> usize {
        if let Some(&index) = self.used.get(name) {
            return index;
        }
        let material = self.known.get(name).cloned().unwrap_or_else(|| {
            loading.warnings.say(
                "there are surfaces without a material: they are drawn matt grey (`albedo` and \
                 `roughness` change it)",
            );
            plain_material(loading.options)
        });
        loading.geometry.materials.push(material);
        let index = loading.geometry.materials.len() - 1;
        self.used.insert(name.to_owned(), index);
        index
    }
}

/// Reads the libraries an OBJ names; one that is not there is a warning, because OBJs
/// often come without.
pub(super) fn read(
    folder: &Path,
    libraries: &[String],
    loading: &mut Loading,
) -> Result<Materials, Fault> {
    let mut materials = Materials {
        known: BTreeMap::new(),
        used: BTreeMap::new(),
    };
    let mut textures = BTreeMap::new();
    for library in libraries {
        let Reference::File(path) = uri::resolve(folder, library, "mtllib")? else {
            continue;
        };
        if check_is_file(&path).is_err() {
            loading.warnings.say(format!(
                "there is no material library {}; its surfaces are drawn matt grey",
                path.display()
            ));
            continue;
        }
        for (name, entry) in entries(&path)? {
            let mut material = entry.material(&name);
            if let Some(file) = entry.albedo_map {
                let texture = match textures.get(&file) {
                    Some(&known) => known,
                    None => {
                        loading
                            .geometry
                            .textures
                            .push(texture(&file, &mut loading.budget)?);
                        let index = loading.geometry.textures.len() - 1;
                        textures.insert(file, index);
                        index
                    }
                };
                material.albedo_texture = Some(texture.into());
            }
            materials.known.insert(name, material);
        }
    }
    Ok(materials)
}

/// The textures a library names.
pub(super) fn textures(library: &Path) -> Result<Vec<PathBuf>, Fault> {
    let maps = entries(library)?
        .into_iter()
        .filter_map(|(_, entry)| entry.albedo_map);
    Ok(maps.collect())
}

/// What is read of a `newmtl`.
#[derive(Default)]
struct Entry {
    albedo: Option<[f32; 3]>,
    emission: [f32; 3],
    exponent: Option<f32>,
    albedo_map: Option<PathBuf>,
}

impl Entry {
    fn material(&self, name: &str) -> Material {
        let default = Material::default();
        Material {
            name: name.to_owned(),
            // A map replaces the colour in most programs that write these files.
            albedo: match (&self.albedo_map, self.albedo) {
                (Some(_), _) => [1.0; 3],
                (None, Some(albedo)) => albedo,
                (None, None) => default.albedo,
            },
            emission: self.emission,
            // Blinn-Phong's exponent n as a microfacet width: α² = 2/(n + 2) (Walter et
            // al. 2007), and perceptual roughness is the root of α.
            roughness: self.exponent.map_or(default.roughness, |n| {
                libm::powf(2.0 / (n.max(0.0) + 2.0), 0.25)
            }),
            ..default
        }
    }
}

/// The materials of a library, in its order.
fn entries(library: &Path) -> Result<Vec<(String, Entry)>, Fault> {
    let folder = library.parent().unwrap_or(Path::new(""));
    let at = |fault: Fault| {
        Fault::new(
            format!("{} {}", library.display(), fault.place),
            fault.message,
        )
    };
    let mut lines = Lines::open(library).map_err(at)?;
    let mut entries: Vec<(String, Entry)> = Vec::new();
    while let Some((number, line)) = lines.next_line().map_err(at)? {
        let place = at_line(number);
        let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        if key == "newmtl" {
            entries.push((rest.trim().to_owned(), Entry::default()));
            continue;
        }
        let Some((_, entry)) = entries.last_mut() else {
            continue;
        };
        match key {
            "Kd" => entry.albedo = Some(colour(rest, &place).map_err(at)?),
            "Ke" => entry.emission = colour(rest, &place).map_err(at)?,
            "Ns" => entry.exponent = rest.trim().parse().ok().filter(|n: &f32| n.is_finite()),
            "map_Kd" => {
                // Options stand before the name, which may have spaces of its own only
                // without them.
                let name = rest.trim();
                let name = if name.starts_with('-') {
                    name.rsplit(char::is_whitespace).next().unwrap_or(name)
                } else {
                    name
                };
                let name = name.replace('\\', "/");
                if let Reference::File(path) = uri::resolve(folder, &name, &place).map_err(at)? {
                    entry.albedo_map = Some(path);
                }
            }
            _ => {}
        }
    }
    Ok(entries)
}

fn colour(text: &str, place: &str) -> Result<[f32; 3], Fault> {
    let numbers: Vec<f32> = text
        .split_ascii_whitespace()
        .map_while(|word| word.parse().ok())
        .collect();
    match numbers.as_slice() {
        [r, g, b, ..] => Ok([*r, *g, *b].map(|c| c.clamp(0.0, 1.0))),
        [grey] => Ok([grey.clamp(0.0, 1.0); 3]),
        _ => {
            let message = format!("found the colour \"{text}\"; three numbers are needed");
            Err(Fault::new(place, message))
        }
    }
}

fn texture(file: &Path, budget: &mut Budget) -> Result<Texture, Fault> {
    let place = file.display().to_string();
    check_is_file(file).map_err(|fault| Fault::new(&place, fault.message))?;
    let encoded = std::fs::read(file).map_err(|error| Fault::unreadable(&place, &error))?;
    let picture = image::decode(&encoded, &place, budget)?;
    Ok(Texture {
        name: place,
        width_px: picture.width_px,
        height_px: picture.height_px,
        rgba8: picture.rgba8,
        encoding: TextureEncoding::Srgb,
        wrap: [Wrap::Repeat; 2],
    })
}
