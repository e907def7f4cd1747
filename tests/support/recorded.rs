//! Sessions of scripted observers over a small study, recorded without a window.

use greyfield::protocol::Protocol;
use greyfield::record::{TrialRow, read_folder};
use greyfield::session::headless::Headless;
use greyfield::session::observer::{Needs, Scripted};
use greyfield::session::start;
use time::OffsetDateTime;

use crate::support::Tiny;

/// Who answers, of a name such as `random:1`; nobody compares images for it.
pub fn observer(study: &Tiny, protocol: &Protocol, name: &str) -> Scripted {
    let needs = Needs {
        protocol,
        manifest: &study.manifest,
        distances: &|_, _| Err(String::from("no images are compared here")),
    };
    Scripted::new(name, &needs).expect("an observer")
}

/// The rows of one participant, who begins at the epoch on the station `desk`.
pub fn rows(study: &Tiny, name: &str) -> Vec<TrialRow> {
    let protocol = study.protocol();
    let results = study.path("results");
    let text = std::fs::read_to_string(study.path("tiny.toml")).expect("the protocol");
    let open = start::open_study(&results, &protocol, &text, &study.manifest).expect("a study");
    let headless = Headless {
        study: &open,
        protocol: &protocol,
        manifest: &study.manifest,
        scripted: &observer(study, &protocol, name),
        station: "desk",
    };
    headless
        .run(1, || OffsetDateTime::UNIX_EPOCH, |_| {})
        .expect("a session");
    read_folder(&results).expect("the data").rows
}
