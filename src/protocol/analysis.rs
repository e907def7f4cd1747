//! What a protocol lays down of the analysis before there are data: the level, the family, and
//! who and what is left out. `greyfield analyse` applies it to the results.

use serde::Deserialize;

use super::options::{TrialCount, twice};
use super::{Condition, PlanError, Protocol};
use crate::config::quantity::{Milliseconds, quantity};

quantity! {
    /// Significance level of the family.
    Significance: f64, 0.000_001, 0.5, ""
}

/// The analysis as it was planned. What is left out here is open to whoever analyses.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AnalysisPlan {
    /// Significance level.
    #[serde(default)]
    pub alpha: Option<Significance>,
    /// Ids of the conditions whose tests are corrected together; empty: all of the main part.
    #[serde(default)]
    pub family: Vec<String>,
    /// Trials answered faster are left out.
    #[serde(default)]
    pub minimum_response_ms: Option<Milliseconds>,
    /// Trials answered slower are left out.
    #[serde(default)]
    pub maximum_response_ms: Option<Milliseconds>,
    /// Whether participants with fewer catch trials right than `catch.minimum_correct` are left
    /// out.
    #[serde(default)]
    pub exclude_failed_catch: bool,
    /// Participants with fewer answered main trials are left out.
    #[serde(default)]
    pub minimum_main_trials: Option<TrialCount>,
}

/// What does not fit the rest of the protocol.
pub(super) fn flaw(protocol: &Protocol) -> Option<String> {
    let plan = protocol.analysis.as_ref()?;
    if let (Some(low), Some(high)) = (plan.minimum_response_ms, plan.maximum_response_ms)
        && low.get() >= high.get()
    {
        return Some(format!(
            "field `analysis.minimum_response_ms`: found {} ms, but `maximum_response_ms` is {} ms; the minimum must be less",
            low.get(),
            high.get()
        ));
    }
    if plan.exclude_failed_catch && protocol.catch.is_none() {
        return Some(
            "field `analysis.exclude_failed_catch`: there is no [catch] to fail; leave it out or declare catch trials"
                .to_owned(),
        );
    }
    let family = plan.family.iter().map(String::as_str);
    if let Some(id) = twice(family) {
        return Some(format!("field `analysis.family`: names {id:?} twice"));
    }
    let outside = plan.family.iter().find(|id| protocol.names(id))?;
    Some(format!(
        "field `analysis.family`: condition {outside:?} is named in `practice` or `catch`; the family is of the main part"
    ))
}

/// Whether the plan fits the conditions of the main part.
///
/// # Errors
/// [`PlanError`] for a family of conditions that are not there, and for more main trials than a
/// session has.
pub(super) fn check(protocol: &Protocol, main: &[&Condition]) -> Result<(), PlanError> {
    let Some(plan) = &protocol.analysis else {
        return Ok(());
    };
    let unknown = |id: &&String| main.iter().all(|condition| condition.id != **id);
    if let Some(id) = plan.family.iter().find(unknown) {
        let known: Vec<&str> = main.iter().map(|condition| condition.id.as_str()).collect();
        return Err(PlanError::UnknownCondition {
            field: "analysis.family",
            found: id.clone(),
            known: known.join(", "),
        });
    }
    match plan.minimum_main_trials.map(|trials| trials.get() as usize) {
        Some(needed) if needed > main.len() => Err(PlanError::TooFewTrials {
            needed,
            there: main.len(),
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::protocol::SessionPlan;

    const THESIS: &str = include_str!("../../protocols/thesis-2010.toml");

    fn parse(more: &str) -> Result<Protocol, String> {
        Protocol::parse(Path::new("p.toml"), &format!("{THESIS}\n{more}"))
            .map_err(|error| error.to_string())
    }

    fn condition(id: &str) -> Condition {
        Condition {
            id: id.to_owned(),
            scene: "atrium".to_owned(),
            techniques: vec!["none".to_owned(), "crytek24".to_owned()],
            reference: None,
            hypothesis: String::new(),
        }
    }

    #[test]
    fn a_plan_is_read_as_it_stands() {
        let protocol = parse(
            "[analysis]\nalpha = 0.01\nfamily = [\"a\", \"b\"]\nminimum_response_ms = 200\nminimum_main_trials = 2\n",
        )
        .unwrap();
        let plan = protocol.analysis.as_ref().unwrap();
        assert!((plan.alpha.unwrap().get() - 0.01).abs() < 1e-15);
        assert_eq!(plan.family, ["a", "b"]);
        assert_eq!(plan.minimum_response_ms.unwrap().get(), 200);
        assert_eq!(plan.maximum_response_ms, None);
        assert!(!plan.exclude_failed_catch);
        let conditions = ["a", "b", "c"].map(condition);
        assert!(SessionPlan::new(&protocol, &conditions, 0).is_ok());
    }

    #[test]
    fn the_thesis_names_its_hypotheses_and_lays_no_rule_down() {
        let protocol = parse("").unwrap();
        let names: Vec<&String> = protocol.hypotheses.keys().collect();
        assert_eq!(names, ["H1", "H2", "H3"]);
        assert_eq!(protocol.analysis, None);
    }

    #[test]
    fn a_plan_that_cannot_be_carried_out_is_refused() {
        for (more, parts) in [
            (
                "[analysis]\nalpha = 0.6\n",
                ["analysis.alpha", "0.6", "0.000001 to 0.5"],
            ),
            (
                "[analysis]\nalfa = 0.05\n",
                ["alfa", "unknown field", "family"],
            ),
            (
                "[analysis]\nminimum_response_ms = 900\nmaximum_response_ms = 900\n",
                ["analysis.minimum_response_ms", "900 ms", "less"],
            ),
            (
                "[analysis]\nexclude_failed_catch = true\n",
                [
                    "analysis.exclude_failed_catch",
                    "no [catch]",
                    "leave it out",
                ],
            ),
            (
                "[analysis]\nfamily = [\"a\", \"a\"]\n",
                ["analysis.family", "\"a\"", "twice"],
            ),
            (
                "[practice]\nconditions = [\"p\"]\n[analysis]\nfamily = [\"p\"]\n",
                ["analysis.family", "\"p\"", "practice"],
            ),
            (
                "[analysis]\nminimum_main_trials = 0\n",
                ["analysis.minimum_main_trials", "found 0", "1 to"],
            ),
        ] {
            let message = parse(more).unwrap_err();
            for part in parts {
                assert!(message.contains(part), "{part:?} not in {message:?}");
            }
        }
        let hypothesis = THESIS.replace("H1 = \"", "H1 = \"\" # ");
        let message = Protocol::parse(Path::new("p.toml"), &hypothesis).unwrap_err();
        assert!(message.to_string().contains("hypotheses.H1"), "{message}");
    }

    /// What only the set knows is checked where the set is.
    #[test]
    fn a_plan_that_the_set_does_not_fit_is_refused() {
        let conditions = ["a", "b"].map(condition);
        let plan = |more: &str| {
            let refused = SessionPlan::new(&parse(more).unwrap(), &conditions, 0);
            refused.unwrap_err().to_string()
        };
        let message = plan("[analysis]\nfamily = [\"a\", \"z\"]\n");
        for part in ["analysis.family", "\"z\"", "a, b"] {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
        let message = plan("[analysis]\nminimum_main_trials = 3\n");
        for part in ["analysis.minimum_main_trials", "found 3", "2 main trials"] {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }
}
