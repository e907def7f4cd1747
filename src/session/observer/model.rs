//! Chooses by how far the images are from the truth, with noise, a lapse rate and a bias towards
//! the image shown first: what an effect of a known size looks like.

use rand_chacha::ChaCha20Rng;

use super::options::{number, split};
use super::qualities::{Metric, Qualities};
use super::{Behaviour, Kind, Observer, Question};
use crate::protocol::Position;
use crate::protocol::procedure::Ask;
use crate::seed;
use crate::session::Answer;

/// `model:SEED[,KEY=VALUE…]`.
pub const MODEL: Kind = Kind {
    name: "model",
    argument: "SEED[,KEY=VALUE…]",
    summary: "chooses by the images' distance to the truth through a psychometric function; keys: metric=flip|error, sigma, lapse, bias, participants, truth=LABEL",
    make: |argument, needs| {
        let options = Options::parse(argument)?;
        let qualities = Qualities::measure(needs, options.metric, options.truth.as_deref())?;
        Ok(Box::new(Model { options, qualities }))
    },
};

/// What stands behind the colon. Lengths are in units of the metric.
#[derive(Debug, Clone, PartialEq)]
struct Options {
    seed: u64,
    metric: Metric,
    /// Standard deviation of the noise on a difference of two qualities.
    sigma: f64,
    /// Share of trials answered without looking, 0 to 1.
    lapse: f64,
    /// Added to the quality of the image shown first.
    bias: f64,
    /// Standard deviation of what each participant adds to that.
    participants: f64,
    truth: Option<String>,
}

const KEYS: &str = "metric, sigma, lapse, bias, participants, truth";

impl Options {
    /// The message says what is needed, as the end of a sentence.
    fn parse(argument: &str) -> Result<Self, String> {
        let (seed, given) = split(argument, "sigma=0.1", KEYS)?;
        Self::with(seed, &given)
    }

    fn with(seed: u64, given: &[(&str, &str)]) -> Result<Self, String> {
        let mut options = Self {
            seed,
            metric: Metric::Flip,
            sigma: f64::NAN,
            lapse: 0.0,
            bias: 0.0,
            participants: 0.0,
            truth: None,
        };
        for &(key, value) in given {
            match key {
                "metric" => options.metric = metric(value)?,
                "sigma" => options.sigma = number(key, value, |x| x > 0.0, "above 0")?,
                "lapse" => {
                    options.lapse =
                        number(key, value, |x| (0.0..=1.0).contains(&x), "from 0 to 1")?;
                }
                "bias" => options.bias = number(key, value, |_| true, "of any sign")?,
                "participants" => {
                    options.participants = number(key, value, |x| x >= 0.0, "from 0")?;
                }
                "truth" if !value.is_empty() => options.truth = Some(value.to_owned()),
                "truth" => return Err("the label of an image for truth, not nothing".to_owned()),
                _ => return Err(format!("options that exist: {KEYS}; not {key:?}")),
            }
        }
        if options.sigma.is_nan() {
            options.sigma = default_sigma(options.metric);
        }
        Ok(options)
    }
}

/// The pairs of 2010 are 0.03 to 0.25 (FLIP) and 1 to 8 (lightness) apart: these make effects
/// that are neither nothing nor everything.
fn default_sigma(metric: Metric) -> f64 {
    match metric {
        Metric::Flip => 0.15,
        Metric::Error => 5.0,
    }
}

fn metric(value: &str) -> Result<Metric, String> {
    match value {
        "flip" => Ok(Metric::Flip),
        "error" => Ok(Metric::Error),
        _ => Err(format!("flip or error for metric, not {value:?}")),
    }
}

#[derive(Debug)]
struct Model {
    options: Options,
    qualities: Qualities,
}

impl Observer for Model {
    fn behave(&self, question: &Question<'_>) -> Behaviour {
        let mut rng = seed::generator(self.options.seed, "observer-model", question.index());
        let qualities = self.seen(question);
        let (answer, decision_s) = match question.ask {
            Ask::Choice | Ask::CloserToReference => self.choice(&mut rng, question, &qualities),
            Ask::Ratings => self.ratings(&mut rng, question, &qualities),
            Ask::Ranking => self.ranking(&mut rng, &qualities),
        };
        Behaviour {
            looks_ns: [(); 2].map(|()| nanoseconds(between(&mut rng, 2.0, 8.0))),
            decision_ns: nanoseconds(decision_s * between(&mut rng, 0.75, 1.25)),
            answer,
        }
    }
}

