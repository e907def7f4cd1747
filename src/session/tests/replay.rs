//! Recorded sessions, laid out in time again.

use super::*;
use crate::protocol::procedure::Ask;
use crate::session::replay::{
    ANSWER_STANDS_NS, LONGEST_GAP_NS, Replay, ReplayError, ReplayScreen, Shown,
};
use crate::stimulus::manifest::{ImageRecord, Manifest, PairRecord, SCHEMA_VERSION};

const FINAL: Shown = Shown::Question {
    ask: Ask::Choice,
    answered: true,
};
const OPEN: Shown = Shown::Question {
    ask: Ask::Choice,
    answered: false,
};

fn manifest() -> Manifest {
    let image = |id: &str, which: &str| ImageRecord {
        file: format!("{id}-{which}.png").into(),
        sha256: format!("{id}-{which}-hash"),
        width_px: 4,
        height_px: 3,
        technique: format!("{id}-{which}"),
        parameters: std::collections::BTreeMap::new(),
        passes: Vec::new(),
        source: None,
    };
    let pairs = ["a", "b", "c"].map(|id| PairRecord {
        condition: id.to_owned(),
        scene: "atrium".to_owned(),
        validity: "low".to_owned(),
        hypothesis: String::new(),
        first: image(id, "base"),
        second: image(id, "other"),
    });
    Manifest {
        schema_version: SCHEMA_VERSION,
        set_id: "set".to_owned(),
        config_sha256: String::new(),
        seed: 0,
        app_version: String::new(),
        adapter: None,
        pairs: pairs.into(),
    }
}

/// A session of three trials, each image looked at for another time.
fn rows() -> Vec<TrialRow> {
    let mut session = session();
    let mut rows = Vec::new();
    let mut now = 500;
    while !session.is_over() {
        session.handle(Event::Shown, at(now));
        let (wait, event) = match session.screen() {
            Screen::Instructions => (1_000, Event::Begin),
            Screen::PairMenu { next, .. } => (3_000_000_000, Event::StartPair(*next)),
            Screen::Image { trial, place } => (
                1_000_000 * (1 + *trial as u64 + 10 * *place as u64),
                Event::Continue,
            ),
            Screen::Question { .. } => (700_000, chosen(Position::Second)),
            Screen::Saving => (0, Event::RowStored),
            _ => (0, Event::Tick),
        };
        now = session.wake_at().map_or(now + wait, |wake| wake.ns);
        for effect in session.handle(event, at(now)) {
            let Effect::StoreRow(row) = effect else {
                panic!("{effect:?}");
            };
            rows.push(*row);
        }
    }
    rows
}

fn replay(rows: &[TrialRow]) -> Replay {
    Replay::new(rows, &protocol(), &manifest()).unwrap()
}

fn of(trial: usize, what: Shown) -> ReplayScreen {
    ReplayScreen {
        trial: Some(trial),
        what,
    }
}

/// Every change by walking forwards.
fn changes(replay: &Replay) -> Vec<u64> {
    std::iter::successors(Some(0), |&at_ns| replay.next_change(at_ns)).collect()
}

#[test]
fn every_screen_stands_exactly_as_long_as_on_record() {
    let rows = rows();
    let replay = replay(&rows);
    let mut expected = vec![0];
    for (trial, row) in rows.iter().enumerate() {
        let changes = [
            (row.first_onset_ns, Shown::Image { place: 0 }),
            (row.grey_onset_ns, Shown::Grey),
            (row.second_onset_ns, Shown::Image { place: 1 }),
            (row.question_onset_ns, OPEN),
            (row.response_ns, FINAL),
            (
                row.response_ns.map(|ns| ns + ANSWER_STANDS_NS),
                Shown::Between,
            ),
        ]
        .map(|(at_ns, what)| (at_ns.unwrap(), what));
        for ((from_ns, what), (until_ns, _)) in changes.iter().zip(&changes[1..]) {
            assert_eq!(replay.screen_at(*from_ns), of(trial, *what));
            assert_eq!(replay.screen_at(until_ns - 1), of(trial, *what));
        }
        expected.extend(changes.map(|(at_ns, _)| at_ns));
        let shown = [&row.first_image_sha256, &row.second_image_sha256];
        let found = replay.trials[trial]
            .images
            .iter()
            .map(|image| &image.sha256);
        assert!(found.eq(shown), "the images of the row, in its order");
        let begin_end = (changes[0].0, changes[5].0);
        assert_eq!(
            (replay.trials[trial].begin_ns, replay.trials[trial].end_ns),
            begin_end
        );
    }
    assert_eq!(changes(&replay), expected);
    assert_eq!(replay.duration_ns(), *expected.last().unwrap());
    let back = |&at_ns: &u64| replay.previous_change(at_ns);
    let backwards: Vec<u64> = std::iter::successors(expected.last().copied(), back).collect();
    assert!(backwards.iter().eq(expected.iter().rev()));
    assert_eq!(replay.screen_at(u64::MAX), of(2, Shown::Between));
}

/// Where a trial starts by itself, its first image follows the answer at once.
#[test]
fn an_answer_never_stands_into_the_next_trial() {
    let mut rows = rows();
    let answered_ns = rows[0].response_ns.unwrap();
    rows[1].first_onset_ns = Some(answered_ns + 5);
    let replay = replay(&rows);
    assert_eq!(replay.screen_at(answered_ns + 4), of(0, FINAL));
    let image = Shown::Image { place: 0 };
    assert_eq!(replay.screen_at(answered_ns + 5), of(1, image));
}

