//! What colour a map is, and the pictures of it.

use std::path::PathBuf;
use std::str::FromStr;

use super::BouncesArgs;
use super::follow::Followed;
use crate::cli::{Failure, Verbosity};
use crate::multi_bounce::{MODELS, Openness};
use crate::reference::bounce_fit::ColourPicture;
use crate::reference::height_field::{Bounces, TransportSettings, albedo_map};

/// `RHO`, `R,G,B`, or a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Albedo {
    /// The same everywhere, linear red, green and blue.
    Even([f32; 3]),
    /// An image of the map's size.
    File(PathBuf),
}

impl FromStr for Albedo {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<f32>, _> =
            text.split(',').map(|part| part.trim().parse()).collect();
        let Ok(numbers) = numbers else {
            return Ok(Self::File(PathBuf::from(text)));
        };
        if let Some(wrong) = numbers.iter().find(|rho| !(0.0..=1.0).contains(*rho)) {
            return Err(format!(
                "found {wrong}, allowed is 0 to 1, the share of light that is sent back"
            ));
        }
        match numbers[..] {
            [rho] => Ok(Self::Even([rho; 3])),
            [red, green, blue] => Ok(Self::Even([red, green, blue])),
            _ => Err(format!(
                "found {} numbers, allowed are one, or three for red, green and blue",
                numbers.len()
            )),
        }
    }
}

/// A map in its colours under a white sky: without light between surfaces, by every safe model, and as
/// it is followed channel by channel; and the mean of its albedo.
///
/// # Errors
/// Exit code 2 for an image of albedos that does not fit.
pub fn pictures(
    followed: &Followed,
    args: &BouncesArgs,
    verbosity: Verbosity,
) -> Result<(Vec<ColourPicture>, [f64; 3]), Failure> {
    let texels = followed.bounces.openness.len();
    let albedo = match &args.albedo {
        Albedo::Even(rgb) => rgb.map(|rho| vec![rho; texels]),
        Albedo::File(path) => albedo_map(path, followed.size_px).map_err(Failure::bad_input)?,
    };
    let bar = verbosity.progress(3);
    bar.set_message(format!("{}: light in its colours", followed.name));
    let truth = [0, 1, 2].map(|channel| {
        let received = received(followed, args, &albedo[channel]);
        bar.inc(1);
        received
    });
    bar.finish_and_clear();
    let picture = |name: &str, value: &dyn Fn(usize, usize) -> f32| ColourPicture {
        name: name.to_owned(),
        size_px: followed.size_px,
        rgb: (0..texels)
            .map(|texel| {
                std::array::from_fn(|channel| albedo[channel][texel] * value(texel, channel))
            })
            .collect(),
    };
    let (openness, direct) = (&followed.bounces.openness, &followed.bounces.irradiance[0]);
    let share = |texel: usize| (direct[texel] / std::f32::consts::PI).min(1.0);
    let mut pictures = vec![picture("off", &|texel, _| share(texel))];
    for model in MODELS
        .iter()
        .filter(|model| model.is_safe && model.name != "none")
    {
        pictures.push(picture(model.name, &|texel, channel| {
            let openness = match model.openness {
                Openness::Uniform => openness[texel],
                Openness::Cosine => share(texel),
            };
            (model.f32)(openness, albedo[channel][texel])
        }));
    }
    pictures.push(picture("truth", &|texel, channel| truth[channel][texel]));
    let mean =
        |channel: &Vec<f32>| channel.iter().map(|rho| f64::from(*rho)).sum::<f64>() / texels as f64;
    Ok((pictures, [0, 1, 2].map(|channel| mean(&albedo[channel]))))
}

/// The light that every texel receives in one channel, as a share of that in the open.
fn received(followed: &Followed, args: &BouncesArgs, albedo: &[f32]) -> Vec<f32> {
    let share = |sum: f32| sum / std::f32::consts::PI;
    // Where all texels have one albedo, each bounce is that of white texels times its power.
    if let Some(&rho) = albedo.first()
        && albedo.iter().all(|other| *other == rho)
    {
        let bounces = &followed.bounces.irradiance;
        return (0..albedo.len())
            .map(|texel| {
                let sum = |sum: f32, bounce: &Vec<f32>| sum * rho + bounce[texel];
                share(bounces.iter().rev().fold(0.0, sum))
            })
            .collect();
    }
    let transport = TransportSettings {
        bounces: args.bounces as usize,
        ..TransportSettings::default()
    };
    let bounces = Bounces::follow(&followed.links, albedo, &transport);
    (0..albedo.len())
        .map(|texel| share(bounces.sum(texel)))
        .collect()
}
