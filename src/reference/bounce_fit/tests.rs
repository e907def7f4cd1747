//! Fits of data whose answer is known.

use super::least_squares::least_squares;
use super::*;
use crate::multi_bounce::{COEFFICIENTS, Coefficients};

/// Curves that a model makes, bounce by bounce, by solving for the factors of a family is not
/// needed: the geometric rest has a closed form for each.
fn made_by(model: &Coefficients, name: &str) -> Measured {
    let bin = |step: i32| {
        let openness = f64::from(step) / 50.0;
        let direct = model.value(openness, 0.0);
        // Slope and curvature in ρ at 0 are F₁ and 2 F₂; the rest falls off by τ₂ = 1 − g₂.
        let rest = 1.0 - direct;
        let first = model.c1 * (1.0 - (1.0 - openness).powf(model.m1));
        let later = model.f + model.c2 * (1.0 - (1.0 - openness).powf(model.m2));
        let mut factors = vec![direct, rest * first];
        let mut left = rest * (1.0 - first);
        for _ in 0..4000 {
            factors.push(left * later);
            left *= 1.0 - later;
        }
        MeasuredBin {
            openness,
            texels: 100,
            factors,
        }
    };
    Measured {
        name: name.into(),
        bins: (1..50).map(bin).collect(),
    }
}

/// A straight line through three points, by hand: slope 1.5 and intercept 1/6; residuals −1/6, 1/3,
/// −1/6 leave s² = 1/6, and t at one degree of freedom is 12.706.
#[test]
fn a_line_has_the_textbook_intervals() {
    let (x, y) = ([0.0, 1.0, 2.0], [0.0, 2.0, 3.0]);
    let unknowns = [
        Unknown {
            name: "slope",
            start: 1.0,
            low: -100.0,
            high: 100.0,
        },
        Unknown {
            name: "intercept",
            start: 0.0,
            low: -100.0,
            high: 100.0,
        },
    ];
    let fitted = least_squares(&unknowns, |u| {
        x.iter().zip(y).map(|(x, y)| u[0] * x + u[1] - y).collect()
    })
    .unwrap();
    assert!((fitted.values[0] - 1.5).abs() < 1e-6 && (fitted.values[1] - 1.0 / 6.0).abs() < 1e-6);
    let expected = [(1.0_f64 / 12.0).sqrt(), (5.0_f64 / 36.0).sqrt()];
    for (found, expected) in fitted.half_widths.iter().zip(expected) {
        let expected = 12.7062 * expected;
        assert!(
            (found.unwrap() / expected - 1.0).abs() < 1e-3,
            "{found:?} {expected}"
        );
    }
    assert!((fitted.rmse - (1.0_f64 / 18.0).sqrt()).abs() < 1e-6);
}

#[test]
fn too_few_measurements_are_refused() {
    let unknowns = [Unknown {
        name: "a",
        start: 1.0,
        low: 0.0,
        high: 2.0,
    }];
    let error = least_squares(&unknowns, |u| vec![u[0]]).unwrap_err();
    assert_eq!(
        error,
        FitError::TooFew {
            residuals: 1,
            unknowns: 1
        }
    );
}

/// What lies on its bound has no interval, and what is beside it has.
#[test]
fn a_bound_is_kept_and_said() {
    let unknowns = [
        Unknown {
            name: "held",
            start: 0.5,
            low: 0.0,
            high: 1.0,
        },
        Unknown {
            name: "free",
            start: 0.5,
            low: -10.0,
            high: 10.0,
        },
    ];
    let targets = [(3.0, 0.2), (3.1, -0.2), (2.9, 0.1)];
    let fitted = least_squares(&unknowns, |u| {
        targets
            .iter()
            .flat_map(|(a, b)| [u[0] - a, u[1] - b])
            .collect()
    })
    .unwrap();
    assert!(fitted.values[0] > 0.999 && fitted.values[0] <= 1.0);
    assert_eq!(fitted.half_widths[0], None);
    assert!(fitted.half_widths[1].is_some());
}

/// The fit finds the coefficients that made the data.
#[test]
fn our_form_finds_itself() {
    let truth = Coefficients {
        k0: 1.1,
        k1: 0.6,
        c1: 0.92,
        m1: 1.4,
        c2: 0.7,
        m2: 2.1,
        f: 0.003,
    };
    let maps = [made_by(&truth, "a"), made_by(&truth, "b")];
    let (found, fit) = fit_greyfield(&maps).unwrap();
    assert!(fit.fitted.rmse < 1e-6, "{fit:?}");
    for (found, truth) in [
        (found.k0, truth.k0),
        (found.k1, truth.k1),
        (found.c1, truth.c1),
        (found.m1, truth.m1),
        (found.c2, truth.c2),
        (found.m2, truth.m2),
    ] {
        assert!((found / truth - 1.0).abs() < 1e-3, "{found} {truth}");
    }
}

/// The published forms' numbers come back out of data that they made, too.
#[test]
fn the_published_forms_find_themselves() {
    let bins = (1..100).map(|step| {
        let a = f64::from(step) / 100.0;
        let direct = a * (1.0 + (1.0 - a).powf(0.75) / 2.0);
        let first = 27.576_937 * a * (1.0 - a).powf(1.5) * (-3.336_439_2 * a.powf(0.25)).exp();
        MeasuredBin {
            openness: a,
            texels: 100,
            factors: vec![direct, first],
        }
    });
    let maps = [Measured {
        name: "made".into(),
        bins: bins.collect(),
    }];
    for fit in fit_forms(&maps).unwrap() {
        for (found, published) in fit.fitted.values.iter().zip(&fit.published) {
            assert!((found / published - 1.0).abs() < 1e-4, "{fit:?}");
        }
    }
}

#[test]
fn errors_are_those_of_the_model() {
    let map = made_by(&COEFFICIENTS, "made");
    let exact = |alpha: f64, _: f64, rho: f64| COEFFICIENTS.value(alpha, rho);
    let candidate = Candidate {
        name: "exact".into(),
        value: &exact,
    };
    for error in validate(&candidate, &map, true) {
        // At ρ = 1 the data lack what comes after 4002 bounces.
        let allowed = if error.albedo == Some(1.0) {
            1e-2
        } else {
            1e-9
        };
        assert!(error.rmse < allowed && error.held_out, "{error:?}");
    }
    let off = |alpha: f64, _: f64, rho: f64| {
        if rho == 0.5 {
            f64::NAN
        } else {
            COEFFICIENTS.value(alpha, rho) + 0.25
        }
    };
    let errors = validate(
        &Candidate {
            name: "off".into(),
            value: &off,
        },
        &map,
        false,
    );
    assert_eq!(errors.len(), 12);
    let all = errors.last().unwrap();
    assert_eq!((all.albedo, all.not_finite), (None, map.bins.len()));
    assert!((all.rmse - 0.25).abs() < 1e-9 && (all.rmse_by_texel - 0.25).abs() < 1e-9);
}
