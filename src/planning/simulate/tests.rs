use super::*;
use crate::planning::family::Holm;
use crate::planning::sample_size::{Criterion, Question};
use std::path::Path;

const THESIS: &str = include_str!("../../../protocols/thesis-2010.toml");
const RATING: &str = include_str!("../../../protocols/kozlowski-kautz-2007.toml");

fn protocol(text: &str) -> Protocol {
    Protocol::parse(Path::new("p.toml"), text).unwrap()
}

fn seven() -> Vec<Condition> {
    let condition = |index| Condition {
        id: format!("c{index}"),
        scene: "atrium".into(),
        techniques: vec!["a".into(), "b".into()],
        reference: None,
        hypothesis: String::new(),
    };
    (0..7).map(condition).collect()
}

fn assumptions() -> Assumptions {
    Assumptions {
        p: 0.7,
        order_bias: 0.0,
        participant_sd: 0.0,
        drop_out: 0.0,
        leave_out_incomplete: false,
        participants: 36,
        studies: 400,
        alpha: Alpha::FIVE_PERCENT,
        family: Vec::new(),
        seed: 1,
    }
}

fn run(assumptions: &Assumptions) -> Simulated {
    simulate(&protocol(THESIS), &seven(), assumptions, &()).unwrap()
}

/// Within four standard errors.
fn assert_near(found: Frequency, expected: f64, what: &str) {
    let (k, n) = (f64::from(found.happened), f64::from(found.studies));
    let error = (expected * (1.0 - expected) / n).sqrt();
    assert!(
        (k / n - expected).abs() <= 4.0 * error,
        "{what}: {} {expected}",
        k / n
    );
}

/// Independent answers: the exact sums of the other files, of one condition and of the family.
#[test]
fn agrees_with_the_exact_sums() {
    let simulated = run(&assumptions());
    let question = Question {
        test: Test::Exact,
        p: 0.7,
        alpha: Alpha::FIVE_PERCENT,
        conditions: 7,
        criterion: Criterion::Uncorrected,
    };
    for condition in &simulated.effect.conditions {
        let exact = condition.exact.unwrap();
        assert!((exact - question.power(36)).abs() < 1e-12);
        assert_near(condition.uncorrected, exact, &condition.id);
        let chi_square = Test::ChiSquare.power(36, 0.7, Alpha::FIVE_PERCENT).value();
        assert_near(condition.chi_square, chi_square, &condition.id);
        // 36 = 2 · 14 + 8: seven in base order and one reversed.
        assert_eq!(condition.orders, (21.0, 15.0));
    }
    let levels: Vec<f64> = (1..=7)
        .map(|step| Test::Exact.power(36, 0.7, question.level(step)).value())
        .collect();
    let holm = Holm::new(&levels);
    assert_near(simulated.effect.any_holm, holm.any(), "any");
    assert_near(simulated.effect.all_holm, holm.all(), "all");
    assert!((simulated.effect.each_holm - holm.each()).abs() < 0.05);
    let null = Test::Exact.power(36, 0.5, Alpha::FIVE_PERCENT).value();
    for condition in &simulated.null.conditions {
        assert_near(condition.uncorrected, null, &condition.id);
    }
    assert!(f64::from(simulated.null.any_holm.happened) < 0.05 * 400.0 + 4.0 * 4.4);
}

/// Uneven orders under a bias, and participants who differ: still sums of two binomials.
#[test]
fn a_bias_and_participants_who_differ_agree_with_the_sums_too() {
    let simulated = run(&Assumptions {
        p: 0.65,
        order_bias: 1.0,
        participant_sd: 0.8,
        ..assumptions()
    });
    for outcome in [&simulated.effect, &simulated.null] {
        for condition in &outcome.conditions {
            assert_near(
                condition.uncorrected,
                condition.exact.unwrap(),
                &condition.id,
            );
        }
    }
    assert!(simulated.effect.chose_first > 0.6);
    let share = simulated.effect.conditions[0].share_b;
    let orders = Orders {
        p: 0.65,
        bias: 1.0,
        participant_sd: 0.8,
        a_then_b: 21,
        b_then_a: 15,
    };
    assert!((share - orders.mean_share()).abs() < 4.0 * 0.5 / (36.0 * 400.0_f64).sqrt());
}

#[test]
fn whoever_leaves_is_followed_by_the_next() {
    let with = |leave_out_incomplete| {
        run(&Assumptions {
            drop_out: 0.25,
            leave_out_incomplete,
            studies: 100,
            ..assumptions()
        })
        .effect
    };
    let (kept, left_out) = (with(false), with(true));
    // 36 / (1 − 0.25) come on average.
    for outcome in [&kept, &left_out] {
        assert!(
            (outcome.came - 48.0).abs() < 4.0 * 4.0 / 10.0,
            "{}",
            outcome.came
        );
    }
    for (some, all) in kept.conditions.iter().zip(&left_out.conditions) {
        assert_eq!(all.answers, 36.0);
        assert!(
            some.answers > 40.0 && some.answers < 44.0,
            "{}",
            some.answers
        );
        assert!(some.exact.is_none() && all.exact.is_some());
    }
}

#[test]
fn the_same_seed_gives_the_same_result() {
    let few = Assumptions {
        studies: 5,
        participants: 5,
        participant_sd: 0.5,
        drop_out: 0.2,
        ..assumptions()
    };
    assert_eq!(run(&few), run(&few));
    assert_ne!(
        run(&few),
        run(&Assumptions {
            seed: 2,
            ..few.clone()
        })
    );
}

/// Outside the family, a condition is never found by Holm.
#[test]
fn a_declared_family_is_kept_to() {
    let simulated = run(&Assumptions {
        p: 0.95,
        studies: 5,
        family: vec!["c1".into(), "c2".into()],
        ..assumptions()
    });
    assert_eq!(simulated.effect.all_holm.happened, 5);
    assert_eq!(simulated.effect.conditions[0].holm.happened, 0);
    assert_eq!(simulated.effect.conditions[1].holm.happened, 5);
}

#[test]
fn ratings_have_no_power_here() {
    let error = simulate(&protocol(RATING), &seven(), &assumptions(), &()).unwrap_err();
    assert_eq!(error, SimulateError::NoChoices("rating"));
}
