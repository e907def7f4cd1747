//! Everything that takes longer than a frame: the scene on the GPU, its truth, measurements. On
//! a thread of its own, which owns all of it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::JoinHandle;

use eframe::egui::Context;

use super::queue::Newest;
use super::result::{Request, Shown, Slot};
use super::tuning::Tuning;
use crate::cost::{CostError, SceneBench, Subject, Truth};
use crate::render::{Gpu, GpuScene, Renderer};
use crate::stimulus::manifest::Picture;
use crate::stimulus::progress::Progress;

/// Truths that are kept, so that going back to a reach takes no time.
const TRUTHS: usize = 4;

/// What the worker says.
pub enum Report {
    /// The adapter is open.
    Adapter {
        /// As the driver names it.
        name: String,
        /// Whether its times are good for ratios only.
        is_software: bool,
    },
    /// Something that takes long has come so far.
    Progress {
        /// What it is.
        what: String,
        /// Share that is done, 0 to 1, where it can be said.
        share: Option<f32>,
    },
    /// Measured.
    Measured(Slot, Box<Shown>),
    /// One measurement cannot be made.
    Refused {
        /// Its number.
        number: u64,
        /// Why.
        detail: String,
    },
    /// Nothing can be measured at all.
    Failed(String),
}

/// What waits to be measured.
pub type Queue = Newest<Slot, Request>;

/// Starts the worker; the interface is woken at everything it says.
pub fn start(
    ctx: &Context,
    tuning: Tuning,
    queue: &Arc<Queue>,
) -> (Receiver<Report>, JoinHandle<()>) {
    let (sender, receiver) = mpsc::channel();
    let (queue, ctx) = (queue.clone(), ctx.clone());
    let thread = std::thread::spawn(move || {
        let mouth = Mouth { sender, ctx };
        if let Err(error) = work(&tuning, &queue, &mouth) {
            mouth.say(Report::Failed(error.to_string()));
        }
    });
    (receiver, thread)
}

/// How the worker says something.
struct Mouth {
    sender: Sender<Report>,
    ctx: Context,
}

impl Mouth {
    fn say(&self, report: Report) {
        // Nobody listens any more once the window is closed.
        if self.sender.send(report).is_ok() {
            self.ctx.request_repaint();
        }
    }

    fn step(&self, what: &str) {
        self.say(Report::Progress {
            what: what.to_owned(),
            share: None,
        });
    }
}

fn work(tuning: &Tuning, queue: &Queue, mouth: &Mouth) -> Result<(), CostError> {
    mouth.step("opening the adapter");
    let gpu = Gpu::open(tuning.adapter.as_deref())?;
    mouth.say(Report::Adapter {
        name: gpu.adapter.name.clone(),
        is_software: gpu.is_software,
    });
    let renderer = Renderer::new(gpu);
    mouth.step("reading the scene");
    let geometry = tuning.scene.geometry.load()?;
    if geometry.triangles() == 0 {
        return Err(CostError::Input(format!(
            "{}: the scene has no triangle, so that there is no occlusion to measure",
            tuning.scene.path.display()
        )));
    }
    let uploaded = renderer.upload(&geometry)?;
    drop(geometry);
    let mut worker = Worker {
        tuning,
        mouth,
        renderer: &renderer,
        uploaded: &uploaded,
        truths: Vec::new(),
        bench: None,
    };
    while let Some((slot, request)) = queue.take() {
        let number = request.number;
        mouth.say(match worker.measure(request) {
            Ok(shown) => Report::Measured(slot, Box::new(shown)),
            Err(error) => Report::Refused {
                number,
                detail: error.to_string(),
            },
        });
    }
    Ok(())
}

struct Worker<'a> {
    tuning: &'a Tuning,
    mouth: &'a Mouth,
    renderer: &'a Renderer,
    uploaded: &'a GpuScene,
    /// By reach, the newest last.
    truths: Vec<(f64, Truth)>,
    bench: Option<Lit<'a>>,
}

