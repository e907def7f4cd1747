//! What can go wrong between a scene and its picture.

/// A frame that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// No adapter at all.
    #[error(
        "no graphics adapter was found ({detail}). Greyfield draws with Vulkan, Metal or Direct3D 12; on a machine \
         without a GPU install Mesa's software Vulkan: `apt-get install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter {
        /// What was looked for.
        detail: String,
    },
    /// No adapter of the name asked for.
    #[error("no graphics adapter is called \"{wanted}\"; there are: {found}")]
    NoSuchAdapter {
        /// What the user named.
        wanted: String,
        /// What there is.
        found: String,
    },
    /// The adapter lacks something.
    #[error("the adapter \"{adapter}\" cannot be used: {message}")]
    Unsuitable {
        /// Its name.
        adapter: String,
        /// What it lacks, and which part needs it.
        message: String,
    },
    /// The request makes no sense.
    #[error("{0}")]
    Request(String),
    /// The driver gave up in the middle of the work.
    #[error("the graphics driver failed while drawing: {0}")]
    Device(String),
}
