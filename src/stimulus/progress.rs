//! What a person who waits for images is told.

/// Told what is about to be made, and how far what takes long has come.
pub struct Progress<'a> {
    /// A step begins: what it is.
    pub step: &'a (dyn Fn(&str) + Sync),
    /// So many more pixels are traced, of the image that the last step named.
    pub pixels: &'a (dyn Fn(u64) + Sync),
}

impl Progress<'_> {
    /// Nobody waits.
    pub const SILENT: Progress<'static> = Progress {
        step: &|_| {},
        pixels: &|_| {},
    };
}
