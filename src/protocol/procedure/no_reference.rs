//! Two images one after the other, no reference: which looked more realistic?

use super::{Ask, Exhibits, Procedure, Step, TrialStart, Until, plain_choice_flaw};

/// Image, grey, image, question; the participant decides how long to look.
pub const NO_REFERENCE: Procedure = Procedure {
    name: "no-reference",
    summary: "two images one after the other with a grey between them, each as long as the participant likes, then a choice of one",
    source: "Jimenez et al. 2009; the thesis of 2010, section 5.4",
    exhibits: Exhibits::Pairs,
    trial_start: TrialStart::Menu,
    steps: |protocol| {
        let image = |place| Step::Image {
            place,
            until: Until::Continue,
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
    flaw: |protocol| plain_choice_flaw(protocol, false),
};
