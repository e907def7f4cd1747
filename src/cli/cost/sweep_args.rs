//! What `cost` and `advise` are told alike: what is measured, how, and where it is kept.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::{Failure, Verbosity, size};
use crate::config;
use crate::cost::input::{Asked, Wishes};
use crate::cost::store::{About, RunRecord};
use crate::cost::{CostError, Grid, Resolution, Store};
use crate::protocol::Protocol;
use crate::render::technique::Technique;
use crate::render::{Gpu, Renderer, Repeats};
use crate::stimulus::flip::Viewing;

/// What is measured, how, and where it is kept.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// Techniques [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    techniques: Option<Vec<String>>,
    /// Resolutions of the occlusion.
    #[arg(
        long,
        value_name = "LIST",
        value_delimiter = ',',
        value_enum,
        default_value = "full,half"
    )]
    resolution: Vec<ResolutionArg>,
    /// Half widths of the blur, pixels [default: the scene's own, and 0].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(0..=32))]
    blur: Option<Vec<u32>>,
    /// Lighting variants [default: of a scene all, of a set those that it shows].
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    lighting: Option<Vec<String>>,
    /// Distance from which on nothing occludes, metres [default: as far as the scene lets gtao look].
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    radius: Option<f64>,
    /// Size of the images, pixels [default: the set's, or 1280x720].
    #[arg(long, value_name = "WxH", value_parser = size::size)]
    size: Option<(u32, u32)>,
    /// Frames timed of each configuration.
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: u32,
    /// Seconds after which a configuration has been timed enough, if six frames were.
    #[arg(long, value_name = "S", default_value_t = 2.0)]
    within: f64,
    /// Time by the wall clock, even where the adapter has timestamps.
    #[arg(long)]
    wall_clock: bool,
    /// Standard error of the truth at each pixel.
    #[arg(long, value_name = "E", default_value_t = 0.01)]
    truth_error: f64,
    /// Pixels that a degree of the viewer's field of view spans, for FLIP [default: the
    /// protocol's, or 67.02: a 0.7 m wide display of 3840 pixels at 0.7 m].
    #[arg(long, value_name = "N")]
    pixels_per_degree: Option<f32>,
    /// Protocol of the study, which says how its participants see the images.
    #[arg(long, value_name = "PROTOCOL", conflicts_with = "pixels_per_degree")]
    protocol: Option<PathBuf>,
    /// Seed of kernels, noise and rays [default: the set's, or 2010].
    #[arg(long)]
    seed: Option<u64>,
    /// Where to put everything [default: a folder named like the first file with -cost, beside it].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Measure the graphics adapter whose name contains this.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Fewer frames tell no 95 % interval of their median.
const FEWEST_FRAMES: u32 = 6;

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum ResolutionArg {
    Full,
    Half,
}

/// What is there before anything is measured.
pub struct Opened {
    /// What is to be measured.
    pub asked: Asked,
    /// On what.
    pub renderer: Renderer,
    /// Where it is kept.
    pub store: Store,
}

impl SweepArgs {
    /// How long times are taken.
    #[must_use]
    pub fn repeats(&self) -> Repeats {
        Repeats {
            frames: self.frames,
            at_least: FEWEST_FRAMES.min(self.frames),
            within_s: self.within,
            wall_clock: self.wall_clock,
        }
    }

