//! Slots: the places of the design, each held by one participant at a time.
//!
//! Every event is a file of its own that is made once and never changed, so that
//! several computers on one folder need no server: of two that make the same
//! name, one succeeds.
//!
//! ```text
//! slot-0003_claim-1.json            P04 takes slot 3
//! slot-0003_claim-1_segment-2.json  P04's session goes on after an interruption
//! slot-0003_claim-1_released.json   P04 drops out: slot 3 is open again
//! slot-0003_claim-2.json            P09 takes it
//! ```
//!
//! Pilot sessions have a series of their own (`pilot-0003_…`), so that they leave
//! no holes in the design.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::{RecordError, files};

/// The folder of the slots, and which series is meant.
#[derive(Debug)]
pub(super) struct Slots {
    folder: PathBuf,
    pilot: bool,
}

/// One participant's hold on a slot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Claim {
    pub slot: u32,
    /// From 1; each later one needs the release of the one before.
    pub number: u32,
}

/// What a claim's file says.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct ClaimRecord {
    pub participant: String,
    pub station: String,
    pub claimed_utc: String,
}

/// What the file of a resumed session says.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct SegmentRecord {
    pub station: String,
    pub resumed_utc: String,
}

/// Why and when a slot was given up.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Release {
    /// The experimenter's words.
    pub reason: String,
    /// Wall-clock time, UTC, ISO 8601.
    pub released_utc: String,
}

/// What a folder's file names say about one slot.
#[derive(Debug, Default)]
struct Standing {
    claims: u32,
    /// The latest claim that was released.
    released: u32,
    /// Segment files of each claim.
    segments: BTreeMap<u32, u32>,
}

enum Part {
    Claim,
    Segment,
    Released,
}

impl Slots {
    pub fn new(results: &Path, pilot: bool) -> Self {
        Self {
            folder: results.join("slots"),
            pilot,
        }
    }

    /// Whether this is the pilot's series.
    pub fn is_pilot(&self) -> bool {
        self.pilot
    }

    /// The lowest slot nobody holds.
    pub fn next_open(&self) -> Result<Claim, RecordError> {
        let standings = self.standings()?;
        let open = |slot: &u32| {
            standings
                .get(slot)
                .is_none_or(|standing| standing.claims == standing.released)
        };
        let slot = (0..).find(open).unwrap_or(u32::MAX);
        let number = standings.get(&slot).map_or(1, |known| known.claims + 1);
        Ok(Claim { slot, number })
    }

    /// Takes the lowest open slot, whoever else is trying.
    pub fn claim(&self, record: &ClaimRecord) -> Result<Claim, RecordError> {
        loop {
            let claim = self.next_open()?;
            if create(&self.claim_path(claim), record)? {
                return Ok(claim);
            }
        }
    }

    /// Every claim ever made, by slot and number.
    pub fn claims(&self) -> Result<Vec<(Claim, ClaimRecord)>, RecordError> {
        let mut claims = Vec::new();
        for (slot, standing) in self.standings()? {
            for number in 1..=standing.claims {
                let claim = Claim { slot, number };
                claims.push((claim, load(&self.claim_path(claim))?));
            }
        }
        Ok(claims)
    }

    /// The latest claim of a participant.
    pub fn find(&self, participant: &str) -> Result<Option<(Claim, ClaimRecord)>, RecordError> {
        let claims = self.claims()?;
        Ok(claims
            .into_iter()
            .rfind(|(_, record)| record.participant == participant))
    }

    /// Puts a new segment on record and gives its number, from 2.
    pub fn add_segment(&self, claim: Claim, record: &SegmentRecord) -> Result<u32, RecordError> {
        let mut segment = 2 + self.segments(claim)?.len().try_into().unwrap_or(0);
        while !create(&self.segment_path(claim, segment), record)? {
            segment += 1;
        }
        Ok(segment)
    }

    /// The resumes of a claim, in order.
    pub fn segments(&self, claim: Claim) -> Result<Vec<SegmentRecord>, RecordError> {
        let standings = self.standings()?;
        let count = standings
            .get(&claim.slot)
            .and_then(|standing| standing.segments.get(&claim.number))
            .copied()
            .unwrap_or(0);
        (2..2 + count)
            .map(|segment| load(&self.segment_path(claim, segment)))
            .collect()
    }

    /// Gives a claim up; the first reason on record counts.
    pub fn release(&self, claim: Claim, record: &Release) -> Result<(), RecordError> {
        create(&self.release_path(claim), record).map(|_| ())
    }

    /// How a claim was given up, if it was.
    pub fn released(&self, claim: Claim) -> Result<Option<Release>, RecordError> {
        let path = self.release_path(claim);
        if path.exists() {
            load(&path).map(Some)
        } else {
            Ok(None)
        }
    }

