//! The folder of a sweep: `sweep.json` says what is measured, `cost.csv` has what was found so
//! far. A sweep that was stopped goes on where it stopped; a folder of another sweep is refused.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::CostError;
use super::configuration::Configuration;
use super::row::Row;
use crate::render::AdapterRecord;
use crate::stimulus::files::write_whole;
use crate::stimulus::manifest::StimulusError;

/// Version of the layout of `sweep.json` and `cost.json`.
const SCHEMA_VERSION: u32 = 1;

/// Name of the record.
const RECORD: &str = "sweep.json";

/// Name of the table.
pub const TABLE: &str = "cost.csv";

/// Name of the whole for machines.
const WHOLE: &str = "cost.json";

/// What all rows of a sweep have in common; rows of one sweep can be compared.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// Version of the layout.
    pub schema_version: u32,
    /// Greyfield's version.
    pub app_version: String,
    /// What draws.
    pub adapter: AdapterRecord,
    /// Whether the adapter is software, whose times are good for ratios only.
    pub is_software: bool,
    /// Size of the images, pixels.
    pub size_px: (u32, u32),
    /// Seed of kernels, noise and rays.
    pub seed: u64,
    /// Standard error of the truth at each pixel.
    pub truth_error: f64,
    /// Pixels a degree of the viewer's field of view, for FLIP.
    pub pixels_per_degree: f32,
}

/// A scene of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneRecord {
    /// SHA-256 of its config and of the files of its model and environment.
    pub sha256: String,
    /// Distance from which on nothing occludes in the truth, metres.
    pub reach_m: f64,
}

/// One run of the program on a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunRecord {
    /// When it began.
    pub date: String,
    /// The command line.
    pub command: String,
}

/// `sweep.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepRecord {
    /// What all rows have in common.
    pub about: About,
    /// By id.
    pub scenes: BTreeMap<String, SceneRecord>,
    /// In order.
    pub runs: Vec<RunRecord>,
}

impl About {
    /// The current layout.
    pub const SCHEMA_VERSION: u32 = SCHEMA_VERSION;

    /// What of another sweep is not as here: a sentence for each.
    fn differences(&self, other: &Self) -> Vec<String> {
        let mut found = Vec::new();
        let mut compare = |name: &str, here: String, there: String| {
            if here != there {
                found.push(format!("{name} was {there} and is {here}"));
            }
        };
        compare(
            "the layout",
            self.schema_version.to_string(),
            other.schema_version.to_string(),
        );
        compare(
            "Greyfield",
            self.app_version.clone(),
            other.app_version.clone(),
        );
        let adapter = |about: &Self| format!("{} ({})", about.adapter.name, about.adapter.driver);
        compare("the adapter", adapter(self), adapter(other));
        let size = |about: &Self| format!("{}×{}", about.size_px.0, about.size_px.1);
        compare("the size", size(self), size(other));
        compare("the seed", self.seed.to_string(), other.seed.to_string());
        compare(
            "the truth's error",
            self.truth_error.to_string(),
            other.truth_error.to_string(),
        );
        let degree = |about: &Self| format!("{:.2}", about.pixels_per_degree);
        compare("pixels a degree", degree(self), degree(other));
        found
    }
}

/// The folder, open.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    /// What is measured.
    pub record: SweepRecord,
    /// What was found so far.
    pub rows: Vec<Row>,
}

impl Store {
    /// Opens a folder for a run, makes it where it is not there.
    ///
    /// # Errors
    /// [`CostError::Input`] for a folder of another sweep or a damaged one; [`CostError::Files`].
    pub fn open(
        folder: &Path,
        about: About,
        scenes: BTreeMap<String, SceneRecord>,
        run: RunRecord,
    ) -> Result<Self, CostError> {
        std::fs::create_dir_all(folder).map_err(|source| StimulusError::Unwritable {
            path: folder.to_owned(),
            source,
        })?;
        let mut store = match Self::load(folder)? {
            Some(store) => store,
            None => Self {
                folder: folder.to_owned(),
                record: SweepRecord {
                    about: about.clone(),
                    scenes: BTreeMap::new(),
                    runs: Vec::new(),
                },
                rows: Vec::new(),
            },
        };
        let mut differences = about.differences(&store.record.about);
        for (id, scene) in &scenes {
            match store.record.scenes.get(id) {
                Some(known) if known.sha256 != scene.sha256 => {
                    differences.push(format!("scene {id} has changed"));
                }
                Some(known) if known.reach_m != scene.reach_m => {
                    let (was, is) = (known.reach_m, scene.reach_m);
                    differences.push(format!("the reach in {id} was {was} m and is {is} m"));
                }
                _ => {}
            }
        }
        if !differences.is_empty() {
            return Err(CostError::Input(format!(
                "{} holds another sweep: {}. Name another folder with --out, or remove this one",
                folder.display(),
                differences.join("; ")
            )));
        }
        store.record.scenes.extend(scenes);
        store.record.runs.push(run);
        store.write(RECORD, &json(&store.record)?)?;
        Ok(store)
    }

