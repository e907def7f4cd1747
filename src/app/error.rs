//! Why the application could not be opened.

/// The application could not be opened, or its window was lost.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// No display to open a window on.
    #[error(
        "no display to open a window on: {detail}; start it in a desktop session, or run scripted observers without a window with `--headless`"
    )]
    NoDisplay {
        /// What was looked for or what the display server said.
        detail: String,
    },
    /// No graphics adapter can draw to the window.
    #[error(
        "no graphics adapter can draw to the window: {detail}; install a Vulkan driver for your graphics card, or the software one of Debian and Ubuntu: `apt install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter {
        /// What was found.
        detail: String,
    },
    /// The window system failed.
    #[error("the window system failed: {0}")]
    WindowSystem(#[from] winit::error::EventLoopError),
}
