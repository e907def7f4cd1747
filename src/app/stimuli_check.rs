//! Whether the images are still the ones that were made, found out beside the
//! interface: hashing and decoding a set takes longer than a first frame may.

use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, TryRecvError};

use eframe::egui::Context;

use crate::stimulus::Manifest;

/// The check of one stimulus set.
#[derive(Debug)]
pub enum StimuliCheck {
    /// Not begun.
    Waiting,
    /// On its way.
    Running(Receiver<Result<(), String>>),
    /// Every image is there, unchanged.
    Passed,
    /// The first that is not, and why.
    Failed(String),
}

impl StimuliCheck {
    /// Starts checking every image of the set in `folder` against its manifest.
    #[must_use]
    pub fn start(ctx: &Context, manifest: Manifest, folder: PathBuf) -> Self {
        let (sender, receiver) = mpsc::channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let outcome = manifest.verify(&folder).map_err(|error| error.to_string());
            if sender.send(outcome).is_ok() {
                ctx.request_repaint();
            }
        });
        Self::Running(receiver)
    }

    /// Takes the outcome over, once there is one.
    pub fn poll(&mut self) {
        let Self::Running(receiver) = self else {
            return;
        };
        *self = match receiver.try_recv() {
            Ok(Ok(())) => Self::Passed,
            Ok(Err(detail)) => Self::Failed(detail),
            Err(TryRecvError::Disconnected) => {
                Self::Failed(String::from("the check stopped early; start again"))
            }
            Err(TryRecvError::Empty) => return,
        };
    }
}
