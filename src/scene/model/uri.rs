//! What a model file refers to: files beside it, or data inside it.

use std::path::{Component, Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::error::Fault;

/// A resolved reference.
pub(super) enum Reference<'a> {
    File(PathBuf),
    /// Base64 text.
    Data(&'a str),
}

/// Resolves the relative reference `uri` of a file in `folder` (RFC 3986, as far as
/// glTF goes).
pub(super) fn resolve<'a>(
    folder: &Path,
    uri: &'a str,
    place: &str,
) -> Result<Reference<'a>, Fault> {
    if let Some(data) = uri.strip_prefix("data:") {
        let data = data.split_once(";base64,").map(|(_, data)| data);
        return data.map(Reference::Data).ok_or_else(|| {
            Fault::new(
                place,
                "found a data URI that is not base64; base64 is allowed",
            )
        });
    }
    let shown: String = uri.chars().take(120).collect();
    let scheme = uri.split_once(':').is_some_and(|(scheme, _)| {
        scheme.len() > 1
            && scheme
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
    });
    if scheme {
        let message = format!("found the URI \"{shown}\"; allowed are files beside the model");
        return Err(Fault::new(place, message));
    }
    let decoded = percent_decoded(uri).ok_or_else(|| {
        Fault::new(
            place,
            format!("found the URI \"{shown}\", which is not UTF-8"),
        )
    })?;
    let path = Path::new(&decoded);
    let relative = path.components().all(|part| {
        matches!(
            part,
            Component::Normal(_) | Component::CurDir | Component::ParentDir
        )
    });
    if decoded.is_empty() || decoded.contains('\0') || !relative {
        let message = format!("found the URI \"{shown}\"; a path relative to the model is allowed");
        return Err(Fault::new(place, message));
    }
    Ok(Reference::File(folder.join(path)))
}

/// Decodes the base64 of a data URI.
pub(super) fn decode(data: &str, place: &str) -> Result<Vec<u8>, Fault> {
    STANDARD
        .decode(data)
        .map_err(|error| Fault::new(place, format!("its data URI is no base64: {error}")))
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        let hex = |at: usize| after.get(at).and_then(|&c| char::from(c).to_digit(16));
        match (byte, hex(0), hex(1)) {
            (b'%', Some(high), Some(low)) => {
                bytes.push((high * 16 + low) as u8);
                rest = &after[2..];
            }
            _ => {
                bytes.push(byte);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(uri: &str) -> Option<PathBuf> {
        match resolve(Path::new("m"), uri, "images[0]") {
            Ok(Reference::File(path)) => Some(path),
            _ => None,
        }
    }

    #[test]
    fn files_beside_the_model_are_found() {
        assert_eq!(file("a%20b.png"), Some(PathBuf::from("m/a b.png")));
        assert_eq!(file("../t/a.png"), Some(PathBuf::from("m/../t/a.png")));
        assert_eq!(file("50%.png"), Some(PathBuf::from("m/50%.png")));
    }

    #[test]
    fn other_places_are_refused() {
        for uri in [
            "http://x.org/a.png",
            "/etc/passwd",
            "file:///a",
            "",
            "a\0b",
            "data:,x",
        ] {
            assert_eq!(file(uri), None, "{uri}");
        }
    }
}
