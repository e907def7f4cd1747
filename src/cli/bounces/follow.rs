//! One map, followed.

use std::str::FromStr;
use std::time::Instant;

use anyhow::anyhow;

use super::{BouncesArgs, border};
use crate::cli::{Failure, Verbosity};
use crate::reference::bounce_fit::{MapSettings, StudiedMap};
use crate::reference::height_field::{
    Bounces, HeightField, HeightMap, HeightSource, LinkSettings, Links, TransportSettings,
};

/// `NAME`, `FILE`, or either with `@AMPLITUDE`.
#[derive(Debug, Clone, PartialEq)]
pub struct MapArg {
    /// A file, or a map that is made.
    pub name: String,
    /// Its own amplitude, as a share of its width.
    pub amplitude: Option<f64>,
}

impl FromStr for MapArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let whole = || Self {
            name: text.to_owned(),
            amplitude: None,
        };
        // A file may have an @ in its name.
        if std::path::Path::new(text).is_file() {
            return Ok(whole());
        }
        match text.rsplit_once('@') {
            None => Ok(whole()),
            Some((name, amplitude)) => Ok(Self {
                name: name.to_owned(),
                amplitude: Some(amplitude.parse().map_err(|_| {
                    format!(
                        "found \"{amplitude}\" behind the @; a number is needed, as in {name}@0.2"
                    )
                })?),
            }),
        }
    }
}

/// A map that is there and fits.
pub struct Found {
    source: HeightSource,
    size_px: (usize, usize),
}

const GIB: f64 = (1_u64 << 30) as f64;

impl MapArg {
    /// Its source, and what it is called.
    pub fn source(&self, args: &BouncesArgs) -> Result<(Found, String), Failure> {
        let source = HeightSource::named(&self.name, args.size).map_err(Failure::bad_input)?;
        let size_px = source.size_px().map_err(Failure::bad_input)?;
        let name = source.name();
        Ok((Found { source, size_px }, name))
    }

    /// A folder of its own among those of several maps.
    pub fn folder_name(&self) -> String {
        let path = std::path::Path::new(&self.name);
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        match self.amplitude {
            Some(amplitude) => format!("{stem}@{amplitude}"),
            None => stem.into_owned(),
        }
    }
}

impl Found {
    /// Whether all links fit into the memory that may be used.
    ///
    /// # Errors
    /// Exit code 2 where not even the rest fits, with what it needs.
    pub fn allowed(&self, args: &BouncesArgs) -> Result<bool, Failure> {
        let (width, height) = self.size_px;
        let texels = width * height;
        // Heights as read, padded and of blocks, albedo, openness, what is sent, and every bounce.
        let rest = 4.0 * texels as f64 * (10.0 + f64::from(args.bounces)) / GIB;
        let links = Links::bytes(texels, (args.rays as usize).next_power_of_two()) as f64 / GIB;
        if rest > args.memory {
            return Err(Failure::bad_input(anyhow!(
                "{width}×{height} texels and {} bounces need {rest:.1} GiB (and their links {links:.1} GiB, or the time to cast \
                 them again), and {} may be used; take a smaller map or fewer bounces, or allow more with --memory",
                args.bounces,
                args.memory
            )));
        }
        let keeps = rest + links <= args.memory;
        if !keeps {
            tracing::info!("links need {links:.1} GiB: rays are cast again for every bounce");
        }
        Ok(keeps)
    }
}

/// A map on which light was followed at an albedo of 1.
pub struct Followed {
    pub name: String,
    /// The name with its amplitude.
    pub label: String,
    pub size_px: (usize, usize),
    pub amplitude: f64,
    pub heights: Vec<f32>,
    pub links: Links,
    pub links_kept: bool,
    pub bounces: Bounces,
    /// Of casting, and of following, seconds.
    pub cast_s: f64,
    pub followed_s: f64,
    settings: MapSettings,
}

impl Followed {
    /// Casts and follows.
    ///
    /// # Errors
    /// Exit code 2 for a map that makes no field.
    pub fn of(
        map: &MapArg,
        amplitude: f64,
        args: &BouncesArgs,
        verbosity: Verbosity,
    ) -> Result<Self, Failure> {
        let (found, name) = map.source(args)?;
        let links_kept = found.allowed(args)?;
        let bar = verbosity.progress((found.size_px.0 * found.size_px.1) as u64);
        bar.set_message(format!("{name}: heights"));
        let heights = found
            .source
            .heights(args.seed)
            .map_err(Failure::bad_input)?;
        let field = field_of(map, &heights, amplitude, args)?;
        let settings = LinkSettings {
            rays: args.rays as usize,
            seed: args.seed,
        };
        bar.set_message(format!("{name}: casting rays"));
        let began = Instant::now();
        let links = match links_kept {
            true => Links::cast(&field, &settings, &|texels| bar.inc(texels)),
            false => Links::recast(&field, &settings),
        };
        let cast_s = began.elapsed().as_secs_f64();
        bar.set_message(format!("{name}: following light"));
        let transport = TransportSettings {
            bounces: args.bounces as usize,
            ..TransportSettings::default()
        };
        let began = Instant::now();
        let bounces = Bounces::follow(&links, &vec![1.0; field.len()], &transport);
        bar.finish_and_clear();
        let label = format!("{name}@{amplitude}");
        Ok(Self {
            settings: MapSettings {
                name: label.clone(),
                size_px: found.size_px,
                amplitude,
                border: border(args),
                rays: links.rays(),
                held_out: false,
            },
            label,
            name,
            size_px: found.size_px,
            amplitude,
            heights: heights.heights,
            links,
            links_kept,
            bounces,
            cast_s,
            followed_s: began.elapsed().as_secs_f64(),
        })
    }

    /// What it says, without its texels.
    pub fn studied(self, held_out: bool) -> StudiedMap {
        let settings = MapSettings {
            held_out,
            ..self.settings
        };
        StudiedMap::of(settings, &self.bounces)
    }

    /// Rays, and how fast they were.
    pub fn speed(&self) -> String {
        let rays = (self.links.texels() * self.links.rays()) as f64;
        match self.links_kept {
            true => format!(
                "{:.1} M rays in {:.1} s ({:.2} M rays/s), bounces in {:.1} s",
                rays / 1e6,
                self.cast_s,
                rays / 1e6 / self.cast_s.max(1e-9),
                self.followed_s
            ),
            false => format!(
                "{:.1} M rays cast again for every bounce (links would not fit into --memory), in {:.1} s",
                rays / 1e6,
                self.followed_s
            ),
        }
    }
}

/// The field of a map at an amplitude.
fn field_of(
    map: &MapArg,
    heights: &HeightMap,
    amplitude: f64,
    args: &BouncesArgs,
) -> Result<HeightField, Failure> {
    if heights.is_even() {
        eprintln!("note: {} is even: every point lies in the open", map.name);
    }
    let scale = amplitude as f32 * heights.width as f32;
    let scaled: Vec<f32> = heights
        .heights
        .iter()
        .map(|height| height * scale)
        .collect();
    HeightField::new((heights.width, heights.height), &scaled, border(args))
        .map_err(|error| Failure::bad_input(anyhow!("{}: {error}", map.name)))
}
