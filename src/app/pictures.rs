//! The images of the trial that is on, decoded ahead of it; never more than one
//! trial's two.

use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, TryRecvError};

use eframe::egui::{Context, TextureHandle};

use super::stimulus_view;
use crate::protocol::{Position, SessionPlan};
use crate::stimulus::Manifest;
use crate::stimulus::manifest::{ImageRecord, Picture};

/// The images of one session.
pub struct Pictures {
    folder: PathBuf,
    /// For each trial: its two images, in the order shown.
    trials: Vec<[ImageRecord; 2]>,
    held: Held,
}

type Decoded = Result<[Picture; 2], String>;

enum Held {
    Nothing,
    Decoding {
        trial: usize,
        decoder: Receiver<Decoded>,
    },
    Ready {
        trial: usize,
        textures: [TextureHandle; 2],
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
    /// The images of a plan over the set in `folder`; nothing is read yet. A
    /// condition that the manifest lacks shows as a failure of its trial.
    #[must_use]
    pub fn new(folder: PathBuf, manifest: &Manifest, plan: &SessionPlan) -> Self {
        let images = |condition: &str, reversed: bool| {
            let pair = manifest
                .pairs
                .iter()
                .find(|pair| pair.condition == condition)?;
            let base = [pair.first.clone(), pair.second.clone()];
            let [first, second] = base;
            Some(if reversed {
                [second, first]
            } else {
                [first, second]
            })
        };
        Self {
            folder,
            trials: plan
                .trials
                .iter()
                .map_while(|trial| images(&plan.conditions[trial.condition].id, trial.reversed))
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

    /// One image of a trial. Waits for the decoder if it is not done.
    ///
    /// # Errors
    /// Why there is none, for the experimenter.
    pub fn texture(
        &mut self,
        ctx: &Context,
        trial: usize,
        position: Position,
    ) -> Result<&TextureHandle, &str> {
        self.prepare(ctx, trial);
        if let Held::Decoding { decoder, .. } = &self.held {
            let decoded = decoder.recv().map_err(|_| ());
            self.settle(ctx, trial, decoded);
        }
        match &self.held {
            Held::Ready { textures, .. } => Ok(match position {
                Position::First => &textures[0],
                Position::Second => &textures[1],
            }),
            Held::Failed { detail, .. } => Err(detail),
            Held::Nothing | Held::Decoding { .. } => Err("the image was not decoded"),
        }
    }

    fn decode(&mut self, ctx: &Context, trial: usize) {
        let Some(images) = self.trials.get(trial).cloned() else {
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
            let decoded = load(&images[0]).and_then(|first| Ok([first, load(&images[1])?]));
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
                textures: pictures.map(|picture| stimulus_view::upload(ctx, "stimulus", &picture)),
            },
            Err(detail) => {
                tracing::error!(trial, detail, "cannot show a stimulus");
                Held::Failed { trial, detail }
            }
        };
    }
}
