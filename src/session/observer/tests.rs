use std::path::Path;

use super::*;

/// A set without images, and nobody who compares any.
fn observer(text: &str) -> Result<Scripted, String> {
    let protocol = include_str!("../../../protocols/thesis-2010.toml");
    let protocol = Protocol::parse(Path::new("p.toml"), protocol).unwrap();
    let manifest = qualities::tests::manifest(&[]);
    let needs = Needs {
        protocol: &protocol,
        manifest: &manifest,
        distances: &|_, pairs| Ok(vec![1.0; pairs.len()]),
    };
    Scripted::new(text, &needs)
}

#[test]
fn observers_are_named_as_on_the_command_line() {
    let random = observer("random:17").unwrap();
    assert_eq!(random.participant_id(3), "random17p0003");
    assert!(observer("first").is_ok());
    assert!(observer("share:1,p=0.6,bias=-0.5").is_ok());
    assert_eq!(
        observer("model:5").unwrap().participant_id(1),
        "model5p0001"
    );
}

/// Letters and digits alone would make these two the same participant.
#[test]
fn observers_of_other_options_are_other_participants() {
    let id = |text| observer(text).unwrap().participant_id(1);
    let (one, other) = (id("model:1,sigma=0.5"), id("model:1,sigma=05"));
    assert_ne!(one, other);
    assert!(
        one.starts_with("model1x") && one.ends_with("p0001"),
        "{one}"
    );
    let long = id("model:18446744073709551615,metric=error,sigma=0.123456,lapse=0.01,bias=0.001");
    assert!(crate::record::ParticipantId::new(&long).is_ok(), "{long}");
}

#[test]
fn wrong_names_say_what_is_allowed() {
    for text in [
        "last",
        "random",
        "random:",
        "random:x",
        "random:-1",
        "first:1",
        "",
    ] {
        let message = observer(text).unwrap_err();
        assert!(message.contains(&format!("{text:?}")), "{message}");
        assert!(
            message.contains("random:SEED") || message.contains("first needs"),
            "{message}"
        );
    }
}
