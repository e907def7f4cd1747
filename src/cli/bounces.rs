//! `greyfield bounces`: light between the points of a height field.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;
use serde::Serialize;

use super::{Failure, Verbosity};
use crate::reference::height_field::{
    Border, Bounces as Followed, HeightField, HeightMap, LinkSettings, Links, Stopped,
    TransportSettings, curves,
};
use crate::stimulus::files::{encode_occlusion, write_whole};

/// Follow light between the points of a height map, bounce after bounce.
///
/// Every texel sends rays over its whole hemisphere: those that meet nothing see a sky of unit
/// radiance, the others another texel. Writes the uniform occlusion, each bounce and their sum as
/// 16-bit PNG (65535 is a point in the open), the curves of irradiance over openness as CSV, and
/// bounces.json.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  greyfield bounces bricks --albedo 0.8\n  greyfield bounces height.png --amplitude 0.05 --rays 1024 --open"
)]
pub struct BouncesArgs {
    /// A grey image, or one of: bricks, pebbles, concrete, fbm, crevices, bowls, shapes.
    #[arg(value_name = "MAP")]
    map: String,
    /// Side of a map that is made, texels.
    #[arg(long, value_name = "N", default_value_t = 512)]
    size: usize,
    /// From the lowest to the highest, as a share of the map's width.
    #[arg(long, value_name = "A", default_value_t = 0.1)]
    amplitude: f32,
    /// Rays a texel, rounded up to a power of two.
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(16..=65_536))]
    rays: u32,
    /// Bounces at most.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(0..=1000))]
    bounces: u32,
    /// Share of the light that every texel sends back, 0 to 1.
    #[arg(long, value_name = "RHO", default_value_t = 1.0)]
    albedo: f32,
    /// The map ends at its border, instead of going on without end.
    #[arg(long)]
    open: bool,
    /// Seed of rays, and of a map that is made.
    #[arg(long, default_value_t = 2010)]
    seed: u64,
    /// Memory that may be used, GiB: links that do not fit are cast again for every bounce.
    #[arg(long, value_name = "G", default_value_t = 2.0)]
    memory: f64,
    /// Where to put everything [default: a folder named like the map with -bounces].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// `bounces.json`.
#[derive(Serialize)]
struct Record<'a> {
    schema_version: u32,
    app_version: &'static str,
    map: &'a str,
    size_px: (usize, usize),
    amplitude: f32,
    rays: usize,
    albedo: f32,
    border: Border,
    seed: u64,
    links_kept: bool,
    bounces: usize,
    stopped: Stopped,
    /// Mean irradiance of each bounce, as a share of a point's in the open.
    means: Vec<f64>,
}

/// Runs the command.
///
/// # Errors
/// Exit code 2 for a wrong map or setting; 1 for the disk.
pub fn run(args: &BouncesArgs, verbosity: Verbosity) -> Result<(), Failure> {
    check(args)?;
    let map = HeightMap::open(&args.map, args.size, args.seed).map_err(Failure::bad_input)?;
    if map.is_even() {
        eprintln!("note: the map is even: every point lies in the open");
    }
    let keeps = keeps_links(args, map.heights.len())?;
    let scale = args.amplitude * map.width as f32;
    let heights: Vec<f32> = map.heights.iter().map(|height| height * scale).collect();
    let border = if args.open {
        Border::Open
    } else {
        Border::Tiled
    };
    let field =
        HeightField::new((map.width, map.height), &heights, border).map_err(Failure::bad_input)?;
    let settings = LinkSettings {
        rays: args.rays as usize,
        seed: args.seed,
    };
    let bar = verbosity.progress(field.len() as u64);
    bar.set_message("casting rays");
    let links = match keeps {
        true => Links::cast(&field, &settings, &|texels| bar.inc(texels)),
        false => Links::recast(&field, &settings),
    };
    bar.set_message("following light");
    let albedo = vec![args.albedo; field.len()];
    let transport = TransportSettings {
        bounces: args.bounces as usize,
        ..TransportSettings::default()
    };
    let followed = Followed::follow(&links, &albedo, &transport);
    bar.finish_and_clear();
    let folder = args.out.clone().unwrap_or_else(|| beside(&args.map));
    write(
        args,
        &folder,
        (map.width, map.height),
        &followed,
        (links.rays(), keeps),
    )
}

