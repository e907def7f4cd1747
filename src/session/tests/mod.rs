//! The session of every procedure: every path, every row, and random events on top.

mod onsets;
mod pages;
mod procedures;
mod random;
mod replay;
mod rows;
mod screens;

use std::path::Path;

use time::macros::datetime;

use super::{
    Answer, DisplayOnRecord, Effect, Event, ImageHashes, Screen, Session, SessionInfo, SessionTime,
};
use crate::protocol::{Condition, Language, Position, Protocol, SessionPlan};
use crate::record::{InputDevice, OnsetMethod, TrialRow};

const GREY_NS: u64 = 2_000_000_000;

fn protocol() -> Protocol {
    let text = include_str!("../../../protocols/thesis-2010.toml");
    Protocol::parse(Path::new("p.toml"), text).unwrap()
}

fn conditions() -> Vec<Condition> {
    ["a", "b", "c"]
        .map(|id| Condition {
            id: id.to_owned(),
            scene: "atrium".to_owned(),
            techniques: vec![format!("{id}-base"), format!("{id}-other")],
            reference: None,
            hypothesis: String::new(),
        })
        .into()
}

fn info(answered: usize) -> SessionInfo {
    SessionInfo {
        participant_id: "P01".to_owned(),
        session: 1,
        segment: 1,
        station_id: "lab".to_owned(),
        pilot: false,
        language: Language::En,
        started_utc: datetime!(2026-03-01 10:00 UTC),
        onset_method: OnsetMethod::PresentCall,
        onset_uncertainty_ms: Some(16.7),
        display: DisplayOnRecord::default(),
        refresh_period_ns: None,
        input_device: InputDevice::Keyboard,
        images: ["a", "b", "c"]
            .map(|id| ImageHashes {
                images: vec![format!("{id}-base-hash"), format!("{id}-other-hash")],
                reference: None,
            })
            .into(),
        answered,
        has_told: false,
        interrupted_utc: None,
    }
}

fn session_with(slot: u32, info: SessionInfo) -> Session {
    let plan = SessionPlan::new(&protocol(), &conditions(), slot).unwrap();
    Session::new(plan, &protocol(), info)
}

fn session() -> Session {
    session_with(0, info(0))
}

fn at(ns: u64) -> SessionTime {
    SessionTime { ns }
}

/// Feeds events, none of which may have an effect.
fn feed(session: &mut Session, events: &[(u64, Event)]) {
    for (ns, event) in events {
        assert_eq!(session.handle(event.clone(), at(*ns)), [], "{event:?}");
    }
}

fn image(trial: usize, position: Position) -> Screen {
    Screen::Image {
        trial,
        place: position.place(),
    }
}

/// Brings a new session to the question of its first trial, shown at 10 s.
fn to_question() -> Session {
    let mut session = session();
    feed(
        &mut session,
        &[
            (0, Event::Begin),
            (0, Event::StartPair(0)),
            (1_000_000_000, Event::Shown),
            (4_000_000_000, Event::Continue),
            (4_100_000_000, Event::Shown),
            (6_100_000_000, Event::Tick),
            (6_200_000_000, Event::Shown),
            (9_900_000_000, Event::Continue),
            (10_000_000_000, Event::Shown),
        ],
    );
    assert_eq!(session.screen(), &Screen::Question { trial: 0 });
    session
}

fn chosen(choice: Position) -> Event {
    Event::Answer(Answer::Choice(choice))
}

fn answer(session: &mut Session, choice: Position, ns: u64) -> TrialRow {
    let effects = session.handle(chosen(choice), at(ns));
    let [Effect::StoreRow(row)] = &effects[..] else {
        panic!("{effects:?}");
    };
    (**row).clone()
}

/// A participant in a hurry.
fn run_to_end(session: &mut Session) -> Vec<TrialRow> {
    let mut rows = Vec::new();
    let mut now = 0;
    while !session.is_over() {
        session.handle(Event::Shown, at(now));
        let event = match session.screen() {
            Screen::Instructions => Event::Begin,
            Screen::PairMenu { next, .. } => Event::StartPair(*next),
            Screen::Image { .. } => Event::Continue,
            Screen::Grey { .. } => Event::Tick,
            Screen::Question { .. } => chosen(Position::First),
            Screen::Saving => Event::RowStored,
            other => panic!("{other:?}"),
        };
        now = session.wake_at().map_or(now + 1, |wake| wake.ns);
        for effect in session.handle(event, at(now)) {
            let Effect::StoreRow(row) = effect else {
                panic!("{effect:?}");
            };
            rows.push(*row);
        }
    }
    assert_eq!(session.screen(), &Screen::Closing);
    rows
}
