//! Who stands where: the participants of a study, and what the experimenter decides
//! about them. Nothing is ever taken away; every decision is one more file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use time::OffsetDateTime;

use super::slots::names::{ClaimFiles, latest};
use super::slots::{
    Claim, ClaimRecord, KnownClaims, Listing, Part, Reinstatement, Rejection, Release,
    SegmentRecord, Slots,
};
use super::study::{Study, claim_record, iso_8601, unknown};
use super::{ParticipantId, RecordError, RowLog};

/// Where one participant stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Standing {
    /// The participant's id.
    pub participant: String,
    /// Participant number in the design, from 0.
    pub slot: u32,
    /// Whether the slot is one of the pilot's.
    pub pilot: bool,
    /// Trials on record.
    pub answered: usize,
    /// Set if the slot was given up.
    pub released: Option<Release>,
    /// Set if the data is not to be counted.
    pub rejected: Option<Rejection>,
}

/// What [`Study::reinstate`] did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reinstated {
    /// The participant's slot.
    pub slot: u32,
    /// The slot had been given up and is the participant's again.
    pub took_slot_back: bool,
}

impl Study {
    /// Gives a participant's slot to the next one; both stay on record.
    ///
    /// # Errors
    /// [`RecordError`], also if the participant holds no slot or the session is running.
    pub fn release(
        &self,
        participant: &ParticipantId,
        reason: &str,
        now: OffsetDateTime,
    ) -> Result<u32, RecordError> {
        let (_log, held) = self.decide_about(participant)?;
        let claim = held.latest();
        let release = Release {
            reason: reason.to_owned(),
            released_utc: iso_8601(now),
        };
        if held.slots.create(claim, Part::Released, &release)? {
            return Ok(claim.slot);
        }
        let Release {
            reason,
            released_utc,
        } = held.slots.read(claim, Part::Released)?;
        Err(RecordError::AlreadyReleased {
            participant: participant.to_string(),
            slot: claim.slot,
            reason,
            released_utc,
        })
    }

    /// Marks a participant's data as not to be counted. It stays where it is, and so
    /// does the participant's hold on the slot; [`Study::release`] gives that to the
    /// next one.
    ///
    /// # Errors
    /// [`RecordError`], also if it is marked already or the session is running.
    pub fn reject(
        &self,
        participant: &ParticipantId,
        reason: &str,
        now: OffsetDateTime,
    ) -> Result<(), RecordError> {
        let (_log, held) = self.decide_about(participant)?;
        let already = |known: Rejection| RecordError::AlreadyRejected {
            participant: participant.to_string(),
            reason: known.reason,
            rejected_utc: known.rejected_utc,
        };
        if let Some(known) = held.rejection()? {
            return Err(already(known));
        }
        let claim = held.latest();
        let count = Part::Rejected(held.files(claim).rejected + 1);
        let rejection = Rejection {
            reason: reason.to_owned(),
            rejected_utc: iso_8601(now),
        };
        if held.slots.create(claim, count, &rejection)? {
            return Ok(());
        }
        Err(already(held.slots.read(claim, count)?))
    }

    /// Takes back a rejection, a release or both: the data counts again, and the slot
    /// is the participant's again, unless somebody else has taken it since.
    ///
    /// # Errors
    /// [`RecordError`], also if somebody else holds the slot (nothing is changed then),
    /// if there is nothing to take back, or if the session is running.
    pub fn reinstate(
        &self,
        participant: &ParticipantId,
        reason: &str,
        now: OffsetDateTime,
    ) -> Result<Reinstated, RecordError> {
        let (_log, held) = self.decide_about(participant)?;
        let claim = held.latest();
        let rejections = held.open_rejections();
        let took_slot_back = held.files(claim).released;
        if !took_slot_back && rejections.is_empty() {
            return Err(RecordError::NothingToReinstate {
                participant: participant.to_string(),
                slot: claim.slot,
            });
        }
        if took_slot_back {
            self.take_back(participant, &held, claim.slot, now)?;
        }
        let reinstatement = Reinstatement {
            reason: reason.to_owned(),
            reinstated_utc: iso_8601(now),
        };
        for (claim, count) in rejections {
            // One of that name says the same already.
            let _ = held
                .slots
                .create(claim, Part::Reinstated(count), &reinstatement)?;
        }
        Ok(Reinstated {
            slot: claim.slot,
            took_slot_back,
        })
    }

