//! The session's one clock.

use std::cell::Cell;
use std::rc::Rc;
use std::time::Instant;

use crate::session::SessionTime;

/// Monotonic time since the session began. Everything a session records is read
/// from one of these, so that onsets and responses can be subtracted.
#[derive(Debug, Clone)]
pub enum Clock {
    /// Runs by itself, from the moment it was made.
    Running {
        /// Time zero.
        start: Instant,
    },
    /// Moved by hand, nanoseconds; how tests let two seconds of grey pass at once.
    Manual(Rc<Cell<u64>>),
}

impl Clock {
    /// A clock that starts now.
    #[must_use]
    pub fn start() -> Self {
        Self::Running {
            start: Instant::now(),
        }
    }

    /// The time now.
    #[must_use]
    pub fn now(&self) -> SessionTime {
        self.at(Instant::now())
    }

    /// The time at `instant`; 0 for any moment before the clock started. A clock
    /// moved by hand knows no instants and gives its own time.
    #[must_use]
    pub fn at(&self, instant: Instant) -> SessionTime {
        let ns = match self {
            Self::Running { start } => instant.saturating_duration_since(*start).as_nanos(),
            Self::Manual(ns) => u128::from(ns.get()),
        };
        SessionTime {
            ns: u64::try_from(ns).unwrap_or(u64::MAX),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn times_are_distances_from_the_start() {
        let clock = Clock::start();
        let Clock::Running { start } = clock else {
            unreachable!("a started clock runs")
        };
        assert_eq!(
            clock.at(start + Duration::from_micros(1500)).ns,
            1_500_000,
            "1.5 ms after the start"
        );
        assert_eq!(clock.at(start - Duration::from_secs(1)).ns, 0);
    }

    #[test]
    fn the_running_clock_never_goes_back() {
        let clock = Clock::start();
        let times: Vec<u64> = (0..1000).map(|_| clock.now().ns).collect();
        assert!(times.is_sorted());
    }
}
