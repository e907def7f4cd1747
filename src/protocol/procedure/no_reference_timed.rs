//! As `no-reference`, but every image stands equally long for everybody.

use super::{Ask, Exhibits, Procedure, Step, TrialStart, Until, plain_choice_flaw};

/// Image, grey, image, question; time ends the images.
pub const NO_REFERENCE_TIMED: Procedure = Procedure {
    name: "no-reference-timed",
    summary: "two images one after the other with a grey between them, each for a time the protocol sets, then a choice of one",
    source: "Sundstedt et al. 2007 (4 s, 2 s of grey, 4 s)",
    exhibits: Exhibits::Pairs,
    trial_start: TrialStart::Button,
    steps: |protocol| {
        let image = |place| Step::Image {
            place,
            until: Until::Elapsed {
                duration_ns: protocol.image.map_or(0, |image| image.duration_ns()),
            },
        };
        vec![
            image(0),
            Step::Grey {
                duration_ns: protocol.grey.duration_ns(),
            },
            image(1),
            Step::Ask(Ask::Choice),
        ]
    },
    flaw: |protocol| {
        if protocol.image.is_none() {
            return Some(
                "field `image.duration_ms` is missing: how long each image stands, such as 4000"
                    .to_owned(),
            );
        }
        plain_choice_flaw(protocol, true)
    },
};