    /// The techniques.
    ///
    /// # Errors
    /// [`CostError::Input`] for a name that there is no technique of.
    pub fn techniques(&self) -> Result<Vec<&'static Technique>, CostError> {
        match &self.techniques {
            Some(names) => Grid::techniques(names),
            None => Ok(Grid::all_techniques()),
        }
    }

    /// Reads the files, opens the adapter and the folder, and says what the person who waits
    /// should know.
    ///
    /// # Errors
    /// Exit code 2 for wrong files, names or a folder of another sweep; 1 for adapter and disk.
    pub fn open(
        &self,
        files: &[PathBuf],
        samples: &[u32],
        verbosity: Verbosity,
    ) -> Result<Opened, Failure> {
        let asked = self.asked(files, samples).map_err(super::failure)?;
        let pixels_per_degree = self.pixels_per_degree().map_err(super::failure)?;
        if !verbosity.quiet {
            asked
                .left_out
                .iter()
                .for_each(|sentence| eprintln!("note: {sentence}"));
        }
        let renderer = Renderer::new(Gpu::open(self.adapter.as_deref())?);
        if !verbosity.quiet {
            note_clock(renderer.gpu(), self.wall_clock);
        }
        let about = About {
            schema_version: About::SCHEMA_VERSION,
            app_version: env!("CARGO_PKG_VERSION").to_owned(),
            adapter: renderer.gpu().adapter.clone(),
            is_software: renderer.gpu().is_software,
            size_px: self.size.or(asked.size_px).unwrap_or((1280, 720)),
            seed: self.seed.or(asked.seed).unwrap_or(2010),
            truth_error: self.truth_error,
            pixels_per_degree,
        };
        let scenes = (asked.sweeps.iter())
            .map(|sweep| Ok((sweep.scene.id.clone(), sweep.record()?)))
            .collect::<Result<_, CostError>>()
            .map_err(super::failure)?;
        let folder = self.out.clone().unwrap_or_else(|| beside(&files[0]));
        let store = Store::open(&folder, about, scenes, this_run()).map_err(super::failure)?;
        Ok(Opened {
            asked,
            renderer,
            store,
        })
    }

    fn asked(&self, files: &[PathBuf], samples: &[u32]) -> Result<Asked, CostError> {
        let in_range =
            |name: &str, value: f64, low: f64, high: f64| match value > low && value <= high {
                true => Ok(()),
                false => Err(CostError::Input(format!(
                    "--{name}: found {value}, allowed is above {low} to {high}"
                ))),
            };
        in_range("radius", self.radius.unwrap_or(1.0), 0.0, 100_000.0)?;
        in_range("truth-error", self.truth_error, 1e-4, 0.5)?;
        in_range("within", self.within, 0.0, 86_400.0)?;
        let grid = Grid {
            techniques: self.techniques()?,
            samples: samples.to_vec(),
            resolutions: (self.resolution.iter())
                .map(|resolution| match resolution {
                    ResolutionArg::Full => Resolution::Full,
                    ResolutionArg::Half => Resolution::Half,
                })
                .collect(),
            blurs_px: self.blur.clone(),
            reach_m: 0.0,
        };
        let wishes = Wishes {
            lightings: self.lighting.clone(),
            reach_m: self.radius,
        };
        Asked::read(files, &grid, &wishes)
    }

    fn pixels_per_degree(&self) -> Result<f32, CostError> {
        let said = |message: String| CostError::Input(message);
        if let Some(path) = &self.protocol {
            let protocol = config::read(path).and_then(|text| Protocol::parse(path, &text));
            let protocol = protocol.map_err(|error| said(error.to_string()))?;
            let viewing = protocol.viewing.map(|viewing| Viewing {
                distance_m: viewing.distance_m.get(),
                display_width_m: viewing.display_width_m.get(),
                display_width_px: viewing.display_width_px.get() as f32,
            });
            return viewing.map(Viewing::pixels_per_degree).ok_or_else(|| {
                said(format!(
                    "{} does not say how participants see the images; add a table [viewing] with distance_m, \
                     display_width_m and display_width_px",
                    path.display()
                ))
            });
        }
        let found = self
            .pixels_per_degree
            .unwrap_or_else(|| Viewing::default().pixels_per_degree());
        match (1.0..=1000.0).contains(&found) {
            true => Ok(found),
            false => Err(said(format!(
                "--pixels-per-degree: found {found}, allowed is 1 to 1000"
            ))),
        }
    }
}

/// A folder beside a file, named like it.
fn beside(file: &Path) -> PathBuf {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    file.with_file_name(format!("{stem}-cost"))
}

/// Date and command line of this run.
fn this_run() -> RunRecord {
    let date = time::OffsetDateTime::now_utc().date();
    let args: Vec<String> = std::env::args().skip(1).collect();
    RunRecord {
        date: date.to_string(),
        command: format!("greyfield {}", args.join(" ")),
    }
}

fn note_clock(gpu: &Gpu, wall_clock: bool) {
    let name = &gpu.adapter.name;
    if gpu.timestamp_period_ns.is_none() && !wall_clock {
        eprintln!(
            "note: the adapter \"{name}\" has no timestamps; times are the wall clock's, from handing a frame over \
             until it is done, and passes cannot be told apart"
        );
    }
    if gpu.is_software {
        eprintln!("note: \"{name}\" is a software adapter: its times are good for ratios only");
    }
}
