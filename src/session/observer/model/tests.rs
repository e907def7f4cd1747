use std::path::Path;

use super::*;
use crate::protocol::{Condition, Protocol, SessionPlan, Trial};

/// Differences of second and first technique, in sigmas.
const STEPS: [f64; 7] = [-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0];
const SIGMA: f64 = 0.04;

fn protocol(text: &str) -> Protocol {
    Protocol::parse(Path::new("p.toml"), text).unwrap()
}

fn thesis() -> Protocol {
    protocol(include_str!("../../../../protocols/thesis-2010.toml"))
}

fn rating() -> Protocol {
    protocol(include_str!(
        "../../../../protocols/kozlowski-kautz-2007.toml"
    ))
}

fn ranking() -> Protocol {
    let text = include_str!("../../../../protocols/yu-2009-ranking.toml");
    let (practice, grey) = (
        text.find("[practice]").unwrap(),
        text.find("[texts]").unwrap(),
    );
    protocol(&format!("{}{}", &text[..practice], &text[grey..]))
}

/// Conditions of two techniques, one a step.
fn conditions(techniques: &[&str]) -> Vec<Condition> {
    let condition = |index: usize| Condition {
        id: format!("c{index}"),
        scene: "hall".to_owned(),
        techniques: techniques.iter().map(|&it| it.to_owned()).collect(),
        reference: None,
        hypothesis: String::new(),
    };
    (0..STEPS.len()).map(condition).collect()
}

fn model(options: &str, entries: &[(&str, &str, f64)]) -> Model {
    Model {
        options: Options {
            sigma: SIGMA,
            ..Options::parse(&format!("7{options}")).unwrap()
        },
        qualities: Qualities::new(entries),
    }
}

/// A model to which the second technique of `c0`, `c1`, … is better by a step each.
fn stepped(options: &str) -> Model {
    let ids: Vec<String> = (0..STEPS.len()).map(|index| format!("c{index}")).collect();
    let entries: Vec<_> = ids
        .iter()
        .zip(STEPS)
        .flat_map(|(id, step)| [(&**id, "a", -0.3), (&**id, "b", -0.3 + step * SIGMA)])
        .collect();
    model(options, &entries)
}

/// Visits every trial of many slots.
fn sit(
    protocol: &Protocol,
    conditions: &[Condition],
    slots: u32,
    model: &Model,
    mut visit: impl FnMut(&SessionPlan, &Trial, Behaviour),
) {
    for slot in 0..slots {
        let plan = SessionPlan::new(protocol, conditions, slot).unwrap();
        for trial in &plan.trials {
            let behaviour = model.behave(&Question::new(protocol, &plan, trial));
            visit(&plan, trial, behaviour);
        }
    }
}

/// How often the first image was chosen, by condition and order; and how often it could be.
fn firsts(model: &Model, slots: u32) -> Vec<[(f64, f64); 2]> {
    let mut counts = vec![[(0.0, 0.0); 2]; STEPS.len()];
    sit(
        &thesis(),
        &conditions(&["a", "b"]),
        slots,
        model,
        |_, trial, behaviour| {
            let count = &mut counts[trial.condition][usize::from(trial.reversed)];
            count.1 += 1.0;
            if behaviour.answer == Answer::Choice(Position::First) {
                count.0 += 1.0;
            }
        },
    );
    counts
}

/// Four standard errors of a binomial share.
fn assert_share(found: (f64, f64), expected: f64, about: &str) {
    let share = found.0 / found.1;
    let error = (expected * (1.0 - expected) / found.1).sqrt();
    assert!(
        (share - expected).abs() <= 4.0 * error,
        "{about}: {share} is not {expected}"
    );
}

/// Φ from the tables.
fn phi(z: f64) -> f64 {
    let upper = match z.abs() {
        0.0 => 0.5,
        0.25 => 0.401_293_67,
        0.5 => 0.308_537_54,
        0.75 => 0.226_627_35,
        1.0 => 0.158_655_25,
        1.25 => 0.105_649_77,
        1.75 => 0.040_059_16,
        2.0 => 0.022_750_13,
        2.25 => 0.012_224_47,
        other => panic!("{other} is not in the table"),
    };
    if z > 0.0 { 1.0 - upper } else { upper }
}