impl Model {
    /// Quality of the trial's images, by place.
    fn seen(&self, question: &Question<'_>) -> Vec<f64> {
        let condition = &question.plan.conditions[question.trial.condition].id;
        let shown = question.plan.shown(question.trial);
        shown
            .map(|technique| self.qualities.of(condition, technique))
            .collect()
    }

    /// What this participant adds to the bias: the same in every trial of a slot.
    fn own_shift(&self, slot: u32) -> f64 {
        let purpose = "observer-model-participant";
        let mut rng = seed::generator(self.options.seed, purpose, slot.into());
        self.options.participants * normal(&mut rng)
    }

    /// The first image with [`chance_of_first`]. A choice takes 0.5 s, and up to 1.5 s more the
    /// less the images differ.
    fn choice(&self, rng: &mut ChaCha20Rng, question: &Question<'_>, q: &[f64]) -> (Answer, f64) {
        let better = q.first().unwrap_or(&0.0) - q.get(1).unwrap_or(&0.0);
        let shifted = better + self.options.bias + self.own_shift(question.plan.slot);
        let in_sigmas = shifted / self.options.sigma;
        let chosen = if seed::unit_f64(rng) < chance_of_first(in_sigmas, self.options.lapse) {
            Position::First
        } else {
            Position::Second
        };
        let decision_s = 0.5 + 1.5 * libm::exp(-in_sigmas.abs());
        (Answer::Choice(chosen), decision_s)
    }

    /// One noisy look a scale, laid linearly over the scale's points: the worst image of the set
    /// at its lowest, the best at its highest.
    fn ratings(&self, rng: &mut ChaCha20Rng, question: &Question<'_>, q: &[f64]) -> (Answer, f64) {
        let (lowest, highest) = self.qualities.range();
        let quality = q.first().copied().unwrap_or(0.0);
        let rating = |points: u32, rng: &mut ChaCha20Rng| {
            if self.lapses(rng) {
                return 1 + seed::below(rng, points);
            }
            let seen = quality + self.look_noise(rng);
            let share = if highest > lowest {
                (seen - lowest) / (highest - lowest)
            } else {
                0.5
            };
            1 + rounded(share.clamp(0.0, 1.0) * f64::from(points - 1))
        };
        let scales = question.protocol.scales.iter();
        let ratings: Vec<u32> = scales
            .map(|scale| rating(scale.points.get(), rng))
            .collect();
        let decision_s = 1.5 * ratings.len() as f64;
        (Answer::Ratings(ratings), decision_s)
    }

    /// By quality, each with the noise of one look (Thurstone's case V); 2 s an image.
    fn ranking(&self, rng: &mut ChaCha20Rng, q: &[f64]) -> (Answer, f64) {
        let mut places: Vec<usize> = (0..q.len()).collect();
        if self.lapses(rng) {
            seed::shuffle(rng, &mut places);
        } else {
            let seen: Vec<f64> = q.iter().map(|q| q + self.look_noise(rng)).collect();
            places.sort_by(|&a, &b| seen[b].total_cmp(&seen[a]));
        }
        (Answer::Ranking(places), 2.0 * q.len() as f64)
    }

    /// Two looks make a difference, whose noise is sigma.
    fn look_noise(&self, rng: &mut ChaCha20Rng) -> f64 {
        self.options.sigma * std::f64::consts::FRAC_1_SQRT_2 * normal(rng)
    }

    fn lapses(&self, rng: &mut ChaCha20Rng) -> bool {
        seed::unit_f64(rng) < self.options.lapse
    }
}

/// ψ = γ + (1 − γ − λ) Φ with γ = λ = lapse / 2: who lapses guesses, and half of the guesses
/// are the first image (Wichmann & Hill 2001, "The psychometric function: I", Perception &
/// Psychophysics 63, equation 1).
fn chance_of_first(in_sigmas: f64, lapse: f64) -> f64 {
    let phi = 0.5 * libm::erfc(-in_sigmas * std::f64::consts::FRAC_1_SQRT_2);
    lapse / 2.0 + (1.0 - lapse) * phi
}

/// A standard normal number (Box & Muller 1958), the same on every machine.
pub(super) fn normal(rng: &mut ChaCha20Rng) -> f64 {
    // 1 − [0, 1) is never 0, which has no logarithm.
    let radius = libm::sqrt(-2.0 * libm::log(1.0 - seed::unit_f64(rng)));
    radius * libm::cos(std::f64::consts::TAU * seed::unit_f64(rng))
}

fn between(rng: &mut ChaCha20Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * seed::unit_f64(rng)
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // seconds, a few
fn nanoseconds(seconds: f64) -> u64 {
    (seconds * 1e9) as u64
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a point of a scale
fn rounded(point: f64) -> u32 {
    point.round() as u32
}

#[cfg(test)]
mod tests;
