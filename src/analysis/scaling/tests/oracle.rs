//! Every value of `tests/data/scaling.csv` (R's glm, brglm2, choix, scipy; `tests/data/scaling.py`).

use super::super::goodness::misfit;
use super::super::order_effect::{self, Ordered};
use super::super::scenes::{one_scale, scenes};
use super::*;

struct Line {
    kind: &'static str,
    scene: &'static str,
    first: usize,
    second: usize,
    wins: u32,
    losses: u32,
}

fn lines(dataset: &str) -> Vec<Line> {
    let text = include_str!("../../../../tests/data/scaling-data.csv");
    text.lines()
        .skip(1)
        .map(|line| line.split(',').collect::<Vec<_>>())
        .filter(|cells| cells[0] == dataset)
        .map(|cells| Line {
            kind: cells[1],
            scene: cells[2],
            first: cells[3].parse().unwrap(),
            second: cells[4].parse().unwrap(),
            wins: cells[5].parse().unwrap(),
            losses: cells[6].parse().unwrap(),
        })
        .collect()
}

/// As a dataset whose techniques come in the order of their numbers: conditions without votes
/// name them first.
fn dataset(lines: &[Line]) -> Dataset {
    let techniques = lines
        .iter()
        .map(|l| l.first.max(l.second) + 1)
        .max()
        .unwrap();
    let name = |number: usize| format!("t{number}");
    let mut data = Dataset::default();
    for number in 1..techniques {
        data.conditions.push(ConditionData {
            technique_a: name(number - 1),
            technique_b: name(number),
            ..ConditionData::default()
        });
    }
    for line in lines {
        data.conditions.push(ConditionData {
            technique_a: name(line.first),
            technique_b: name(line.second),
            scene: (!line.scene.is_empty()).then(|| line.scene.to_owned()),
            votes: Votes {
                a: line.wins,
                b: line.losses,
            },
            ..ConditionData::default()
        });
    }
    data
}

fn ours(dataset_name: &str, quantity: &str, i: &str, j: &str) -> f64 {
    let lines = lines(dataset_name);
    let data = dataset(&lines);
    if quantity.starts_with("delta") {
        return order_quantity(&lines, &data, quantity);
    }
    let (model, what) = quantity.split_once('_').unwrap();
    let link = match model {
        "logit" => Link::BradleyTerry,
        _ => Link::Thurstone,
    };
    if what.starts_with("lr") {
        let test = one_scale(&data, &scenes(&data), link).unwrap();
        return match what {
            "lr" => test.statistic,
            "lr_df" => f64::from(test.df),
            _ => test.p.value(),
        };
    }
    let component = only_component(&data);
    let scale = component.fit(link).unwrap();
    let expected = match lines[0].kind {
        "firth" => Method::Penalised,
        _ => Method::MaximumLikelihood,
    };
    assert_eq!(scale.method, expected);
    assert!(scale.fit.gradient <= GRADIENT_GOOD);
    let place = |text: &str| text.parse::<usize>().unwrap_or(0);
    let misfit = misfit(&scale.design, link, &scale.fit.beta);
    match what {
        "beta" => scale.value(place(i)),
        "se" => scale.standard_error(place(i), 0),
        "se_difference" => scale.standard_error(place(i), place(j)),
        "g2" => misfit.g2,
        "x2" => misfit.x2,
        "df" => (component.pairs.len() + 1 - component.members.len()) as f64,
        other => panic!("unknown quantity {other}"),
    }
}

fn order_quantity(lines: &[Line], data: &Dataset, quantity: &str) -> f64 {
    let answers: Vec<Ordered> = lines
        .iter()
        .map(|line| Ordered {
            first: line.first,
            second: line.second,
            first_wins: u64::from(line.wins),
            second_wins: u64::from(line.losses),
        })
        .collect();
    let table = Comparisons::of(&data.conditions);
    let (parts, _) = components(&table);
    let effect = order_effect::fit(&answers, &parts, table.techniques.len()).unwrap();
    let expected = match lines[0].kind {
        "order-firth" => Method::Penalised,
        _ => Method::MaximumLikelihood,
    };
    assert_eq!(effect.method, expected);
    match quantity {
        "delta" => effect.delta,
        "delta_se" => effect.se,
        "delta_lr" => effect.likelihood_ratio.unwrap().0,
        _ => effect.likelihood_ratio.unwrap().1.value(),
    }
}

