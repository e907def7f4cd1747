//! The application.

pub mod clock;
pub mod display;
pub mod error;
pub mod stimulus_view;
pub mod theme;
pub mod window;
