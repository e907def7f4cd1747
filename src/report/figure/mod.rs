//! What figures of any report are made of.
//!
//! ```text
//! axis    scales with their ticks       labels   names without overlap
//! panel   one coordinate system         numbers  as people read them
//! sheet   size, title, keys, captions   words    names, sentences in lines
//! ```

pub mod axis;
pub mod labels;
pub mod numbers;
pub mod panel;
pub mod sheet;
pub mod words;
