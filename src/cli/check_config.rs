//! `greyfield check FILE.toml`: a protocol, a set or a scene, without running anything.

use std::path::Path;

use anyhow::anyhow;

use super::order;
use super::{Failure, output};
use crate::config;
use crate::planning::preregistration::{self, AnalysisPlan, Facts, SetFacts};
use crate::protocol::{Phase, Protocol, SessionPlan};
use crate::scene::SceneConfig;
use crate::stimulus::StimulusSet;

/// A key that every protocol has, and nothing else.
const PROTOCOL_KEY: &str = "study_id";

/// Whether this is a config file, by its name.
pub fn is_config(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension == "toml")
}

/// Reads the file with everything it names, and says what it is.
///
/// # Errors
/// Bad input (exit code 2): file, line, field, what was found and what is allowed.
pub fn run(path: &Path) -> Result<(), Failure> {
    let text = config::read(path).map_err(Failure::bad_input)?;
    let said = if has(&text, PROTOCOL_KEY) {
        protocol(path, &text)?
    } else if has(&text, "[[condition]]") {
        set(path)?
    } else {
        let scene = SceneConfig::load(path).map_err(Failure::bad_input)?;
        format!("a scene: {}", scene.title)
    };
    Ok(output::write(
        None,
        format!("{}: {said}\n", path.display()).as_bytes(),
    )?)
}

/// What has the key of one kind is meant as that kind, however wrong the rest of it is.
fn has(text: &str, key: &str) -> bool {
    let begins = |line: &str| line.trim_start().starts_with(key);
    text.lines().any(begins)
}

/// Writes the preregistration of a protocol.
///
/// # Errors
/// Bad input (exit code 2): no protocol, or one that makes no sessions. Otherwise the output.
pub fn preregister(path: &Path, to: Option<&Path>) -> Result<(), Failure> {
    if !is_config(path) {
        return Err(Failure::bad_input(anyhow!(
            "{}: --preregister is for a protocol, a .toml file with the key {PROTOCOL_KEY}",
            path.display()
        )));
    }
    let text = config::read(path).map_err(Failure::bad_input)?;
    if !has(&text, PROTOCOL_KEY) {
        return Err(Failure::bad_input(anyhow!(
            "{}: --preregister is for a protocol, and this file has no {PROTOCOL_KEY}",
            path.display()
        )));
    }
    let protocol = Protocol::parse(path, &text).map_err(Failure::bad_input)?;
    let set_path = protocol.stimulus_set(path);
    let set = StimulusSet::load(&set_path).map_err(Failure::bad_input)?;
    let facts = Facts {
        protocol: &protocol,
        conditions: &order::conditions(&protocol, &set_path)?,
        set: SetFacts {
            id: set.id,
            title: set.title,
            sha256: set.sha256,
            size_px: set.size_px,
        },
        hypotheses: preregistration::hypotheses(&protocol),
        analysis: AnalysisPlan::of(&protocol),
    };
    let text = preregistration::text(&facts).map_err(Failure::bad_input)?;
    Ok(output::write(to, text.as_bytes())?)
}

fn set(path: &Path) -> Result<String, Failure> {
    let set = StimulusSet::load(path).map_err(Failure::bad_input)?;
    Ok(format!(
        "a stimulus set of {} conditions over {} scenes",
        set.conditions.len(),
        set.scenes.len()
    ))
}

fn protocol(path: &Path, text: &str) -> Result<String, Failure> {
    let protocol = Protocol::parse(path, text).map_err(Failure::bad_input)?;
    let conditions = order::conditions(&protocol, &protocol.stimulus_set(path))?;
    let plan = SessionPlan::new(&protocol, &conditions, 0).map_err(Failure::bad_input)?;
    let count = |phase| plan.trials.iter().filter(|it| it.phase == phase).count();
    let languages: Vec<&str> = protocol.languages().map(|it| it.code()).collect();
    Ok(format!(
        "a protocol: {} of {} trials ({} practice, {} catch), design {}, in {}; SHA-256 {}",
        protocol.procedure.name,
        plan.trials.len(),
        count(Phase::Practice),
        count(Phase::Catch),
        protocol.design.name,
        languages.join(", "),
        protocol.hash
    ))
}
