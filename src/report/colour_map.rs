//! Colours for numbers: one map for sizes, one for signed differences. Both can be told apart by
//! people who see fewer colours, and the first also in grey.

/// Magma at every 15th of its 256 steps: by Nathaniel Smith and Stéfan van der Walt, given to the
/// public domain (CC0), as in matplotlib 2.0. Between them straight lines, which stay within 3
/// levels of the whole table.
const MAGMA: [[u8; 3]; 18] = [
    [0, 0, 4],
    [9, 7, 32],
    [26, 16, 66],
    [49, 17, 101],
    [74, 16, 121],
    [98, 25, 128],
    [121, 34, 130],
    [145, 43, 129],
    [170, 51, 125],
    [194, 59, 117],
    [217, 70, 107],
    [236, 88, 96],
    [247, 114, 92],
    [252, 142, 100],
    [254, 170, 116],
    [254, 198, 138],
    [253, 226, 163],
    [252, 253, 191],
];

/// RdBu with 11 classes from blue to red, its middle made white. This includes color
/// specifications and designs developed by Cynthia Brewer (<https://colorbrewer2.org>).
const BLUE_RED: [[u8; 3]; 11] = [
    [5, 48, 97],
    [33, 102, 172],
    [67, 147, 195],
    [146, 197, 222],
    [209, 229, 240],
    [255, 255, 255],
    [253, 219, 199],
    [244, 165, 130],
    [214, 96, 77],
    [178, 24, 43],
    [103, 0, 31],
];

/// Black over violet to pale yellow for 0 to 1, brighter for more. What is outside is clipped;
/// NaN counts as 0.
#[must_use]
pub fn magma(value: f32) -> [u8; 3] {
    between(&MAGMA, value)
}

/// Blue for 0 over white for 0.5 to red for 1. What is outside is clipped; NaN counts as 0.
#[must_use]
pub fn blue_white_red(value: f32) -> [u8; 3] {
    between(&BLUE_RED, value)
}

/// Straight between neighbouring colours.
fn between(colours: &[[u8; 3]], value: f32) -> [u8; 3] {
    let last = colours.len() - 1;
    let value = match value.is_nan() {
        true => 0.0,
        false => value.clamp(0.0, 1.0),
    };
    let place = value * last as f32;
    // The place of the last colour is reached from the one before.
    let from = (place as usize).min(last.saturating_sub(1));
    let share = place - from as f32;
    [0, 1, 2].map(|channel| {
        let [low, high] = [from, from + 1].map(|at| f32::from(colours[at][channel]));
        (low + (high - low) * share).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_and_the_middle() {
        assert_eq!([0.0, 1.0].map(magma), [MAGMA[0], MAGMA[17]]);
        let blue_red = [0.0, 0.5, 1.0].map(blue_white_red);
        assert_eq!(blue_red, [[5, 48, 97], [255; 3], [103, 0, 31]]);
        assert_eq!([-3.0, 7.0].map(magma), [0.0, 1.0].map(magma));
        assert_eq!(magma(f32::NAN), magma(0.0));
        assert_eq!(blue_white_red(f32::INFINITY), blue_white_red(1.0));
    }

    /// Steps 8, 128 and 250 of matplotlib's own table, which lie between those kept here.
    #[test]
    fn what_lies_between_is_magma() {
        let known = [
            (8, [0.013_708, 0.011_771, 0.068_667]),
            (128, [0.716_387, 0.214_982, 0.475_290]),
            (250, [0.988_717, 0.955_742, 0.712_242]),
        ];
        for (step, colour) in known {
            let ours = magma(step as f32 / 255.0);
            for (ours, share) in ours.into_iter().zip(colour) {
                assert!((f32::from(ours) - share * 255.0).abs() < 3.0, "{step}");
            }
        }
    }

    #[test]
    fn more_is_brighter_and_zero_is_brightest() {
        let light = |colour: fn(f32) -> [u8; 3], i: i32| {
            let [red, green, blue] = colour(i as f32 / 100.0).map(f32::from);
            0.299 * red + 0.587 * green + 0.114 * blue
        };
        for i in 0..100 {
            assert!(light(magma, i) <= light(magma, i + 1), "{i}");
        }
        for i in 0..50 {
            assert!(
                light(blue_white_red, i) <= light(blue_white_red, i + 1),
                "{i}"
            );
            assert!(
                light(blue_white_red, 100 - i) <= light(blue_white_red, 99 - i),
                "{i}"
            );
        }
    }
}
