//! Eight computers on one results folder, any of which may lose its power at any moment:
//! no slot is held by two, no participant is lost, nothing on record ever changes.
#![cfg(unix)]
#![allow(clippy::unwrap_used)]

mod tiny_study;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use greyfield::protocol::{Protocol, SessionPlan};
use greyfield::record::audit::{Severity, audit};
use greyfield::record::{Enrolment, ParticipantId, RecordError, Study};
use greyfield::seed;
use greyfield::session::headless::{Headless, HeadlessError};
use greyfield::session::observer::{Needs, Scripted};
use greyfield::session::start;
use greyfield::stimulus::Manifest;
use time::OffsetDateTime;
use tiny_study::{TRIALS, TinyStudy};

const PROCESSES: usize = 8;
const EVENTS: usize = 10_000;
const KILLS: usize = 120;
/// Something hangs if it takes longer than this.
const LIMIT: Duration = Duration::from_secs(900);

/// Where a process finds its work.
const FOLDER: &str = "GREYFIELD_RACE_STUDY";
const RESULTS: &str = "GREYFIELD_RACE_RESULTS";
/// Which of the processes, and its how many-th life.
const WHO: &str = "GREYFIELD_RACE_WHO";

/// What a process does; the number is its share of a hundred.
const EVENTS_OF_A_PROCESS: [(Deed, u32); 7] = [
    (Deed::EnrolAndFinish, 14),
    (Deed::EnrolAndAbandon, 6),
    (Deed::Resume, 14),
    (Deed::Release, 14),
    (Deed::Reject, 21),
    (Deed::Reinstate, 25),
    (Deed::Replace, 6),
];

#[derive(Clone, Copy)]
enum Deed {
    EnrolAndFinish,
    EnrolAndAbandon,
    Resume,
    Release,
    Reject,
    Reinstate,
    Replace,
}

struct Worker {
    protocol: Protocol,
    manifest: Manifest,
    study: Study,
    scripted: Scripted,
    name: String,
    enrolled: u32,
    rng: rand_chacha::ChaCha20Rng,
}

impl Worker {
    fn new(who: &str) -> Self {
        let folder = PathBuf::from(std::env::var(FOLDER).unwrap());
        let results = PathBuf::from(std::env::var(RESULTS).unwrap());
        let path = folder.join("protocol.toml");
        let text = fs::read_to_string(&path).unwrap();
        let protocol = Protocol::parse(&path, &text).unwrap();
        let manifest = Manifest::load(&folder.join("images")).unwrap();
        let study = start::open_study(&results, &protocol, &text, &manifest).unwrap();
        let needs = Needs {
            protocol: &protocol,
            manifest: &manifest,
            distances: &|_, _| Err(String::from("no images are compared here")),
        };
        let scripted = Scripted::new("random:5", &needs).unwrap();
        Self {
            protocol,
            manifest,
            study,
            scripted,
            name: who.to_owned(),
            enrolled: 0,
            rng: seed::generator(1, who, 0),
        }
    }

    /// Does things until it is killed.
    fn work(&mut self) -> ! {
        let mut known = Vec::new();
        for event in 0_u32.. {
            if event % 32 == 0 {
                known = participants(self.study.folder());
            }
            let mut pick = seed::below(&mut self.rng, 100);
            let deed = EVENTS_OF_A_PROCESS.iter().find(|(_, share)| {
                let found = pick < *share;
                pick = pick.wrapping_sub(*share);
                found
            });
            let count = u32::try_from(known.len()).unwrap();
            let somebody = (count > 0).then(|| {
                let index = seed::below(&mut self.rng, count) as usize;
                ParticipantId::new(&known[index]).unwrap()
            });
            let done = self.act(deed.unwrap().0, somebody.as_ref());
            match done {
                Ok(()) => {}
                // Refusals are right: somebody else was there first.
                Err(
                    RecordError::InUse { .. }
                    | RecordError::Released { .. }
                    | RecordError::Finished { .. }
                    | RecordError::AlreadyReleased { .. }
                    | RecordError::AlreadyRejected { .. }
                    | RecordError::NothingToReinstate { .. }
                    | RecordError::NoSlot { .. }
                    | RecordError::SlotTaken { .. },
                ) => {}
                Err(error) => panic!("{error}"),
            }
        }
        unreachable!("it is killed before")
    }

