//! The display: is there one, what is it, is it good enough for these images.

use std::path::Path;

use eframe::egui;
use winit::window::Window;

use super::stimulus_view::{SizePx, surface_px};

/// What is known about the display a window stands on.
#[derive(Debug, Clone, PartialEq)]
pub struct DisplayFacts {
    /// Size of the monitor, physical pixels; unknown on some systems.
    pub monitor_px: Option<SizePx>,
    /// Size of the window's content, physical pixels.
    pub window_px: SizePx,
    /// As the system states it, in hertz; not measured.
    pub refresh_hz: Option<f64>,
    /// Physical pixels a point of the interface.
    pub scale_factor: f32,
    /// Whether the window covers the monitor.
    pub full_screen: bool,
}

/// The display is too small for the study's images.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "the {what} is {}×{} pixels, the images are {}×{}: {mend}. Images are never scaled.",
    found_px[0], found_px[1], image_px[0], image_px[1]
)]
pub struct DisplayTooSmall {
    /// `monitor` or `window`.
    what: &'static str,
    found_px: SizePx,
    image_px: SizePx,
    mend: &'static str,
}

impl DisplayFacts {
    /// Reads what egui and the window system know now.
    #[must_use]
    pub fn read(ctx: &egui::Context, window: Option<&Window>) -> Self {
        let monitor = window.and_then(Window::current_monitor);
        Self {
            monitor_px: monitor
                .as_ref()
                .map(|monitor| monitor.size().into())
                // Some window systems report a monitor of no size while it changes.
                .filter(|size: &SizePx| size[0] > 0 && size[1] > 0),
            window_px: surface_px(ctx),
            refresh_hz: monitor
                .and_then(|monitor| monitor.refresh_rate_millihertz())
                .map(|millihertz| f64::from(millihertz) / 1000.0),
            scale_factor: ctx.pixels_per_point(),
            full_screen: ctx.input(|input| input.viewport().fullscreen == Some(true)),
        }
    }

    /// Whether images of `image_px` can be shown in their own pixels: on the
    /// monitor, or, `windowed`, inside the window as it is.
    ///
    /// # Errors
    /// [`DisplayTooSmall`] with both sizes and the way out.
    pub fn check(&self, image_px: SizePx, windowed: bool) -> Result<(), DisplayTooSmall> {
        let fits = |found: SizePx| image_px[0] <= found[0] && image_px[1] <= found[1];
        if let Some(found_px) = self.monitor_px.filter(|&size| !fits(size)) {
            return Err(DisplayTooSmall {
                what: "monitor",
                found_px,
                image_px,
                mend: "use a larger monitor, or set this one to its full resolution",
            });
        }
        if windowed && !fits(self.window_px) {
            return Err(DisplayTooSmall {
                what: "window",
                found_px: self.window_px,
                image_px,
                mend: "enlarge the window, or run without --windowed",
            });
        }
        Ok(())
    }
}

/// Whether a window can be opened: on Linux and the BSDs, whether a Wayland or X
/// server answers at the address in the environment; elsewhere always.
#[must_use]
pub fn available() -> bool {
    missing().is_none()
}

/// What is missing for a window to open, in words; `None` if nothing is.
#[must_use]
pub fn missing() -> Option<String> {
    if cfg!(any(windows, target_os = "macos")) {
        return None;
    }
    let value = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    let wayland = value("WAYLAND_DISPLAY").or_else(|| value("WAYLAND_SOCKET"));
    let x11 = value("DISPLAY");
    match (wayland, x11) {
        (None, None) => Some(String::from("neither DISPLAY nor WAYLAND_DISPLAY is set")),
        (None, Some(address)) if !x_server_answers(&address) => {
            Some(format!("no X server answers at DISPLAY={address}"))
        }
        _ => None,
    }
}

/// Whether something listens at an X display address (`:0`, `:0.1`, `host:10`).
/// Addresses of other machines are taken at their word.
fn x_server_answers(address: &str) -> bool {
    let Some(local) = address
        .strip_prefix("unix")
        .unwrap_or(address)
        .strip_prefix(':')
    else {
        return true;
    };
    let number = local.split('.').next().unwrap_or(local);
    connects(
        Path::new("/tmp/.X11-unix")
            .join(format!("X{number}"))
            .as_path(),
    )
}

#[cfg(unix)]
fn connects(socket: &Path) -> bool {
    use std::os::unix::net::UnixStream;
    if UnixStream::connect(socket).is_ok() {
        return true;
    }
    // X servers on Linux also listen at the same name in the abstract namespace.
    #[cfg(target_os = "linux")]
    {
        use std::os::linux::net::SocketAddrExt;
        use std::os::unix::ffi::OsStrExt;
        std::os::unix::net::SocketAddr::from_abstract_name(socket.as_os_str().as_bytes())
            .and_then(|name| UnixStream::connect_addr(&name))
            .is_ok()
    }
    #[cfg(not(target_os = "linux"))]
    false
}

#[cfg(not(unix))]
fn connects(_socket: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts(monitor_px: Option<SizePx>, window_px: SizePx) -> DisplayFacts {
        DisplayFacts {
            monitor_px,
            window_px,
            refresh_hz: None,
            scale_factor: 1.0,
            full_screen: false,
        }
    }

    #[test]
    fn a_monitor_one_pixel_short_is_refused() {
        let error = facts(Some([1280, 719]), [1280, 719])
            .check([1280, 720], false)
            .unwrap_err()
            .to_string();
        for part in ["monitor", "1280×719", "1280×720", "larger monitor"] {
            assert!(error.contains(part), "{part:?} not in {error:?}");
        }
    }

    #[test]
    fn a_small_window_matters_only_when_it_stays_a_window() {
        let facts = facts(Some([1920, 1080]), [800, 600]);
        assert!(facts.check([1280, 720], false).is_ok());
        let error = facts.check([1280, 720], true).unwrap_err().to_string();
        assert!(error.contains("800×600"), "{error}");
    }

    #[test]
    fn an_exact_fit_is_enough() {
        assert!(
            facts(Some([1280, 720]), [1280, 720])
                .check([1280, 720], true)
                .is_ok()
        );
    }

    #[test]
    fn nothing_listens_at_an_unused_display() {
        assert!(!x_server_answers(":64999"));
        assert!(!x_server_answers("unix:64999.0"));
        assert!(x_server_answers("elsewhere.example:10.0"));
    }
}
