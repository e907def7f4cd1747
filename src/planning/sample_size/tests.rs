use super::*;
use proptest::prelude::*;

fn question(p: f64, conditions: u32, criterion: Criterion) -> Question {
    Question {
        test: Test::Exact,
        p,
        alpha: Alpha::FIVE_PERCENT,
        conditions,
        criterion,
    }
}

#[test]
fn no_effect_has_no_sample_size() {
    for criterion in Criterion::ALL {
        assert_eq!(question(0.5, 7, criterion).sample_size(0.8), None);
        assert_eq!(question(0.5001, 7, criterion).sample_size(0.8), None);
    }
}

#[test]
fn blocks_are_filled_up() {
    let size = SampleSize {
        smallest: 85,
        stable: 90,
    };
    assert_eq!(size.in_blocks(14), 98);
    assert_eq!(size.in_blocks(1), 90);
    assert_eq!(size.in_blocks(0), 90);
    assert_eq!(size.in_blocks(90), 90);
}

/// An effect that takes eighty thousand participants is found in the same way.
#[test]
fn small_effects_are_found_too() {
    let question = question(0.505, 1, Criterion::Uncorrected);
    let size = question.sample_size(0.8).unwrap();
    // The normal approximation, ((1.96 + 0.8416 √(1 − 4 δ²)) / 2δ)² with δ = 0.005; one vote more or
    // less is worth 1/δ participants.
    let approximate = ((1.959_964 + 0.841_579) / 0.01_f64).powi(2);
    assert!(
        (f64::from(size.stable) - approximate).abs() < 2.0 / 0.005,
        "{size:?}"
    );
    assert!(question.power(size.stable) >= 0.8 && question.power(size.stable - 1) < 0.8);
    assert!(question.power(size.smallest) >= 0.8 && size.smallest < size.stable);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Against the power of every n up to twice the number found, one by one.
    #[test]
    fn is_what_counting_up_gives(
        p in prop_oneof![0.58..0.95_f64, 0.05..0.42_f64],
        target in 0.3..0.95_f64,
        conditions in 1_u32..5,
        which in 0_usize..5,
        exact in any::<bool>(),
    ) {
        let question = Question {
            test: if exact { Test::Exact } else { Test::ChiSquare },
            ..question(p, conditions, Criterion::ALL[which])
        };
        let size = question.sample_size(target).unwrap();
        let powers: Vec<f64> = (0..=2 * size.stable).map(|n| question.power(n)).collect();
        let first = powers.iter().position(|&power| power >= target).unwrap();
        let last_short = powers.iter().rposition(|&power| power < target).unwrap();
        prop_assert_eq!(size.smallest as usize, first);
        prop_assert_eq!(size.stable as usize, last_short + 1);
    }

    /// The stretch's bounds hold for every n in it.
    #[test]
    fn bounds_hold_over_a_stretch(a in 1_u32..300, length in 0_u32..60, p in 0.5..0.99_f64, which in 0_usize..5) {
        let question = question(p, 4, Criterion::ALL[which]);
        let (least, most) = (question.least(a, a + length), question.most(a, a + length));
        for n in a..=a + length {
            let power = question.power(n);
            prop_assert!(least <= power + 1e-12 && power <= most + 1e-12, "{n}: {least} {power} {most}");
        }
    }
}
