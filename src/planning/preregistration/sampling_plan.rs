//! How many participants, what that many can find, and when it ends.

use super::{Asked, Study, heading_row, line, row};
use crate::planning::power::Test;
use crate::planning::sample_size::{Criterion, Question};
use crate::planning::sheet::SHARES;
use crate::protocol::balance::{Aspect, Balance};
use crate::protocol::{PlanError, SessionPlan};

impl Study<'_> {
    /// Participants of a full block.
    pub(super) fn block(&self) -> Option<u32> {
        (self.protocol.design.block_slots)(self.main.len())
            .and_then(|slots| u32::try_from(slots).ok())
            .filter(|&slots| slots > 0)
    }

    pub(super) fn sampling(&self, out: &mut String) -> Result<(), PlanError> {
        let planned = self.protocol.planned_participants.get();
        line(out, "## Sampling plan");
        line(out, "### Existing data");
        line(
            out,
            "Only sessions recorded under the protocol named below (by its SHA-256) after this registration are analysed. Pilot sessions are marked as such in the data and left out.",
        );
        line(out, "### Sample size");
        line(
            out,
            &format!("{planned} participants who finish the session."),
        );
        let blocks = self.blocks(planned)?;
        line(out, &blocks);
        line(out, "### Sample size rationale");
        self.rationale(planned, out);
        line(out, "### Stopping rule");
        line(
            out,
            &format!(
                "Data collection ends when {planned} participants have finished. There is no look at the results before that, and no participant is added afterwards on account of them. The place of a participant who leaves, or who is left out by a rule below before the last session, is taken by another."
            ),
        );
        Ok(())
    }

    /// How the number fits the blocks, and how uneven it leaves the orders.
    fn blocks(&self, planned: u32) -> Result<String, PlanError> {
        let Some(block) = self.block() else {
            return Ok(
                "The design has no blocks, so there is no number that evens the orders.".to_owned(),
            );
        };
        let left = planned % block;
        let full = planned / block;
        if left == 0 {
            return Ok(format!(
                "That is {full} full {} of {block}: every condition stands equally often at every position{}.",
                if full == 1 { "block" } else { "blocks" },
                if self.asked == Asked::Choice {
                    ", and equally often in both inner orders"
                } else {
                    ""
                }
            ));
        }
        // Full blocks are even; what is left over is not.
        let mut balance = Balance::default();
        for slot in full * block..planned {
            balance.add(&SessionPlan::new(
                self.protocol,
                self.facts.conditions,
                slot,
            )?);
        }
        let mut text = format!(
            "That is no multiple of a full block of {block}: after {full} full {} {left} are left over, and {} would fill the next. ",
            if full == 1 { "block" } else { "blocks" },
            (full + 1) * block
        );
        let places = balance.evenness(Aspect::Position).range;
        let positions = u32::try_from(self.main.len()).unwrap_or(u32::MAX);
        let each = full * block / positions.max(1);
        let (low, high) = (each + places.low, each + places.high);
        let times = match high - low {
            0 => format!("{low}"),
            1 => format!("{low} or {high}"),
            _ => format!("{low} to {high}"),
        };
        text += &format!("Each condition will stand at each position {times} times");
        if self.asked == Asked::Choice {
            let reversed = balance.evenness(Aspect::InnerOrder).range;
            let half = full * block / 2;
            let (low, high) = (half + reversed.low, half + reversed.high);
            text += &match low == high {
                true => format!(
                    ", and each pair is reversed {low} times and in its base order {} times. A preference for the image shown first does not cancel altogether, and is tested and reported.",
                    planned - low
                ),
                false => format!(", and each pair is reversed {low} to {high} times of {planned}."),
            };
        } else {
            text.push('.');
        }
        Ok(text)
    }

    fn rationale(&self, planned: u32, out: &mut String) {
        let of = match self.asked {
            Asked::Choice => "the exact binomial test of one condition (two-sided)",
            Asked::Ratings | Asked::Ranking => {
                "a sign test between two versions of a scene (two-sided, ties left out), the plainest comparison the data hold,"
            }
        };
        let question = |p, criterion| Question {
            test: Test::Exact,
            p,
            alpha: self.facts.analysis.alpha,
            conditions: self.family,
            criterion,
        };
        let tests = self.family;
        line(
            out,
            &format!(
                "Power of {of} with {planned} participants, exact, by the probability p with which a participant prefers one technique; family of {tests}, alpha = {}:",
                self.facts.analysis.alpha.get()
            ),
        );
        heading_row(
            out,
            &[
                "p",
                "no correction",
                "whatever the others do (alpha/K)",
                "all K have the effect, Holm",
            ],
        );
        for p in SHARES {
            let power = |criterion| format!("{:.3}", question(p, criterion).power(planned));
            row(
                out,
                &[
                    format!("{p:.2}"),
                    power(Criterion::Uncorrected),
                    power(Criterion::Bonferroni),
                    power(Criterion::HolmEach),
                ],
            );
        }
        out.push('\n');
        let detectable = |level, power: f64| {
            let found = Test::Exact.detectable(planned, power, level);
            found.map_or_else(|| "no share".to_owned(), |p| format!("{p:.3}"))
        };
        let alpha = self.facts.analysis.alpha;
        let smallest = question(0.5, Criterion::Bonferroni).level(1);
        line(
            out,
            &format!(
                "The smallest share found with a power of 0.8 is {} without correction and {} whatever the other conditions do; with 0.9 it is {} and {}. Computed with `greyfield power --p P --conditions {tests} --n {planned}`.",
                detectable(alpha, 0.8),
                detectable(smallest, 0.8),
                detectable(alpha, 0.9),
                detectable(smallest, 0.9)
            ),
        );
    }
}
