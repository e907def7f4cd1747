//! The status against the definition, over all divisions of the techniques.

use super::super::graph;
use super::*;
use proptest::prelude::*;

/// Ford's condition as he states it: in every division into two sets, somebody inside lost to
/// somebody outside.
fn is_finite(techniques: usize, wins: &[(usize, usize)]) -> bool {
    (1..(1_u32 << techniques) - 1).all(|inside| {
        wins.iter()
            .any(|&(winner, loser)| inside >> loser & 1 == 1 && inside >> winner & 1 == 0)
    })
}

/// In every division, somebody was compared with somebody on the other side.
fn is_connected(techniques: usize, wins: &[(usize, usize)]) -> bool {
    (1..(1_u32 << techniques) - 1).all(|inside| {
        wins.iter()
            .any(|&(winner, loser)| (inside >> loser & 1) != (inside >> winner & 1))
    })
}

const NAMES: [&str; 7] = ["t0", "t1", "t2", "t3", "t4", "t5", "t6"];

/// Two to seven techniques, each named by some condition, and few votes: all kinds of graphs.
fn studies() -> impl Strategy<Value = (usize, Vec<(usize, usize, u32, u32)>)> {
    (2..=7_usize).prop_flat_map(|techniques| {
        let vote = prop_oneof![3 => Just(0_u32), 2 => 1..4_u32, 1 => 1..2000_u32];
        let row = (0..techniques, 1..techniques, vote.clone(), vote)
            .prop_map(move |(a, step, for_a, for_b)| (a, (a + step) % techniques, for_a, for_b));
        (Just(techniques), prop::collection::vec(row, 0..14))
    })
}

/// The study as counts, its techniques first named in the order of their numbers.
fn data_of(techniques: usize, rows: &[(usize, usize, u32, u32)]) -> Dataset {
    let mut named: Vec<_> = (1..techniques)
        .map(|at| (NAMES[at - 1], NAMES[at], 0, 0))
        .collect();
    named.extend(
        rows.iter()
            .map(|&(a, b, for_a, for_b)| (NAMES[a], NAMES[b], for_a, for_b)),
    );
    counted(&named)
}

fn wins_of(rows: &[(usize, usize, u32, u32)]) -> Vec<(usize, usize)> {
    let mut wins = Vec::new();
    for &(a, b, for_a, for_b) in rows {
        if for_a > 0 {
            wins.push((a, b));
        }
        if for_b > 0 {
            wins.push((b, a));
        }
    }
    wins
}

