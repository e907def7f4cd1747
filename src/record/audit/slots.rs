//! The files under `slots/`: nobody lost, no slot held by two.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::finding::{Findings, Severity};
use crate::record::slots::names::{self, ClaimFiles, SlotFiles};
use crate::record::slots::{Claim, KnownClaims, Part, SegmentRecord, Slots};
use crate::record::{RecordError, Reinstatement, Rejection, Release, files};

/// One claim as its files tell it.
#[derive(Debug, Clone)]
pub(super) struct KnownClaim {
    pub claim: Claim,
    pub pilot: bool,
    pub participant: String,
    pub released: bool,
    /// What each segment's file says, by number.
    pub segments: BTreeMap<u32, SegmentRecord>,
    /// The claim's own file, relative to the results folder.
    pub path: PathBuf,
}

/// Every claim that could be read.
#[derive(Debug, Default)]
pub(super) struct Claims(pub Vec<KnownClaim>);

impl Claims {
    /// Claims of a participant, in order.
    pub fn of<'a>(&'a self, participant: &'a str) -> impl Iterator<Item = &'a KnownClaim> {
        let theirs = move |claim: &&KnownClaim| claim.participant == participant;
        self.0.iter().filter(theirs)
    }

    /// How many people these are.
    pub fn participants(&self) -> usize {
        let ids: BTreeSet<&str> = self.0.iter().map(|c| c.participant.as_str()).collect();
        ids.len()
    }
}

const BY_HAND: &str = "slots are only made by Greyfield: somebody has copied, renamed or removed files here; put back the folder's backup";

/// Checks the folder of the slots and gives the claims.
pub(super) fn check(results: &Path, findings: &mut Findings) -> Result<Claims, RecordError> {
    let folder = results.join("slots");
    let mut claims = Claims::default();
    if !folder.is_dir() {
        let message = "the folder is not there: nobody knows who has which slot";
        findings.file(Severity::Error, "slots", message, BY_HAND);
        return Ok(claims);
    }
    for name in files::names(&folder)? {
        stray(&name, findings);
    }
    for pilot in [false, true] {
        let slots = Slots::new(results, pilot, KnownClaims::default());
        let listing = slots.list()?;
        for (&slot, known) in &listing {
            one_slot(slot, pilot, known, findings);
            for (&number, files) in known {
                let claim = Claim { slot, number };
                claims.0.extend(read(&slots, claim, files, findings));
            }
        }
        holes(pilot, &listing, findings);
    }
    one_slot_each(&claims, findings);
    Ok(claims)
}

/// The path of a slot's file as findings name it.
fn path(pilot: bool, claim: Claim, part: Part) -> PathBuf {
    names::path(Path::new("slots"), pilot, claim, part)
}

/// Files that are no slot's.
fn stray(name: &str, findings: &mut Findings) {
    let known = |pilot| names::parse(name, pilot).is_some();
    if known(false) || known(true) {
        return;
    }
    let path = Path::new("slots").join(name);
    if name.starts_with('.') && name.ends_with(".draft") {
        findings.file(
            Severity::Note,
            path,
            "a draft that a crash has left; nobody reads it",
            "it may be removed while no session is running",
        );
    } else {
        findings.file(
            Severity::Warning,
            path,
            "not a file of Greyfield; nobody reads it",
            "move it elsewhere",
        );
    }
}

/// Claim N + 1 needs the release of claim N; decisions need their claim and each other.
fn one_slot(slot: u32, pilot: bool, known: &SlotFiles, findings: &mut Findings) {
    let highest = known.keys().max().copied().unwrap_or(0);
    for number in 1..=highest {
        let claim = Claim { slot, number };
        let here = path(pilot, claim, Part::Claim);
        let Some(files) = known.get(&number).filter(|files| files.claimed) else {
            let message = "it is not there, though later files of this slot are";
            findings.file(Severity::Error, here, message, BY_HAND);
            continue;
        };
        if number < highest && !files.released {
            let message = format!(
                "slot {slot} is held twice: claim {number} was not released, and there is claim {}",
                number + 1
            );
            findings.file(Severity::Error, here.clone(), message, BY_HAND);
        }
        if files.reinstated > files.rejected || files.rejected > files.reinstated + 1 {
            let message = format!(
                "rejected {} times and reinstated {} times: one follows the other",
                files.rejected, files.reinstated
            );
            findings.file(Severity::Error, here, message, BY_HAND);
        }
    }
}

/// Reads every file of a claim; those that cannot be read are findings.
fn read(
    slots: &Slots,
    claim: Claim,
    files: &ClaimFiles,
    findings: &mut Findings,
) -> Option<KnownClaim> {
    let pilot = slots.is_pilot();
    let mut unreadable = |part: Part, error: &RecordError| {
        let mend =
            "an empty file is a crash on a shared folder without hard links; put back its backup";
        let message = error.to_string();
        findings.file(Severity::Error, path(pilot, claim, part), message, mend);
    };
    let mut segments = BTreeMap::new();
    for &segment in &files.segments {
        let part = Part::Segment(segment);
        match slots.read::<SegmentRecord>(claim, part) {
            Ok(record) => {
                segments.insert(segment, record);
            }
            Err(error) => unreadable(part, &error),
        }
    }
    if files.released
        && let Err(error) = slots.read::<Release>(claim, Part::Released)
    {
        unreadable(Part::Released, &error);
    }
    for count in 1..=files.rejected {
        if let Err(error) = slots.read::<Rejection>(claim, Part::Rejected(count)) {
            unreadable(Part::Rejected(count), &error);
        }
    }
    for count in 1..=files.reinstated {
        if let Err(error) = slots.read::<Reinstatement>(claim, Part::Reinstated(count)) {
            unreadable(Part::Reinstated(count), &error);
        }
    }
    if !files.claimed {
        return None; // said by one_slot
    }
    match slots.read_claim(claim) {
        Ok(record) => Some(KnownClaim {
            claim,
            pilot,
            participant: record.participant,
            released: files.released,
            segments,
            path: path(pilot, claim, Part::Claim),
        }),
        Err(error) => {
            unreadable(Part::Claim, &error);
            None
        }
    }
}

/// Open slots below the highest: the design is not balanced until they are filled.
fn holes(pilot: bool, listing: &names::Listing, findings: &mut Findings) {
    let Some(&highest) = listing.keys().max() else {
        return;
    };
    let open = |slot: &u32| names::latest(listing.get(slot)).is_none_or(|(_, released)| released);
    let open: Vec<String> = (0..highest).filter(open).map(|s| s.to_string()).collect();
    if !open.is_empty() {
        let series = names::prefix(pilot);
        findings.file(
            Severity::Note,
            "slots",
            format!("open below the highest {series}: {}", open.join(", ")),
            "the next new participants take these first",
        );
    }
}

/// A participant holds one slot, in one series.
fn one_slot_each(claims: &Claims, findings: &mut Findings) {
    let mut first: BTreeMap<&str, &KnownClaim> = BTreeMap::new();
    for claim in &claims.0 {
        let known = first.entry(claim.participant.as_str()).or_insert(claim);
        if (known.pilot, known.claim.slot) != (claim.pilot, claim.claim.slot) {
            let message = format!(
                "participant {:?} has two slots: this one and {}",
                claim.participant,
                known.path.display()
            );
            findings.file(Severity::Error, claim.path.clone(), message, BY_HAND);
        }
    }
}