    /// Claims the slot that a participant had given up, if nobody holds it.
    fn take_back(
        &self,
        participant: &ParticipantId,
        held: &Held,
        slot: u32,
        now: OffsetDateTime,
    ) -> Result<(), RecordError> {
        let station = held.station();
        loop {
            let listing = held.slots.list_for(participant.as_str())?;
            let (number, released) = latest(listing.get(&slot)).unwrap_or((0, true));
            if !released {
                let holder = held.slots.read_claim(Claim { slot, number })?;
                return Err(RecordError::SlotTaken {
                    participant: participant.to_string(),
                    slot,
                    holder: holder.participant,
                    since_utc: holder.claimed_utc,
                });
            }
            let next = Claim {
                slot,
                number: number + 1,
            };
            let record = claim_record(participant, station, now);
            if held.slots.claim_this(next, &record)? {
                return Ok(());
            }
        }
    }

    /// Everybody who ever held a slot of this series, once, by slot.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn standings(&self) -> Result<Vec<Standing>, RecordError> {
        let slots = self.slots(self.is_pilot());
        let mut standings = Vec::new();
        for (participant, held) in everybody(&slots)? {
            standings.push((held.latest(), self.standing(participant, &held)?));
        }
        standings.sort_by_key(|(claim, _)| *claim);
        Ok(standings
            .into_iter()
            .map(|(_, standing)| standing)
            .collect())
    }

    fn standing(&self, participant: String, held: &Held) -> Result<Standing, RecordError> {
        let id = ParticipantId::new(&participant)?;
        let claim = held.latest();
        Ok(Standing {
            slot: claim.slot,
            pilot: held.slots.is_pilot(),
            answered: self.answered(&id)?.unwrap_or(0),
            released: if held.files(claim).released {
                Some(held.slots.read(claim, Part::Released)?)
            } else {
                None
            },
            rejected: held.rejection()?,
            participant,
        })
    }

    /// Ids of the participants whose data is not to be counted, of both series.
    ///
    /// # Errors
    /// [`RecordError`] if the folder cannot be read.
    pub fn rejected_ids(&self) -> Result<BTreeSet<String>, RecordError> {
        Ok(rejections(self.folder())?.into_keys().collect())
    }

    /// The participant's claims, and the session's file, held so that nobody resumes
    /// what is being decided about.
    fn decide_about(&self, participant: &ParticipantId) -> Result<(RowLog, Held), RecordError> {
        let path = self.data_path(participant);
        if !path.exists() {
            return Err(unknown(participant));
        }
        let log = RowLog::open(&path, participant.as_str())?;
        let held = self.held(participant)?.ok_or(RecordError::NoSlot {
            participant: participant.to_string(),
        })?;
        Ok((log, held))
    }

    /// A participant's claims, in either series.
    pub(super) fn held(&self, participant: &ParticipantId) -> Result<Option<Held>, RecordError> {
        for pilot in [self.is_pilot(), !self.is_pilot()] {
            let slots = self.slots(pilot);
            let listing = slots.list_for(participant.as_str())?;
            let claims = slots.claims_by(participant.as_str(), &listing)?;
            if !claims.is_empty() {
                return Ok(Some(Held {
                    slots,
                    listing,
                    claims,
                }));
            }
        }
        Ok(None)
    }
}

