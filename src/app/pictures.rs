//! The images of the trial that is on, decoded ahead of it; never more than one
//! trial's.

use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, TryRecvError};

use eframe::egui::{Context, TextureHandle};

use super::stimulus_view;
use crate::protocol::{Exhibit, SessionPlan, Trial};
use crate::session::start;
use crate::stimulus::Manifest;
use crate::stimulus::manifest::{ImageRecord, Picture};

/// The images of one session.
pub struct Pictures {
    folder: PathBuf,
    /// For each trial: its images by place, then the reference if there is one.
    trials: Vec<Vec<ImageRecord>>,
    held: Held,
}

type Decoded = Result<Vec<Picture>, String>;

enum Held {
    Nothing,
    Decoding {
        trial: usize,
        decoder: Receiver<Decoded>,
    },
    Ready {
        trial: usize,
        textures: Vec<TextureHandle>,
    },
    Failed {
        trial: usize,
        detail: String,
    },
}

impl Held {
    fn trial(&self) -> Option<usize> {
        match self {
            Self::Nothing => None,
            Self::Decoding { trial, .. }
            | Self::Ready { trial, .. }
            | Self::Failed { trial, .. } => Some(*trial),
        }
    }
}

impl Pictures {
    /// The images of a plan over the set in `folder`; nothing is read yet. `exhibits` are
    /// those the plan was made of. What the manifest lacks shows as a failure of its trial.
    #[must_use]
    pub fn new(
        folder: PathBuf,
        manifest: &Manifest,
        exhibits: &[Exhibit],
        plan: &SessionPlan,
    ) -> Self {
        let trials = plan.trials.iter();
        Self {
            folder,
            trials: trials
                .map(|trial| images(manifest, exhibits, trial).unwrap_or_default())
                .collect(),
            held: Held::Nothing,
        }
    }

    /// Starts decoding a trial's images beside the interface, and lets go of any
    /// other trial's. Call it as early as the trial is known, and as often as you
    /// like.
    pub fn prepare(&mut self, ctx: &Context, trial: usize) {
        if self.held.trial() != Some(trial) {
            self.decode(ctx, trial);
        }
        let Held::Decoding { decoder, .. } = &self.held else {
            return;
        };
        match decoder.try_recv() {
            Err(TryRecvError::Empty) => {}
            decoded => self.settle(ctx, trial, decoded.map_err(|_| ())),
        }
    }

    /// Reads the held trial's images again, after a failure was mended.
    pub fn retry(&mut self, ctx: &Context) {
        if let Held::Failed { trial, .. } = self.held {
            self.decode(ctx, trial);
        }
    }

    /// Lets go of every image.
    pub fn release(&mut self) {
        self.held = Held::Nothing;
    }

    /// The images of a trial by place, then the reference if there is one. Waits for the
    /// decoder if it is not done.
    ///
    /// # Errors
    /// Why there are none, for the experimenter.
    pub fn textures(&mut self, ctx: &Context, trial: usize) -> Result<&[TextureHandle], &str> {
        self.prepare(ctx, trial);
        if let Held::Decoding { decoder, .. } = &self.held {
            let decoded = decoder.recv().map_err(|_| ());
            self.settle(ctx, trial, decoded);
        }
        match &self.held {
            Held::Ready { textures, .. } => Ok(textures),
            Held::Failed { detail, .. } => Err(detail),
            Held::Nothing | Held::Decoding { .. } => Err("the image was not decoded"),
        }
    }

    fn decode(&mut self, ctx: &Context, trial: usize) {
        let images = self.trials.get(trial).cloned().unwrap_or_default();
        if images.is_empty() {
            self.held = Held::Failed {
                trial,
                detail: format!("the stimulus set has no images for trial {}", trial + 1),
            };
            return;
        };
        let (folder, ctx) = (self.folder.clone(), ctx.clone());
        let (sender, decoder) = mpsc::channel();
        std::thread::spawn(move || {
            let load = |image: &ImageRecord| image.load(&folder).map_err(|e| e.to_string());
            let decoded = images.iter().map(load).collect();
            // Nobody listens any more once the session has gone on without them.
            if sender.send(decoded).is_ok() {
                // Wakes the interface, so that the textures go to the GPU now and
                // not when the first image is due.
                ctx.request_repaint();
            }
        });
        self.held = Held::Decoding { trial, decoder };
    }

    /// Takes over what the decoder made; `Err` if it died.
    fn settle(&mut self, ctx: &Context, trial: usize, decoded: Result<Decoded, ()>) {
        let decoded =
            decoded.unwrap_or_else(|()| Err(String::from("the image decoder stopped early")));
        self.held = match decoded {
            Ok(pictures) => Held::Ready {
                trial,
                textures: pictures
                    .iter()
                    .map(|picture| stimulus_view::upload(ctx, "stimulus", picture))
                    .collect(),
            },
            Err(detail) => {
                tracing::error!(trial, detail, "cannot show a stimulus");
                Held::Failed { trial, detail }
            }
        };
    }
}

/// The images of a trial, by place, and the reference; `None` if one is not in the manifest.
fn images(manifest: &Manifest, exhibits: &[Exhibit], trial: &Trial) -> Option<Vec<ImageRecord>> {
    let exhibit = exhibits.get(trial.condition)?;
    let by_place = trial.places.iter().map(|&place| exhibit.images.get(place));
    let reference = exhibit.reference.iter().map(Some);
    by_place
        .chain(reference)
        .map(|at| start::image(manifest, *at?).cloned())
        .collect()
}