#[test]
fn choices_follow_the_psychometric_function() {
    for (options, lapse, bias) in [("", 0.0, 0.0), (",lapse=0.1,bias=0.01", 0.1, 0.25)] {
        let counts = firsts(&stepped(options), 2800);
        for (step, [base, reversed]) in STEPS.into_iter().zip(counts) {
            let expected = |better: f64| lapse / 2.0 + (1.0 - lapse) * phi(better + bias);
            assert_share(base, expected(-step), &format!("{options} {step}"));
            assert_share(
                reversed,
                expected(step),
                &format!("{options} {step} reversed"),
            );
        }
    }
}

#[test]
fn a_bias_alone_is_a_preference_for_the_first() {
    for (bias, expected) in [("0.04", 0.841_344_75), ("-0.04", 0.158_655_25)] {
        let same = model(&format!(",bias={bias}"), &[]);
        let found = firsts(&same, 700).into_iter().flatten();
        let all = found.fold((0.0, 0.0), |all, one| (all.0 + one.0, all.1 + one.1));
        assert_share(all, expected, bias);
    }
}

#[test]
fn a_lapse_alone_is_a_coin() {
    let counts = firsts(&stepped(",lapse=1,bias=9"), 1400);
    for one in counts.into_iter().flatten() {
        assert_share(one, 0.5, "lapse");
    }
}

/// Mean 0 and the standard deviation asked for, within four standard errors of each.
#[test]
fn participants_differ_by_as_much_as_they_are_to() {
    let model = model(",participants=0.02", &[]);
    let shifts: Vec<f64> = (0..10_000).map(|slot| model.own_shift(slot)).collect();
    let mean = shifts.iter().sum::<f64>() / 1e4;
    let variance = shifts
        .iter()
        .map(|shift| (shift - mean).powi(2))
        .sum::<f64>()
        / 1e4;
    assert!(mean.abs() < 4.0 * 0.02 / 100.0, "{mean}");
    let spread = variance.sqrt();
    assert!(
        (spread - 0.02).abs() < 4.0 * 0.02 / (2.0 * 1e4_f64).sqrt(),
        "{spread}"
    );
}

/// With shifts far above the noise, everybody takes one side throughout.
#[test]
fn a_participants_shift_is_the_same_in_every_trial() {
    let model = model(",participants=1000", &[]);
    let mut answers = vec![Vec::new(); 40];
    sit(
        &thesis(),
        &conditions(&["a", "b"]),
        40,
        &model,
        |plan, _, behaviour| {
            answers[plan.slot as usize].push(behaviour.answer);
        },
    );
    assert!(
        answers
            .iter()
            .all(|slot| slot.iter().all(|it| *it == slot[0]))
    );
    let first = Answer::Choice(Position::First);
    let takers = answers.iter().filter(|slot| slot[0] == first).count();
    assert!((5..=35).contains(&takers), "{takers}");
}

/// The same seed, slot and trial, in whatever order they are asked.
#[test]
fn behaviour_is_a_pure_function_of_slot_and_trial() {
    for protocol in [thesis(), rating(), ranking()] {
        let techniques: &[&str] = if protocol.scales.is_empty() {
            &["a", "b"]
        } else {
            &["a"]
        };
        let conditions = conditions(techniques);
        let plan = SessionPlan::new(&protocol, &conditions, 5).unwrap();
        let behave =
            |model: &Model, trial: &Trial| model.behave(&Question::new(&protocol, &plan, trial));
        let one = stepped("");
        let forth: Vec<_> = plan
            .trials
            .iter()
            .map(|trial| behave(&one, trial))
            .collect();
        let again = stepped("");
        let back = plan.trials.iter().rev().map(|trial| behave(&again, trial));
        assert!(back.eq(forth.iter().rev().cloned()));
        let other = Model {
            options: Options {
                seed: 8,
                ..again.options.clone()
            },
            qualities: again.qualities.clone(),
        };
        let others: Vec<_> = plan
            .trials
            .iter()
            .map(|trial| behave(&other, trial))
            .collect();
        assert_ne!(others, forth);
    }
}

#[test]
fn near_indifference_takes_longer() {
    let mut times = vec![(0.0, 0.0); STEPS.len()];
    sit(
        &thesis(),
        &conditions(&["a", "b"]),
        200,
        &stepped(""),
        |_, trial, behaviour| {
            let time = &mut times[trial.condition];
            *time = (time.0 + behaviour.decision_ns as f64, time.1 + 1.0);
            assert!(
                behaviour
                    .looks_ns
                    .iter()
                    .all(|&ns| (2_000_000_000..=8_000_000_000).contains(&ns))
            );
        },
    );
    let mean: Vec<f64> = times.iter().map(|(sum, count)| sum / count).collect();
    assert!(
        mean[0] < mean[1] && mean[1] < mean[2] && mean[2] < mean[3],
        "{mean:?}"
    );
    assert!(
        mean[3] > mean[4] && mean[4] > mean[5] && mean[5] > mean[6],
        "{mean:?}"
    );
}

