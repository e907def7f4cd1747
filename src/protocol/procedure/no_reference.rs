//! Two images one after the other, no reference: which looked more realistic?

use super::{Procedure, Step, Until};
use crate::protocol::Position;

/// Image, grey, image, question; the participant decides how long to look.
pub const NO_REFERENCE: Procedure = Procedure {
    name: "no-reference",
    summary: "two images one after the other with a grey between them, each as long as the participant likes, then a choice of one",
    source: "Jimenez et al. 2009; the thesis of 2010, section 5.4",
    steps: |protocol| {
        let image = |position| Step::Image {
            position,
            until: Until::Continue,
        };
        vec![
            image(Position::First),
            Step::Grey {
                duration_ns: protocol.grey.duration_ns(),
            },
            image(Position::Second),
            Step::Question,
        ]
    },
};
