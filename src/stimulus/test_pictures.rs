//! Pairs of pictures made by whole-number formulas, the same as in `tests/data/flip.py`.

use super::manifest::Picture;

pub const WIDTH_PX: u32 = 64;
pub const HEIGHT_PX: u32 = 48;

/// A picture of the pairs' size, a colour a pixel.
pub fn picture(colour: impl Fn(u32, u32) -> [u8; 3]) -> Picture {
    let places = (0..HEIGHT_PX).flat_map(|y| (0..WIDTH_PX).map(move |x| (x, y)));
    Picture {
        width_px: WIDTH_PX,
        height_px: HEIGHT_PX,
        rgba8: places
            .flat_map(|(x, y)| {
                let [red, green, blue] = colour(x, y);
                [red, green, blue, 255]
            })
            .collect(),
    }
}

pub fn flat(level: u8) -> Picture {
    picture(|_, _| [level; 3])
}

/// A byte that looks random.
fn mixed(x: u32, y: u32, channel: u32, seed: u32) -> u8 {
    let h = x
        .wrapping_mul(374_761_393)
        .wrapping_add(y.wrapping_mul(668_265_263))
        .wrapping_add(channel.wrapping_mul(2_246_822_519))
        .wrapping_add(seed.wrapping_mul(3_266_489_917));
    let h = (h ^ (h >> 13)).wrapping_mul(1_274_126_177);
    (h ^ (h >> 16)) as u8
}

fn gradient(x: u32, y: u32) -> [u8; 3] {
    [x * 255 / 63, y * 255 / 47, (x + y) * 255 / 110].map(|level| level as u8)
}

fn shaken(x: u32, y: u32) -> [u8; 3] {
    let smooth = gradient(x, y);
    [0, 1, 2].map(|channel| {
        let shift = i32::from(mixed(x, y, channel, 7) & 15) - 8;
        (i32::from(smooth[channel as usize]) + shift).clamp(0, 255) as u8
    })
}

fn edge(shift: u32) -> Picture {
    picture(|x, y| match 2 * x + y < 80 + shift {
        true => [200, 180, 60],
        false => [30, 60, 140],
    })
}

fn noise(seed: u32) -> Picture {
    picture(|x, y| [0, 1, 2].map(|channel| mixed(x, y, channel, seed)))
}

fn grey(seed: u32) -> Picture {
    picture(|x, y| [96 + (mixed(x, y, 0, seed) & 63); 3])
}

/// The pair of a name; panics at one that is not there.
pub fn pair(name: &str) -> [Picture; 2] {
    match name {
        "gradient" => [picture(gradient), picture(shaken)],
        "edge" => [edge(0), edge(4)],
        "noise" => [noise(1), noise(2)],
        "grey" => [grey(3), grey(4)],
        "unlike" => [grey(3), picture(gradient)],
        "flat" => [flat(0), flat(255)],
        other => panic!("no pair {other}"),
    }
}

/// Holds a map of a pair against a table of somebody else's numbers: lines of what `lead` columns
/// say of the pair, then `mean` or `pixel`, column, row and the value. How many lines there were, and
/// the largest difference with its line.
pub fn against(
    table: &str,
    lead: usize,
    mut map: impl FnMut(&[&str]) -> (f64, Vec<f32>),
) -> (usize, (f64, &str)) {
    let mut worst = (0.0, "");
    let mut rows = 0;
    for line in table.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let (mean, values) = map(&cells[..lead]);
        let ours = match cells[lead] {
            "mean" => mean,
            _ => {
                let [x, y] = [1, 2].map(|next| cells[lead + next].parse::<usize>().unwrap());
                f64::from(values[y * WIDTH_PX as usize + x])
            }
        };
        let error = (ours - cells[lead + 3].parse::<f64>().unwrap()).abs();
        if error.is_nan() || error > worst.0 {
            worst = (error, line);
        }
        rows += 1;
    }
    (rows, worst)
}
