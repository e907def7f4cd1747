//! What a protocol asks of the display, checked before a session.

use serde::{Deserialize, Serialize};

use crate::config::quantity::quantity;

quantity! {
    /// A number of frames.
    Frames: u32, 2, 100_000, "frames"
}
quantity! {
    /// Standard deviation of the time from frame to frame.
    Jitter: f32, 0.0, 1000.0, "ms"
}
quantity! {
    /// A refresh rate.
    Hertz: f32, 1.0, 1000.0, "Hz"
}

/// What the display must be like for a session to begin. The optional table
/// `[display]` of a protocol; every field has a default.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DisplayRequirements {
    /// Frames to measure at least.
    pub minimum_frames: Frames,
    /// Largest standard deviation of the time from frame to frame. One frame missed in
    /// 50 at 60 Hz makes 2.4 ms.
    #[serde(rename = "maximum_jitter_ms")]
    pub maximum_jitter: Jitter,
    /// Lowest and highest mean refresh rate; any if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refresh_hz: Option<RefreshRange>,
    /// Whether the window must cover the monitor.
    pub full_screen: bool,
    /// Whether the window must have the keyboard focus.
    pub focus: bool,
    /// What happens to a display that falls short.
    pub verdict: Strictness,
}

impl Default for DisplayRequirements {
    fn default() -> Self {
        Self {
            minimum_frames: Frames(50),
            maximum_jitter: Jitter(2.0),
            refresh_hz: None,
            full_screen: true,
            focus: true,
            verdict: Strictness::Refuse,
        }
    }
}

impl DisplayRequirements {
    /// What is asked where a protocol has no such table: the same, but it only warns.
    #[must_use]
    pub fn unasked() -> Self {
        Self {
            verdict: Strictness::Warn,
            ..Self::default()
        }
    }
}

/// What happens to a display that falls short.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Strictness {
    /// No session begins.
    Refuse,
    /// The experimenter is told, and decides.
    Warn,
}

/// Lowest and highest refresh rate allowed, both included; `[59, 61]` in a protocol.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "[Hertz; 2]", into = "[Hertz; 2]")]
pub struct RefreshRange {
    low: Hertz,
    high: Hertz,
}

impl RefreshRange {
    /// The lowest rate, hertz.
    #[must_use]
    pub fn low_hz(self) -> f64 {
        self.low.into()
    }

    /// The highest rate, hertz.
    #[must_use]
    pub fn high_hz(self) -> f64 {
        self.high.into()
    }
}

impl TryFrom<[Hertz; 2]> for RefreshRange {
    type Error = String;

    fn try_from([low, high]: [Hertz; 2]) -> Result<Self, String> {
        if low > high {
            return Err(format!(
                "found {} to {} Hz; the lowest rate comes first, as in [59, 61]",
                low.get(),
                high.get()
            ));
        }
        Ok(Self { low, high })
    }
}

impl From<RefreshRange> for [Hertz; 2] {
    fn from(range: RefreshRange) -> Self {
        [range.low, range.high]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config;
    use std::path::Path;

    fn parse(text: &str) -> Result<DisplayRequirements, String> {
        config::parse(Path::new("p.toml"), text).map_err(|error| error.to_string())
    }

    #[test]
    fn an_empty_table_asks_for_a_full_screen_in_focus_and_steady_frames() {
        let asked = parse("").unwrap();
        assert_eq!(asked, DisplayRequirements::default());
        assert_eq!(asked.minimum_frames.get(), 50);
        assert!(asked.full_screen && asked.focus);
        assert_eq!(asked.verdict, Strictness::Refuse);
    }

    #[test]
    fn every_field_can_be_written() {
        let asked = parse(
            "minimum_frames = 200\nmaximum_jitter_ms = 0.5\nrefresh_hz = [59, 61]\n\
             full_screen = false\nfocus = false\nverdict = \"warn\"",
        )
        .unwrap();
        assert_eq!(asked.minimum_frames.get(), 200);
        assert!((asked.maximum_jitter.get() - 0.5).abs() < f32::EPSILON);
        let range = asked.refresh_hz.unwrap();
        assert_eq!((range.low_hz(), range.high_hz()), (59.0, 61.0));
        assert!(!asked.full_screen && !asked.focus);
        assert_eq!(asked.verdict, Strictness::Warn);
        let again = parse(&toml::to_string(&asked).unwrap()).unwrap();
        assert_eq!(again, asked);
    }

    #[test]
    fn wrong_values_name_what_is_allowed() {
        for (text, parts) in [
            ("minimum_frames = 1", ["p.toml:1", "found 1", "2 to"]),
            (
                "refresh_hz = [61, 59]",
                ["p.toml:1", "61 to 59", "[59, 61]"],
            ),
            ("verdict = \"ask\"", ["p.toml:1", "ask", "`refuse`"]),
            ("jitter = 1", ["p.toml:1", "jitter", "maximum_jitter_ms"]),
        ] {
            let message = parse(text).unwrap_err();
            for part in parts {
                assert!(message.contains(part), "{part:?} not in {message:?}");
            }
        }
    }
}
