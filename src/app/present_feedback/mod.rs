//! When the display system says that a frame was on the display, where it says so.
//!
//! See `docs/timing.md` for what each system tells. Where nothing is told, nothing
//! is lost: onsets stay the estimates they are.

pub mod matching;
#[cfg(all(unix, not(target_os = "macos")))]
pub mod x11;

use std::time::{Duration, Instant};

use winit::window::Window;

use matching::{HandedOver, Matcher};

/// A frame that was on the display.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Displayed {
    /// When the call that handed it over returned; names the frame.
    pub handed_over: Instant,
    /// When the display switched to it.
    pub at: Instant,
}

/// Collects the display system's reports about one window.
#[derive(Debug)]
pub struct PresentFeedback {
    matcher: Matcher,
    /// Number and time of the first and the last refresh told.
    refreshes: Option<[(u64, Instant); 2]>,
    #[cfg(all(unix, not(target_os = "macos")))]
    listener: x11::Listener,
}

impl PresentFeedback {
    /// Listens for a window's frames; `None` where its system tells nothing. To be
    /// called before the first frame.
    #[must_use]
    pub fn listen(window: &Window) -> Option<Self> {
        #[cfg(all(unix, not(target_os = "macos")))]
        {
            let listener = x11::Listener::new(None, xid(window)?)
                .inspect_err(|error| tracing::debug!(%error, "onsets stay estimates"))
                .ok()?;
            Some(Self {
                matcher: Matcher::default(),
                refreshes: None,
                listener,
            })
        }
        #[cfg(not(all(unix, not(target_os = "macos"))))]
        {
            let _ = window;
            None
        }
    }

    /// A frame whose drawing began at `begun` was handed over at `at`. Every frame
    /// of the window counts, pages and all.
    pub fn handed_over(&mut self, begun: Instant, at: Instant) {
        self.matcher.handed_over(HandedOver { begun, at });
    }

    /// The frames reported since the last call. Only those the display was switched
    /// to: when a copied frame can be seen, only the compositor knows.
    pub fn displayed(&mut self) -> Vec<Displayed> {
        #[cfg(all(unix, not(target_os = "macos")))]
        {
            let reports: Vec<x11::Report> = self.listener.reports().collect();
            reports
                .into_iter()
                .filter_map(|report| self.take(report))
                .collect()
        }
        #[cfg(not(all(unix, not(target_os = "macos"))))]
        Vec::new()
    }

    #[cfg(all(unix, not(target_os = "macos")))]
    fn take(&mut self, report: x11::Report) -> Option<Displayed> {
        match report {
            x11::Report::Refresh { count, at } => {
                let first = self.refreshes.map_or((count, at), |[first, _]| first);
                self.refreshes = Some([first, (count, at)]);
                None
            }
            x11::Report::Frame { serial, at, mode } => {
                let frame = self.matcher.reported(serial, at)?;
                (mode == x11::Mode::Flipped).then_some(Displayed {
                    handed_over: frame.at,
                    at,
                })
            }
        }
    }

    /// Asks for the time of the next refresh of the display.
    pub fn ask_refresh(&mut self) {
        #[cfg(all(unix, not(target_os = "macos")))]
        if let Err(error) = self.listener.ask_refresh() {
            tracing::debug!(%error, "no time of a refresh");
        }
    }

    /// Mean time from refresh to refresh, from the display system's own times of them;
    /// `None` until a quarter of a second of refreshes was told.
    #[must_use]
    pub fn refresh_period(&self) -> Option<Duration> {
        let [(first, began), (last, ended)] = self.refreshes?;
        let count = u32::try_from(last.checked_sub(first)?).ok()?;
        let took = ended.saturating_duration_since(began);
        (count > 0 && took >= Duration::from_millis(250)).then(|| took / count)
    }
}

/// The X server's id of a window; `None` under Wayland.
#[cfg(all(unix, not(target_os = "macos")))]
fn xid(window: &Window) -> Option<u32> {
    use winit::raw_window_handle::{HasWindowHandle as _, RawWindowHandle};
    match window.window_handle().ok()?.as_raw() {
        RawWindowHandle::Xlib(handle) => u32::try_from(handle.window).ok(),
        RawWindowHandle::Xcb(handle) => Some(handle.window.get()),
        _ => None,
    }
}
