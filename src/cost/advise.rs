//! The cheapest settings that a person should not be able to tell from the truth.
//!
//! An image passes when 95 % of its pixels differ from the image with the true occlusion by no
//! more than [`JUST_NOTICEABLE`] in FLIP. No threshold for FLIP has been published; this one is
//! what FLIP gives for two even patches that differ by ΔE*ab = 2.3 in lightness, the just
//! noticeable difference of Mahy, Van Eycken & Oosterlinck 1994. It is on the careful side: in a
//! picture with structure, seconds apart, more goes unseen. Votes overrule it.

use super::row::Row;
use crate::render::technique::{Settings, SettingsError};

/// FLIP of a difference that is just noticed on an even patch: of mid grey (sRGB 128) and a grey
/// 2.3 lighter in L*.
pub const JUST_NOTICEABLE: f64 = 0.1;

/// What is advised for a scene under one lighting.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice<'a> {
    /// The lighting variant.
    pub lighting: &'a str,
    /// The cheapest configuration that passes; `None` where none does.
    pub cheapest: Option<&'a Row>,
    /// The one whose image is nearest to the truth, whatever it takes.
    pub nearest: Option<&'a Row>,
    /// No occlusion at all.
    pub none: Option<&'a Row>,
    /// How many were measured.
    pub measured: usize,
}

