//! Resampled participants.

use super::*;
use crate::analysis::dataset::{Answer, Order, OrderCounts};
use crate::analysis::table::Interval;
use crate::protocol::Position;

/// Participants who answer each of some pairs of techniques once; `chose_b(participant, pair)`.
pub fn answered(
    participants: u32,
    pairs: &[(&str, &str)],
    chose_b: impl Fn(u32, usize) -> bool,
) -> Dataset {
    let rows: Vec<_> = pairs.iter().map(|&(a, b)| (a, b, 0, 0)).collect();
    let mut data = counted(&rows);
    for participant in 0..participants {
        data.participants.push(format!("P{participant}"));
        for (at, condition) in data.conditions.iter_mut().enumerate() {
            let order = if (participant + at as u32).is_multiple_of(2) {
                Order::AThenB
            } else {
                Order::BThenA
            };
            let second = chose_b(participant, at) == (order == Order::AThenB);
            let chosen = Some(if second {
                Position::Second
            } else {
                Position::First
            });
            let counts = condition.orders.get_or_insert_with(OrderCounts::default);
            counts.add(order, chosen);
            condition.votes = counts.votes();
            data.answers.push(Answer {
                participant,
                condition: at as u32,
                order,
                chosen,
                response_time_ms: None,
            });
        }
    }
    data
}

const TRIANGLE: [(&str, &str); 3] = [("x", "y"), ("y", "z"), ("z", "x")];

fn settings(bootstrap: u32, seed: u64) -> Settings {
    Settings {
        bootstrap,
        seed,
        ..Settings::default()
    }
}

fn ends(section: &Section, row: usize, key: &str) -> Interval {
    let Cell::Interval(ends) = cell(table(section, "jod"), row, key) else {
        panic!("{section:#?}")
    };
    *ends
}

#[test]
fn the_same_seed_gives_the_same_interval_on_any_number_of_threads() {
    let data = answered(40, &TRIANGLE, |participant, pair| {
        (participant as usize * 7 + pair * 5) % 11 < 6
    });
    let run = |threads: usize, seed| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| report_with(&data, &settings(200, seed)))
    };
    assert_eq!(run(1, 1), run(3, 1));
    assert_ne!(run(1, 1), run(1, 2));
    assert!(all_finite(&run(1, 1)));
}

/// Where every participant repeats one of two opinions, votes hang together: the Wald interval,
/// which takes 4 votes a participant as 4 independent ones, is about half as wide as it should be.
#[test]
fn dependent_votes_widen_the_bootstrap_and_not_wald() {
    let pairs = [("x", "y"); 4];
    let data = answered(60, &pairs, |participant, _| participant % 5 < 3);
    let section = report_with(&data, &settings(2000, 1));
    let (wald, bootstrap) = (
        ends(&section, 1, "jod_ci"),
        ends(&section, 1, "jod_bootstrap"),
    );
    let ratio = (bootstrap.high - bootstrap.low) / (wald.high - wald.low);
    assert!((ratio - 2.0).abs() < 0.2, "{ratio}");
}

/// With one vote a participant, both stand for the same.
#[test]
fn independent_votes_give_the_wald_interval() {
    let data = answered(400, &[("x", "y")], |participant, _| participant % 10 < 6);
    let section = report_with(&data, &settings(2000, 1));
    let (wald, bootstrap) = (
        ends(&section, 1, "jod_ci"),
        ends(&section, 1, "jod_bootstrap"),
    );
    let wide = wald.high - wald.low;
    assert!(
        (wald.low - bootstrap.low).abs() < 0.06 * wide,
        "{wald:?} {bootstrap:?}"
    );
    assert!(
        (wald.high - bootstrap.high).abs() < 0.06 * wide,
        "{wald:?} {bootstrap:?}"
    );
}

#[test]
fn replicates_without_finite_estimate_are_counted() {
    // One dissenter of ten: about (9/10)^10 = 35 % of the resamples miss them.
    let data = answered(10, &[("x", "y")], |participant, _| participant > 0);
    let section = report_with(&data, &settings(500, 1));
    let finding = section.findings.last().unwrap();
    let count: u32 = finding
        .split(" had no finite")
        .next()
        .and_then(|text| text.rsplit(' ').next())
        .unwrap()
        .parse()
        .unwrap();
    assert!((140..=210).contains(&count), "{finding}");
    assert!(all_finite(&section));
}

#[test]
fn too_few_resamples_give_no_interval() {
    let data = answered(10, &TRIANGLE, |participant, _| participant % 2 == 0);
    let section = report_with(&data, &settings(10, 1));
    assert!(matches!(
        cell(table(&section, "jod"), 1, "jod_bootstrap"),
        Cell::Undefined(_)
    ));
}

#[test]
fn participants_without_an_answer_are_not_drawn() {
    let mut data = answered(10, &TRIANGLE, |participant, pair| {
        (participant as usize + pair).is_multiple_of(3)
    });
    let before = report_with(&data, &settings(100, 1));
    data.participants.push("late".into());
    assert_eq!(before, report_with(&data, &settings(100, 1)));
}
