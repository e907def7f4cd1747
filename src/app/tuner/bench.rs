//! What was asked of the worker, and what has come.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use eframe::egui::Context;

use super::result::{Request, Shown, Slot};
use super::tuning::Tuning;
use super::worker::{self, Queue, Report};
use crate::cost::Configuration;

/// How long a closing window waits for the worker: a driver that still draws while the program
/// ends may crash it. A measurement takes less; the tracing of a truth is not in a driver.
const PATIENCE: Duration = Duration::from_secs(2);

/// The worker from the interface's side.
pub struct Bench {
    queue: Arc<Queue>,
    reports: Receiver<Report>,
    worker: Option<JoinHandle<()>>,
    last_number: u64,
    held: [Held; 3],
    /// Reach of the truth that is measured against, metres.
    pub reach_m: f64,
    /// Name of the adapter, and whether its times are good for ratios only.
    pub adapter: Option<(String, bool)>,
    /// What takes long at the moment, and the share that is done.
    pub progress: Option<(String, Option<f32>)>,
    /// Why something could not be measured.
    pub trouble: Option<String>,
}

/// What is known of one slot.
#[derive(Default)]
struct Held {
    asked: Option<Request>,
    shown: Option<Arc<Shown>>,
}

impl Bench {
    /// Starts a worker.
    #[must_use]
    pub fn start(ctx: &Context, tuning: &Tuning) -> Self {
        let queue = Arc::default();
        let (reports, worker) = worker::start(ctx, tuning.clone(), &queue);
        Self {
            queue,
            reports,
            worker: Some(worker),
            last_number: 0,
            held: Default::default(),
            reach_m: tuning.reach_m,
            adapter: None,
            progress: None,
            trouble: None,
        }
    }

    /// What was measured last.
    #[must_use]
    pub fn shown(&self, slot: Slot) -> Option<&Shown> {
        self.held[slot as usize].shown.as_deref()
    }

    /// What was asked for last.
    #[must_use]
    pub fn request(&self, slot: Slot) -> Option<&Request> {
        self.held[slot as usize].asked.as_ref()
    }

    /// Whether what was asked for last has not come.
    #[must_use]
    pub fn is_waiting(&self, slot: Slot) -> bool {
        let held = &self.held[slot as usize];
        let shown = held.shown.as_ref().map(|shown| shown.request.number);
        held.asked
            .as_ref()
            .is_some_and(|asked| Some(asked.number) != shown)
    }

    /// Asks for a measurement, in the place of what was asked for this slot before.
    pub fn ask(&mut self, slot: Slot, configuration: Configuration, lighting: &str) {
        self.last_number += 1;
        let request = Request {
            number: self.last_number,
            configuration,
            lighting: lighting.to_owned(),
            reach_m: self.reach_m,
        };
        self.held[slot as usize].asked = Some(request.clone());
        self.queue.put(slot, request);
    }

    /// Asks for the same settings under this light and against the present truth.
    pub fn ask_again(&mut self, slots: [Slot; 2], lighting: &str) {
        for slot in slots {
            if let Some(asked) = self.request(slot) {
                self.ask(slot, asked.configuration.clone(), lighting);
            }
        }
    }

    /// Keeps what is asked for now, with its result once there is one.
    pub fn pin(&mut self, slot: Slot) {
        let Some(asked) = self.request(Slot::Now).cloned() else {
            return;
        };
        if self.is_waiting(Slot::Now) {
            // Not what is still shown, which has other settings.
            self.held[slot as usize].shown = None;
            self.ask(slot, asked.configuration, &asked.lighting);
            return;
        }
        let shown = self.held[Slot::Now as usize].shown.clone();
        self.held[slot as usize] = Held {
            asked: Some(asked),
            shown,
        };
    }

    /// Takes over what the worker has said.
    pub fn poll(&mut self) {
        loop {
            match self.reports.try_recv() {
                Ok(report) => self.take(report),
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => {
                    self.progress = None;
                    self.trouble.get_or_insert_with(|| {
                        String::from("The measuring stopped early; open the panel again.")
                    });
                    return;
                }
            }
        }
    }

    fn take(&mut self, report: Report) {
        match report {
            Report::Adapter { name, is_software } => self.adapter = Some((name, is_software)),
            Report::Progress { what, share } => self.progress = Some((what, share)),
            Report::Measured(slot, shown) => {
                self.progress = None;
                self.trouble = None;
                let held = &mut self.held[slot as usize];
                // One that was overtaken is still nearer to what is wanted than what is there; one
                // that was asked for before a pin took its place is wanted no more.
                let number = shown.request.number;
                let is_wanted = (held.asked.as_ref()).is_some_and(|asked| number <= asked.number);
                if is_wanted && is_newer(&shown, held.shown.as_deref()) {
                    held.shown = Some(Arc::from(shown));
                }
            }
            Report::Refused { number, detail } => {
                self.progress = None;
                // Of a request that was overtaken nobody wants to hear.
                if Slot::ALL.into_iter().any(|slot| {
                    self.request(slot)
                        .is_some_and(|asked| asked.number == number)
                }) {
                    self.trouble = Some(detail);
                }
            }
            Report::Failed(detail) => {
                self.progress = None;
                self.trouble = Some(detail);
            }
        }
    }
}

fn is_newer(shown: &Shown, than: Option<&Shown>) -> bool {
    than.is_none_or(|old| old.request.number < shown.request.number)
}

impl Drop for Bench {
    fn drop(&mut self) {
        self.queue.close();
        let deadline = Instant::now() + PATIENCE;
        let is_working = |worker: &JoinHandle<()>| !worker.is_finished();
        while self.worker.as_ref().is_some_and(is_working) && Instant::now() < deadline {
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}
