//! What every safe model must be, at every openness and albedo that a texture or a float can hold.

use half::f16;
use proptest::prelude::*;

use super::*;

/// The 8-bit levels, 0 to 1.
fn levels() -> impl Iterator<Item = f64> + Clone {
    (0..=255_u8).map(|level| f64::from(level) / 255.0)
}

fn safe() -> impl Iterator<Item = &'static Model> {
    MODELS.iter().copied().filter(|model| model.is_safe)
}

/// Whether a model answers to light between surfaces at all.
fn bounces(model: &Model) -> bool {
    model.name != "none"
}

#[test]
fn names_are_unlike_and_found() {
    for model in MODELS {
        assert_eq!(find(model.name).map(|found| found.name), Some(model.name));
    }
    assert!(find("no-such-model").is_none());
}

/// Every cell of the 8-bit grid: finite, in [0, 1], and growing along both sides.
#[test]
fn the_grid_of_bytes_is_whole() {
    for model in safe() {
        for rho in levels() {
            let mut before = -1.0;
            for alpha in levels() {
                let value = (model.f64)(alpha, rho);
                assert!(
                    (0.0..=1.0).contains(&value),
                    "{} {alpha} {rho}: {value}",
                    model.name
                );
                assert!(value >= before, "{} falls at {alpha} {rho}", model.name);
                before = value;
            }
        }
        for alpha in levels() {
            let mut before = -1.0;
            for rho in levels() {
                let value = (model.f64)(alpha, rho);
                assert!(
                    value >= before,
                    "{} falls at {alpha}, albedo {rho}",
                    model.name
                );
                before = value;
            }
        }
    }
}

/// No light is lost where nothing absorbs it, and none is gained where nothing blocks it.
#[test]
fn a_white_cavity_and_an_open_plane_are_as_bright_as_the_sky() {
    for model in safe().filter(|model| bounces(model)) {
        for level in levels() {
            // The printed coefficients of 2016 have four digits; their sum at ρ = 1 is no
            // polynomial identity, and neither is openness the only thing they answer to.
            if model.name != "jimenez-2016" {
                let white = (model.f64)(level, 1.0);
                // A point that sees nothing at all receives nothing of the published series.
                if level > 0.0 || model.name == "greyfield" {
                    assert!(
                        (white - 1.0).abs() < 1e-12,
                        "{} {level}: {white}",
                        model.name
                    );
                }
            }
            let open = (model.f64)(1.0, level);
            assert!((open - 1.0).abs() < 1e-3, "{} {level}: {open}", model.name);
        }
    }
    for level in levels() {
        assert_eq!((find("greyfield").unwrap().f64)(1.0, level), 1.0);
    }
}

/// The second form of the notes' model is the first wherever the first is sound: below the pole of
/// its direct term.
#[test]
fn the_safe_form_is_the_published_one_where_that_is_sound() {
    let (published, safe) = (&published::PUBLISHED, &published_safe::PUBLISHED_SAFE);
    let mut compared = 0;
    for alpha in levels().filter(|alpha| (1e-9..0.949).contains(alpha)) {
        for rho in levels() {
            let (ours, theirs) = ((safe.f64)(alpha, rho), (published.f64)(alpha, rho));
            assert!(
                (ours - theirs).abs() < 1e-12,
                "{alpha} {rho}: {ours} {theirs}"
            );
            compared += 1;
        }
    }
    assert!(compared > 60_000, "{compared}");
}

