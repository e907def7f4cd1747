use super::*;
use crate::analysis::dataset::{Answer, ConditionData, Order, OrderCounts, Votes};
use crate::analysis::table::Interval;
use crate::analysis::tails::{Alpha, Binomial};
use crate::protocol::Position;
use crate::seed;
use proptest::prelude::*;

fn table_rows(function: &str) -> Vec<Vec<f64>> {
    include_str!("../../../tests/data/evidence.csv")
        .lines()
        .filter_map(|line| line.strip_prefix(function)?.strip_prefix(','))
        .map(|cells| {
            cells
                .split(',')
                .filter(|c| !c.is_empty())
                .map(|c| c.parse().unwrap())
                .collect()
        })
        .collect()
}

#[test]
fn confidence_sequences_are_those_of_the_table() {
    let rows = table_rows("anytime");
    assert!(rows.len() >= 30);
    for row in rows {
        let votes = Votes {
            a: row[0] as u32,
            b: row[1] as u32,
        };
        let ours = confidence_sequence(votes, Alpha::try_from(row[2]).unwrap());
        for (ours, expected) in [(ours.low, row[3]), (ours.high, row[4])] {
            assert!(
                (ours - expected).abs() <= 1e-12 * expected,
                "{row:?}: {ours}"
            );
        }
    }
}

/// Votes with the share `p` of b; how many of the first 500 it takes to reach alpha, if any.
fn stops_at(p: f64, seed: u64, study: u64) -> Option<u32> {
    let mut rng = seed::generator(seed, "sequential-test", study);
    let mut monitor = Monitor::default();
    (1..=500).find(|_| {
        monitor.vote(seed::unit_f64(&mut rng) < p);
        monitor.p().at_most(Alpha::FIVE_PERCENT)
    })
}

/// Whoever looks after every answer and stops at p ≤ 0.05 finds something in at most 5 % of studies
/// of even splits, and as often as the exact sum over all paths says. Both bounds are one-sided
/// binomial ones at 1e-4, fixed before: 4000 studies, seed 20100. Power likewise, seed 20107.
#[test]
fn optional_stopping_keeps_the_error_rate_and_has_the_power_of_the_exact_sum() {
    let studies = 4000_u32;
    for (p, seed) in [(0.5, 20_100), (0.7, 20_107)] {
        let stops: Vec<u32> = (0..u64::from(studies))
            .filter_map(|study| stops_at(p, seed, study))
            .collect();
        for n in [36, 100, 500] {
            let rejected = stops.iter().filter(|at| **at <= n).count() as u32;
            let row = (table_rows("rejects").into_iter())
                .find(|row| row[0] == p && row[1] == f64::from(n))
                .unwrap();
            let exact = Binomial::new(studies, row[3]).unwrap();
            let (above, below) = (exact.upper_tail(rejected), exact.lower_tail(rejected));
            assert!(
                above.value() > 1e-4 && below.value() > 1e-4,
                "{p} {n}: {rejected}"
            );
            if p == 0.5 {
                let nominal = Binomial::new(studies, 0.05).unwrap();
                assert!(
                    nominal.upper_tail(rejected).value() > 1e-4,
                    "{n}: {rejected}"
                );
                assert!(row[3] <= 0.05);
            }
        }
    }
}

/// The true share stays in the sequence at every vote, in at least 95 % of studies.
#[test]
fn the_confidence_sequence_holds_at_every_vote_at_once() {
    let (studies, share) = (500_u32, 0.3);
    let missed = (0..u64::from(studies))
        .filter(|study| {
            let mut rng = seed::generator(20_103, "sequential-coverage", *study);
            let mut monitor = Monitor::default();
            (0..150).any(|_| {
                monitor.vote(seed::unit_f64(&mut rng) < share);
                let interval = monitor.interval(Alpha::FIVE_PERCENT);
                !(interval.low..=interval.high).contains(&share)
            })
        })
        .count() as u32;
    let nominal = Binomial::new(studies, 0.05).unwrap();
    assert!(nominal.upper_tail(missed).value() > 1e-4, "{missed}");
}

/// After 2000 votes for one and as many for the other e is e⁻¹⁰⁰⁰ of the largest and less, which no product
/// of doubles comes back from.
#[test]
fn wealth_that_is_all_but_lost_can_come_back() {
    let mut monitor = Monitor::default();
    (0..2000).for_each(|_| _ = monitor.vote(true));
    (0..2000).for_each(|_| _ = monitor.vote(false));
    assert!(monitor.ln_e_value() < 0.0);
    assert_eq!(monitor.largest_at(), 2000);
    let largest = monitor.ln_largest_e_value();
    assert!(largest - monitor.ln_e_value() > 1000.0);
    let mut votes = 0;
    while !monitor.vote(false) {
        votes += 1;
    }
    assert!(votes > 1000);
    assert!(monitor.ln_e_value() >= largest && monitor.largest_at() == 4001 + votes);
    assert!((monitor.ln_largest_e_value() - monitor.ln_e_value()).abs() < 1e-9);
}

