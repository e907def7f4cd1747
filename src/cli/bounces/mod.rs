//! `greyfield bounces`: light between the points of height fields, and models of it.

mod albedo;
mod follow;
mod write;

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;

use self::albedo::Albedo;
use self::follow::{Followed, MapArg};
use super::{Failure, Verbosity};
use crate::reference::bounce_fit::{StudiedMap, Study, errors, fit_forms, fit_greyfield};
use crate::reference::height_field::{Border, HeightField};

/// Follow light between the points of height maps, bounce after bounce, and fit models to it.
///
/// Every texel sends rays over its whole hemisphere: those that meet nothing see a sky of unit
/// radiance, the others another texel. Writes the uniform occlusion, each bounce and their sum as
/// 16-bit PNG (65535 is a point in the open), the curves of irradiance over openness, what every model
/// of the registry misses on them, figures, and one page, bounces.html.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  greyfield bounces bricks --albedo 0.8,0.5,0.3\n  greyfield bounces height.png --amplitude 0.05 --rays 1024 --open --albedo colour.png\n  greyfield bounces fbm@0.2 pebbles concrete --fit --held-out bricks,crevices@0.05"
)]
pub struct BouncesArgs {
    /// Grey images, or some of: bricks, pebbles, concrete, fbm, crevices, bowls, shapes. A number behind
    /// an @ is that map's own amplitude.
    #[arg(required = true, value_name = "MAP")]
    maps: Vec<MapArg>,
    /// Maps that models are tried on and never fitted to.
    #[arg(long, value_name = "MAP", value_delimiter = ',')]
    held_out: Vec<MapArg>,
    /// Fit the published forms and ours to the maps, all alike.
    #[arg(long)]
    fit: bool,
    /// Follow light on the first map at these amplitudes, too.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    amplitudes: Vec<f64>,
    /// Side of a map that is made, texels.
    #[arg(long, value_name = "N", default_value_t = 512)]
    size: usize,
    /// From the lowest to the highest, as a share of a map's width.
    #[arg(long, value_name = "A", default_value_t = 0.1)]
    amplitude: f64,
    /// Rays a texel, rounded up to a power of two.
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(16..=65_536))]
    rays: u32,
    /// Bounces at most; it ends where the next adds less than half a level of 8 bits anywhere.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(0..=1000))]
    bounces: u32,
    /// Share of light that is sent back, for the pictures of the first map: a number from 0 to 1, three
    /// for red, green and blue, or an image of the map's size.
    #[arg(long, value_name = "RHO", default_value = "0.9,0.6,0.3")]
    albedo: Albedo,
    /// The maps end at their border, instead of going on without end.
    #[arg(long)]
    open: bool,
    /// Seed of rays, and of maps that are made.
    #[arg(long, default_value_t = 2010)]
    seed: u64,
    /// Memory that may be used, GiB: links that do not fit are cast again for every bounce.
    #[arg(long, value_name = "G", default_value_t = 2.0)]
    memory: f64,
    /// Where to put everything [default: a folder named like the first map with -bounces].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for a wrong map or setting; 1 for the disk.
pub fn run(args: &BouncesArgs, verbosity: Verbosity) -> Result<(), Failure> {
    check(args)?;
    // What cannot be read or does not fit is said before anything is followed.
    let asked: Vec<(&MapArg, bool)> = (args.maps.iter().map(|map| (map, false)))
        .chain(args.held_out.iter().map(|map| (map, true)))
        .collect();
    for (map, _) in &asked {
        map.source(args)?.0.allowed(args)?;
    }
    let folder = args
        .out
        .clone()
        .unwrap_or_else(|| beside(&args.maps[0].name));
    write::make(&folder)?;
    let mut maps: Vec<StudiedMap> = Vec::new();
    let mut pictures = (Vec::new(), [0.0; 3]);
    for (map, held_out) in asked {
        let followed = Followed::of(
            map,
            map.amplitude.unwrap_or(args.amplitude),
            args,
            verbosity,
        )?;
        let is_first = maps.is_empty();
        if is_first {
            pictures = albedo::pictures(&followed, args, verbosity)?;
        }
        let own = match args.maps.len() + args.held_out.len() {
            1 => folder.clone(),
            _ => folder.join(map.folder_name()),
        };
        write::map(&own, &followed, args)?;
        say(&followed, verbosity);
        maps.push(followed.studied(held_out));
    }
    let study = study(args, maps, pictures, verbosity)?;
    write::study(&folder, &study, args)?;
    write::say(&study);
    println!("in {}", folder.display());
    Ok(())
}

/// What the maps come to.
fn study(
    args: &BouncesArgs,
    maps: Vec<StudiedMap>,
    (pictures, albedo): (Vec<crate::reference::bounce_fit::ColourPicture>, [f64; 3]),
    verbosity: Verbosity,
) -> Result<Study, Failure> {
    let sweep = (args.amplitudes.iter())
        .map(|&amplitude| {
            let followed = Followed::of(&args.maps[0], amplitude, args, verbosity)?;
            Ok(followed.studied(false))
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    let (mut fits, mut refitted) = (Vec::new(), None);
    if args.fit {
        let fitted_to: Vec<_> = (maps.iter().filter(|map| !map.held_out))
            .map(|map| map.measured.clone())
            .collect();
        fits = fit_forms(&fitted_to).map_err(Failure::bad_input)?;
        let (coefficients, fit) = fit_greyfield(&fitted_to).map_err(Failure::bad_input)?;
        fits.push(fit);
        refitted = Some(coefficients);
    }
    Ok(Study {
        errors: errors(&maps, refitted.as_ref()),
        maps,
        sweep,
        fits,
        refitted,
        pictures,
        albedo,
    })
}

fn check(args: &BouncesArgs) -> Result<(), Failure> {
    let wrong = |name: &str, found: f64, allowed: &str| {
        Err(Failure::bad_input(anyhow!(
            "--{name}: found {found}, allowed is {allowed}"
        )))
    };
    let own = args.maps.iter().chain(&args.held_out);
    let amplitudes = own.filter_map(|map| map.amplitude);
    for amplitude in amplitudes
        .chain(args.amplitudes.iter().copied())
        .chain([args.amplitude])
    {
        if !(0.0..=100.0).contains(&amplitude) {
            return wrong("amplitude", amplitude, "0 to 100 times the map's width");
        }
    }
    if !(2..=HeightField::LARGEST).contains(&args.size) {
        return wrong("size", args.size as f64, "2 to 16384");
    }
    match args.memory > 0.0 {
        true => Ok(()),
        false => wrong("memory", args.memory, "above 0"),
    }
}

fn border(args: &BouncesArgs) -> Border {
    match args.open {
        true => Border::Open,
        false => Border::Tiled,
    }
}

fn beside(map: &str) -> PathBuf {
    let path = Path::new(map);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-bounces"))
}

/// How a map went.
fn say(followed: &Followed, verbosity: Verbosity) {
    if verbosity.quiet {
        return;
    }
    let bounces = &followed.bounces;
    println!(
        "{}: {} bounces, {}; {}",
        followed.label,
        bounces.irradiance.len() - 1,
        write::why(bounces.stopped),
        followed.speed()
    );
}