/// What each source is good for: R iterates until the deviance stands still, choix to 1e-12 of its
/// own step, and scipy's simplex sees the objective only, to half the digits.
fn allowed(source: &str, expected: f64) -> f64 {
    let relative = match source {
        "R" => 1e-9,
        "choix" => 1e-8,
        _ => 1e-6,
    };
    relative * expected.abs().max(1.0)
}

#[test]
fn every_value_of_the_table_holds() {
    let text = include_str!("../../../../tests/data/scaling.csv");
    let mut rows = 0;
    let mut failures = Vec::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let expected: f64 = cells[5].parse().unwrap();
        let value = ours(cells[1], cells[2], cells[3], cells[4]);
        let error = (value - expected).abs();
        if error.is_nan() || error > allowed(cells[0], expected) {
            failures.push(format!("{line}: {value}, off by {error:e}"));
        }
        rows += 1;
    }
    assert!(rows > 600, "{rows} rows");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// One pair has a scale in closed form: logit and probit of the share.
#[test]
fn two_techniques_have_the_scale_of_their_share() {
    for (a, b) in [(1_u32, 3_u32), (1, 999_999_999), (5, 5), (123_456, 7)] {
        let data = counted(&[("x", "y", a, b)]);
        let component = only_component(&data);
        let (a, b) = (f64::from(a), f64::from(b));
        let scale = component.fit(Link::BradleyTerry).unwrap();
        assert!((scale.value(1) - (b / a).ln()).abs() < 1e-12 * (b / a).ln().abs().max(1.0));
        let se = (1.0 / a + 1.0 / b).sqrt();
        assert!((scale.standard_error(1, 0) / se - 1.0).abs() < 1e-12);
        let scale = component.fit(Link::Thurstone).unwrap();
        let rare = a.min(b) / (a + b);
        let z = crate::analysis::tails::normal_quantile(rare).unwrap();
        assert!(
            (scale.value(1).abs() - z).abs() < 1e-11 * z.max(1.0),
            "{a} {b}"
        );
    }
}

/// 75 % preferred is 1 JOD, by definition.
#[test]
fn three_of_four_is_one_jod() {
    let section = report_of(&counted(&[("x", "y", 25, 75)]));
    let jod = number(cell(table(&section, "jod"), 1, "jod"));
    assert!((jod - 1.0).abs() < 1e-14, "{jod}");
}

/// Kosmidis & Firth 2021: with the logistic model and one pair, the penalty adds half a vote to
/// either side.
#[test]
fn firth_on_one_pair_adds_half_a_vote() {
    for votes in [1_u32, 36, 1_000_000, 1_000_000_000] {
        let component = only_component(&counted(&[("x", "y", 0, votes)]));
        let scale = component.fit(Link::BradleyTerry).unwrap();
        assert_eq!(scale.method, Method::Penalised);
        let expected = (2.0 * f64::from(votes) + 1.0).ln();
        assert!((scale.value(1) / expected - 1.0).abs() < 1e-10, "{votes}");
    }
}

/// Chen, Ibrahim & Kim 2008 warn that Jeffreys' prior need not leave one maximum. Here are two, mirror
/// images of each other (scipy's simplex finds either, 1.7940198520024255 high, the middle technique
/// 1.98997 from one end and 6.02070 from the other): neither is the answer.
#[test]
fn two_equal_maxima_of_the_penalised_likelihood_are_no_estimate() {
    let data = counted(&[("x", "y", 3, 0), ("y", "z", 3, 0), ("x", "z", 1517, 0)]);
    let refused = only_component(&data).fit(Link::BradleyTerry).unwrap_err();
    assert!(refused.reason.contains("equally high"));
    // The probit model has one, 1.722383 to either side (scipy).
    let scale = only_component(&data).fit(Link::Thurstone).unwrap();
    assert!((scale.value(1) + 1.722_383).abs() < 1e-6);
    assert!((scale.value(2) + 2.0 * 1.722_383).abs() < 2e-6);
    let section = report_of(&data);
    assert_eq!(section.status, Status::NoFiniteEstimate);
    assert!(all_finite(&section));
    // Two links of a ring with equal votes can change places (scipy: both models, two maxima).
    let ring = [
        ("s", "t", 60, 0),
        ("u", "v", 2, 0),
        ("s", "u", 2, 0),
        ("t", "v", 329, 0),
    ];
    for turn in 0..4 {
        let mut rows = ring;
        rows.rotate_left(turn);
        let component = only_component(&counted(&rows));
        for link in [Link::BradleyTerry, Link::Thurstone] {
            assert!(component.fit(link).is_err(), "{turn} {link:?}");
        }
    }
}