/// A bench, and what it is for.
struct Lit<'a> {
    lighting: String,
    reach_m: f64,
    bench: SceneBench<'a>,
    true_picture: Arc<Picture>,
}

impl<'a> Worker<'a> {
    fn measure(&mut self, request: Request) -> Result<Shown, CostError> {
        let mouth = self.mouth;
        let on = self.bench(&request)?;
        mouth.step("measuring");
        let measured = on.bench.measure(&request.configuration)?;
        let none = || CostError::Input(String::from("nothing was drawn"));
        Shown::new(request, measured, on.bench.truth(), &on.true_picture).ok_or_else(none)
    }

    /// The bench for a request: the one there is, or a new one on the same surfaces.
    fn bench(&mut self, request: &Request) -> Result<&mut Lit<'a>, CostError> {
        let serves =
            |kept: &Lit<'_>| kept.lighting == request.lighting && kept.reach_m == request.reach_m;
        if let Some(kept) = self.bench.take_if(|kept| serves(kept)) {
            return Ok(self.bench.insert(kept));
        }
        // Its textures make room before the next one's.
        self.bench = None;
        let truth = self.truth(request.reach_m)?;
        self.mouth
            .step(&format!("drawing the truth under {}", request.lighting));
        let bench = SceneBench::new(
            self.renderer,
            self.uploaded,
            &self.tuning.scene,
            std::slice::from_ref(&request.lighting),
            truth,
            self.tuning.bench(request.reach_m),
        )?;
        let drawn = bench.true_pictures().next();
        let (_, true_picture) =
            drawn.ok_or_else(|| CostError::Input(String::from("the truth could not be drawn")))?;
        Ok(self.bench.insert(Lit {
            lighting: request.lighting.clone(),
            reach_m: request.reach_m,
            true_picture: Arc::new(true_picture.clone()),
            bench,
        }))
    }

    fn truth(&mut self, reach_m: f64) -> Result<Truth, CostError> {
        if let Some((_, known)) = self.truths.iter().find(|(known, _)| *known == reach_m) {
            return Ok(known.clone());
        }
        let tuning = self.tuning;
        let subject = Subject {
            renderer: self.renderer,
            uploaded: self.uploaded,
            scene: &tuning.scene,
            size_px: tuning.size_px,
            seed: tuning.seed,
        };
        // Read again: it is large, and rarely needed.
        self.mouth.step("reading the scene");
        let geometry = tuning.scene.geometry.load()?;
        let tracing = Tracing::new(self.mouth, tuning.size_px);
        let truth = Truth::find(
            &subject,
            &geometry,
            &tuning.truth(reach_m),
            None,
            &Progress {
                step: &|what| self.mouth.step(what),
                pixels: &|count| tracing.advance(count),
            },
        )?;
        if self.truths.len() == TRUTHS {
            self.truths.remove(0);
        }
        self.truths.push((reach_m, truth.clone()));
        Ok(truth)
    }
}

/// How far the tracing of a truth has come; said at every new percent.
struct Tracing<'a> {
    mouth: &'a Mouth,
    pixels: u64,
    done: AtomicU64,
}

impl<'a> Tracing<'a> {
    fn new(mouth: &'a Mouth, (width_px, height_px): (u32, u32)) -> Self {
        Self {
            mouth,
            pixels: (u64::from(width_px) * u64::from(height_px)).max(1),
            done: AtomicU64::new(0),
        }
    }

    fn advance(&self, count: u64) {
        let before = self.done.fetch_add(count, Ordering::Relaxed);
        let percent = |done: u64| 100 * done / self.pixels;
        let now = percent(before + count);
        if now > percent(before) {
            self.mouth.say(Report::Progress {
                what: String::from("tracing the truth"),
                share: Some(now as f32 / 100.0),
            });
        }
    }
}
