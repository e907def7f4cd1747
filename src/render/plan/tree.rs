//! A plan as a tree to read, with what each pass cost when it ran.

use std::fmt::{self, Write};

use super::FramePlan;
use crate::render::PassRecord;

impl FramePlan {
    /// The plan as a tree; `ran` is what the frame's passes took when it was drawn, and may
    /// be empty.
    #[must_use]
    pub fn tree(&self, ran: &[PassRecord]) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut text, ran);
        text
    }

    fn write(&self, out: &mut impl Write, ran: &[PassRecord]) -> fmt::Result {
        let count = self.passes.len();
        writeln!(
            out,
            "├─ runs: {count} {}",
            if count == 1 { "pass" } else { "passes" }
        )?;
        for (index, pass) in self.passes.iter().enumerate() {
            let last = index + 1 == count;
            let (branch, below) = if last {
                ("└─", "  ")
            } else {
                ("├─", "│ ")
            };
            let record = ran.iter().find(|record| record.pass == pass.kind.name());
            writeln!(
                out,
                "│  {branch} {:<13} {:>4}×{:<4} {}  {}",
                pass.kind.name(),
                pass.size_px.0,
                pass.size_px.1,
                record.map_or_else(String::new, cost),
                pass.because,
            )?;
            writeln!(
                out,
                "│  {below}   reads {}; writes {}",
                pass.reads.join(", "),
                pass.writes.join(", ")
            )?;
        }
        writeln!(out, "└─ left out: {}", self.left_out.len())?;
        for (index, left_out) in self.left_out.iter().enumerate() {
            let branch = if index + 1 == self.left_out.len() {
                "└─"
            } else {
                "├─"
            };
            writeln!(
                out,
                "   {branch} {:<16} {}",
                left_out.effect, left_out.because
            )?;
        }
        Ok(())
    }
}

/// What a pass took.
fn cost(record: &PassRecord) -> String {
    let time = record
        .gpu_ms
        .map_or_else(|| String::from("not timed"), |ms| format!("{ms:.2} ms"));
    let shared = if record.shared { " (shared)" } else { "" };
    format!("{time:>10}{shared}")
}

impl fmt::Display for FramePlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, &[])
    }
}
