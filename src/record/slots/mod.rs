//! Slots: the places of the design, each held by one participant at a time.
//!
//! Every event is a file of its own that is made once and never changed, so that
//! several computers on one folder need no server: of two that make the same
//! name, one succeeds.
//!
//! ```text
//! slot-0003_claim-1.json               P04 takes slot 3
//! slot-0003_claim-1_segment-2.json     P04's session goes on after an interruption
//! slot-0003_claim-1_rejected-1.json    P04's data is not to be counted
//! slot-0003_claim-1_reinstated-1.json  it is to be counted after all
//! slot-0003_claim-1_released.json      P04 drops out: slot 3 is open again
//! slot-0003_claim-2.json               P09 takes it
//! ```
//!
//! A participant whose slot was released takes it back with one more claim of the
//! same slot, if nobody else has. Pilot sessions have a series of their own
//! (`pilot-0003_…`), so that they leave no holes in the design.

mod events;
pub(super) mod names;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::Serialize;
use serde::de::DeserializeOwned;

pub(super) use events::{ClaimRecord, SegmentRecord};
pub use events::{Reinstatement, Rejection, Release};
pub(super) use names::{Claim, Listing, Part};
use names::{ClaimFiles, SlotFiles};

use super::{RecordError, files};

/// Claims that were read already. A claim's file never changes, so that a folder
/// with thousands of them is read once only.
pub(super) type KnownClaims = Arc<Mutex<Known>>;

/// What [`KnownClaims`] keeps; `true` stands for the pilot's series.
#[derive(Debug, Default)]
pub(super) struct Known {
    claims: HashMap<(bool, Claim), ClaimRecord>,
    /// The one slot of each participant.
    slots: HashMap<String, (bool, u32)>,
}

/// The folder of the slots, and which series is meant.
#[derive(Debug)]
pub(super) struct Slots {
    folder: PathBuf,
    pilot: bool,
    known: KnownClaims,
}

impl Slots {
    pub fn new(results: &Path, pilot: bool, known: KnownClaims) -> Self {
        Self {
            folder: results.join("slots"),
            pilot,
            known,
        }
    }

    /// The same series.
    pub fn again(&self) -> Self {
        Self {
            folder: self.folder.clone(),
            pilot: self.pilot,
            known: Arc::clone(&self.known),
        }
    }

    /// Whether this is the pilot's series.
    pub fn is_pilot(&self) -> bool {
        self.pilot
    }

    /// What the names of the files say now.
    pub fn list(&self) -> Result<Listing, RecordError> {
        names::list(&self.folder, self.pilot)
    }

    /// As [`Self::list`], but of the slot of one participant alone where that is known
    /// already: by asking for the names that may be there, which does not grow with the
    /// folder.
    pub fn list_for(&self, participant: &str) -> Result<Listing, RecordError> {
        let known = self.known().slots.get(participant).copied();
        match known {
            None => self.list(),
            Some((pilot, _)) if pilot != self.pilot => Ok(Listing::new()),
            Some((_, slot)) => Ok(Listing::from([(slot, self.probe(slot, participant)?)])),
        }
    }