/// Thurstone's case V: two versions are ranked as they would be chosen.
#[test]
fn two_versions_are_ranked_as_two_images_are_chosen() {
    let mut counts = vec![(0.0, 0.0); STEPS.len()];
    sit(
        &ranking(),
        &conditions(&["a", "b"]),
        2800,
        &stepped(""),
        |_, trial, behaviour| {
            let Answer::Ranking(places) = behaviour.answer else {
                panic!("not a ranking");
            };
            let count = &mut counts[trial.condition];
            count.1 += 1.0;
            if trial.places[places[0]] == 1 {
                count.0 += 1.0;
            }
        },
    );
    for (step, count) in STEPS.into_iter().zip(counts) {
        assert_share(count, phi(step), &format!("{step}"));
    }
}

/// Without noise to speak of: worst, middle and best of the set at the ends and the middle.
#[test]
fn ratings_lie_linearly_between_the_worst_and_the_best_of_the_set() {
    let entries = [("c0", "a", -8.0), ("c1", "a", -4.0), ("c2", "a", 0.0)];
    let mut sharp = model("", &entries);
    sharp.options.sigma = 1e-6;
    let three = conditions(&["a"])[..3].to_vec();
    sit(&rating(), &three, 10, &sharp, |_, trial, behaviour| {
        let expected = [1, 4, 7][trial.condition];
        assert_eq!(behaviour.answer, Answer::Ratings(vec![expected; 2]));
    });
}

/// However wide the noise: on the scale, and with a lapse every point equally often.
#[test]
fn ratings_stay_on_their_scale() {
    let mut counts = [0.0; 7];
    let wild = model(",lapse=1", &[("c0", "a", -0.1), ("c1", "a", 0.0)]);
    sit(
        &rating(),
        &conditions(&["a"]),
        1000,
        &wild,
        |_, _, behaviour| {
            let Answer::Ratings(ratings) = behaviour.answer else {
                panic!("not ratings");
            };
            for rating in ratings {
                counts[rating as usize - 1] += 1.0;
            }
        },
    );
    let total: f64 = counts.iter().sum();
    for count in counts {
        assert_share((count, total), 1.0 / 7.0, "lapse");
    }
    let noisy = model("", &[("c0", "a", -0.001), ("c1", "a", 0.0)]);
    sit(
        &rating(),
        &conditions(&["a"]),
        50,
        &noisy,
        |_, _, behaviour| {
            let Answer::Ratings(ratings) = behaviour.answer else {
                panic!("not ratings");
            };
            assert!(ratings.iter().all(|rating| (1..=7).contains(rating)));
        },
    );
}

#[test]
fn bad_options_say_what_is_needed() {
    for (argument, parts) in [
        ("", ["whole number", "sigma=0.1"]),
        ("x", ["whole number", "\"x\""]),
        ("1,", ["KEY=VALUE", "\"\""]),
        ("1,sigma", ["KEY=VALUE", "\"sigma\""]),
        ("1,sgma=1", ["metric, sigma, lapse", "\"sgma\""]),
        ("1,sigma=0", ["above 0 for sigma", "\"0\""]),
        ("1,sigma=nan", ["above 0 for sigma", "\"nan\""]),
        ("1,lapse=1.5", ["from 0 to 1 for lapse", "\"1.5\""]),
        ("1,bias=inf", ["for bias", "\"inf\""]),
        ("1,participants=-1", ["from 0 for participants", "\"-1\""]),
        ("1,metric=ssim", ["flip or error", "\"ssim\""]),
        ("1,truth=", ["label", "truth"]),
        ("1,lapse=0,lapse=0", ["once", "lapse"]),
    ] {
        let message = Options::parse(argument).unwrap_err();
        for part in parts {
            assert!(
                message.contains(part),
                "{argument:?}: {part:?} not in {message:?}"
            );
        }
    }
    let options = Options::parse("3,metric=error,bias=-0.5,truth=traced").unwrap();
    assert_eq!(
        (options.seed, options.metric, options.sigma),
        (3, Metric::Error, 5.0)
    );
    assert_eq!(
        (options.bias, options.truth.as_deref()),
        (-0.5, Some("traced"))
    );
}