#[test]
fn a_monitor_without_votes_says_nothing() {
    let monitor = Monitor::default();
    assert_eq!(monitor.p(), Probability::ONE);
    assert_eq!(monitor.ln_e_value(), 0.0);
    let all = Interval {
        low: 0.0,
        high: 1.0,
    };
    assert_eq!(monitor.interval(Alpha::FIVE_PERCENT), all);
}

/// Participants in order of appearance; in the file the last one's rows stand first.
fn study(votes: &[bool], reversed: bool) -> Dataset {
    let mut orders = OrderCounts::default();
    let mut answers: Vec<Answer> = (0_u32..)
        .zip(votes)
        .map(|(participant, for_b)| {
            let chosen = Some(if *for_b {
                Position::Second
            } else {
                Position::First
            });
            orders.add(Order::AThenB, chosen);
            Answer {
                participant,
                condition: 0,
                order: Order::AThenB,
                chosen,
                response_time_ms: None,
            }
        })
        .collect();
    if reversed {
        answers.reverse();
    }
    Dataset {
        conditions: vec![ConditionData {
            id: "c".into(),
            votes: orders.votes(),
            orders: Some(orders),
            ..ConditionData::default()
        }],
        answers,
        ..Dataset::default()
    }
}

#[test]
fn the_order_of_participants_counts_not_that_of_rows() {
    // Eight for b, e = 2^8/9 = 28.4; then eight for a, and e is under 1 again.
    let votes: Vec<bool> = (0..16).map(|i| i < 8).collect();
    for reversed in [false, true] {
        let data = study(&votes, reversed);
        let section = section(&Context::of(&data, &Settings::default())).unwrap();
        let row = &section.tables[0].table.rows[0];
        assert_eq!(row[4], Cell::Count(8));
        assert_eq!(row[8], Cell::Count(8));
        let Cell::Probability(p) = row[5] else {
            panic!("{row:?}")
        };
        assert!((p.value() - 9.0 / 256.0).abs() < 1e-15);
        let Cell::Interval(interval) = row[7] else {
            panic!("{row:?}")
        };
        assert!(interval.low < 0.5 && interval.high > 0.5);
        assert!(
            section.findings[0].contains("in: 1 (c) before"),
            "{section:?}"
        );
    }
}

#[test]
fn counts_have_an_e_value_and_no_anytime_p() {
    let mut data = study(&[true; 8], false);
    data.answers.clear();
    let section = section(&Context::of(&data, &Settings::default())).unwrap();
    assert_eq!(section.status, Status::NotAvailable);
    let row = &section.tables[0].table.rows[0];
    assert!(matches!(row[2], Cell::Number(e) if (e - (256.0_f64 / 9.0).log10()).abs() < 1e-14));
    for at in [3, 4, 5, 6, 8] {
        assert_eq!(row[at], Cell::Undefined(NEEDS_ORDER));
    }
    data.conditions[0].votes = Votes::default();
    let section = super::section(&Context::of(&data, &Settings::default())).unwrap();
    assert_eq!(section.status, Status::Degenerate);
}

proptest! {
    /// p never rises, the sum of the bets is the closed form, and the set holds ½ while e < 1/alpha.
    #[test]
    fn bets_add_up(votes in prop::collection::vec(any::<bool>(), 1..400)) {
        let mut monitor = Monitor::default();
        let mut before = Probability::ONE;
        let (mut sum, mut largest) = (0.0_f64, 0.0_f64);
        for vote in votes {
            let Votes { a, b } = monitor.votes();
            let side = if vote { b } else { a };
            sum += (2.0 * f64::from(side + 1) / f64::from(a + b + 2)).ln();
            let larger = monitor.vote(vote);
            prop_assert_eq!(larger, sum > largest + 1e-12, "{} {}", sum, largest);
            largest = sum.max(largest);
            prop_assert!((sum - monitor.ln_e_value()).abs() < 1e-11);
            prop_assert!((largest - monitor.ln_largest_e_value()).abs() < 1e-11);
            prop_assert!(monitor.p().ln() <= before.ln() + 1e-12);
            before = monitor.p();
            let interval = monitor.interval(Alpha::FIVE_PERCENT);
            let inside = interval.low < 0.5 && 0.5 < interval.high;
            prop_assert_eq!(inside, monitor.ln_e_value() < 20_f64.ln());
            let share = monitor.votes().share_b().unwrap();
            prop_assert!(interval.low <= share && share <= interval.high);
        }
    }
}
