//! Times of frames and refreshes from an X server, through its Present extension.
//!
//! Vulkan drivers for graphics cards hand their frames to an X server with
//! `PresentPixmap`, and anybody may listen when they completed: a second connection
//! does, without a word to the driver. Software adapters copy their frames to the
//! window instead, and nothing is told of those. The times of refreshes can be asked
//! for in either case.
//!
//! Times are microseconds of `CLOCK_MONOTONIC`, the clock of [`Instant`] as well.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};
use x11rb::connection::Connection as _;
use x11rb::errors::{ConnectError, ConnectionError, ReplyError, ReplyOrIdError};
use x11rb::protocol::Event;
use x11rb::protocol::present::{
    CompleteKind, CompleteMode, CompleteNotifyEvent, ConnectionExt as _, EventMask,
};
use x11rb::protocol::xproto::{
    ConfigureWindowAux, ConnectionExt as _, CreateWindowAux, WindowClass,
};
use x11rb::rust_connection::RustConnection;

/// Present events could not be asked for.
#[derive(Debug, thiserror::Error)]
pub enum X11Error {
    /// No connection.
    #[error("no second connection to the X server: {0}")]
    Connect(#[from] ConnectError),
    /// The connection broke.
    #[error("the connection to the X server broke: {0}")]
    Connection(#[from] ConnectionError),
    /// The server refused; without the extension, too.
    #[error("the X server does not tell when frames are shown: {0}")]
    Refused(#[from] ReplyError),
    /// No id for the events.
    #[error("the X server has no id left: {0}")]
    Id(#[from] ReplyOrIdError),
}

/// How a frame reached the display.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The display was switched to it: the time is that of the refresh.
    Flipped,
    /// It was copied into the screen, or into what a compositor shows later.
    Copied,
    /// It was never shown: a later frame took its place.
    Skipped,
}

/// Something the X server has reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Report {
    /// A frame is on the display.
    Frame {
        /// The driver's number of it.
        serial: u32,
        /// When.
        at: Instant,
        /// How.
        mode: Mode,
    },
    /// A refresh of the display.
    Refresh {
        /// Its number.
        count: u64,
        /// When.
        at: Instant,
    },
}

/// Listens to an X server on a connection of its own.
#[derive(Debug)]
pub struct Listener {
    connection: Arc<RustConnection>,
    /// Never on the screen; the refreshes asked for are reported to it, so that the
    /// driver of the real window does not hear of them.
    own_window: u32,
    window: u32,
    root: u32,
    reports: Receiver<Report>,
    stop: Arc<AtomicBool>,
}

impl Listener {
    /// Listens for the frames of `window` on the X server at `display` (that of the
    /// environment if `None`).
    ///
    /// # Errors
    /// [`X11Error`] saying what the server lacks.
    pub fn new(display: Option<&str>, window: u32) -> Result<Self, X11Error> {
        let (connection, screen) = RustConnection::connect(display)?;
        connection.present_query_version(1, 0)?.reply()?;
        let root = connection.setup().roots[screen].root;
        let own_window = connection.generate_id()?;
        connection
            .create_window(
                0,
                own_window,
                root,
                0,
                0,
                1,
                1,
                0,
                WindowClass::INPUT_ONLY,
                0,
                &CreateWindowAux::new().override_redirect(1),
            )?
            .check()?;
        for listened in [window, own_window] {
            let id = connection.generate_id()?;
            connection
                .present_select_input(id, listened, EventMask::COMPLETE_NOTIFY)?
                .check()?;
        }
        let connection = Arc::new(connection);
        let stop = Arc::new(AtomicBool::new(false));
        let (sender, reports) = mpsc::channel();
        let (listening, stopped) = (Arc::clone(&connection), Arc::clone(&stop));
        let clock = MonotonicClock::read();
        std::thread::spawn(move || {
            while let Ok(event) = listening.wait_for_event() {
                let Event::PresentCompleteNotify(event) = event else {
                    continue;
                };
                let gone = sender.send(report(&event, clock)).is_err();
                if gone || stopped.load(Ordering::Relaxed) {
                    break;
                }
            }
        });
        Ok(Self {
            connection,
            own_window,
            window,
            root,
            reports,
            stop,
        })
    }

    /// Asks for the time of the next refresh of the monitor that the window is on.
    ///
    /// # Errors
    /// [`X11Error`] if the connection broke.
    pub fn ask_refresh(&self) -> Result<(), X11Error> {
        let corner = self
            .connection
            .translate_coordinates(self.window, self.root, 0, 0)?
            .reply()?;
        let (x, y) = (i32::from(corner.dst_x), i32::from(corner.dst_y));
        self.connection
            .configure_window(self.own_window, &ConfigureWindowAux::new().x(x).y(y))?;
        self.wake()?;
        Ok(())
    }

    fn wake(&self) -> Result<(), X11Error> {
        // The next one of those divisible by 1.
        self.connection
            .present_notify_msc(self.own_window, 0, 0, 1, 0)?;
        self.connection.flush()?;
        Ok(())
    }

    /// Everything reported since the last call.
    pub fn reports(&self) -> impl Iterator<Item = Report> {
        self.reports.try_iter()
    }

    /// Waits for one report.
    #[must_use]
    pub fn wait(&self, patience: Duration) -> Option<Report> {
        self.reports.recv_timeout(patience).ok()
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        // Wakes the thread; if the server is gone, it has ended already.
        let _ = self.wake();
    }
}

fn report(event: &CompleteNotifyEvent, clock: MonotonicClock) -> Report {
    let at = clock.instant(event.ust);
    if event.kind == CompleteKind::NOTIFY_MSC {
        return Report::Refresh {
            count: event.msc,
            at,
        };
    }
    Report::Frame {
        serial: event.serial,
        at,
        mode: match event.mode {
            CompleteMode::FLIP => Mode::Flipped,
            CompleteMode::SKIP => Mode::Skipped,
            _ => Mode::Copied,
        },
    }
}

/// Where the monotonic clock stood at some instant.
#[derive(Debug, Clone, Copy)]
struct MonotonicClock {
    instant: Instant,
    since_boot: Duration,
}

impl MonotonicClock {
    fn read() -> Self {
        let before = Instant::now();
        let time = clock_gettime(ClockId::Monotonic);
        // The reading lies between the two.
        let instant = before + before.elapsed() / 2;
        let seconds = u64::try_from(time.tv_sec).unwrap_or(0);
        let nanoseconds = u32::try_from(time.tv_nsec).unwrap_or(0);
        Self {
            instant,
            since_boot: Duration::new(seconds, nanoseconds),
        }
    }

    /// The instant at which the clock showed so many microseconds.
    fn instant(self, microseconds: u64) -> Instant {
        let time = Duration::from_micros(microseconds);
        if let Some(later) = time.checked_sub(self.since_boot) {
            return self.instant + later;
        }
        self.instant
            .checked_sub(self.since_boot - time)
            .unwrap_or(self.instant)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_monotonic_clock_and_instants_are_one_clock() {
        let clock = MonotonicClock::read();
        std::thread::sleep(Duration::from_millis(30));
        let (before, time, after) = (
            Instant::now(),
            clock_gettime(ClockId::Monotonic),
            Instant::now(),
        );
        let microseconds = (time.tv_sec * 1_000_000 + time.tv_nsec / 1000) as u64;
        let found = clock.instant(microseconds);
        let grace = Duration::from_micros(200);
        assert!(found + grace >= before && found <= after + grace);
        let earlier = clock.instant(microseconds - 1_000_000);
        assert_eq!(found - earlier, Duration::from_secs(1));
    }
}