#[test]
fn segments_follow_each_other_with_a_gap_that_is_cut_short() {
    for (gap_ms, gap_ns) in [
        (Some(1500), 1_500_000_000),
        (Some(86_400_000), LONGEST_GAP_NS),
        (None, LONGEST_GAP_NS),
    ] {
        let mut rows = rows();
        let shift_ns = rows[1].first_onset_ns.unwrap() - 1000;
        for row in &mut rows[1..] {
            row.segment = 2;
            for time in [
                &mut row.first_onset_ns,
                &mut row.first_offset_ns,
                &mut row.grey_onset_ns,
                &mut row.grey_offset_ns,
                &mut row.second_onset_ns,
                &mut row.second_offset_ns,
                &mut row.question_onset_ns,
                &mut row.response_ns,
            ] {
                *time = time.map(|ns| ns - shift_ns);
            }
        }
        rows[1].resume_gap_ms = gap_ms;
        let replay = replay(&rows);
        let over_ns = rows[0].response_ns.unwrap() + ANSWER_STANDS_NS;
        let gap = ReplayScreen {
            trial: None,
            what: Shown::Gap,
        };
        assert_eq!(replay.screen_at(over_ns), gap);
        assert_eq!(replay.screen_at(over_ns + gap_ns - 1), gap);
        assert_eq!(replay.screen_at(over_ns + gap_ns).what, Shown::Between);
        let image = of(1, Shown::Image { place: 0 });
        assert_eq!(replay.screen_at(over_ns + gap_ns + 1000), image);
        assert_eq!(replay.trials[1].begin_ns, over_ns + gap_ns + 1000);
        assert!(changes(&replay).is_sorted());
    }
}

#[test]
fn what_is_not_on_record_is_not_shown() {
    let mut rows = rows();
    let row = &mut rows[1];
    let (first_offset_ns, second_ns) = (row.first_offset_ns.unwrap(), row.second_onset_ns.unwrap());
    row.grey_onset_ns = None;
    let found = replay(&rows);
    assert_eq!(found.screen_at(first_offset_ns), of(1, Shown::Between));
    assert_eq!(found.screen_at(second_ns), of(1, Shown::Image { place: 1 }));
    // Nothing at all of a trial: its neighbours are as they were.
    let row = &mut rows[1];
    for time in [
        &mut row.first_onset_ns,
        &mut row.first_offset_ns,
        &mut row.grey_offset_ns,
        &mut row.second_onset_ns,
        &mut row.second_offset_ns,
        &mut row.question_onset_ns,
        &mut row.response_ns,
    ] {
        *time = None;
    }
    let found = replay(&rows);
    assert_eq!(found.trials.len(), 3);
    assert_eq!(found.screen_at(second_ns).trial, Some(0));
    assert_eq!(
        found.screen_at(rows[2].first_onset_ns.unwrap()),
        of(2, Shown::Image { place: 0 })
    );
}

#[test]
fn images_beside_the_question_come_with_it() {
    let text = include_str!("../../../protocols/yu-2009-ranking.toml");
    let ranking = Protocol::parse(Path::new("p.toml"), text).unwrap();
    let mut rows = rows();
    rows.truncate(1);
    let row = &mut rows[0];
    row.protocol_hash = ranking.hash.clone();
    row.images_sha256 = "a-base-hash;b-base-hash;c-other-hash".to_owned();
    let (from_ns, to_ns) = (row.question_onset_ns.unwrap(), row.response_ns.unwrap());
    row.first_onset_ns = Some(from_ns);
    row.second_onset_ns = Some(from_ns);
    row.first_offset_ns = None;
    row.second_offset_ns = None;
    row.grey_onset_ns = None;
    row.grey_offset_ns = None;
    let found = Replay::new(&rows, &ranking, &manifest()).unwrap();
    let asked = |answered| Shown::Question {
        ask: Ask::Ranking,
        answered,
    };
    assert_eq!(
        changes(&found),
        [0, from_ns, to_ns, to_ns + ANSWER_STANDS_NS]
    );
    assert_eq!(found.screen_at(from_ns), of(0, asked(false)));
    assert_eq!(found.screen_at(to_ns), of(0, asked(true)));
    assert_eq!(found.trials[0].images.len(), 3);
    assert_eq!(found.trials[0].images[2].technique, "c-other");
}

#[test]
fn what_would_not_be_what_was_shown_is_refused() {
    let refused = |change: &dyn Fn(&mut Vec<TrialRow>)| {
        let mut rows = rows();
        change(&mut rows);
        Replay::new(&rows, &protocol(), &manifest()).unwrap_err()
    };
    assert_eq!(refused(&Vec::clear), ReplayError::NoRows);
    let message = refused(&|rows| rows[1].second_image_sha256 = "beef".to_owned()).to_string();
    for part in ["P01:1:main:1", "beef", "--stimuli"] {
        assert!(message.contains(part), "{message}");
    }
    let message = refused(&|rows| rows[2].protocol_hash = "0123".to_owned()).to_string();
    for part in ["P01:1:main:2", "0123", "materials/protocol.toml"] {
        assert!(message.contains(part), "{message}");
    }
    let message = refused(&|rows| rows[2].participant_id = "P02".to_owned()).to_string();
    assert!(message.contains("P02"), "{message}");
}
