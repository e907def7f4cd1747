//! Two images beside a reference: which is closer to it?

use super::{Ask, Exhibits, Procedure, Step, TrialStart, needless};

/// Grey, then all three at once with the question; a key or a click ends it.
pub const REFERENCE: Procedure = Procedure {
    name: "reference",
    summary: "a reference in the middle and the two images on either side of it, as long as the participant likes, then a choice of the closer one",
    source: "Yu et al. 2009, experiment 1; Sundstedt et al. 2007",
    exhibits: Exhibits::PairsWithReference,
    trial_start: TrialStart::Itself,
    steps: |protocol| {
        vec![
            Step::Grey {
                duration_ns: protocol.grey.duration_ns(),
            },
            Step::Ask(Ask::CloserToReference),
        ]
    },
    flaw: |protocol| {
        if protocol.reference.is_none() {
            return Some(
                "field `reference.technique` is missing: the technique whose image of each view is the reference, such as \"ray-traced\"".to_owned(),
            );
        }
        let name = protocol.procedure.name;
        needless(protocol.image.is_some(), "image", name)
            .or_else(|| needless(!protocol.scales.is_empty(), "scales", name))
    },
};
