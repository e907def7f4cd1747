//! Work that takes longer than a frame, done beside the interface.

use std::sync::mpsc::{self, Receiver, TryRecvError};

use eframe::egui::Context;

/// A value that is on its way, there, or will not come.
#[derive(Debug)]
pub enum Task<T> {
    /// Being made.
    Running(Receiver<Result<T, String>>),
    /// Made.
    Done(T),
    /// Why not.
    Failed(String),
}

impl<T: Send + 'static> Task<T> {
    /// Starts `work` on a thread of its own; the interface is woken when it is done.
    pub fn start(ctx: &Context, work: impl FnOnce() -> Result<T, String> + Send + 'static) -> Self {
        let (sender, receiver) = mpsc::channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            // Nobody listens any more once something else was selected.
            if sender.send(work()).is_ok() {
                ctx.request_repaint();
            }
        });
        Self::Running(receiver)
    }

    /// Takes the outcome over, once there is one; true if this call did.
    pub fn poll(&mut self) -> bool {
        let Self::Running(receiver) = self else {
            return false;
        };
        *self = match receiver.try_recv() {
            Ok(Ok(value)) => Self::Done(value),
            Ok(Err(detail)) => Self::Failed(detail),
            Err(TryRecvError::Empty) => return false,
            Err(TryRecvError::Disconnected) => {
                Self::Failed(String::from("stopped early; select it again"))
            }
        };
        true
    }
}
