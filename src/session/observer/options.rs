//! What stands behind an observer's colon: a seed, then options as `KEY=VALUE` after commas. Messages
//! say what is needed, as the end of a sentence.

/// Keys and values.
type Given<'a> = Vec<(&'a str, &'a str)>;

/// The seed, and the options in the order given, none twice. `example` and `keys` are for the message.
pub(super) fn split<'a>(
    argument: &'a str,
    example: &str,
    keys: &str,
) -> Result<(u64, Given<'a>), String> {
    let mut parts = argument.split(',');
    let seed = parts.next().unwrap_or_default();
    let seed = seed.parse().map_err(|_| {
        format!("a whole number from 0 behind the colon, then options such as {example} ({keys}) after commas; not {seed:?}")
    })?;
    let mut given = Given::new();
    for part in parts {
        let (key, value) = part
            .split_once('=')
            .ok_or_else(|| format!("KEY=VALUE after each comma ({keys}), not {part:?}"))?;
        if given.iter().any(|(known, _)| *known == key) {
            return Err(format!("each option once; {key} stands twice"));
        }
        given.push((key, value));
    }
    Ok((seed, given))
}

/// The number of an option.
pub(super) fn number(
    key: &str,
    value: &str,
    is_allowed: impl Fn(f64) -> bool,
    allowed: &str,
) -> Result<f64, String> {
    let parsed = value.parse().ok();
    parsed
        .filter(|&number: &f64| number.is_finite() && is_allowed(number))
        .ok_or_else(|| format!("a number {allowed} for {key}, not {value:?}"))
}
