//! All versions of a scene at once: put them in order.

use super::{Ask, Exhibits, Procedure, Step, TrialStart, needless, no_choice_flaw};

/// Grey, then all versions at once; the participant ranks them.
pub const RANK_ORDER: Procedure = Procedure {
    name: "rank-order",
    summary: "all versions of a scene at once, which the participant puts in order",
    source: "Yu et al. 2009, experiment 2",
    exhibits: Exhibits::Versions,
    trial_start: TrialStart::Itself,
    steps: |protocol| {
        vec![
            Step::Grey {
                duration_ns: protocol.grey.duration_ns(),
            },
            Step::Ask(Ask::Ranking),
        ]
    },
    flaw: |protocol| {
        let name = protocol.procedure.name;
        needless(protocol.image.is_some(), "image", name)
            .or_else(|| needless(!protocol.scales.is_empty(), "scales", name))
            .or_else(|| no_choice_flaw(protocol))
    },
};