impl<'a> Advice<'a> {
    /// From the rows of a sweep.
    #[must_use]
    pub fn of(rows: &'a [Row], scene: &str, lighting: &'a str, threshold: f64) -> Self {
        let here = || {
            rows.iter()
                .filter(move |row| row.scene == scene && row.lighting == lighting)
        };
        let passes = here().filter(|row| row.flip_p95 <= threshold);
        // Of two that take the same, the one that shows less.
        let cost = |row: &&Row| (row.total_ms, row.flip_p95);
        let by_cost = |a: &&Row, b: &&Row| {
            let (a, b) = (cost(a), cost(b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        Self {
            lighting,
            cheapest: passes.min_by(by_cost),
            nearest: here().min_by(|a, b| a.flip_p95.total_cmp(&b.flip_p95)),
            none: here().find(|row| row.technique == "none"),
            measured: here().count(),
        }
    }

    /// The evidence in words.
    #[must_use]
    pub fn sentences(&self, threshold: f64) -> Vec<String> {
        let mut said = Vec::new();
        let seen = |row: &Row| {
            format!(
                "{} ({:.3} ms, FLIP {:.3} at 95 % of the pixels, {:.4} on average, occlusion RMSE {:.3})",
                row.configuration, row.total_ms, row.flip_p95, row.flip_mean, row.rmse
            )
        };
        said.push(match (self.cheapest, self.nearest) {
            (Some(row), _) if row.technique == "none" => format!(
                "no occlusion at all: {} stays under {threshold}. Ambient occlusion does not earn its time here",
                seen(row)
            ),
            (Some(row), _) => format!("{}: the cheapest of {} under {threshold}", seen(row), self.measured),
            (None, Some(row)) => format!(
                "none of {} stays under {threshold}. The nearest is {}",
                self.measured,
                seen(row)
            ),
            (None, None) => String::from("nothing was measured"),
        });
        if let (Some(none), Some(cheapest)) = (self.none, self.cheapest)
            && cheapest.technique != "none"
        {
            said.push(format!("without occlusion: {}", seen(none)));
        }
        said
    }

    /// The row that is recommended: the cheapest that passes, or the nearest.
    #[must_use]
    pub fn recommended(&self) -> Option<&'a Row> {
        self.cheapest.or(self.nearest)
    }
}

/// The settings of a row, from its parameters.
///
/// # Errors
/// [`SettingsError`] for a row of another version's technique.
pub fn settings_of(row: &Row) -> Result<Settings, SettingsError> {
    let mut settings = Settings::from_label(&row.technique)?;
    for pair in row.parameters.split_whitespace() {
        let Some((name, value)) = pair.split_once('=') else {
            continue;
        };
        match value.parse::<f64>() {
            Ok(number) => settings.set(name, number)?,
            Err(_) => settings.set(name, value)?,
        }
    }
    settings.label.clone_from(&row.label);
    Ok(settings)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::cost::Resolution;
    use crate::render::Picture;
    use crate::stimulus::flip::{Viewing, flip};

    fn grey(level: u8) -> Picture {
        Picture {
            width_px: 64,
            height_px: 64,
            rgba8: [level, level, level, 255].repeat(64 * 64),
        }
    }

    /// CIE L* of an sRGB grey.
    fn lightness(level: u8) -> f64 {
        let encoded = f64::from(level) / 255.0;
        let y = ((encoded + 0.055) / 1.055).powf(2.4);
        116.0 * y.cbrt() - 16.0
    }

    /// The threshold is what its derivation says: 2.3 in L* from mid grey lies between two
    /// neighbouring levels of sRGB.
    #[test]
    fn the_threshold_is_a_just_noticeable_difference() {
        let ppd = Viewing::default().pixels_per_degree();
        let wanted = lightness(128) + 2.3;
        let above = (129..=255)
            .find(|&level| lightness(level) >= wanted)
            .unwrap();
        let [below, above] =
            [above - 1, above].map(|level| flip(&grey(128), &grey(level), ppd).unwrap().mean());
        assert!(
            (below..=above).contains(&JUST_NOTICEABLE),
            "{below} {above}"
        );
    }

    pub(in crate::cost) fn row(technique: &str, samples: u32, total_ms: f64, flip_p95: f64) -> Row {
        Row {
            scene: String::from("room"),
            lighting: String::from("low"),
            configuration: format!("{technique}-{samples}-full-b4"),
            technique: technique.to_owned(),
            label: format!("{technique}-{samples}"),
            samples,
            resolution: Resolution::Full,
            blur_px: 4,
            parameters: String::new(),
            total_ms,
            total_low_ms: None,
            total_high_ms: None,
            occlusion_ms: None,
            blur_ms: None,
            upsample_ms: None,
            frames: 6,
            clock: None,
            rmse: flip_p95,
            mae: 0.0,
            p95: 0.0,
            bias: 0.0,
            estimator_rmse: 0.0,
            estimator_bias: 0.0,
            information_loss_rmse: 0.0,
            thickness_m: 0.1,
            truth_error: 0.0,
            flip_mean: flip_p95 / 2.0,
            flip_p95,
            ssim: 1.0,
            reach_m: 1.0,
            width_px: 64,
            height_px: 64,
            adapter: String::from("x"),
            run: 1,
        }
    }

    #[test]
    fn the_cheapest_that_passes_is_advised() {
        let rows = [
            row("none", 0, 0.0, 0.4),
            row("gtao", 64, 8.0, 0.05),
            row("gtao", 16, 2.0, 0.09),
            row("crytek", 8, 1.0, 0.5),
        ];
        let advice = Advice::of(&rows, "room", "low", 0.1);
        assert_eq!(advice.cheapest.unwrap().label, "gtao-16");
        assert_eq!(advice.nearest.unwrap().label, "gtao-64");
        let strict = Advice::of(&rows, "room", "low", 0.01);
        assert_eq!(
            (strict.cheapest, strict.recommended().unwrap().samples),
            (None, 64)
        );
        let lax = Advice::of(&rows, "room", "low", 0.4);
        assert!(lax.sentences(0.4)[0].contains("no occlusion at all"));
    }

    #[test]
    fn a_rows_settings_come_back() {
        let settings = Settings::from_label("gtao54").unwrap();
        let mut half = settings;
        half.set("resolution", "half").unwrap();
        let parameters = crate::cost::Configuration {
            settings: half.clone(),
            blur_radius_px: 4,
        }
        .parameters();
        let back = settings_of(&Row {
            parameters,
            ..row("gtao", 54, 1.0, 0.1)
        });
        assert_eq!(back.unwrap().values(), half.values());
    }
}
