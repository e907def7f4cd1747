//! The pair that is looked at: both pictures, their difference, and its numbers.

use std::path::PathBuf;

use eframe::egui::{Context, TextureHandle};

use crate::app::background::Task;
use crate::app::stage::upload;
use crate::stimulus::difference::{Difference, difference_picture};
use crate::stimulus::manifest::{PairRecord, Picture};

/// By how much the difference can be amplified.
pub const GAINS: [u32; 3] = [1, 4, 16];

/// The pictures of one pair, decoded and compared.
pub struct Loaded {
    /// First and second.
    pub pictures: [Picture; 2],
    /// How they differ, or why that cannot be said.
    pub difference: Result<Difference, String>,
}

/// One pair on its way to the screen.
pub struct Pair {
    loading: Task<Loaded>,
    textures: Option<[TextureHandle; 2]>,
    differences: [Option<TextureHandle>; GAINS.len()],
}

impl Pair {
    /// Starts reading and comparing the images of a pair in `folder`.
    #[must_use]
    pub fn load(ctx: &Context, folder: PathBuf, record: PairRecord) -> Self {
        let work = move || {
            let load = |image: &crate::stimulus::ImageRecord| {
                image.load(&folder).map_err(|error| error.to_string())
            };
            let pictures = [load(&record.first)?, load(&record.second)?];
            let difference =
                Difference::between(&pictures[0], &pictures[1]).map_err(|e| e.to_string());
            Ok(Loaded {
                pictures,
                difference,
            })
        };
        Self {
            loading: Task::start(ctx, work),
            textures: None,
            differences: std::array::from_fn(|_| None),
        }
    }

    /// How it stands.
    pub fn poll(&mut self, ctx: &Context) -> &Task<Loaded> {
        self.loading.poll();
        if let (Task::Done(loaded), None) = (&self.loading, &self.textures) {
            // Both at once, so that neither has to be uploaded when the other is flipped away.
            let [first, second] = &loaded.pictures;
            self.textures = Some([upload(ctx, "first", first), upload(ctx, "second", second)]);
        }
        &self.loading
    }

    /// The pictures, once they are there.
    #[must_use]
    pub fn loaded(&self) -> Option<&Loaded> {
        match &self.loading {
            Task::Done(loaded) => Some(loaded),
            _ => None,
        }
    }

    /// Both pictures as textures, once they are there.
    #[must_use]
    pub fn textures(&self) -> Option<&[TextureHandle; 2]> {
        self.textures.as_ref()
    }

    /// The difference, amplified by one of [`GAINS`]; made when it is first asked for.
    pub fn difference(&mut self, ctx: &Context, gain: u32) -> Option<&TextureHandle> {
        let slot = GAINS.iter().position(|known| *known == gain)?;
        if self.differences[slot].is_none() {
            let [first, second] = &self.loaded()?.pictures;
            let picture = difference_picture(first, second, gain).ok()?;
            self.differences[slot] = Some(upload(ctx, "difference", &picture));
        }
        self.differences[slot].as_ref()
    }
}
