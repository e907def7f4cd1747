//! What accuracy costs in time, and what it buys: every technique at many settings on one scene,
//! its time beside its error to the ray-traced truth and beside what can be seen of it.
//!
//! ```text
//! configuration  one point of the sweep         truth     a picture's true occlusion
//! bench          one scene, measured on         measured  what comes of one configuration
//! error          occlusion against the truth    spread    median and interval of times
//! row            one line of cost.csv           front     what nothing else beats
//! sweep          configurations in turn         store     the folder they are kept in
//! bent_cones     light through bent cones against rays
//! ```

pub mod advise;
pub mod bench;
pub mod bent_cones;
pub mod configuration;
pub mod effects;
pub mod error;
pub mod front;
pub mod input;
pub mod measured;
pub mod recommend;
pub mod row;
pub mod scaling;
pub mod spread;
pub mod store;
pub mod sweep;
pub mod truth;
pub mod votes;

pub use bench::{BenchOptions, SceneBench};
pub use configuration::{Configuration, Grid, Resolution};
pub use measured::{ImageMeasured, Measured, Times};
pub use row::Row;
pub use store::Store;
pub use truth::{Subject, Truth, TruthOptions};

use crate::render::RenderError;
use crate::scene::SceneError;
use crate::stimulus::manifest::StimulusError;

/// A measurement that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CostError {
    /// The frame.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The files.
    #[error(transparent)]
    Files(#[from] StimulusError),
    /// What was asked for makes no sense for this scene.
    #[error("{0}")]
    Input(String),
}
