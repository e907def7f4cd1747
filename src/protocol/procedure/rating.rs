//! One image after the other, each rated on the protocol's scales.

use super::{Ask, Exhibits, Procedure, Step, TrialStart, Until, no_choice_flaw};

/// Grey, image, ratings.
pub const RATING: Procedure = Procedure {
    name: "rating",
    summary: "single images in random order, a short grey before each, then a rating on every scale of the protocol",
    source: "Kozlowski & Kautz 2007 (60 images, 0.5 s between them; realism of the lighting, and how pleasing)",
    exhibits: Exhibits::Singles,
    trial_start: TrialStart::Itself,
    steps: |protocol| {
        let until = protocol
            .image
            .map_or(Until::Continue, |image| Until::Elapsed {
                duration_ns: image.duration_ns(),
            });
        vec![
            Step::Grey {
                duration_ns: protocol.grey.duration_ns(),
            },
            Step::Image { place: 0, until },
            Step::Ask(Ask::Ratings),
        ]
    },
    flaw: |protocol| {
        if protocol.scales.is_empty() {
            return Some(
                "a protocol of ratings needs at least one [[scales]] with id and points".to_owned(),
            );
        }
        no_choice_flaw(protocol)
    },
};