    fn prefix(&self) -> &'static str {
        if self.pilot { "pilot" } else { "slot" }
    }

    fn claim_path(&self, Claim { slot, number }: Claim) -> PathBuf {
        let prefix = self.prefix();
        self.folder
            .join(format!("{prefix}-{slot:04}_claim-{number}.json"))
    }

    fn segment_path(&self, Claim { slot, number }: Claim, segment: u32) -> PathBuf {
        let prefix = self.prefix();
        self.folder.join(format!(
            "{prefix}-{slot:04}_claim-{number}_segment-{segment}.json"
        ))
    }

    fn release_path(&self, Claim { slot, number }: Claim) -> PathBuf {
        let prefix = self.prefix();
        self.folder
            .join(format!("{prefix}-{slot:04}_claim-{number}_released.json"))
    }

    fn standings(&self) -> Result<BTreeMap<u32, Standing>, RecordError> {
        let mut standings: BTreeMap<u32, Standing> = BTreeMap::new();
        for name in files::names(&self.folder)? {
            let Some((claim, part)) = parse(&name, self.prefix()) else {
                continue;
            };
            let standing = standings.entry(claim.slot).or_default();
            match part {
                Part::Claim => standing.claims = standing.claims.max(claim.number),
                Part::Segment => *standing.segments.entry(claim.number).or_default() += 1,
                Part::Released => standing.released = standing.released.max(claim.number),
            }
        }
        Ok(standings)
    }
}

/// What a file's name says; `None` for files that are no slot's of this series.
fn parse(name: &str, prefix: &str) -> Option<(Claim, Part)> {
    let stem = name.strip_prefix(prefix)?.strip_suffix(".json")?;
    let (slot, rest) = stem.strip_prefix('-')?.split_once("_claim-")?;
    let (number, part) = match rest.split_once('_') {
        None => (rest, Part::Claim),
        Some((number, "released")) => (number, Part::Released),
        Some((number, segment)) => {
            segment.strip_prefix("segment-")?.parse::<u32>().ok()?;
            (number, Part::Segment)
        }
    };
    let claim = Claim {
        slot: slot.parse().ok()?,
        number: number.parse().ok()?,
    };
    Some((claim, part))
}

fn create(path: &Path, record: &impl Serialize) -> Result<bool, RecordError> {
    files::create_whole(path, &json(path, record)?)
}

/// A record as indented JSON with a line break at its end.
pub(super) fn json(path: &Path, record: &impl Serialize) -> Result<Vec<u8>, RecordError> {
    let mut text = serde_json::to_vec_pretty(record)
        .map_err(|error| RecordError::io(path, "write")(error.into()))?;
    text.push(b'\n');
    Ok(text)
}

/// Reads a record.
pub(super) fn load<T: DeserializeOwned>(path: &Path) -> Result<T, RecordError> {
    let bytes = files::read(path)?;
    serde_json::from_slice(&bytes).map_err(|error| RecordError::Malformed {
        path: path.to_owned(),
        line: error.line() as u64,
        message: format!("not a file Greyfield wrote, or changed since: {error}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claimed_by(participant: &str) -> ClaimRecord {
        ClaimRecord {
            participant: participant.to_owned(),
            station: "lab".to_owned(),
            claimed_utc: String::new(),
        }
    }

    fn slots(folder: &Path) -> Slots {
        std::fs::create_dir_all(folder.join("slots")).unwrap();
        Slots::new(folder, false)
    }

    fn release() -> Release {
        Release {
            reason: "left".to_owned(),
            released_utc: String::new(),
        }
    }

    #[test]
    fn a_released_slot_is_taken_by_the_next_and_both_stay() {
        let folder = tempfile::tempdir().unwrap();
        let slots = slots(folder.path());
        let a = slots.claim(&claimed_by("a")).unwrap();
        let b = slots.claim(&claimed_by("b")).unwrap();
        assert_eq!((a.slot, b.slot), (0, 1));
        slots.release(a, &release()).unwrap();
        let c = slots.claim(&claimed_by("c")).unwrap();
        assert_eq!((c.slot, c.number), (0, 2));
        assert_eq!(slots.claim(&claimed_by("d")).unwrap().slot, 2);
        let on_record: Vec<String> = slots
            .claims()
            .unwrap()
            .into_iter()
            .map(|(_, record)| record.participant)
            .collect();
        assert_eq!(on_record, ["a", "c", "b", "d"]);
    }

    #[test]
    fn many_at_once_get_every_slot_once() {
        let folder = tempfile::tempdir().unwrap();
        slots(folder.path());
        let mut taken: Vec<u32> = std::thread::scope(|scope| {
            let stations: Vec<_> = (0..6)
                .map(|station| {
                    let slots = Slots::new(folder.path(), false);
                    scope.spawn(move || {
                        let who = claimed_by(&format!("station{station}"));
                        (0..10)
                            .map(|_| slots.claim(&who).unwrap().slot)
                            .collect::<Vec<_>>()
                    })
                })
                .collect();
            stations
                .into_iter()
                .flat_map(|s| s.join().unwrap())
                .collect()
        });
        taken.sort_unstable();
        assert_eq!(taken, (0..60).collect::<Vec<_>>());
    }

    #[test]
    fn pilots_have_slots_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let slots = slots(folder.path());
        let pilot = Slots::new(folder.path(), true);
        assert_eq!(pilot.claim(&claimed_by("p")).unwrap().slot, 0);
        assert_eq!(slots.claim(&claimed_by("a")).unwrap().slot, 0);
    }
}