fn check(args: &BouncesArgs) -> Result<(), Failure> {
    let wrong = |name: &str, found: f64, allowed: &str| {
        Err(Failure::bad_input(anyhow!(
            "--{name}: found {found}, allowed is {allowed}"
        )))
    };
    if !(0.0..=1.0).contains(&args.albedo) {
        return wrong("albedo", args.albedo.into(), "0 to 1");
    }
    if !(args.amplitude >= 0.0 && args.amplitude <= 100.0) {
        return wrong(
            "amplitude",
            args.amplitude.into(),
            "0 to 100 times the map's width",
        );
    }
    if !(2..=HeightField::LARGEST).contains(&args.size) {
        return wrong("size", args.size as f64, "2 to 16384");
    }
    match args.memory > 0.0 {
        true => Ok(()),
        false => wrong("memory", args.memory, "above 0"),
    }
}

/// Whether all links fit into the memory that may be used.
fn keeps_links(args: &BouncesArgs, texels: usize) -> Result<bool, Failure> {
    const GIB: f64 = (1_u64 << 30) as f64;
    // Heights, padded and of blocks, albedo, openness, what is sent, and every bounce.
    let rest = 4.0 * texels as f64 * (6.0 + f64::from(args.bounces)) / GIB;
    let links = Links::bytes(texels, (args.rays as usize).next_power_of_two()) as f64 / GIB;
    if rest > args.memory {
        return Err(Failure::bad_input(anyhow!(
            "{texels} texels and {} bounces need {rest:.1} GiB, and {} may be used; take a smaller map or fewer bounces, or allow \
             more with --memory",
            args.bounces,
            args.memory
        )));
    }
    let keeps = rest + links <= args.memory;
    if !keeps {
        eprintln!(
            "note: the links need {links:.1} GiB, and {:.1} may be used: rays are cast again for every bounce",
            args.memory - rest
        );
    }
    Ok(keeps)
}

fn beside(map: &str) -> PathBuf {
    let path = Path::new(map);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-bounces"))
}

fn write(
    args: &BouncesArgs,
    folder: &Path,
    size_px: (usize, usize),
    followed: &Followed,
    (rays, links_kept): (usize, bool),
) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|error| anyhow!("{} cannot be made: {error}", folder.display()))?;
    let image = |name: &str, values: &[f32]| -> Result<(), Failure> {
        let path = folder.join(format!("{name}.png"));
        let size = (size_px.0 as u32, size_px.1 as u32);
        Ok(write_whole(&path, &encode_occlusion(&path, values, size)?)?)
    };
    image("openness", &followed.openness)?;
    let share = |value: f32| value / std::f32::consts::PI;
    for (bounce, irradiance) in followed.irradiance.iter().enumerate() {
        let shares: Vec<f32> = irradiance.iter().copied().map(share).collect();
        image(&format!("irradiance-{bounce:02}"), &shares)?;
    }
    let texels = followed.openness.len();
    let sums: Vec<f32> = (0..texels)
        .map(|texel| share(followed.sum(texel)))
        .collect();
    image("irradiance-sum", &sums)?;
    let mut table = csv::Writer::from_writer(Vec::new());
    for point in curves(followed) {
        table.serialize(point)?;
    }
    let bytes = table
        .into_inner()
        .map_err(|error| anyhow!(error.to_string()))?;
    write_whole(&folder.join("curves.csv"), &bytes)?;
    let mean = |irradiance: &Vec<f32>| {
        irradiance.iter().map(|e| f64::from(share(*e))).sum::<f64>() / texels as f64
    };
    let record = Record {
        schema_version: 1,
        app_version: env!("CARGO_PKG_VERSION"),
        map: &args.map,
        size_px,
        amplitude: args.amplitude,
        rays,
        albedo: args.albedo,
        border: if args.open {
            Border::Open
        } else {
            Border::Tiled
        },
        seed: args.seed,
        links_kept,
        bounces: followed.irradiance.len() - 1,
        stopped: followed.stopped,
        means: followed.irradiance.iter().map(mean).collect(),
    };
    let text = serde_json::to_string_pretty(&record)? + "\n";
    write_whole(&folder.join("bounces.json"), text.as_bytes())?;
    say(&record, folder);
    Ok(())
}

fn say(record: &Record<'_>, folder: &Path) {
    let why = match record.stopped {
        Stopped::Enough => "as many as asked for",
        Stopped::Unseen => "the last adds less than half a level of 8 bits anywhere",
        Stopped::Dark => "nothing is sent back any more",
    };
    println!("{} bounces: {why}", record.bounces);
    for (bounce, mean) in record.means.iter().enumerate() {
        println!("  {bounce:>2}  {mean:.5} of a point's light in the open");
    }
    println!("in {}", folder.display());
}