/// The gradient of the log-likelihood written out, for techniques 1…: relative to its terms.
fn gradient(data: &Dataset, scale: &Scale, component: &Component) -> f64 {
    let mut worst = 0.0_f64;
    for (place, &member) in component.members.iter().enumerate() {
        let (mut sum, mut size) = (0.0, 0.0);
        for pair in &Comparisons::of(&data.conditions).pairs {
            let (other, wins, losses) = match member {
                m if m == pair.i => (pair.j, pair.i_wins, pair.j_wins),
                m if m == pair.j => (pair.i, pair.j_wins, pair.i_wins),
                _ => continue,
            };
            let other = component.members.binary_search(&other).unwrap();
            let at = scale.link.at(scale.value(place) - scale.value(other));
            let (up, down) = (wins as f64 * at.win_pull, losses as f64 * at.loss_pull);
            sum += up - down;
            size += up + down;
        }
        worst = worst.max(sum.abs() / size);
    }
    worst
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn the_status_is_the_one_of_the_definition((techniques, rows) in studies()) {
        let data = data_of(techniques, &rows);
        let wins = wins_of(&rows);
        let section = report_of(&data);
        let expected = if wins.is_empty() {
            Status::Degenerate
        } else if !is_connected(techniques, &wins) {
            Status::Disconnected
        } else if !is_finite(techniques, &wins) {
            Status::NoFiniteEstimate
        } else {
            Status::Ok
        };
        prop_assert_eq!(section.status, expected, "{:?}", section.findings);
        prop_assert!(all_finite(&section), "{:#?}", section);
        let (parts, _) = components(&Comparisons::of(&data.conditions));
        for component in &parts {
            for link in [Link::BradleyTerry, Link::Thurstone] {
                let scale = match component.fit(link) {
                    Ok(scale) => scale,
                    // Rare: the penalised likelihood can have two equal maxima.
                    Err(why) => {
                        prop_assert!(!component.is_finite() && why.reason.contains("equally high"));
                        continue;
                    }
                };
                if scale.method == Method::MaximumLikelihood {
                    prop_assert!(gradient(&data, &scale, component) < 1e-9);
                }
            }
        }
    }

    /// Names do not matter, nor which of a pair is a.
    #[test]
    fn estimates_do_not_depend_on_names_and_sides(
        (techniques, rows) in studies(),
        shift in 0..7_usize,
        swapped in any::<u16>(),
    ) {
        let number = |at: usize| (at + shift) % techniques;
        let turned: Vec<_> = rows
            .iter()
            .enumerate()
            .map(|(at, &(a, b, for_a, for_b))| {
                if swapped >> at & 1 == 1 {
                    (number(b), number(a), for_b, for_a)
                } else {
                    (number(a), number(b), for_a, for_b)
                }
            })
            .collect();
        let (one, other) = (data_of(techniques, &rows), data_of(techniques, &turned));
        let values = |data: &Dataset, link: Link, of: &dyn Fn(usize) -> usize| -> Vec<Option<(usize, f64, f64)>> {
            let (parts, _) = components(&Comparisons::of(&data.conditions));
            (0..techniques)
                .map(|technique| {
                    let wanted = of(technique);
                    let component = parts.iter().find(|part| part.members.contains(&wanted))?;
                    let place = component.members.binary_search(&wanted).unwrap();
                    let (value, se) = component.fit(link).ok()?.centred(place);
                    Some((component.members.len(), value, se))
                })
                .collect()
        };
        for link in [Link::BradleyTerry, Link::Thurstone] {
            let before = values(&one, link, &|at| at);
            let after = values(&other, link, &number);
            for (before, after) in before.into_iter().zip(after) {
                prop_assert_eq!(before.is_some(), after.is_some());
                if let (Some(before), Some(after)) = (before, after) {
                    prop_assert_eq!(before.0, after.0);
                    prop_assert!((before.1 - after.1).abs() < 1e-7, "{:?} {:?}", before, after);
                    prop_assert!((before.2 / after.2 - 1.0).abs() < 1e-6, "{:?} {:?}", before, after);
                }
            }
        }
    }

    /// The position term: finite exactly where no direction separates the answers, tried over all
    /// small whole λ for δ = ±1 (difference constraints have whole solutions, at most n apart).
    #[test]
    fn the_order_effect_exists_where_nothing_separates_the_answers(
        rows in prop::collection::vec((0..4_usize, 1..4_usize, 0..3_u32, 0..3_u32), 1..9),
    ) {
        use super::super::order_effect::{Ordered, fit};
        let answers: Vec<Ordered> = rows
            .iter()
            .filter(|row| row.2 + row.3 > 0)
            .map(|&(first, step, first_wins, second_wins)| Ordered {
                first,
                second: (first + step) % 4,
                first_wins: first_wins.into(),
                second_wins: second_wins.into(),
            })
            .collect();
        let flat: Vec<_> = rows.iter().map(|&(a, step, w, l)| (a, (a + step) % 4, w, l)).collect();
        let data = data_of(4, &flat);
        let (parts, _) = components(&Comparisons::of(&data.conditions));
        let (mut separates, mut collinear) = (false, false);
        for code in 0..9_i64.pow(4) {
            let lambda: Vec<i64> = (0..4).map(|at| code / 9_i64.pow(at) % 9 - 4).collect();
            for delta in [-1, 0, 1] {
                let eta = |row: &Ordered| lambda[row.first] - lambda[row.second] + delta;
                let constant = answers.iter().all(|row| eta(row) == 0);
                let weakly = answers.iter().all(|row| {
                    (row.first_wins == 0 || eta(row) >= 0) && (row.second_wins == 0 || eta(row) <= 0)
                });
                separates |= weakly && !constant;
                collinear |= constant && delta != 0;
            }
        }
        match fit(&answers, &parts, 4) {
            Err(_) => prop_assert!(answers.is_empty() || collinear),
            Ok(effect) => {
                prop_assert!(!collinear);
                prop_assert_eq!(effect.method == Method::Penalised, separates);
                prop_assert!(effect.delta.is_finite() && effect.se.is_finite());
            }
        }
    }
}

#[test]
fn one_way_votes_are_between_the_sets_named() {
    let pair = |i, j, i_wins, j_wins| Pair {
        i,
        j,
        i_wins,
        j_wins,
    };
    let pairs = [pair(0, 1, 3, 2), pair(1, 2, 0, 9), pair(2, 3, 1, 1)];
    let sets = graph::strong_sets(4, &pairs);
    assert_eq!(sets, [0, 0, 1, 1]);
    assert_eq!(graph::one_way(&sets, &pairs), [(1, 0)]);
}
