//! `greyfield techniques`: what the registry of techniques says.

use std::fmt::Write;

use clap::Args;

use super::{Failure, output};
use crate::render::technique::{self, Noise, Technique, Weighting};

/// Print the ambient-occlusion techniques there are: source, what they estimate, what they read,
/// parameters with units, ranges and defaults, and presets.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  greyfield techniques\n  greyfield techniques gtao")]
pub struct Techniques {
    /// One of them, or one of its presets.
    name: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// Bad input: a name that is not there.
pub fn run(args: &Techniques) -> Result<(), Failure> {
    let text = match &args.name {
        None => technique::TECHNIQUES.iter().map(|t| line(t)).collect(),
        Some(name) => {
            let settings = technique::Settings::from_label(name).map_err(Failure::bad_input)?;
            entry(settings.technique)
        }
    };
    Ok(output::write(None, text.as_bytes())?)
}

fn line(technique: &Technique) -> String {
    format!("{:<12} {}\n", technique.name, technique.summary)
}

fn entry(technique: &Technique) -> String {
    let mut text = format!("{}: {}\n", technique.name, technique.summary);
    let mut add = |name: &str, value: &str| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:<22} {value}");
    };
    add("source", technique.citation);
    add("estimates", weighting(technique.weighting));
    add("reads", &inputs(technique));
    add(
        "from pixel to pixel",
        match technique.noise {
            Noise::None => "the same: nothing to blur",
            Noise::Tile => "turns with a 4 x 4 tile; blurred",
            Noise::Hilbert => "turns along a Hilbert curve; blurred",
        },
    );
    for preset in technique.presets {
        let values: Vec<String> = preset
            .values
            .iter()
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        add(&format!("preset {}", preset.label), &values.join(", "));
    }
    for parameter in technique.all_parameters() {
        add(parameter.name, &parameter.allowed());
        add("", parameter.meaning);
    }
    text
}

fn weighting(weighting: Weighting) -> &'static str {
    match weighting {
        Weighting::None => "nothing",
        Weighting::Empirical => "no integral: an empirical darkening",
        Weighting::Uniform => "the open share of directions, all alike",
        Weighting::Cosine => "the open share of directions, by the cosine to the normal",
        Weighting::Obscurance => "what directions let in, by the distance of what blocks them",
    }
}

fn inputs(technique: &Technique) -> String {
    let read: Vec<&str> = [
        (technique.inputs.depth, "depth"),
        (technique.inputs.normals, "normals"),
        (technique.inputs.light, "colours and light"),
        (technique.inputs.proxies, "spheres fitted to the scene"),
    ]
    .into_iter()
    .filter_map(|(reads, name)| reads.then_some(name))
    .collect();
    if read.is_empty() {
        String::from("nothing")
    } else {
        read.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_technique_names_its_source_and_every_parameter() {
        for technique in technique::TECHNIQUES {
            let text = entry(technique);
            assert!(text.contains(technique.citation), "{text}");
            for parameter in technique.all_parameters() {
                assert!(text.contains(&parameter.allowed()), "{text}");
            }
        }
    }

    #[test]
    fn a_name_that_is_not_there_is_said_with_those_that_are() {
        let args = Techniques {
            name: Some(String::from("hbbao")),
        };
        let failure = run(&args).unwrap_err();
        let message = failure.error.to_string();
        assert!(message.contains("vbao"), "{message}");
        assert_eq!(failure.code, 2);
    }
}