/// The participants of a results folder whose data is not to be counted, and why.
///
/// # Errors
/// [`RecordError`] if the folder's `slots/` is there and cannot be read.
pub fn rejections(results: &Path) -> Result<BTreeMap<String, Rejection>, RecordError> {
    let mut rejected = BTreeMap::new();
    if !results.join("slots").is_dir() {
        return Ok(rejected);
    }
    for pilot in [false, true] {
        let slots = Slots::new(results, pilot, KnownClaims::default());
        for (participant, held) in everybody(&slots)? {
            if let Some(rejection) = held.rejection()? {
                rejected.insert(participant, rejection);
            }
        }
    }
    Ok(rejected)
}

/// Everybody who ever held a slot of a series.
fn everybody(slots: &Slots) -> Result<BTreeMap<String, Held>, RecordError> {
    let listing = slots.list()?;
    let mut everybody: BTreeMap<String, Held> = BTreeMap::new();
    for (claim, record) in slots.claims_of(&listing)? {
        let held = everybody
            .entry(record.participant.clone())
            .or_insert_with(|| Held {
                slots: slots.again(),
                listing: Listing::new(),
                claims: Vec::new(),
            });
        let files = listing.get(&claim.slot).cloned().unwrap_or_default();
        held.listing.insert(claim.slot, files);
        held.claims.push((claim, record));
    }
    Ok(everybody)
}

/// The claims of one participant, at least one.
#[derive(Debug)]
pub(super) struct Held {
    pub slots: Slots,
    listing: Listing,
    claims: Vec<(Claim, ClaimRecord)>,
}

impl Held {
    /// What holds the participant's slot, or held it last.
    pub fn latest(&self) -> Claim {
        // Never empty where it is made.
        self.claims
            .last()
            .map_or(Claim { slot: 0, number: 1 }, |(claim, _)| *claim)
    }

    /// What the names of a claim's files say.
    pub fn files(&self, claim: Claim) -> ClaimFiles {
        let slot = self.listing.get(&claim.slot);
        slot.and_then(|slot| slot.get(&claim.number))
            .cloned()
            .unwrap_or_default()
    }

    /// The computer of the latest claim.
    fn station(&self) -> &str {
        self.claims
            .last()
            .map_or("", |(_, record)| record.station.as_str())
    }

    /// Wall-clock times that the claims and the segments have left on record.
    pub fn times_utc(&self) -> Result<Vec<String>, RecordError> {
        let mut times = Vec::new();
        for (claim, record) in &self.claims {
            times.push(record.claimed_utc.clone());
            for segment in self.files(*claim).segments {
                let record: SegmentRecord = self.slots.read(*claim, Part::Segment(segment))?;
                times.push(record.resumed_utc);
            }
        }
        Ok(times)
    }

    /// Puts one more segment on record and gives its number, from 2. Segments count on
    /// where a slot was taken back.
    pub fn add_segment(&self, record: &SegmentRecord) -> Result<u32, RecordError> {
        let last = |(claim, _): &(Claim, ClaimRecord)| self.files(*claim).segments.last().copied();
        let mut segment = 1 + self.claims.iter().filter_map(last).max().unwrap_or(1);
        while !self
            .slots
            .create(self.latest(), Part::Segment(segment), record)?
        {
            segment += 1;
        }
        Ok(segment)
    }

    /// Rejections that were not taken back: claim and number.
    fn open_rejections(&self) -> Vec<(Claim, u32)> {
        self.claims
            .iter()
            .map(|(claim, _)| (*claim, self.files(*claim)))
            .filter(|(_, files)| files.rejected > files.reinstated)
            .map(|(claim, files)| (claim, files.rejected))
            .collect()
    }

    /// Why the data is not to be counted, if it is not.
    fn rejection(&self) -> Result<Option<Rejection>, RecordError> {
        self.open_rejections()
            .last()
            .map(|&(claim, count)| self.slots.read(claim, Part::Rejected(count)))
            .transpose()
    }
}
