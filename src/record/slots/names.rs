//! The names of the files under `slots/`: what each says, and the path of each.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::record::{RecordError, files};

/// One participant's hold on a slot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(in crate::record) struct Claim {
    /// Participant number in the design, from 0.
    pub slot: u32,
    /// From 1; each later one needs the release of the one before.
    pub number: u32,
}

/// What a file of a claim is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::record) enum Part {
    /// The claim itself.
    Claim,
    /// The session went on, as this segment.
    Segment(u32),
    /// The slot was given up.
    Released,
    /// The participant was rejected, for the nth time.
    Rejected(u32),
    /// The nth rejection was taken back.
    Reinstated(u32),
}

/// What file names say about one claim.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(in crate::record) struct ClaimFiles {
    /// The claim's own file is there.
    pub claimed: bool,
    /// Numbers of the segments on record, in order.
    pub segments: Vec<u32>,
    /// It was given up.
    pub released: bool,
    /// How often it was rejected.
    pub rejected: u32,
    /// How often that was taken back.
    pub reinstated: u32,
}

/// What file names say about one slot: its claims by number.
pub(in crate::record) type SlotFiles = BTreeMap<u32, ClaimFiles>;

/// What file names say about a whole series, by slot.
pub(in crate::record) type Listing = BTreeMap<u32, SlotFiles>;

/// How the names of a series begin.
pub(in crate::record) fn prefix(pilot: bool) -> &'static str {
    if pilot { "pilot" } else { "slot" }
}

/// Path of one file of a claim.
pub(in crate::record) fn path(
    folder: &Path,
    pilot: bool,
    Claim { slot, number }: Claim,
    part: Part,
) -> PathBuf {
    let prefix = prefix(pilot);
    let what = match part {
        Part::Claim => String::new(),
        Part::Segment(segment) => format!("_segment-{segment}"),
        Part::Released => "_released".to_owned(),
        Part::Rejected(count) => format!("_rejected-{count}"),
        Part::Reinstated(count) => format!("_reinstated-{count}"),
    };
    folder.join(format!("{prefix}-{slot:04}_claim-{number}{what}.json"))
}

/// What a file's name says; `None` for files that are no slot's of this series.
pub(in crate::record) fn parse(name: &str, pilot: bool) -> Option<(Claim, Part)> {
    let stem = name.strip_prefix(prefix(pilot))?.strip_suffix(".json")?;
    let (slot, rest) = stem.strip_prefix('-')?.split_once("_claim-")?;
    let (number, part) = match rest.split_once('_') {
        None => (rest, Part::Claim),
        Some((number, "released")) => (number, Part::Released),
        Some((number, counted)) => {
            let (what, count) = counted.split_once('-')?;
            let count: u32 = count.parse().ok()?;
            let part = match what {
                "segment" => Part::Segment(count),
                "rejected" => Part::Rejected(count),
                "reinstated" => Part::Reinstated(count),
                _ => return None,
            };
            (number, part)
        }
    };
    let claim = Claim {
        slot: slot.parse().ok()?,
        number: number.parse().ok()?,
    };
    Some((claim, part))
}

/// What the names of a folder say about a series.
pub(in crate::record) fn list(folder: &Path, pilot: bool) -> Result<Listing, RecordError> {
    let mut listing = Listing::new();
    files::each_name(folder, |name| {
        let Some((claim, part)) = parse(name, pilot) else {
            return;
        };
        let known = listing.entry(claim.slot).or_default();
        let known = known.entry(claim.number).or_default();
        match part {
            Part::Claim => known.claimed = true,
            Part::Segment(segment) => known.segments.push(segment),
            Part::Released => known.released = true,
            Part::Rejected(count) => known.rejected = known.rejected.max(count),
            Part::Reinstated(count) => known.reinstated = known.reinstated.max(count),
        }
    })?;
    for known in listing.values_mut().flat_map(BTreeMap::values_mut) {
        known.segments.sort_unstable();
    }
    Ok(listing)
}

/// The latest claim of a slot, and whether it was given up; `None` if nobody ever
/// held it.
pub(in crate::record) fn latest(slot: Option<&SlotFiles>) -> Option<(u32, bool)> {
    let (&number, known) = slot?.iter().next_back()?;
    Some((number, known.released))
}