/// Where the printed formula breaks, with the numbers of its poles: computed apart from this code
/// from F₀ = 1 and 1 − ρτ = 0.
#[test]
fn the_published_form_has_a_pole_for_every_bright_open_surface() {
    let published = published::PUBLISHED.f64;
    for (alpha, pole) in [(0.97, 0.4946), (0.99, 0.8524), (0.999, 0.9831)] {
        let near: Vec<f64> = (-50..=50)
            .map(|step| published(alpha, pole + 2e-6 * f64::from(step)))
            .collect();
        let (low, high) = near.iter().fold((0.0_f64, 0.0_f64), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
        assert!(low < -20.0 && high > 20.0, "{alpha}: {low} to {high}");
    }
    assert!(published(1.0, 0.5).is_nan(), "0/0 in the open");
    assert!(published(0.0, 1.0).is_nan(), "0/0 in the dark");
    assert!((published::direct(0.98316_f64) - 1.00614).abs() < 1e-5);
    assert!((published::direct(0.949_253_235_f64) - 1.0).abs() < 1e-9);
    let cells: Vec<f64> = levels()
        .flat_map(|alpha| levels().map(move |rho| published(alpha, rho)))
        .collect();
    let broken = cells.iter().filter(|value| value.is_nan()).count();
    let negative = cells.iter().filter(|value| **value < 0.0).count();
    let worst = cells
        .iter()
        .filter(|value| value.is_finite())
        .fold(0.0_f64, |worst, value| worst.max(value.abs()));
    assert_eq!((broken, negative), (257, 2));
    assert!((worst - 3.26).abs() < 0.005, "{worst}");
}

/// Half floats, as the occlusion and albedo targets store them: every openness there is.
#[test]
fn every_half_float_is_whole() {
    let halves = (0..=f16::ONE.to_bits()).map(|bits| f16::from_bits(bits).to_f32());
    for model in safe() {
        for rho in [0.0, 0.18, 0.5, 0.9, 0.99951, 1.0] {
            let mut before = 0.0;
            for alpha in halves.clone() {
                let value = (model.f32)(alpha, rho);
                assert!(
                    (0.0..=1.0).contains(&value),
                    "{} {alpha} {rho}: {value}",
                    model.name
                );
                assert!(
                    value >= before - 2e-6,
                    "{} falls at {alpha} {rho}",
                    model.name
                );
                before = before.max(value);
            }
        }
    }
}

/// From one openness to the other and back.
#[test]
fn either_openness_leads_to_the_other() {
    for alpha in levels() {
        let back = COEFFICIENTS.uniform_of(COEFFICIENTS.cosine_of(alpha));
        assert!((back - alpha).abs() < 1e-4, "{alpha}: {back}");
    }
    let greyfield = find("greyfield").unwrap();
    for level in levels() {
        // Direct light that is known is kept.
        let direct = greyfield.value(Openness::Cosine, level, 0.0);
        assert!((direct - level).abs() < 1e-4, "{level}: {direct}");
    }
    // Nothing blocked stays nothing blocked, bit for bit.
    assert_eq!(COEFFICIENTS.uniform_of(1.0_f32), 1.0);
    assert_eq!(COEFFICIENTS.cosine_of(1.0_f32), 1.0);
}

proptest! {
    #[test]
    fn both_widths_agree(alpha in 0.0_f32..=1.0, rho in 0.0_f32..=1.0) {
        for model in safe() {
            let (single, double) = ((model.f32)(alpha, rho), (model.f64)(alpha.into(), rho.into()));
            prop_assert!((0.0..=1.0).contains(&single));
            // A small 1 − ρ or 1 − α has few digits of its own left.
            prop_assert!((f64::from(single) - double).abs() < 1e-4, "{}: {single} {double}", model.name);
        }
    }

    /// A target may hold a little less than 0 or more than 1, and nothing else comes of it.
    #[test]
    fn what_lies_outside_is_brought_to_the_border(alpha in -2.0_f64..3.0, rho in 0.0_f64..=1.0) {
        for model in safe().filter(|model| bounces(model)) {
            let inside = (model.f64)(alpha.clamp(0.0, 1.0), rho);
            prop_assert_eq!((model.f64)(alpha, rho), inside);
        }
    }

    /// Any coefficients within their bounds make a whole model.
    #[test]
    fn any_fit_is_whole(
        (k0, k1, c1, m1) in (0.3_f64..3.0, 0.0_f64..3.0, 0.0_f64..=1.0, 0.2_f64..8.0),
        (c2, m2, f) in (0.0_f64..=0.9, 0.2_f64..12.0, 1e-3_f64..=0.1),
        (alpha, rho) in (0.0_f64..=1.0, 0.0_f64..=1.0),
        step in 1e-4_f64..0.5,
    ) {
        let model = Coefficients { k0, k1, c1, m1, c2, m2, f };
        let value = model.value(alpha, rho);
        prop_assert!((0.0..=1.0).contains(&value));
        prop_assert!(model.value((alpha + step).min(1.0), rho) >= value - 1e-12);
        prop_assert!(model.value(alpha, (rho + step).min(1.0)) >= value - 1e-12);
        prop_assert!((model.value(alpha, 1.0) - 1.0).abs() < 1e-12);
    }
}