    /// What a folder holds; `None` where there is no sweep.
    ///
    /// # Errors
    /// [`CostError::Input`] naming what cannot be read.
    pub fn load(folder: &Path) -> Result<Option<Self>, CostError> {
        let path = folder.join(RECORD);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(damaged(&path, &error)),
        };
        let record = serde_json::from_str(&text).map_err(|error| damaged(&path, &error))?;
        let table = folder.join(TABLE);
        let mut rows = Vec::new();
        if table.exists() {
            let mut reader = csv::Reader::from_path(&table).map_err(|e| damaged(&table, &e))?;
            for row in reader.deserialize() {
                rows.push(row.map_err(|error| damaged(&table, &error))?);
            }
        }
        Ok(Some(Self {
            folder: folder.to_owned(),
            record,
            rows,
        }))
    }

    /// Where a file of this name lies in the folder.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Which run this is, from 1.
    #[must_use]
    pub fn run(&self) -> u32 {
        u32::try_from(self.record.runs.len()).unwrap_or(u32::MAX)
    }

    /// Whether a configuration of a scene is measured under all of these lightings.
    #[must_use]
    pub fn has(&self, scene: &str, configuration: &Configuration, lightings: &[String]) -> bool {
        let (id, parameters) = (configuration.id(), configuration.parameters());
        lightings.iter().all(|lighting| {
            self.rows.iter().any(|row| {
                row.scene == scene
                    && row.lighting == *lighting
                    && row.configuration == id
                    && row.parameters == parameters
            })
        })
    }

    /// Adds the rows of a configuration, in place of what was known of it, and writes the table.
    ///
    /// # Errors
    /// [`CostError::Files`]; the table on disk then is the one before.
    pub fn add(&mut self, new: Vec<Row>) -> Result<(), CostError> {
        let is_same = |a: &Row, b: &Row| {
            (&a.scene, &a.lighting, &a.configuration) == (&b.scene, &b.lighting, &b.configuration)
        };
        self.rows
            .retain(|row| !new.iter().any(|new| is_same(new, row)));
        self.rows.extend(new);
        let path = self.path(TABLE);
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in &self.rows {
            writer
                .serialize(row)
                .map_err(|error| damaged(&path, &error))?;
        }
        let bytes = writer
            .into_inner()
            .map_err(|error| damaged(&path, &error))?;
        self.write(TABLE, &bytes)
    }

    /// Writes the whole for machines.
    ///
    /// # Errors
    /// [`CostError::Files`].
    pub fn finish(&self) -> Result<(), CostError> {
        #[derive(Serialize)]
        struct Whole<'a> {
            #[serde(flatten)]
            record: &'a SweepRecord,
            rows: &'a [Row],
        }
        let whole = Whole {
            record: &self.record,
            rows: &self.rows,
        };
        self.write(WHOLE, &json(&whole)?)
    }

    /// Writes a file into the folder, whole or not at all.
    ///
    /// # Errors
    /// [`CostError::Files`].
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), CostError> {
        Ok(write_whole(&self.path(name), bytes)?)
    }
}

fn json(value: &impl Serialize) -> Result<Vec<u8>, CostError> {
    let text = serde_json::to_string_pretty(value);
    let text = text.map_err(|error| CostError::Input(error.to_string()))?;
    Ok((text + "\n").into_bytes())
}

fn damaged(path: &Path, error: &dyn std::fmt::Display) -> CostError {
    CostError::Input(format!(
        "{} cannot be used: {error}. Mend or remove it, or name another folder with --out",
        path.display()
    ))
}
