//! A session as it is on record, laid out in time again: what stood on the participant's screen
//! at every moment, as far as the rows say.
//!
//! Within one segment the times are those of the rows, to the nanosecond. Segments follow each
//! other with their gap between them, cut short where it was long.

use crate::protocol::Protocol;
use crate::protocol::procedure::{Ask, Step};
use crate::record::TrialRow;
use crate::record::row::LIST_SEPARATOR;
use crate::stimulus::{ImageRecord, Manifest};

/// The longest that the gap between two segments stands in a replay.
pub const LONGEST_GAP_NS: u64 = 5_000_000_000;

/// How long an answer stands on its question. This is the replay's addition: the participant
/// saw the next page at once.
pub const ANSWER_STANDS_NS: u64 = 1_000_000_000;

/// A session that cannot be shown again.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReplayError {
    /// Nothing to show.
    #[error("no rows on record; there is nothing to replay")]
    NoRows,
    /// Rows of two sessions.
    #[error(
        "row {row_id} is of participant {participant}, session {session}; a replay shows one session, the rows before are of another"
    )]
    OtherSession {
        /// The row.
        row_id: String,
        /// Whose it is.
        participant: String,
        /// Which session of theirs.
        session: u32,
    },
    /// The question and the grey would not be those that were shown.
    #[error(
        "row {row_id} was recorded with the protocol of SHA-256 {found}, the one given is {given}; give the one kept as materials/protocol.toml beside the data"
    )]
    OtherProtocol {
        /// The row.
        row_id: String,
        /// SHA-256 of the protocol it was recorded with.
        found: String,
        /// SHA-256 of the one given.
        given: String,
    },
    /// The image that was shown is not there.
    #[error(
        "row {row_id} shows an image of SHA-256 {sha256:?}, which is not in the set {set:?}; name the folder of the images that were shown with --stimuli"
    )]
    UnknownImage {
        /// The row.
        row_id: String,
        /// The image's hash.
        sha256: String,
        /// The set it was looked for in.
        set: String,
    },
}

/// What stands on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// One image.
    Image {
        /// Which of the trial's, by time: 0 is the first.
        place: usize,
    },
    /// The grey.
    Grey,
    /// The question; images may stand beside it, as its kind has it.
    Question {
        /// What is asked.
        ask: Ask,
        /// Whether the answer is given and shown with it.
        answered: bool,
    },
    /// Pages of text, or whatever the rows do not tell.
    Between,
    /// The session was interrupted.
    Gap,
}

/// The screen of one moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReplayScreen {
    /// The trial it is of; `None` before the first and in a gap.
    pub trial: Option<usize>,
    /// What stands on it.
    pub what: Shown,
}

/// One trial and when it ran.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayTrial {
    /// As it is on record.
    pub row: TrialRow,
    /// Its images by place, as the manifest has them.
    pub images: Vec<ImageRecord>,
    /// The image they were compared with.
    pub reference: Option<ImageRecord>,
    /// What it asked.
    pub ask: Ask,
    /// From its first moment on record, nanoseconds of the replay.
    pub begin_ns: u64,
    /// To its last.
    pub end_ns: u64,
}

/// A session, laid out in time.
#[derive(Debug, Clone, PartialEq)]
pub struct Replay {
    /// Its trials, in order.
    pub trials: Vec<ReplayTrial>,
    /// Every moment at which the screen changes, in order, the first one at 0.
    changes: Vec<(u64, ReplayScreen)>,
}

impl Replay {
    /// Lays out the rows of one session, in the order of the file.
    ///
    /// # Errors
    /// [`ReplayError`]: every image must be found by its hash, and the protocol be the one of
    /// the rows.
    pub fn new(
        rows: &[TrialRow],
        protocol: &Protocol,
        manifest: &Manifest,
    ) -> Result<Self, ReplayError> {
        let first = rows.first().ok_or(ReplayError::NoRows)?;
        let ask = match (protocol.procedure.steps)(protocol).last() {
            Some(Step::Ask(ask)) => *ask,
            // Every procedure ends with a question; a test holds that.
            _ => Ask::Choice,
        };
        let mut replay = Self {
            trials: Vec::new(),
            changes: vec![(0, between(None))],
        };
        let mut base_ns = 0;
        for (index, row) in rows.iter().enumerate() {
            check(row, first, protocol)?;
            if index > 0 && row.segment != rows[index - 1].segment {
                base_ns = replay.interrupt(row);
            }
            let next = rows.get(index + 1);
            let next = next.filter(|next| next.segment == row.segment);
            replay.lay_out(row, ask, base_ns, next, manifest)?;
        }
        Ok(replay)
    }

    /// What stood on the screen.
    #[must_use]
    pub fn screen_at(&self, at_ns: u64) -> ReplayScreen {
        let after = self
            .changes
            .partition_point(|(from_ns, _)| *from_ns <= at_ns);
        let current = self.changes[..after].last();
        current.map_or(between(None), |(_, screen)| *screen)
    }

    /// The first change after a moment.
    #[must_use]
    pub fn next_change(&self, at_ns: u64) -> Option<u64> {
        let after = self
            .changes
            .partition_point(|(from_ns, _)| *from_ns <= at_ns);
        self.changes.get(after).map(|(from_ns, _)| *from_ns)
    }

    /// The last change before a moment.
    #[must_use]
    pub fn previous_change(&self, at_ns: u64) -> Option<u64> {
        let before = self
            .changes
            .partition_point(|(from_ns, _)| *from_ns < at_ns);
        let previous = self.changes[..before].last();
        previous.map(|(from_ns, _)| *from_ns)
    }

