//! One line of `cost.csv`: a configuration under one lighting.

use serde::{Deserialize, Serialize};

use super::configuration::{Configuration, Resolution};
use super::measured::{ImageMeasured, Measured};
use crate::render::{AdapterRecord, Clock};

/// A configuration under one lighting variant of one scene. Times and errors of occlusion are
/// the same under every lighting, but for a technique that looks at the light.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Scene id.
    pub scene: String,
    /// Lighting variant.
    pub lighting: String,
    /// What the configuration is called: `gtao-16-full-b4`.
    pub configuration: String,
    /// Registry name of the technique.
    pub technique: String,
    /// Its label.
    pub label: String,
    /// Looks at the scene for one estimate.
    pub samples: u32,
    /// Full or half.
    pub resolution: Resolution,
    /// Half width of the blur, pixels.
    pub blur_px: u32,
    /// `name=value` of every parameter.
    pub parameters: String,
    /// Median of all its passes together, milliseconds; 0 where it runs none.
    pub total_ms: f64,
    /// Lower end of the median's 95 % interval.
    pub total_low_ms: Option<f64>,
    /// Upper end.
    pub total_high_ms: Option<f64>,
    /// Median of the technique's own pass.
    pub occlusion_ms: Option<f64>,
    /// Median of the blur.
    pub blur_ms: Option<f64>,
    /// Median of the upsampling.
    pub upsample_ms: Option<f64>,
    /// Frames timed.
    pub frames: usize,
    /// What timed them.
    pub clock: Option<Clock>,
    /// Occlusion against the ray-traced truth: root of the mean squared error.
    pub rmse: f64,
    /// Mean absolute error.
    pub mae: f64,
    /// 95th percentile of the absolute error.
    pub p95: f64,
    /// Mean error; above 0 is too open.
    pub bias: f64,
    /// Occlusion against what the depth buffer alone answers.
    pub estimator_rmse: f64,
    /// Mean of that error.
    pub estimator_bias: f64,
    /// What the depth buffer alone answers against the truth.
    pub information_loss_rmse: f64,
    /// The thickness of what is seen at which the depth buffer's answer is nearest to the truth,
    /// metres; infinite for solid.
    pub thickness_m: f32,
    /// Standard error of the truth, root mean square.
    pub truth_error: f64,
    /// Image against the image with the true occlusion: mean FLIP, 0 to 1.
    pub flip_mean: f64,
    /// 95th percentile of FLIP.
    pub flip_p95: f64,
    /// Mean structural similarity, 1 for the same image.
    pub ssim: f64,
    /// Distance from which on nothing occludes in the truth, metres.
    pub reach_m: f64,
    /// Columns.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// Adapter and its driver.
    pub adapter: String,
    /// Which run of the sweep measured it, from 1: compare times of one run.
    pub run: u32,
}

/// What the rows of one scene of one run have in common.
#[derive(Debug, Clone)]
pub struct Common {
    /// Scene id.
    pub scene: String,
    /// Distance from which on nothing occludes in the truth, metres.
    pub reach_m: f64,
    /// Standard error of the truth.
    pub truth_error: f64,
    /// Thickness of the depth buffer's best answer, metres.
    pub thickness_m: f32,
    /// Size of the images, pixels.
    pub size_px: (u32, u32),
    /// What draws.
    pub adapter: AdapterRecord,
    /// Which run.
    pub run: u32,
}

impl Row {
    /// The rows of a measured configuration, one a lighting.
    #[must_use]
    pub fn all(common: &Common, configuration: &Configuration, measured: &Measured) -> Vec<Self> {
        let row = |image: &ImageMeasured| Self::of(common, configuration, measured, image);
        measured.images.iter().map(row).collect()
    }

    fn of(
        common: &Common,
        configuration: &Configuration,
        measured: &Measured,
        image: &ImageMeasured,
    ) -> Self {
        let settings = &configuration.settings;
        let times = measured.times.as_ref();
        let interval = times.and_then(|times| times.total_ms.interval);
        let adapter = &common.adapter;
        Self {
            scene: common.scene.clone(),
            lighting: image.lighting.clone(),
            configuration: configuration.id(),
            technique: settings.technique.name.to_owned(),
            label: settings.label.clone(),
            samples: settings.taps(),
            resolution: configuration.resolution(),
            blur_px: configuration.blur_radius_px,
            parameters: configuration.parameters(),
            total_ms: times.map_or(0.0, |times| rounded(times.total_ms.median)),
            total_low_ms: interval.map(|(low, _)| rounded(low)),
            total_high_ms: interval.map(|(_, high)| rounded(high)),
            occlusion_ms: times.and_then(|times| times.occlusion_ms).map(rounded),
            blur_ms: times.and_then(|times| times.blur_ms).map(rounded),
            upsample_ms: times.and_then(|times| times.upsample_ms).map(rounded),
            frames: times.map_or(0, |times| times.total_ms.count),
            clock: times.map(|times| times.clock),
            rmse: rounded(measured.error.rmse),
            mae: rounded(measured.error.mae),
            p95: rounded(measured.error.p95),
            bias: rounded(measured.error.bias),
            estimator_rmse: rounded(measured.estimator_error.rmse),
            estimator_bias: rounded(measured.estimator_error.bias),
            information_loss_rmse: rounded(measured.information_loss.rmse),
            thickness_m: common.thickness_m,
            truth_error: rounded(common.truth_error),
            flip_mean: rounded(image.flip.mean()),
            flip_p95: rounded(f64::from(image.flip.percentile(0.95))),
            ssim: rounded(image.ssim),
            reach_m: common.reach_m,
            width_px: common.size_px.0,
            height_px: common.size_px.1,
            adapter: format!("{}; {}", adapter.name, adapter.driver),
            run: common.run,
        }
    }
}

/// To six significant digits: more than any of these numbers has.
fn rounded(number: f64) -> f64 {
    // What a float prints, it reads back.
    format!("{number:.5e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn six_digits_stay() {
        assert_eq!(rounded(0.123_456_789), 0.123_457);
        assert_eq!(rounded(1_234_567.0), 1_234_570.0);
        assert_eq!((rounded(0.0), rounded(-2.5)), (0.0, -2.5));
    }
}
