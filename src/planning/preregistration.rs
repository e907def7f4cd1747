//! The text of a preregistration, from the protocol alone: what will be shown to whom, how many, and
//! what will be made of the answers, under the headings of the OSF's form.
//!
//! Headings: S. D. Bowman et al. (2020), OSF Prereg Template, doi 10.31222/osf.io/epgjd.

mod analysis_plan;
mod design_plan;
mod sampling_plan;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use crate::analysis::tails::Alpha;
use crate::protocol::procedure::{Ask, Step};
use crate::protocol::{Condition, PlanError, Protocol, SessionPlan};

/// Everything the text is made from. The same facts give the same text.
#[derive(Debug, Clone)]
pub struct Facts<'a> {
    /// The protocol.
    pub protocol: &'a Protocol,
    /// Its stimulus set.
    pub set: SetFacts,
    /// What its trials show, in the set's order.
    pub conditions: &'a [Condition],
    /// Hypotheses in the study's own words, by name.
    pub hypotheses: BTreeMap<String, String>,
    /// How the answers will be analysed.
    pub analysis: AnalysisPlan,
}

/// What is said of a stimulus set.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SetFacts {
    /// Its id.
    pub id: String,
    /// For people.
    pub title: String,
    /// Of its config, its scenes, and the files they name.
    pub sha256: String,
    /// Of every image, where they are all of one size.
    pub size_px: Option<(u32, u32)>,
}

/// How the answers will be analysed; what a protocol does not say stands at its default.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnalysisPlan {
    /// Level of the family.
    pub alpha: Alpha,
    /// Conditions of the family; empty: all.
    pub family: Vec<String>,
    /// Answers faster than this are left out, milliseconds.
    pub minimum_response_ms: Option<f64>,
    /// Answers slower than this are left out.
    pub maximum_response_ms: Option<f64>,
    /// Whether participants who fail the attention checks are left out.
    pub exclude_failed_catch: bool,
    /// Participants with fewer main trials are left out.
    pub minimum_main_trials: Option<u32>,
}

impl AnalysisPlan {
    /// What a protocol lays down, the rest at its default.
    #[must_use]
    pub fn of(protocol: &Protocol) -> Self {
        let plan = protocol.analysis.clone().unwrap_or_default();
        let alpha = plan.alpha.map(|alpha| Alpha::try_from(alpha.get()));
        Self {
            // Every level a protocol may have is an alpha.
            alpha: alpha.and_then(Result::ok).unwrap_or_default(),
            family: plan.family,
            minimum_response_ms: plan.minimum_response_ms.map(|ms| f64::from(ms.get())),
            maximum_response_ms: plan.maximum_response_ms.map(|ms| f64::from(ms.get())),
            exclude_failed_catch: plan.exclude_failed_catch,
            minimum_main_trials: plan.minimum_main_trials.map(|count| count.get()),
        }
    }
}

/// The hypotheses of a protocol in its own words, by name.
#[must_use]
pub fn hypotheses(protocol: &Protocol) -> BTreeMap<String, String> {
    let all = protocol.hypotheses.iter();
    all.map(|(name, words)| (name.clone(), words.to_string()))
        .collect()
}

/// The text, Markdown.
///
/// # Errors
/// [`PlanError`] if the protocol makes no sessions of its stimulus set.
pub fn text(facts: &Facts<'_>) -> Result<String, PlanError> {
    let plan = SessionPlan::new(facts.protocol, facts.conditions, 0)?;
    let study = Study::of(facts, &plan);
    let mut out = String::new();
    study.information(&mut out);
    study.design(&mut out);
    study.sampling(&mut out)?;
    study.variables(&mut out);
    study.analyses(&mut out);
    study.other(&mut out);
    Ok(out)
}

/// What a trial asks for, in the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Asked {
    Choice,
    Ratings,
    Ranking,
}

/// The facts, and what follows from them.
struct Study<'a> {
    facts: &'a Facts<'a>,
    protocol: &'a Protocol,
    plan: &'a SessionPlan,
    asked: Asked,
    /// Conditions of the main part, in the set's order.
    main: Vec<&'a Condition>,
    /// Tests of the family that is corrected for.
    family: u32,
}

impl<'a> Study<'a> {
    fn of(facts: &'a Facts<'a>, plan: &'a SessionPlan) -> Self {
        let protocol = facts.protocol;
        let asked = match (protocol.procedure.steps)(protocol).last() {
            Some(Step::Ask(Ask::Ratings)) => Asked::Ratings,
            Some(Step::Ask(Ask::Ranking)) => Asked::Ranking,
            _ => Asked::Choice,
        };
        let main: Vec<&Condition> = facts
            .conditions
            .iter()
            .filter(|it| !protocol.names(&it.id))
            .collect();
        let declared = &facts.analysis.family;
        let tests = match asked {
            // One test a scene and scale, over its versions.
            Asked::Ratings => views(&main) * protocol.scales.len(),
            Asked::Choice | Asked::Ranking => {
                let of_family = |it: &&&Condition| declared.is_empty() || declared.contains(&it.id);
                main.iter().filter(of_family).count()
            }
        };
        Self {
            facts,
            protocol,
            plan,
            asked,
            main,
            family: u32::try_from(tests.max(1)).unwrap_or(u32::MAX),
        }
    }