    /// What there is of one slot now; events other than the release only of one
    /// participant's claims.
    fn probe(&self, slot: u32, participant: &str) -> Result<SlotFiles, RecordError> {
        let mut files = SlotFiles::new();
        let mut segment = 2;
        for number in 1.. {
            let claim = Claim { slot, number };
            let there = |part| self.path(claim, part).exists();
            if !there(Part::Claim) {
                break;
            }
            let mut known = ClaimFiles {
                claimed: true,
                released: there(Part::Released),
                ..ClaimFiles::default()
            };
            if self.read_claim(claim)?.participant == participant {
                // Segments count on from claim to claim, and none is left out.
                while there(Part::Segment(segment)) {
                    known.segments.push(segment);
                    segment += 1;
                }
                while there(Part::Rejected(known.rejected + 1)) {
                    known.rejected += 1;
                }
                while there(Part::Reinstated(known.reinstated + 1)) {
                    known.reinstated += 1;
                }
            }
            files.insert(number, known);
        }
        Ok(files)
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The lowest slot nobody holds.
    pub fn next_open(&self) -> Result<Claim, RecordError> {
        let listing = self.list()?;
        let open = |slot: &u32| {
            let latest = names::latest(listing.get(slot));
            latest.is_none_or(|(_, released)| released)
        };
        let slot = (0..).find(open).unwrap_or(u32::MAX);
        let number = names::latest(listing.get(&slot)).map_or(1, |(number, _)| number + 1);
        Ok(Claim { slot, number })
    }

    /// Takes the lowest open slot, whoever else is trying.
    pub fn claim(&self, record: &ClaimRecord) -> Result<Claim, RecordError> {
        loop {
            let claim = self.next_open()?;
            if self.create(claim, Part::Claim, record)? {
                return Ok(claim);
            }
        }
    }

    /// Takes this very claim; false if somebody else was faster.
    pub fn claim_this(&self, claim: Claim, record: &ClaimRecord) -> Result<bool, RecordError> {
        self.create(claim, Part::Claim, record)
    }

    /// Every claim of a listing, by slot and number.
    pub fn claims_of(&self, listing: &Listing) -> Result<Vec<(Claim, ClaimRecord)>, RecordError> {
        let mut claims = Vec::new();
        for (&slot, files) in listing {
            for &number in files.keys() {
                let claim = Claim { slot, number };
                if self.has(files, claim) {
                    claims.push((claim, self.read_claim(claim)?));
                }
            }
        }
        Ok(claims)
    }

    /// Every claim of one participant, by slot and number.
    pub fn claims_by(
        &self,
        participant: &str,
        listing: &Listing,
    ) -> Result<Vec<(Claim, ClaimRecord)>, RecordError> {
        let mut claims = Vec::new();
        for (&slot, files) in listing {
            for &number in files.keys() {
                let claim = Claim { slot, number };
                let others = {
                    let known = self.known();
                    let record = known.claims.get(&(self.pilot, claim));
                    record.is_some_and(|record| record.participant != participant)
                };
                if others || !self.has(files, claim) {
                    continue;
                }
                let record = self.read_claim(claim)?;
                if record.participant == participant {
                    claims.push((claim, record));
                }
            }
        }
        Ok(claims)
    }

    /// A listing made while others write may know a claim by its other files only.
    fn has(&self, slot: &SlotFiles, claim: Claim) -> bool {
        let listed = slot.get(&claim.number).is_some_and(|files| files.claimed);
        listed || self.path(claim, Part::Claim).exists()
    }

    /// Who made a claim.
    pub fn read_claim(&self, claim: Claim) -> Result<ClaimRecord, RecordError> {
        let key = (self.pilot, claim);
        if let Some(record) = self.known().claims.get(&key) {
            return Ok(record.clone());
        }
        let record: ClaimRecord = load(&self.path(claim, Part::Claim))?;
        let mut known = self.known();
        let slot = (self.pilot, claim.slot);
        known.slots.insert(record.participant.clone(), slot);
        known.claims.insert(key, record.clone());
        Ok(record)
    }

    /// Puts an event on record; false if one of that name is there already.
    pub fn create(
        &self,
        claim: Claim,
        part: Part,
        record: &impl Serialize,
    ) -> Result<bool, RecordError> {
        let path = self.path(claim, part);
        files::create_whole(&path, &json(&path, record)?)
    }

    /// What an event's file says.
    pub fn read<T: DeserializeOwned>(&self, claim: Claim, part: Part) -> Result<T, RecordError> {
        load(&self.path(claim, part))
    }

    fn path(&self, claim: Claim, part: Part) -> PathBuf {
        names::path(&self.folder, self.pilot, claim, part)
    }
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
        Slots::new(folder, false, KnownClaims::default())
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
        assert!(slots.create(a, Part::Released, &release()).unwrap());
        let c = slots.claim(&claimed_by("c")).unwrap();
        assert_eq!((c.slot, c.number), (0, 2));
        assert_eq!(slots.claim(&claimed_by("d")).unwrap().slot, 2);
        let on_record: Vec<String> = slots
            .claims_of(&slots.list().unwrap())
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
                    let slots = Slots::new(folder.path(), false, KnownClaims::default());
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
    fn every_name_says_what_it_was_made_for() {
        let claim = Claim {
            slot: 12,
            number: 3,
        };
        for pilot in [false, true] {
            for part in [
                Part::Claim,
                Part::Segment(2),
                Part::Released,
                Part::Rejected(1),
                Part::Reinstated(7),
            ] {
                let path = names::path(Path::new("slots"), pilot, claim, part);
                let name = path.file_name().unwrap().to_string_lossy().into_owned();
                assert_eq!(names::parse(&name, pilot), Some((claim, part)), "{name}");
                assert_eq!(names::parse(&name, !pilot), None, "{name}");
                assert_eq!(names::parse(&format!(".{name}.7-0.draft"), pilot), None);
            }
        }
        assert_eq!(names::parse("slot-0001_claim-1_lost-1.json", false), None);
    }

    #[test]
    fn pilots_have_slots_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let slots = slots(folder.path());
        let pilot = Slots::new(folder.path(), true, KnownClaims::default());
        assert_eq!(pilot.claim(&claimed_by("p")).unwrap().slot, 0);
        assert_eq!(slots.claim(&claimed_by("a")).unwrap().slot, 0);
    }
}
