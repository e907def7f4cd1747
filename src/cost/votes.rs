//! People's choices beside what the images cost: how much more often an image was chosen, and
//! how many milliseconds more it takes.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

use super::CostError;
use super::row::Row;
use crate::analysis::dataset::{ConditionData, Dataset};
use crate::analysis::tails::Alpha;
use crate::analysis::wilson;
use crate::render::technique::Settings;
use crate::stimulus::StimulusSet;

/// A condition that people voted on, with the costs of its two images.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Preference {
    /// Condition id.
    pub condition: String,
    /// Scene id.
    pub scene: String,
    /// Level of ecological validity, as the set names it.
    pub validity: String,
    /// What it asks.
    pub hypothesis: String,
    /// The image that comes first in the base order.
    pub a: Side,
    /// The other.
    pub b: Side,
    /// Share of the votes for b, 0 to 1, with its 95 % Wilson interval.
    pub share_b: Estimate,
    /// How much better b is in just objectionable differences: 1 where three of four choose b
    /// (Thurstone's case V). `None` where everybody chose one of the two.
    pub jod_b: Option<Estimate>,
    /// Percentage points of the votes above a half that b has for each millisecond that it takes
    /// more than a; `None` where the two take the same.
    pub points_per_ms: Option<f64>,
}

/// One image of a condition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Side {
    /// What rows of trials call its technique.
    pub label: String,
    /// Votes for it.
    pub votes: u32,
    /// What its occlusion takes, milliseconds.
    pub ms: f64,
    /// Error of its occlusion against the truth.
    pub rmse: f64,
    /// Mean FLIP of the image against the one with the true occlusion.
    pub flip_mean: f64,
}

/// A number with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Joins the votes of a set's study to the rows of a sweep of that set.
///
/// # Errors
/// [`CostError::Input`] for a condition that the set does not have, whose images were made
/// elsewhere, or whose images the sweep has not measured.
pub fn join(
    set: &StimulusSet,
    votes: &Dataset,
    rows: &[Row],
) -> Result<Vec<Preference>, CostError> {
    if votes.conditions.is_empty() {
        return Err(CostError::Input(String::from(
            "votes: there are ratings or rankings, and no choices between two images",
        )));
    }
    let of = |data: &ConditionData| preference(set, data, rows);
    votes.conditions.iter().map(of).collect()
}

fn preference(
    set: &StimulusSet,
    data: &ConditionData,
    rows: &[Row],
) -> Result<Preference, CostError> {
    let said = |message: String| CostError::Input(format!("votes for \"{}\": {message}", data.id));
    let (condition, pair) = set
        .rendered()
        .find(|(condition, _)| condition.id == data.id)
        .ok_or_else(|| {
            let ids: Vec<&str> = set
                .rendered()
                .map(|(condition, _)| condition.id.as_str())
                .collect();
            said(format!(
                "the set {} renders no such condition; it has {}",
                set.id,
                ids.join(", ")
            ))
        })?;
    let labels = [&pair.first.label, &pair.second.label];
    if labels != [&data.technique_a, &data.technique_b] {
        return Err(said(format!(
            "they are for {} and {}, the set's images are {} and {}",
            data.technique_a, data.technique_b, labels[0], labels[1]
        )));
    }
    let scene = &set.scenes[pair.scene];
    let side = |settings: &Settings, votes: u32| {
        let blur_px = match settings.technique.shader {
            Some(_) => scene.occlusion.blur_radius_px,
            None => 0,
        };
        let is_it = |row: &&Row| {
            row.scene == scene.id
                && row.lighting == pair.lighting
                && row.label == settings.label
                && row.blur_px == blur_px
        };
        let row = rows.iter().find(is_it).ok_or_else(|| {
            said(format!(
                "the sweep has no image of {} under {} with {}; measure the set itself: greyfield cost {}",
                scene.id,
                pair.lighting,
                settings.label,
                set.path.display()
            ))
        })?;
        Ok::<_, CostError>(Side {
            label: settings.label.clone(),
            votes,
            ms: row.total_ms,
            rmse: row.rmse,
            flip_mean: row.flip_mean,
        })
    };
    let (a, b) = (
        side(&pair.first, data.votes.a)?,
        side(&pair.second, data.votes.b)?,
    );
    let share = data
        .votes
        .share_b()
        .ok_or_else(|| said(String::from("there are none")))?;
    let ends = wilson::interval(data.votes, Alpha::default())
        .map_err(|_| said(String::from("there are none")))?;
    let share_b = Estimate {
        value: share,
        low: ends.low,
        high: ends.high,
    };
    let extra_ms = b.ms - a.ms;
    Ok(Preference {
        condition: condition.id.clone(),
        scene: scene.id.clone(),
        validity: condition.validity.clone(),
        hypothesis: condition.hypothesis.clone(),
        jod_b: in_jod(share_b),
        points_per_ms: (extra_ms != 0.0).then(|| 100.0 * (share - 0.5) / extra_ms),
        share_b,
        a,
        b,
    })
}

/// A share of the votes in just objectionable differences: Φ⁻¹(share) / Φ⁻¹(¾) (Perez-Ortiz &
/// Mantiuk 2017, 2.3, from Thurstone 1927, case V).
fn in_jod(share: Estimate) -> Option<Estimate> {
    let normal = Normal::standard();
    let of = |share: f64| normal.inverse_cdf(share) / normal.inverse_cdf(0.75);
    (share.value > 0.0 && share.value < 1.0).then(|| Estimate {
        value: of(share.value),
        low: of(share.low),
        high: of(share.high),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(value: f64, low: f64, high: f64) -> Estimate {
        Estimate { value, low, high }
    }

    #[test]
    fn three_of_four_are_one_jod() {
        let found = in_jod(share(0.75, 0.25, 0.9)).unwrap();
        assert!((found.value - 1.0).abs() < 1e-9 && (found.low + 1.0).abs() < 1e-9);
        assert!((in_jod(share(0.5, 0.4, 0.6)).unwrap().value).abs() < 1e-9);
        assert_eq!(in_jod(share(1.0, 0.9, 1.0)), None);
    }
}
