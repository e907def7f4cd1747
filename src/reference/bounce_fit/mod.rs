//! From light followed between the points of height fields to models of it: least squares, and what
//! the models then miss on maps they were not fitted to.
//!
//! ```text
//! measured       curves of a map: what a bin of openness receives, bounce by bounce
//! least_squares  the solver, with intervals
//! forms          the published forms and ours, fitted
//! validation     what a model misses on a map
//! study          all of it, for files and figures
//! ```

mod forms;
mod least_squares;
mod measured;
mod study;
mod validation;

pub use forms::{Fit, FitError, Term, fit_forms, fit_greyfield};
pub use least_squares::{Fitted, Unknown};
pub use measured::{LEAST_TEXELS, Measured, MeasuredBin};
pub use study::{ColourPicture, MapSettings, StudiedMap, Study, errors};
pub use validation::{Candidate, MapError, validate};

/// The albedos of the notes' figure, 0 to 1 by tenths.
pub const ALBEDOS: [f64; 11] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

#[cfg(test)]
mod tests;
