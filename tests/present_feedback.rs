//! What an X server tells about frames and refreshes, heard on a real server.
#![cfg(all(unix, not(target_os = "macos")))]
#![allow(clippy::expect_used)] // a test ends where something is missing

#[path = "support/xvfb.rs"]
mod xvfb;

use std::time::{Duration, Instant};

use greyfield::app::present_feedback::x11::{Listener, Mode, Report};
use x11rb::connection::Connection as _;
use x11rb::protocol::present::ConnectionExt as _;
use x11rb::protocol::xproto::{ConnectionExt as _, CreateWindowAux, WindowClass};
use x11rb::rust_connection::RustConnection;
use xvfb::Xvfb;

/// Xvfb pretends to refresh 60 times a second.
const PERIOD: Duration = Duration::from_nanos(16_666_667);
const PATIENCE: Duration = Duration::from_secs(10);

/// A program that shows frames as a driver does: each a pixmap, handed over whole.
struct Client {
    connection: RustConnection,
    window: u32,
    pixmap: u32,
}

impl Client {
    fn new(display: &str) -> Self {
        let (connection, screen) = RustConnection::connect(Some(display)).expect("a server");
        let root = &connection.setup().roots[screen];
        let (root, depth) = (root.root, root.root_depth);
        let window = connection.generate_id().expect("an id");
        let class = WindowClass::INPUT_OUTPUT;
        let aux = CreateWindowAux::new();
        connection
            .create_window(depth, window, root, 0, 0, 64, 64, 0, class, 0, &aux)
            .expect("sent")
            .check()
            .expect("a window");
        connection.map_window(window).expect("sent");
        let pixmap = connection.generate_id().expect("an id");
        connection
            .create_pixmap(depth, pixmap, window, 64, 64)
            .expect("sent")
            .check()
            .expect("a pixmap");
        Self {
            connection,
            window,
            pixmap,
        }
    }

    fn present(&self, serial: u32) {
        self.connection
            .present_pixmap(
                self.window,
                self.pixmap,
                serial,
                0,
                0,
                0,
                0,
                0,
                0,
                0,
                0,
                0,
                1,
                0,
                &[],
            )
            .expect("sent")
            .check()
            .expect("presented");
    }
}

#[test]
fn a_frame_is_reported_with_its_number_at_the_time_it_was_shown() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: times of frames from an X server ({missing})");
        return;
    }
    let x = Xvfb::start(200, 100);
    let client = Client::new(&x.display);
    let listener = Listener::new(Some(&x.display), client.window).expect("Present is there");
    for serial in 1..=20 {
        let before = Instant::now();
        client.present(serial);
        let report = listener.wait(PATIENCE).expect("a report");
        let received = Instant::now();
        let Report::Frame {
            serial: found,
            at,
            mode,
        } = report
        else {
            panic!("{report:?}");
        };
        assert_eq!(found, serial);
        assert_eq!(mode, Mode::Copied, "nothing to flip on this server");
        // The server's time of it lies between the request and the report, to the
        // refresh that it may be rounded to.
        assert!(
            at + PERIOD >= before,
            "{:?} before it was asked",
            before - at
        );
        assert!(
            at <= received + PERIOD,
            "{:?} after the report",
            at - received
        );
    }
}

#[test]
fn refreshes_are_told_with_their_numbers_and_come_at_the_servers_rate() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: times of refreshes from an X server ({missing})");
        return;
    }
    let x = Xvfb::start(200, 100);
    let client = Client::new(&x.display);
    let listener = Listener::new(Some(&x.display), client.window).expect("Present is there");
    let mut refreshes = Vec::new();
    for _ in 0..60 {
        listener.ask_refresh().expect("the server is there");
        match listener.wait(PATIENCE).expect("a report") {
            Report::Refresh { count, at } => refreshes.push((count, at)),
            other @ Report::Frame { .. } => panic!("{other:?}"),
        }
    }
    assert!(
        refreshes.is_sorted(),
        "numbers and times go up: {refreshes:?}"
    );
    let ((first, began), (last, ended)) = (refreshes[0], refreshes[59]);
    let periods = u32::try_from(last - first).expect("few");
    let hz = f64::from(periods) / (ended - began).as_secs_f64();
    assert!((hz - 60.0).abs() < 2.0, "{hz} refreshes a second");
}

#[test]
fn a_listener_without_a_server_or_a_window_says_what_is_missing() {
    if let Some(missing) = xvfb::missing() {
        eprintln!("skipped: listening to no window ({missing})");
        return;
    }
    let message = Listener::new(Some(":9999"), 1).expect_err("no server");
    assert!(message.to_string().contains("no second connection"));
    let x = Xvfb::start(200, 100);
    let message = Listener::new(Some(&x.display), 1).expect_err("no window");
    assert!(message.to_string().contains("does not tell"), "{message}");
}
