//! What every model says of a picture, and how far that is from the truth.

use std::fmt::Write as _;

use crate::multi_bounce::{MODELS, Model, ModelError, Openness};
use crate::stimulus::truth::inter_reflection::PictureInterReflection;

/// What a model says at every pixel.
pub struct Row {
    /// Name in tables and of files.
    pub name: String,
    /// What it was told of each pixel.
    pub given: Openness,
    /// E/E₀ in red, green and blue; 1 where there is no surface.
    pub values: Vec<[f32; 3]>,
    /// Against the truth, over the pixels with a surface and the three channels.
    pub error: ModelError,
}

impl Row {
    /// Cosine-weighted openness alone, which is the direct light; every model with the openness that it
    /// takes; and those that take the uniform one with the cosine-weighted one in its place, as the
    /// renderer gives it to them where a technique knows no other.
    pub fn all(picture: &PictureInterReflection) -> Vec<Self> {
        let alone = Self::of(
            String::from("cosine-openness"),
            Openness::Cosine,
            picture,
            |k_a, _| k_a,
        );
        let own = MODELS.iter().map(|model| {
            let name = model.name.to_owned();
            Self::of(name, model.openness, picture, model.f64)
        });
        let bounces = |model: &&&Model| model.openness == Openness::Uniform && model.name != "none";
        let converted = MODELS.iter().filter(bounces).map(|model| {
            let name = format!("{}-from-cosine", model.name);
            let given = Openness::Cosine;
            Self::of(name, given, picture, |k_a, rho| {
                model.value(given, k_a, rho)
            })
        });
        std::iter::once(alone).chain(own).chain(converted).collect()
    }

    fn of(
        name: String,
        given: Openness,
        picture: &PictureInterReflection,
        value: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let openness = match given {
            Openness::Uniform => &picture.openness.occlusion,
            Openness::Cosine => &picture.light.direct,
        };
        let seen = &picture.has_surface;
        let values: Vec<[f64; 3]> = (openness.iter().zip(&picture.albedo))
            .zip(seen)
            .map(|((&openness, albedo), seen)| match seen {
                true => albedo.map(|rho| value(openness.into(), rho.into())),
                false => [1.0; 3],
            })
            .collect();
        let pairs = (values.iter().zip(&picture.light.irradiance))
            .zip(seen)
            .filter(|(_, seen)| **seen)
            .flat_map(|((found, truth), _)| [0, 1, 2].map(|c| (found[c], f64::from(truth[c]))));
        Self {
            name,
            given,
            error: ModelError::of(pairs),
            values: (values.iter())
                .map(|colour| colour.map(|c| c as f32))
                .collect(),
        }
    }
}

/// The errors as lines for a terminal.
pub fn table(rows: &[Row]) -> String {
    let wide = rows.iter().map(|row| row.name.len()).max().unwrap_or(0);
    let mut text = format!(
        "{:wide$}  {:>8}  {:>7}  {:>8}  {:>7}  {:>7}  {:>12}  {:>12}\n",
        "model", "given", "RMSE", "mean", "p95", "worst", "no number", "not in 0..1"
    );
    for row in rows {
        let error = &row.error;
        let given = match row.given {
            Openness::Uniform => "uniform",
            Openness::Cosine => "cosine",
        };
        let _ = writeln!(
            text,
            "{:wide$}  {given:>8}  {:>7.4}  {:>+8.4}  {:>7.4}  {:>7.4}  {:>12}  {:>12}",
            row.name,
            error.rmse,
            error.bias,
            error.p95,
            error.worst,
            error.not_finite,
            error.outside
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{Estimates, InterReflections};

    /// One pixel in the open, one in a cavity, one without a surface.
    fn picture() -> PictureInterReflection {
        PictureInterReflection {
            size_px: (3, 1),
            has_surface: vec![true, true, false],
            openness: Estimates {
                occlusion: vec![1.0, 0.4, 1.0],
                standard_error: vec![0.0; 3],
                rays: 1,
                surfaces: 2,
            },
            light: InterReflections {
                irradiance: vec![[1.0; 3], [0.7, 0.6, 0.5], [1.0; 3]],
                standard_error: vec![[0.0; 3]; 3],
                direct: vec![1.0, 0.5, 1.0],
                given_up: vec![0.0; 3],
                paths: 1,
                surfaces: 2,
            },
            albedo: vec![[0.5; 3], [0.6, 0.4, 0.0], [0.0; 3]],
            albedo_apart: 0.0,
        }
    }

    #[test]
    fn every_model_has_a_row_and_openness_alone_has_one() {
        let picture = picture();
        let rows = Row::all(&picture);
        for model in MODELS {
            assert!(rows.iter().any(|row| row.name == model.name));
        }
        assert_eq!(rows[0].name, "cosine-openness");
        assert_eq!(rows[0].values[1], [0.5; 3]);
        let alone = &rows[0].error;
        assert!(alone.values == 6 && (alone.worst - 0.2).abs() < 1e-6);
        // A model's openness is its own: α of 0.4 here, k_A of 0.5 there.
        let named = |name: &str| rows.iter().find(|row| row.name == name).unwrap();
        assert_eq!(named("none").values[1], [0.4; 3]);
        assert_eq!(named("greyfield-from-cosine").given, Openness::Cosine);
        assert!((named("greyfield-from-cosine").values[1][2] - 0.5).abs() < 1e-3);
        let [red, green, blue] = named("greyfield").values[1];
        assert!(red > green && green > blue);
        // The published model is 0/0 in the open.
        let published = &named("published").error;
        assert_eq!((published.not_finite, published.values), (3, 3));
        assert_eq!(table(&rows).lines().count(), rows.len() + 1);
    }
}
