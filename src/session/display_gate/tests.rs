//! Each figure alone can fail a display; which rate its frames are counted by.

use super::*;
use crate::config;
use std::path::Path;

fn good() -> DisplayFigures {
    DisplayFigures {
        mean_refresh_hz: Some(59.95),
        jitter_sd_ms: Some(0.3),
        longest_ms: 17.5,
        valid_frames: 60,
        missed: 0,
        stated_refresh_hz: Some(59.94),
        told_refresh_hz: None,
        scale_factor: 1.0,
        window_px: [1920, 1080],
        monitor_px: Some([1920, 1080]),
        full_screen: true,
        focused: true,
        method: FrameTimes::PresentCall,
    }
}

fn asked(text: &str) -> DisplayRequirements {
    config::parse(Path::new("p.toml"), text).unwrap()
}

#[test]
fn a_good_display_passes() {
    assert_eq!(judge(&good(), &asked("")), Verdict::Good);
    assert_eq!(
        judge(&good(), &asked("refresh_hz = [59, 61]")),
        Verdict::Good
    );
}

/// Each figure alone can fail, with its number and the limit in the message.
#[test]
fn each_shortfall_is_refused_by_its_own_name() {
    let cases: [(DisplayFigures, &str, [&str; 3]); 5] = [
        (
            DisplayFigures {
                valid_frames: 49,
                ..good()
            },
            "",
            ["49 frames", "50 are needed", "hidden"],
        ),
        (
            DisplayFigures {
                jitter_sd_ms: Some(2.01),
                ..good()
            },
            "",
            ["2.01 ms", "allowed is 2.00 ms", "power saving"],
        ),
        (
            DisplayFigures {
                mean_refresh_hz: Some(75.0),
                ..good()
            },
            "refresh_hz = [59, 61]",
            ["75.00", "59 to 61", "settings"],
        ),
        (
            DisplayFigures {
                full_screen: false,
                window_px: [800, 600],
                ..good()
            },
            "",
            ["800×600", "1920×1080", "full screen"],
        ),
        (
            DisplayFigures {
                focused: false,
                ..good()
            },
            "",
            ["focus", "click", "window"],
        ),
    ];
    for (figures, text, parts) in cases {
        let verdict = judge(&figures, &asked(text));
        assert!(verdict.is_refused());
        let [one] = verdict.shortfalls() else {
            panic!("{verdict:?}");
        };
        let message = one.to_string();
        for part in parts {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }
}

#[test]
fn a_protocol_may_be_content_to_warn_or_not_to_ask() {
    let bad = DisplayFigures {
        full_screen: false,
        focused: false,
        ..good()
    };
    let warned = judge(&bad, &asked("verdict = \"warn\""));
    assert_eq!(warned.shortfalls().len(), 2);
    assert!(!warned.is_refused());
    assert_eq!(
        judge(&bad, &asked("full_screen = false\nfocus = false")),
        Verdict::Good
    );
}

fn with(mean_hz: f64, stated_hz: Option<f64>, told_hz: Option<f64>) -> DisplayFigures {
    DisplayFigures {
        mean_refresh_hz: Some(mean_hz),
        stated_refresh_hz: stated_hz,
        told_refresh_hz: told_hz,
        ..good()
    }
}

#[test]
fn what_the_system_says_is_the_period_where_frames_agree_with_it() {
    for figures in [
        with(59.95, Some(59.94), None),
        with(59.7, Some(59.94), None),
        with(59.95, Some(144.0), Some(59.94)),
        with(59.95, Some(60.0), Some(59.94)),
    ] {
        assert_eq!(figures.period_ns(), Some(16_683_350), "{figures:?}");
        assert_eq!(figures.counted_period_ns(), Some(16_683_350));
    }
}

#[test]
fn frames_are_not_counted_where_they_do_not_keep_the_displays_rate() {
    // Steady at another rate than the system states, or nothing stated: as measured.
    for figures in [with(75.0, Some(60.0), None), with(75.0, None, None)] {
        assert_eq!(figures.period_ns(), Some(13_333_333));
        assert_eq!(figures.counted_period_ns(), None);
    }
    // Late frames, on a machine too slow for its display: as told.
    let slow = DisplayFigures {
        missed: 35,
        jitter_sd_ms: Some(5.0),
        ..with(35.7, None, Some(60.0))
    };
    assert_eq!(slow.period_ns(), Some(16_666_667));
    assert_eq!(slow.counted_period_ns(), None);
    // A timer measures itself.
    let timed = DisplayFigures {
        method: FrameTimes::Timer,
        ..with(60.0, Some(60.0), None)
    };
    assert_eq!(timed.period_ns(), Some(16_666_667));
    assert_eq!(timed.counted_period_ns(), None);
}