    fn information(&self, out: &mut String) {
        let set = &self.facts.set;
        line(
            out,
            &format!("# Preregistration: {}", &*self.protocol.study_id),
        );
        line(out, "## Study information");
        line(out, "### Description");
        let what = match self.asked {
            Asked::Choice => "choose between two images of the same scene",
            Asked::Ratings => "rate images of the same scenes",
            Asked::Ranking => "put images of the same scene in order",
        };
        line(
            out,
            &format!(
                "Participants {what}; the images differ in the technique that made them and in nothing else. The stimuli are the set \"{}\" ({}). The question is whether the technique makes a difference to what people see, as they are asked it: *{}*",
                set.title,
                set.id,
                self.question()
            ),
        );
        line(out, "### Hypotheses");
        self.hypotheses(out);
    }

    /// By name; with the study's own words where it has them.
    fn hypotheses(&self, out: &mut String) {
        let mut names: Vec<&str> = Vec::new();
        let asked = self.main.iter().map(|it| &*it.hypothesis);
        for name in asked.chain(self.facts.hypotheses.keys().map(String::as_str)) {
            if !name.is_empty() && !names.contains(&name) {
                names.push(name);
            }
        }
        names.sort_unstable();
        for name in &names {
            let asks: Vec<&str> = (self.main.iter())
                .filter(|it| it.hypothesis == **name)
                .map(|it| &*it.id)
                .collect();
            let words = self.facts.hypotheses.get(*name);
            let words = words.map_or_else(|| self.usual_hypothesis(), Clone::clone);
            let by = match asks.is_empty() {
                true => String::new(),
                false => format!(" Asked by {}.", listed(&asks)),
            };
            item(out, &format!("**{name}.** {}{by}", sentence(&words)));
        }
        if names.is_empty() {
            line(out, &self.usual_hypothesis());
        } else {
            out.push('\n');
        }
    }

    /// What the main analysis tests, where the study has no words of its own.
    fn usual_hypothesis(&self) -> String {
        match self.asked {
            Asked::Choice => "One of the two techniques of a condition is chosen more often than the other. The test is two-sided.",
            Asked::Ratings => "The versions of a scene are rated differently.",
            Asked::Ranking => "The versions of a scene are not ranked at random: some tend to stand before others.",
        }
        .to_owned()
    }

    fn question(&self) -> String {
        self.protocol.words(self.protocol.language).question
    }

    fn other(&self, out: &mut String) {
        let set = &self.facts.set;
        line(out, "## Other");
        item(
            out,
            &format!(
                "Software: Greyfield {} runs the sessions and analyses the data; everything drawn at random comes from its generator `{}`.",
                env!("CARGO_PKG_VERSION"),
                crate::seed::GENERATOR
            ),
        );
        item(
            out,
            &format!(
                "Protocol: SHA-256 `{}`. Every row of the data names the protocol it was recorded under; a results folder of another protocol is refused.",
                self.protocol.hash
            ),
        );
        item(
            out,
            &format!(
                "Stimulus set: `{}`, SHA-256 of its configuration `{}`. Every row names the SHA-256 of the images it showed.",
                set.id, set.sha256
            ),
        );
        item(
            out,
            "Every answer is on disk before the next screen is shown; no row is changed or removed afterwards.",
        );
    }
}

/// How many scenes, each in one light, single images show: their ids end with the technique.
fn views(singles: &[&Condition]) -> usize {
    let view = |it: &&Condition| {
        let technique = it.techniques.first().map_or("", String::as_str);
        let id = it.id.strip_suffix(technique).unwrap_or(&it.id);
        id.to_owned()
    };
    singles.iter().map(view).collect::<BTreeSet<_>>().len()
}

/// A paragraph or heading.
fn line(out: &mut String, text: &str) {
    let _ = writeln!(out, "{text}\n");
}

/// An item of a list; the list ends with an empty line of the caller's.
fn item(out: &mut String, text: &str) {
    let _ = writeln!(out, "- {text}");
}

/// A table row.
fn row(out: &mut String, cells: &[String]) {
    let escaped: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
    let _ = writeln!(out, "| {} |", escaped.join(" | "));
}

/// A table's heading.
fn heading_row(out: &mut String, cells: &[&str]) {
    row(
        out,
        &cells
            .iter()
            .map(|cell| (*cell).to_owned())
            .collect::<Vec<_>>(),
    );
    let _ = writeln!(out, "|{}", "---|".repeat(cells.len()));
}

/// `a`, `a and b`, `a, b and c`.
fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

/// With a full stop at its end.
fn sentence(text: &str) -> String {
    let text = text.trim();
    match text.ends_with(['.', '!', '?']) {
        true => text.to_owned(),
        false => format!("{text}."),
    }
}

/// Somebody's own words, quoted line by line.
fn quoted(text: &str) -> String {
    let lines = text.trim().lines().map(|line| match line.trim() {
        "" => ">".to_owned(),
        words => format!("> {words}"),
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests;
