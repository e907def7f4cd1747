//! How often a technique looks at the scene, and settings that look so often.

use super::{Settings, SettingsError, Taps};

impl Settings {
    /// How often these settings look at the scene for one estimate; 0 for a technique that
    /// does not.
    #[must_use]
    pub fn taps(&self) -> u32 {
        let of = |name: &str| self.get(name) as u32;
        match self.technique.taps {
            Taps::None => 0,
            Taps::Count(name) => of(name),
            Taps::Lines {
                count,
                sides,
                steps,
            } => of(count) * sides * of(steps),
        }
    }

    /// The same settings looking at the scene `taps` times. Lines and steps keep to the
    /// proportion they have as nearly as whole numbers allow.
    ///
    /// # Errors
    /// [`SettingsError`] where the technique cannot look exactly so often.
    pub fn with_taps(&self, taps: u32) -> Result<Self, SettingsError> {
        let refused = |allowed: String| SettingsError {
            parameter: None,
            message: format!(
                "technique `{}` cannot take {taps} samples a pixel; {allowed}",
                self.technique.name
            ),
        };
        let mut settings = self.clone();
        match self.technique.taps {
            Taps::None => return Err(refused(String::from("it takes none"))),
            Taps::Count(name) => settings.set(name, f64::from(taps))?,
            Taps::Lines {
                count,
                sides,
                steps,
            } => {
                let wanted = (self.get(count) / self.get(steps)).ln();
                let off = |lines: u32| {
                    let per_line = f64::from(taps / sides / lines);
                    ((f64::from(lines) / per_line).ln() - wanted).abs()
                };
                let lines = (1..=taps / sides)
                    .filter(|lines| taps.is_multiple_of(sides * lines))
                    .min_by(|&a, &b| off(a).total_cmp(&off(b)))
                    .ok_or_else(|| refused(format!("allowed are multiples of {sides}")))?;
                settings.set(count, f64::from(lines))?;
                settings.set(steps, f64::from(taps / sides / lines))?;
            }
        }
        Ok(settings)
    }

    /// The same settings with their reach at `reach_m` metres; what else they say of distances
    /// that belong to the reach keeps its proportion to it. Settings without a reach stay.
    ///
    /// # Errors
    /// [`SettingsError`] for a distance out of range.
    pub fn with_reach_m(&self, reach_m: f64) -> Result<Self, SettingsError> {
        let mut settings = self.clone();
        let Some(reach) = self.technique.reach else {
            return Ok(settings);
        };
        let before_m = self.get(reach);
        settings.set(reach, reach_m)?;
        let inner = "radius_m";
        if reach != inner && self.technique.parameter(inner).is_some() && before_m > 0.0 {
            settings.set(inner, self.get(inner) * reach_m / before_m)?;
        }
        Ok(settings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::technique::TECHNIQUES;
    use proptest::prelude::*;

    #[test]
    fn the_presets_look_as_often_as_their_names_say() {
        for (label, taps) in [
            ("crytek24", 24),
            ("blizzard8", 8),
            // The number of ray-march is its directions, each walked in 4 steps.
            ("ray-march30", 120),
            ("gtao18", 18),
            ("vbao54", 54),
            ("hbao24", 24),
            ("none", 0),
        ] {
            assert_eq!(Settings::from_label(label).unwrap().taps(), taps, "{label}");
        }
    }

    #[test]
    fn lines_and_steps_keep_their_proportion() {
        let gtao = Settings::from_label("gtao18").unwrap();
        for (taps, slices, steps) in [
            (4, 1.0, 2.0),
            (18, 3.0, 3.0),
            (32, 4.0, 4.0),
            (256, 8.0, 16.0),
        ] {
            let set = gtao.with_taps(taps).unwrap();
            let found = (set.get("slices"), set.get("steps"));
            assert!(
                found == (slices, steps) || found == (steps, slices),
                "{taps}: {found:?}"
            );
        }
        assert!(gtao.with_taps(7).is_err());
    }

    #[test]
    fn what_a_technique_cannot_do_is_said() {
        let crytek = Settings::from_label("crytek").unwrap();
        let message = crytek.with_taps(4).unwrap_err().message;
        assert!(
            message.contains("crytek") && message.contains('8'),
            "{message}"
        );
        assert!(Settings::from_label("none").unwrap().with_taps(4).is_err());
    }

    #[test]
    fn two_bands_reach_as_one() {
        let two_band = Settings::from_label("two-band").unwrap();
        let near = two_band.get("radius_m") / two_band.get("reach_m");
        let set = two_band.with_reach_m(2.0).unwrap();
        assert!((set.get("reach_m") - 2.0).abs() < 1e-12);
        assert!((set.get("radius_m") - 2.0 * near).abs() < 1e-12);
    }

    proptest! {
        /// Whoever takes a number takes exactly that number.
        #[test]
        fn settings_look_as_often_as_asked(taps in 1_u32..300) {
            for technique in TECHNIQUES {
                let settings = Settings::from_label(technique.name).unwrap();
                if let Ok(set) = settings.with_taps(taps) {
                    prop_assert_eq!(set.taps(), taps);
                }
            }
        }
    }
}
