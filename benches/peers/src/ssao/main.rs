//! Bevy's screen-space ambient occlusion beside Greyfield's: the same triangles, camera, radius,
//! picture size and adapter, frames in turn, each pass timed by timestamps on the encoder; and
//! how far each is from the ray-traced truth of the same points.

mod agreement;
mod ours;
mod passes;
mod read;
mod report;
mod scene;
mod theirs;
mod times;
mod truth;

use std::path::PathBuf;

use clap::Parser;
use greyfield::render::{Gpu, Renderer, View};
use greyfield::scene::VisibleSurfaces;
use indicatif::{ProgressBar, ProgressStyle};

use agreement::Agreement;
use ours::Contender;
use passes::OcclusionPasses;
use report::{Report, Row};
use scene::Scene;
use theirs::Theirs;
use times::Passes;
use truth::Truth;

/// What goes wrong is told and ends the program.
type Failure = Box<dyn std::error::Error>;

/// Frames of each before the first that counts: shaders are compiled in them.
const WARM_UP: usize = 3;

/// Frames of which Bevy's own diagnostics are asked, to hold our timestamps to.
const OWN_FRAMES: usize = 5;

/// Time Greyfield's occlusion beside Bevy's, and measure both against the ray-traced truth.
#[derive(Parser)]
#[command(
    after_help = "Example:\n  cargo run --release --manifest-path benches/peers/Cargo.toml --features bevy --bin ssao -- stimuli/scenes/atrium.toml"
)]
struct Arguments {
    /// A scene config of Greyfield's. Its materials are drawn white, without normal maps.
    scene: PathBuf,
    /// Greyfield's techniques, with what is to differ from their preset: gtao18:falloff=0.
    #[arg(long, value_delimiter = ',', default_value = "gtao18,vbao18")]
    technique: Vec<String>,
    /// Half widths of Greyfield's blur, pixels [default: the scene's own].
    #[arg(long, value_delimiter = ',', value_name = "N")]
    blur_px: Vec<u32>,
    /// Timed frames of each.
    #[arg(long, default_value_t = 21, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// Columns of the picture.
    #[arg(long, default_value_t = 1280)]
    width_px: u32,
    /// Rows of the picture.
    #[arg(long, default_value_t = 720)]
    height_px: u32,
    /// Standard error of the truth at which a pixel has had rays enough.
    #[arg(long, default_value_t = 0.01)]
    error: f64,
    /// Trace no rays: times only.
    #[arg(long)]
    times_only: bool,
    /// The graphics adapter whose name contains this [default: the fastest there is].
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Where to put the table and the pictures.
    #[arg(long, value_name = "DIR", default_value = "beside-bevy")]
    out: PathBuf,
}

fn main() {
    if let Err(error) = run(&Arguments::parse()) {
        eprintln!("error: {error}");
        std::process::exit(1);
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    std::fs::create_dir_all(&arguments.out)?;
    let progress = progress_bar();
    progress.set_message("scene");
    let size_px = (arguments.width_px, arguments.height_px);
    let scene = Scene::load(&arguments.scene, size_px)?;
    let contenders = contenders(arguments, &scene)?;
    let gpu = Gpu::open(arguments.adapter.as_deref())?;
    if gpu.timestamp_period_ns.is_none() {
        return Err(format!("{} cannot time passes", gpu.adapter.name).into());
    }
    let renderer = Renderer::new(gpu);
    let uploaded = renderer.upload(&scene.geometry)?;
    let mut view = renderer.view(&uploaded);
    let surfaces = view.visible_surfaces(contenders[0].request())?;

    progress.set_message("Bevy's first frames");
    let mut bevy = Theirs::new(&scene, renderer.gpu())?;
    let passes = bevy.passes(|| progress.tick())?;
    let drawn = read::read(&passes, size_px, scene.config.camera.near_m)?;
    let agreement = Agreement::new(&surfaces, &drawn);
    agreement.check()?;

    let times = timed(arguments, &contenders, &passes, &mut view, &progress)?;
    let mut images = vec![drawn.occlusion];
    for contender in &contenders {
        images.push(contender.occlusion(&mut view)?);
    }
    progress.set_message("Bevy's own diagnostics");
    let own_ms = bevy.own_diagnostics_ms(OWN_FRAMES, || progress.tick());
    let truths = truths(arguments, &scene, &surfaces, &progress)?;
    progress.finish_and_clear();
    let report = Report {
        scene: &scene,
        adapter: &renderer.gpu().adapter,
        agreement: &agreement,
        own_ms: &own_ms,
        rows: &rows(&contenders, times, images),
        truths: &truths,
    };
    report.print();
    report.write(&arguments.out)
}

fn truths(
    arguments: &Arguments,
    scene: &Scene,
    surfaces: &VisibleSurfaces,
    progress: &ProgressBar,
) -> Result<Vec<Truth>, Failure> {
    if arguments.times_only {
        return Ok(Vec::new());
    }
    progress.set_length(2 * surfaces.len() as u64);
    progress.set_position(0);
    let both = truth::both(&scene.geometry, surfaces, arguments.error, progress)?;
    Ok(both.into())
}

/// Bevy's row and then the contenders', as times and images are.
fn rows(contenders: &[Contender], times: Vec<Vec<Passes>>, images: Vec<[Vec<f32>; 2]>) -> Vec<Row> {
    let of = |contender: &Contender| (contender.label.clone(), Some(contender.blur_radius_px));
    let names = std::iter::once((String::from("bevy-high"), None)).chain(contenders.iter().map(of));
    names
        .zip(times)
        .zip(images)
        .map(|(((name, blur_radius_px), times), images)| Row {
            name,
            blur_radius_px,
            times,
            images,
        })
        .collect()
}

fn contenders(arguments: &Arguments, scene: &Scene) -> Result<Vec<Contender>, Failure> {
    let own = [scene.config.occlusion.blur_radius_px];
    let blurs = if arguments.blur_px.is_empty() {
        &own[..]
    } else {
        &arguments.blur_px
    };
    let mut contenders = Vec::new();
    for label in &arguments.technique {
        for &blur_px in blurs {
            contenders.push(Contender::new(scene, label, blur_px)?);
        }
    }
    if contenders.is_empty() {
        return Err("there is no technique to time".into());
    }
    Ok(contenders)
}

/// Frames of all in turn, so that what else the machine does meets all alike: Bevy's first, then
/// each contender's.
fn timed(
    arguments: &Arguments,
    contenders: &[Contender],
    bevy: &OcclusionPasses,
    view: &mut View<'_>,
    progress: &ProgressBar,
) -> Result<Vec<Vec<Passes>>, Failure> {
    let frames = WARM_UP + arguments.frames as usize;
    progress.set_message("frames");
    progress.set_length((frames * (1 + contenders.len())) as u64);
    progress.set_position(0);
    let mut times = vec![Vec::new(); 1 + contenders.len()];
    for frame in 0..frames {
        let mut took = vec![bevy.frame((arguments.width_px, arguments.height_px))?];
        progress.inc(1);
        for contender in contenders {
            took.push(contender.frame(view)?);
            progress.inc(1);
        }
        if frame >= WARM_UP {
            for (times, took) in times.iter_mut().zip(took) {
                times.push(took);
            }
        }
    }
    Ok(times)
}

fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::new(0);
    // A template that is wrong leaves the plain bar.
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} ({eta} left)") {
        bar.set_style(style);
    }
    bar
}
