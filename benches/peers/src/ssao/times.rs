//! What passes took, over many frames.

/// Times of one frame.
#[derive(Debug, Clone, Copy)]
pub struct Passes {
    /// What comes before: Bevy's mips of the depth.
    pub before_ms: f64,
    /// The occlusion itself.
    pub occlusion_ms: f64,
    /// The denoising, and bringing a smaller picture to the size of the whole.
    pub denoise_ms: f64,
}

impl Passes {
    /// All that stands between the drawn surfaces and the occlusion that is used.
    pub fn total_ms(&self) -> f64 {
        self.before_ms + self.occlusion_ms + self.denoise_ms
    }
}

/// The middle of a list of numbers, and the middle half of it.
#[derive(Debug, Clone, Copy)]
pub struct Spread {
    pub median: f64,
    pub quartiles: [f64; 2],
}

impl Spread {
    /// Of at least one number.
    pub fn of(numbers: impl Iterator<Item = f64>) -> Self {
        let mut numbers: Vec<f64> = numbers.collect();
        numbers.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = share * (numbers.len() - 1) as f64;
            let (low, high) = (place.floor() as usize, place.ceil() as usize);
            numbers[low] + (numbers[high] - numbers[low]) * place.fract()
        };
        Self {
            median: at(0.5),
            quartiles: [at(0.25), at(0.75)],
        }
    }
}

/// How many times as long one took as the other, frame by frame: what else the machine did meanwhile
/// met both alike.
pub fn ratio(ours: &[Passes], theirs: &[Passes], time_ms: impl Fn(&Passes) -> f64) -> f64 {
    let ratios = ours.iter().zip(theirs);
    Spread::of(ratios.map(|(ours, theirs)| time_ms(ours) / time_ms(theirs))).median
}