    fn act(&mut self, deed: Deed, somebody: Option<&ParticipantId>) -> Result<(), RecordError> {
        let now = OffsetDateTime::now_utc();
        match (deed, somebody) {
            (Deed::EnrolAndFinish, _) | (_, None) => {
                let enrolment = self.enrol(now)?;
                self.sit(enrolment, now)
            }
            (Deed::EnrolAndAbandon, _) => self.enrol(now).map(drop),
            (Deed::Resume, Some(id)) => {
                let enrolment = self.study.resume(id, "lab", now)?;
                self.sit(enrolment, now)
            }
            (Deed::Release, Some(id)) => {
                let slot = self.study.release(id, "left", now)?;
                say("release", id.as_str(), slot);
                Ok(())
            }
            (Deed::Reject, Some(id)) => {
                self.study.reject(id, "slept", now)?;
                say("reject", id.as_str(), 0);
                Ok(())
            }
            (Deed::Reinstate, Some(id)) => {
                let done = self.study.reinstate(id, "", now)?;
                say("reinstate", id.as_str(), done.slot);
                Ok(())
            }
            (Deed::Replace, Some(id)) => {
                let slot = self.study.release(id, "replaced", now)?;
                say("release", id.as_str(), slot);
                self.enrol(now).map(drop)
            }
        }
    }

    fn enrol(&mut self, now: OffsetDateTime) -> Result<Enrolment, RecordError> {
        self.enrolled += 1;
        let id = ParticipantId::new(&format!("{}n{}", self.name, self.enrolled))?;
        let enrolment = self.study.enrol(&id, "lab", now)?;
        say("enrol", id.as_str(), enrolment.slot);
        Ok(enrolment)
    }

    fn sit(&self, enrolment: Enrolment, now: OffsetDateTime) -> Result<(), RecordError> {
        let headless = Headless {
            study: &self.study,
            protocol: &self.protocol,
            manifest: &self.manifest,
            scripted: &self.scripted,
            station: "lab",
        };
        let (id, slot) = (enrolment.participant.clone(), enrolment.slot);
        match headless.sit(enrolment, now, &mut |_| {}) {
            Ok(_) => {
                say("finish", id.as_str(), slot);
                Ok(())
            }
            Err(HeadlessError::Record(error)) => Err(error),
            Err(error) => panic!("{error}"),
        }
    }
}

/// One line, with one write, once the event is on record.
fn say(event: &str, participant: &str, slot: u32) {
    let line = format!("done {event} {participant} {slot}\n");
    std::io::stdout().write_all(line.as_bytes()).unwrap();
    std::io::stdout().flush().unwrap();
}

/// Ids by the names of the data files: these ids are letters and digits. A file whose name
/// begins with a dot is no data file yet, and its participant nobody.
fn participants(results: &Path) -> Vec<String> {
    let names = fs::read_dir(results.join("data")).unwrap();
    let mut ids: Vec<String> = names
        .filter_map(|entry| {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let (_, rest) = name
                .split_once("_subject-")
                .filter(|_| !name.starts_with('.'))?;
            Some(rest.split_once('_')?.0.to_owned())
        })
        .collect();
    ids.sort_unstable();
    ids
}

/// No test of its own: one of the processes.
#[test]
#[ignore = "one of the processes of the race"]
fn a_process_of_the_race() {
    if let Ok(who) = std::env::var(WHO) {
        Worker::new(&who).work();
    }
}

struct Process {
    child: Child,
    lives: u32,
}

