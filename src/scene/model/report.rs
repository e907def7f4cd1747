//! What came in with a model, for people: how large it is, what it is made of, and
//! what of the file is not drawn as its author meant it.

use std::fmt;
use std::path::PathBuf;

use glam::Vec3;

use crate::scene::Geometry;

/// What was found in a model file.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelReport {
    /// The file.
    pub path: PathBuf,
    /// Corners of the box round the model as placed in the scene, metres.
    pub bounds_m: Option<(Vec3, Vec3)>,
    /// Triangles.
    pub triangles: usize,
    /// Vertices.
    pub vertices: usize,
    /// Meshes, an instance counted each.
    pub meshes: usize,
    /// Materials in use.
    pub materials: usize,
    /// Textures in use: how many, and their decoded size in bytes.
    pub textures: (usize, usize),
    /// Skins in the file.
    pub skins: usize,
    /// Animations in the file, in its order.
    pub animations: Vec<AnimationReport>,
    /// Directional lights, and point and spot lights.
    pub lights: (usize, usize),
    /// What somebody should know before trusting the picture.
    pub warnings: Vec<String>,
}

/// One animation of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct AnimationReport {
    /// Its name, empty if it has none.
    pub name: String,
    /// From the first to the last key frame's end, seconds.
    pub duration_s: f32,
    /// How many properties it moves.
    pub channels: usize,
}

/// Beyond this a model is probably not in metres.
const LARGE_M: f32 = 100.0;
/// Beyond this it is not in centimetres either.
const HUGE_M: f32 = 5_000.0;
/// Below this a model is probably not in metres.
const SMALL_M: f32 = 0.02;

impl ModelReport {
    pub(super) fn new(path: PathBuf, geometry: &Geometry, warnings: Warnings) -> Self {
        let mut report = Self {
            path,
            bounds_m: geometry.bounds_m(),
            triangles: geometry.triangles(),
            vertices: geometry.meshes.iter().map(|m| m.vertices.len()).sum(),
            meshes: geometry.meshes.len(),
            materials: geometry.materials.len(),
            textures: (
                geometry.textures.len(),
                geometry.textures.iter().map(|t| t.rgba8.len()).sum(),
            ),
            skins: 0,
            animations: Vec::new(),
            lights: (geometry.lights.suns.len(), geometry.lights.points.len()),
            warnings: Vec::new(),
        };
        report.warnings.extend(report.size_warning());
        report.warnings.extend(warnings.finish());
        report
    }

    /// Extent along x, y and z, metres; zero without vertices.
    #[must_use]
    pub fn size_m(&self) -> Vec3 {
        self.bounds_m.map_or(Vec3::ZERO, |(low, high)| high - low)
    }

    /// The size in one line.
    #[must_use]
    pub fn size_line(&self) -> String {
        let size = self.size_m();
        format!(
            "{} × {} × {} m (width, height, depth)",
            Metres(size.x),
            Metres(size.y),
            Metres(size.z)
        )
    }

    fn size_warning(&self) -> Option<String> {
        let largest = self.size_m().max_element();
        let (unit, scale) = if largest > HUGE_M {
            ("millimetres", "0.001")
        } else if largest > LARGE_M {
            ("centimetres", "0.01")
        } else if largest > 0.0 && largest < SMALL_M {
            ("decametres or larger units", "10 or more")
        } else {
            return None;
        };
        Some(format!(
            "{} m at its longest: is the file in {unit}? Try scale = {scale}",
            Metres(largest)
        ))
    }
}

/// A length with three significant digits.
struct Metres(f32);

impl fmt::Display for Metres {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let digits = match self.0.abs() {
            x if x >= 100.0 => 0,
            x if x >= 10.0 => 1,
            x if x >= 1.0 => 2,
            x if x >= 0.1 || x == 0.0 => 3,
            _ => 5,
        };
        write!(f, "{:.digits$}", self.0)
    }
}

impl fmt::Display for ModelReport {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}", self.path.display())?;
        writeln!(f, "  size        {}", self.size_line())?;
        if let Some((low, high)) = self.bounds_m {
            let point = |p: Vec3| format!("{}, {}, {}", Metres(p.x), Metres(p.y), Metres(p.z));
            writeln!(f, "  from, to    ({}) to ({})", point(low), point(high))?;
        }
        writeln!(
            f,
            "  triangles   {} of {} vertices in {} meshes",
            self.triangles, self.vertices, self.meshes
        )?;
        writeln!(
            f,
            "  materials   {}, with {} textures ({:.1} MiB decoded)",
            self.materials,
            self.textures.0,
            self.textures.1 as f64 / f64::from(1 << 20)
        )?;
        writeln!(f, "  skins       {}", self.skins)?;
        writeln!(f, "  animations  {}", self.animations.len())?;
        for (index, animation) in self.animations.iter().enumerate() {
            writeln!(
                f,
                "              {index} \"{}\", {:.3} s, {} channels",
                animation.name, animation.duration_s, animation.channels
            )?;
        }
        let (suns, points) = self.lights;
        writeln!(
            f,
            "  lights      {suns} directional, {points} point or spot"
        )?;
        for warning in &self.warnings {
            writeln!(f, "  warning: {warning}")?;
        }
        Ok(())
    }
}

/// Warnings while a file is read: each said once, and not without end.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    said: Vec<String>,
    dropped: usize,
}

/// A list longer than this is not read to its end anyway.
const MOST_WARNINGS: usize = 30;

impl Warnings {
    pub fn say(&mut self, warning: impl Into<String>) {
        let warning = warning.into();
        if self.said.contains(&warning) {
            return;
        }
        if self.said.len() == MOST_WARNINGS {
            self.dropped += 1;
        } else {
            self.said.push(warning);
        }
    }

    fn finish(mut self) -> Vec<String> {
        if self.dropped > 0 {
            self.said
                .push(format!("and {} more of these", self.dropped));
        }
        self.said
    }
}
