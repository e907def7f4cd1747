//! Sizes on the command line.

/// `1280x720`.
///
/// # Errors
/// What is allowed.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let wrong =
        || format!("found \"{text}\", a size is columns x rows from 16 to 16384, such as 1280x720");
    let (width, height) = text.split_once(['x', '×']).ok_or_else(wrong)?;
    let number = |text: &str| {
        text.trim()
            .parse()
            .ok()
            .filter(|px| (16..=16_384).contains(px))
    };
    Ok((
        number(width).ok_or_else(wrong)?,
        number(height).ok_or_else(wrong)?,
    ))
}