impl Drop for Process {
    fn drop(&mut self) {
        // Also where the test has failed: nothing it started goes on after it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

struct Race {
    study: TinyStudy,
    results: PathBuf,
    said: (Sender<String>, Receiver<String>),
}

impl Race {
    fn start(&self, number: usize, life: u32) -> Child {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args([
                "--exact",
                "a_process_of_the_race",
                "--ignored",
                "--nocapture",
            ])
            .env(FOLDER, self.study.path(""))
            .env(RESULTS, &self.results)
            .env(WHO, format!("p{number}l{life}"))
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let said = self.said.0.clone();
        std::thread::spawn(move || {
            for line in lines.map_while(Result::ok) {
                if line.starts_with("done ") {
                    let _ = said.send(line);
                }
            }
        });
        child
    }
}

/// What the files have said so far.
#[derive(Default)]
struct Seen {
    /// Content of every file under `slots/`.
    slots: BTreeMap<String, Vec<u8>>,
    /// Content of every data file; it may only grow.
    data: BTreeMap<String, Vec<u8>>,
}

impl Seen {
    /// Looks at everything; `again` also at what was seen before.
    fn look(&mut self, results: &Path, again: bool) {
        for name in names(&results.join("slots")) {
            if name.starts_with('.') || (!again && self.slots.contains_key(&name)) {
                continue;
            }
            let bytes = fs::read(results.join("slots").join(&name)).unwrap();
            serde_json::from_slice::<serde_json::Value>(&bytes)
                .unwrap_or_else(|error| panic!("{name} is half written: {error}"));
            let before = self.slots.entry(name.clone()).or_insert(bytes.clone());
            assert_eq!(before, &bytes, "{name} has changed");
        }
        for name in names(&results.join("data")) {
            if name.starts_with('.') || (!again && self.data.contains_key(&name)) {
                continue;
            }
            let bytes = fs::read(results.join("data").join(&name)).unwrap();
            if let Some(before) = self.data.get(&name) {
                assert!(bytes.starts_with(before), "{name} has changed");
            }
            self.data.insert(name, bytes);
        }
        self.nobody_holds_what_another_holds(results);
        let now: BTreeSet<String> = names(&results.join("slots")).into_iter().collect();
        assert!(self.slots.keys().all(|name| now.contains(name)));
    }

    /// From the files alone: claim N + 1 is there only if claim N was released.
    fn nobody_holds_what_another_holds(&self, results: &Path) {
        for name in self.slots.keys() {
            let Some((slot, number)) = claim(name) else {
                continue;
            };
            if number > 1 {
                let before = format!("slot-{slot:04}_claim-{}_released.json", number - 1);
                let released = results.join("slots").join(before);
                assert!(released.exists(), "{name}, but no {}", released.display());
            }
        }
    }

    fn count(&self, participant_claims: &BTreeSet<(u32, u32)>, what: &str) -> usize {
        let theirs = |name: &&String| {
            let stem = name.strip_suffix(".json").unwrap();
            let Some((claim_name, event)) = stem.rsplit_once('_') else {
                return false;
            };
            event.starts_with(what)
                && claim(&format!("{claim_name}.json"))
                    .is_some_and(|claim| participant_claims.contains(&claim))
        };
        self.slots.keys().filter(theirs).count()
    }
}

/// Slot and number of a claim's own file.
fn claim(name: &str) -> Option<(u32, u32)> {
    let stem = name.strip_prefix("slot-")?.strip_suffix(".json")?;
    let (slot, number) = stem.split_once("_claim-")?;
    Some((slot.parse().ok()?, number.parse().ok()?))
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

/// A process that is killed loses nothing the system has taken, on whatever disk: a
/// folder in memory shows the same and spares the disk ten thousand syncs.
fn room(study: &TinyStudy) -> (Option<tempfile::TempDir>, PathBuf) {
    match tempfile::tempdir_in("/dev/shm") {
        Ok(folder) => {
            let path = folder.path().join("results");
            (Some(folder), path)
        }
        Err(_) => (None, study.path("results")),
    }
}

#[test]
fn ten_thousand_events_of_eight_processes_that_are_killed_leave_every_slot_to_one() {
    let started = Instant::now();
    let study = TinyStudy::new();
    let (_room, results) = room(&study);
    let race = Race {
        study,
        results,
        said: channel(),
    };
    // The folder is made by all of them at once.
    let mut processes: Vec<Process> = (0..PROCESSES)
        .map(|number| Process {
            child: race.start(number, 0),
            lives: 1,
        })
        .collect();
    let mut rng = seed::generator(1, "killer", 0);
    let (mut said, mut kills, mut seen) = (Vec::new(), 0, Seen::default());
    while said.len() < EVENTS || kills < KILLS {
        assert!(
            started.elapsed() < LIMIT,
            "{} events and {kills} kills in {LIMIT:?}",
            said.len()
        );
        let until = said.len() + 20 + seed::below(&mut rng, 100) as usize;
        while said.len() < until && started.elapsed() < LIMIT {
            said.extend(race.said.1.recv_timeout(Duration::from_millis(500)));
        }
        let number = seed::below(&mut rng, u32::try_from(PROCESSES).unwrap()) as usize;
        let process = &mut processes[number];
        let status = process.child.try_wait().unwrap();
        assert!(
            status.is_none(),
            "a process has ended by itself: {status:?}"
        );
        process.child.kill().unwrap();
        process.child.wait().unwrap();
        kills += 1;
        process.child = race.start(number, process.lives);
        process.lives += 1;
        if kills % 16 == 0 {
            seen.look(&race.results, false);
        }
    }
    for mut process in processes {
        assert!(process.child.try_wait().unwrap().is_none());
        process.child.kill().unwrap();
        process.child.wait().unwrap();
    }
    while let Ok(line) = race.said.1.recv_timeout(Duration::from_millis(200)) {
        said.push(line);
    }
    println!(
        "{} events, {kills} kills, {:?}",
        said.len(),
        started.elapsed()
    );
    seen.look(&race.results, true);
    everything_said_is_there(&race.results, &said, &seen);
    the_design_is_balanced_once_its_holes_are_filled(&race);
    println!("checked after {:?}", started.elapsed());
}

fn everything_said_is_there(results: &Path, said: &[String], seen: &Seen) {
    let report = audit(results).unwrap();
    let errors: Vec<_> = report
        .findings
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .collect();
    assert!(errors.is_empty(), "{errors:#?}");
    let mut claims: BTreeMap<String, BTreeSet<(u32, u32)>> = BTreeMap::new();
    for (name, bytes) in &seen.slots {
        if let Some(claim) = claim(name) {
            let record: serde_json::Value = serde_json::from_slice(bytes).unwrap();
            let id = record["participant"].as_str().unwrap().to_owned();
            claims.entry(id).or_default().insert(claim);
        }
    }
    let study = Study::open_existing(results).unwrap();
    let standings = study.standings().unwrap();
    let rows: BTreeMap<&str, usize> = standings
        .iter()
        .map(|standing| (standing.participant.as_str(), standing.answered))
        .collect();
    let mut told: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for line in said {
        let [_, event, participant, slot] = line.split(' ').collect::<Vec<_>>()[..] else {
            panic!("{line}");
        };
        *told.entry((participant, event)).or_default() += 1;
        let theirs = &claims[participant];
        if event != "reject" {
            let slot: u32 = slot.parse().unwrap();
            assert!(theirs.iter().all(|claim| claim.0 == slot), "{line}");
        }
        if event == "finish" {
            assert_eq!(rows[participant], TRIALS, "{line}");
        }
    }
    for ((participant, event), times) in told {
        let theirs = &claims[participant];
        let on_record = match event {
            "release" => seen.count(theirs, "released"),
            "reject" => seen.count(theirs, "rejected-"),
            // Either undoes a rejection or takes the slot back, or both.
            "reinstate" => seen.count(theirs, "reinstated-") + theirs.len() - 1,
            _ => times,
        };
        assert!(on_record >= times, "{participant}: {event} {times} times");
    }
}

/// Within every block each pair then stands in each position equally often, but for the
/// part of the last block that nobody has come for yet.
fn the_design_is_balanced_once_its_holes_are_filled(race: &Race) {
    let study = Study::open_existing(&race.results).unwrap();
    let highest = |study: &Study| study.standings().unwrap().last().unwrap().slot;
    let last = highest(&study);
    for number in 0.. {
        if study.next_slot().unwrap() > last {
            break;
        }
        let id = ParticipantId::new(&format!("filler{number}")).unwrap();
        study.enrol(&id, "lab", OffsetDateTime::now_utc()).unwrap();
    }
    let held: Vec<u32> = study
        .standings()
        .unwrap()
        .into_iter()
        .filter(|standing| standing.released.is_none())
        .map(|standing| standing.slot)
        .collect();
    assert_eq!(held, (0..=last).collect::<Vec<_>>(), "each slot once");
    let protocol = study.protocol().unwrap();
    let mut counts = [0_u32; TRIALS * TRIALS];
    for &slot in &held {
        let plan = SessionPlan::new(&protocol, &study.identity().conditions, slot).unwrap();
        for trial in &plan.trials {
            counts[trial.condition * TRIALS + trial.index] += 1;
        }
    }
    let (low, high) = (counts.iter().min().unwrap(), counts.iter().max().unwrap());
    assert!(high - low <= 1, "{low} to {high}");
}
