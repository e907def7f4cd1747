//! Plans: order, phases, pauses.

use std::collections::HashSet;
use std::path::Path;

use proptest::prelude::*;

use super::*;

fn protocol() -> Protocol {
    let text = include_str!("../../../protocols/thesis-2010.toml");
    Protocol::parse(Path::new("p.toml"), text).unwrap()
}

fn condition(id: &str) -> Condition {
    Condition {
        id: id.to_owned(),
        scene: "atrium".to_owned(),
        techniques: vec!["none".to_owned(), "blizzard24".to_owned()],
        reference: None,
        hypothesis: String::new(),
    }
}

#[test]
fn a_reversed_trial_shows_the_second_technique_first() {
    let conditions = [condition("a"), condition("b")];
    let techniques = |slot| {
        let plan = SessionPlan::new(&protocol(), &conditions, slot).unwrap();
        let (first, second) = plan.techniques(&plan.trials[0]);
        (first.to_owned(), second.to_owned())
    };
    assert_eq!(techniques(0), ("none".into(), "blizzard24".into()));
    assert_eq!(techniques(2), ("blizzard24".into(), "none".into()));
}

#[test]
fn trials_are_numbered_in_the_order_shown() {
    let conditions: Vec<Condition> = ["a", "b", "c"].map(condition).into();
    let plan = SessionPlan::new(&protocol(), &conditions, 4).unwrap();
    let indices: Vec<usize> = plan.trials.iter().map(|trial| trial.index).collect();
    assert_eq!(indices, [0, 1, 2]);
}

#[test]
fn a_set_that_makes_no_study_is_refused() {
    assert_eq!(
        SessionPlan::new(&protocol(), &[], 0),
        Err(PlanError::NoConditions)
    );
    assert_eq!(
        SessionPlan::new(&protocol(), &[condition("a"), condition("a")], 0),
        Err(PlanError::DuplicateCondition("a".into()))
    );
}

/// The thesis protocol with practice, catch trials and rests over conditions `p0…`, `k0…`.
fn elaborate(practice: usize, catch: usize, every: u32) -> Protocol {
    let names = |prefix: &str, count: usize| -> Vec<String> {
        (0..count).map(|n| format!("{prefix}{n}")).collect()
    };
    let mut text = include_str!("../../../protocols/thesis-2010.toml").to_owned();
    text += &format!("\n[practice]\nconditions = {:?}\n", names("p", practice));
    text += &format!("\n[breaks]\nevery_trials = {every}\n");
    if catch > 0 {
        text += "\n[catch]\nminimum_correct = 1\n";
        for name in names("k", catch) {
            text += &format!("[[catch.trials]]\ncondition = \"{name}\"\ncorrect = \"none\"\n");
        }
    }
    Protocol::parse(Path::new("p.toml"), &text).unwrap()
}

fn conditions(main: usize, practice: usize, catch: usize) -> Vec<Condition> {
    let named = |prefix: &'static str, count: usize| {
        (0..count).map(move |n| condition(&format!("{prefix}{n}")))
    };
    named("m", main)
        .chain(named("k", catch))
        .chain(named("p", practice))
        .collect()
}

proptest! {
    #[test]
    fn practice_comes_first_catch_trials_are_spread_and_every_condition_is_shown_once(
        main in 1_usize..40, practice in 0_usize..4, catch in 0_usize..6,
        every in 1_u32..12, slot in 0_u32..200,
    ) {
        let protocol = elaborate(practice, catch, every);
        let conditions = conditions(main, practice, catch);
        let plan = SessionPlan::new(&protocol, &conditions, slot).unwrap();
        prop_assert_eq!(&plan, &SessionPlan::new(&protocol, &conditions, slot).unwrap());
        let shown: HashSet<usize> = plan.trials.iter().map(|trial| trial.condition).collect();
        prop_assert_eq!(shown.len(), conditions.len());
        prop_assert_eq!(plan.trials.len(), conditions.len());
        let phases: Vec<Phase> = plan.trials.iter().map(|trial| trial.phase).collect();
        prop_assert!(phases[..practice].iter().all(|&phase| phase == Phase::Practice));
        prop_assert!(phases[practice..].iter().all(|&phase| phase != Phase::Practice));
        // Nobody is checked before the first trial that counts.
        prop_assert_eq!(phases[practice], Phase::Main);
        // Spread: each stretch of the main part holds its own catch trial.
        if catch > 0 && main >= catch {
            let mut done = 0;
            let mut caught = 0;
            for phase in &phases[practice..] {
                match phase {
                    Phase::Catch => {
                        let stretch = caught * main / catch..=(caught + 1) * main / catch;
                        prop_assert!(stretch.contains(&done), "{done} in {stretch:?}");
                        caught += 1;
                    }
                    _ => done += 1,
                }
            }
        }
        let rests = plan.trials.iter().filter(|trial| trial.pause == Some(Pause::Break)).count();
        prop_assert_eq!(rests, (main - 1) / every as usize);
        let over = plan.trials.iter().position(|trial| trial.pause == Some(Pause::PracticeOver));
        prop_assert_eq!(over, (practice > 0).then_some(practice));
    }
}

#[test]
fn catch_trials_do_not_always_stand_in_the_same_places() {
    let protocol = elaborate(0, 2, 100);
    let conditions = conditions(20, 0, 2);
    let places: HashSet<Vec<usize>> = (0..20)
        .map(|slot| {
            let plan = SessionPlan::new(&protocol, &conditions, slot).unwrap();
            let caught = plan.trials.iter().filter(|it| it.phase == Phase::Catch);
            caught.map(|trial| trial.index).collect()
        })
        .collect();
    assert!(places.len() > 5, "{places:?}");
}

#[test]
fn names_that_are_no_conditions_are_refused_with_what_there_is() {
    let protocol = elaborate(1, 0, 5);
    let error = SessionPlan::new(&protocol, &[condition("a"), condition("b")], 0).unwrap_err();
    let message = error.to_string();
    for part in ["practice.conditions", "\"p0\"", "a, b"] {
        assert!(message.contains(part), "{part:?} not in {message:?}");
    }
}

#[test]
fn a_catch_trial_needs_a_technique_of_its_condition() {
    let mut protocol = elaborate(0, 1, 5);
    if let Some(catch) = &mut protocol.catch {
        catch.trials[0].correct = "gtao".to_owned();
    }
    let error = SessionPlan::new(&protocol, &conditions(2, 0, 1), 0).unwrap_err();
    let message = error.to_string();
    for part in ["catch.trials.correct", "gtao", "none, blizzard24"] {
        assert!(message.contains(part), "{part:?} not in {message:?}");
    }
}
