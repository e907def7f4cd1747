//! What no single field of a protocol can know: whether its parts fit each other.

use super::locale::Texts;
use super::options::twice;
use super::{Language, Protocol, analysis};

/// The first thing that does not fit, with its field and how to mend it.
pub(super) fn flaw(protocol: &Protocol) -> Option<String> {
    (protocol.procedure.flaw)(protocol)
        .or_else(|| named_twice(protocol))
        .or_else(|| catch_that_cannot_pass(protocol))
        .or_else(|| analysis::flaw(protocol))
        .or_else(|| {
            texts_of(protocol).find_map(|(table, texts)| words_missing(protocol, &table, texts))
        })
        .or_else(|| own_language_translated(protocol))
}

/// Every table of texts, with its name in the file.
fn texts_of(protocol: &Protocol) -> impl Iterator<Item = (String, &Texts)> {
    let others = protocol.translations.iter();
    let others =
        others.map(|(language, texts)| (format!("translations.{}", language.code()), texts));
    std::iter::once(("texts".to_owned(), &protocol.texts)).chain(others)
}

fn named_twice(protocol: &Protocol) -> Option<String> {
    let scales = protocol.scales.iter().map(|scale| &*scale.id);
    if let Some(id) = twice(scales) {
        return Some(format!(
            "field `scales`: two scales named {id:?}; every id must differ"
        ));
    }
    let fields = protocol.metadata.iter().map(|field| &*field.id);
    if let Some(id) = twice(fields) {
        return Some(format!(
            "field `metadata`: two questions named {id:?}; every id must differ"
        ));
    }
    let practice = protocol.practice.iter().flat_map(|it| &it.conditions);
    let catch = protocol.catch.iter().flat_map(|it| &it.trials);
    let named = practice.chain(catch.map(|trial| &trial.condition));
    twice(named.map(String::as_str)).map(|id| {
        format!("condition {id:?} is named twice in `practice` and `catch`; a condition is shown once a session")
    })
}

fn catch_that_cannot_pass(protocol: &Protocol) -> Option<String> {
    let catch = protocol.catch.as_ref()?;
    let (needed, there) = (catch.minimum_correct.get() as usize, catch.trials.len());
    (needed > there).then(|| {
        format!(
            "field `catch.minimum_correct`: found {needed}, but there are only {there} catch trials"
        )
    })
}

/// Scales and offered answers that a language has no words for, and words for what is not there.
fn words_missing(protocol: &Protocol, table: &str, texts: &Texts) -> Option<String> {
    for scale in &protocol.scales {
        if !texts.scales.contains_key(&*scale.id) {
            return Some(format!(
                "[{table}.scales.{}] is missing: question, low and high of that scale",
                &*scale.id
            ));
        }
    }
    for field in &protocol.metadata {
        let words = texts.metadata.get(&*field.id);
        if let Some(words) = words.filter(|words| words.choices.len() != field.choices.len()) {
            return Some(format!(
                "field `{table}.metadata.{}.choices`: found {}, the question has {} choices; one text each is needed, in the same order",
                &*field.id,
                words.choices.len(),
                field.choices.len()
            ));
        }
    }
    let stray_scale = texts
        .scales
        .keys()
        .find(|id| protocol.scales.iter().all(|scale| *scale.id != ***id));
    let stray_field = texts
        .metadata
        .keys()
        .find(|id| protocol.metadata.iter().all(|field| *field.id != ***id));
    stray_scale
        .map(|id| format!("[{table}.scales.{id}]: there is no scale of that id"))
        .or_else(|| {
            stray_field
                .map(|id| format!("[{table}.metadata.{id}]: there is no question of that id"))
        })
}

fn own_language_translated(protocol: &Protocol) -> Option<String> {
    let own: Language = protocol.language;
    protocol.translations.contains_key(&own).then(|| {
        format!(
            "[translations.{0}]: the texts under [texts] are in that language already (field `language`); leave one of them out",
            own.code()
        )
    })
}