    /// From the session's start to the last change.
    #[must_use]
    pub fn duration_ns(&self) -> u64 {
        self.changes.last().map_or(0, |(from_ns, _)| *from_ns)
    }

    /// Puts a gap behind what there is, and gives the moment the segment of `row` starts at.
    fn interrupt(&mut self, row: &TrialRow) -> u64 {
        let gap_ms = row.resume_gap_ms.unwrap_or(u64::MAX);
        let gap_ns = gap_ms.saturating_mul(1_000_000).min(LONGEST_GAP_NS);
        let from_ns = self.duration_ns();
        let gap = ReplayScreen {
            trial: None,
            what: Shown::Gap,
        };
        self.push(from_ns, gap);
        let base_ns = from_ns.saturating_add(gap_ns);
        self.push(base_ns, between(None));
        base_ns
    }

    fn lay_out(
        &mut self,
        row: &TrialRow,
        ask: Ask,
        base_ns: u64,
        next: Option<&TrialRow>,
        manifest: &Manifest,
    ) -> Result<(), ReplayError> {
        let trial = self.trials.len();
        let mut moments = moments(row, ask);
        if let Some(answered_ns) = row.response_ns {
            // Never into what follows.
            let stands_until_ns = answered_ns.saturating_add(ANSWER_STANDS_NS);
            let next_ns = next.and_then(|next| Some(self::moments(next, ask).first()?.0));
            let until_ns = next_ns.map_or(stands_until_ns, |next_ns| next_ns.min(stands_until_ns));
            moments.push((until_ns.max(answered_ns), Shown::Between));
        }
        let at = |ns: u64| base_ns.saturating_add(ns);
        for &(ns, what) in &moments {
            let trial = Some(trial);
            self.push(at(ns), ReplayScreen { trial, what });
        }
        let ends = moments.first().zip(moments.last());
        let (begin_ns, end_ns) = match ends {
            Some((first, last)) => (at(first.0), at(last.0)),
            // Nothing of it is on record but that it was.
            None => (self.duration_ns(), self.duration_ns()),
        };
        self.trials.push(ReplayTrial {
            images: images(row, manifest)?,
            reference: match &*row.reference_image_sha256 {
                "" => None,
                sha256 => Some(find(row, sha256, manifest)?),
            },
            row: row.clone(),
            ask,
            begin_ns,
            end_ns,
        });
        Ok(())
    }

    /// The last of several at one moment is what stands.
    fn push(&mut self, at_ns: u64, screen: ReplayScreen) {
        // A clock that went back would be one that nobody recorded with.
        let at_ns = at_ns.max(self.duration_ns());
        match self.changes.last_mut() {
            Some(last) if last.0 == at_ns => last.1 = screen,
            _ => self.changes.push((at_ns, screen)),
        }
    }
}

fn between(trial: Option<usize>) -> ReplayScreen {
    ReplayScreen {
        trial,
        what: Shown::Between,
    }
}

fn check(row: &TrialRow, first: &TrialRow, protocol: &Protocol) -> Result<(), ReplayError> {
    if (&row.participant_id, row.session) != (&first.participant_id, first.session) {
        return Err(ReplayError::OtherSession {
            row_id: row.row_id.clone(),
            participant: row.participant_id.clone(),
            session: row.session,
        });
    }
    if row.protocol_hash != protocol.hash {
        return Err(ReplayError::OtherProtocol {
            row_id: row.row_id.clone(),
            found: row.protocol_hash.clone(),
            given: protocol.hash.clone(),
        });
    }
    Ok(())
}

/// What the row says came when, on the clock of its segment, up to the answer. Of two things at
/// one moment, what comes stands after what goes.
fn moments(row: &TrialRow, ask: Ask) -> Vec<(u64, Shown)> {
    let question = |answered| Shown::Question { ask, answered };
    let beside = matches!(ask, Ask::CloserToReference | Ask::Ranking);
    let mut known: Vec<(Option<u64>, Shown)> = Vec::new();
    if !beside {
        known.extend([
            (row.first_offset_ns, Shown::Between),
            (row.grey_offset_ns, Shown::Between),
            (row.second_offset_ns, Shown::Between),
            (row.first_onset_ns, Shown::Image { place: 0 }),
            (row.grey_onset_ns, Shown::Grey),
            (row.second_onset_ns, Shown::Image { place: 1 }),
        ]);
    }
    let with_images = row.first_onset_ns.filter(|_| beside);
    known.push((row.question_onset_ns.or(with_images), question(false)));
    known.push((row.response_ns, question(true)));
    let mut moments: Vec<(u64, Shown)> = known
        .into_iter()
        .filter_map(|(at_ns, what)| Some((at_ns?, what)))
        .collect();
    moments.sort_by_key(|(at_ns, _)| *at_ns);
    moments
}

/// The images of a row, by place.
fn images(row: &TrialRow, manifest: &Manifest) -> Result<Vec<ImageRecord>, ReplayError> {
    let hashes: Vec<&str> = if row.images_sha256.is_empty() {
        let second = Some(&*row.second_image_sha256).filter(|hash| !hash.is_empty());
        std::iter::once(&*row.first_image_sha256)
            .chain(second)
            .collect()
    } else {
        row.images_sha256.split(LIST_SEPARATOR).collect()
    };
    let found = hashes.into_iter().map(|sha256| find(row, sha256, manifest));
    found.collect()
}

fn find(row: &TrialRow, sha256: &str, manifest: &Manifest) -> Result<ImageRecord, ReplayError> {
    let mut known = manifest.images();
    let found = known.find(|image| image.sha256 == sha256).cloned();
    found.ok_or_else(|| ReplayError::UnknownImage {
        row_id: row.row_id.clone(),
        sha256: sha256.to_owned(),
        set: manifest.set_id.clone(),
    })
}
