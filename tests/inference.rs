//! The errors that the statistics claim to make, on simulated studies and by summing all cases. Seeds
//! and numbers of studies stand in the modules; a longer run is `cargo bench --bench inference`.

#[path = "inference/mod.rs"]
mod simulated;

use simulated::claim::{Claim, Measured, Verdict};
use simulated::{Effort, effects, evidence, families, participants, scales, shares};

const EFFORT: Effort = Effort {
    times: 1,
    wide: false,
};

#[track_caller]
fn hold(claims: &[Claim]) {
    for claim in claims {
        let source = match claim.measured {
            Measured::Exact(_) => "all cases summed".to_owned(),
            Measured::Counted { seed, studies, .. } => format!("{studies} studies, seed {seed}"),
        };
        let value = claim.measured.estimate();
        println!("{value:.4}  {} ({source})", claim.what);
    }
    let refuted: Vec<_> = (claims.iter())
        .filter(|claim| claim.verdict() == Verdict::Refuted)
        .collect();
    assert!(refuted.is_empty(), "{refuted:#?}");
}

fn value(claims: &[Claim], what: &str) -> f64 {
    let mut found = claims.iter().filter(|claim| claim.what.contains(what));
    let value = found.next().map(|claim| claim.measured.estimate());
    assert!(found.next().is_none(), "{what}: more than one");
    value.unwrap_or_else(|| panic!("no {what}"))
}

#[test]
fn intervals_of_a_share_cover_what_they_say() {
    hold(&shares::intervals(EFFORT));
}

/// By whole numbers: chi-square rejects 24 : 12 and beyond (3.84 = 1.96² is passed between 23 : 13 and there),
/// the exact test 25 : 11 and beyond.
#[test]
fn the_chi_square_test_of_36_rejects_more_than_it_says() {
    let tail = |last: u64| {
        let (mut term, mut sum) = (1_u64, 1);
        for k in 1..=last {
            term = term * (37 - k) / k;
            sum += term;
        }
        2.0 * sum as f64 / 2_f64.powi(36)
    };
    let claims = shares::sizes(EFFORT);
    hold(&claims);
    for (what, last) in [
        ("chi-square test of an even split, n = 36", 12),
        ("exact test of an even split, n = 36", 11),
    ] {
        assert!((value(&claims, what) - tail(last)).abs() < 1e-14, "{what}");
    }
    assert!((tail(12) - 0.065).abs() < 5e-4 && (tail(11) - 0.029).abs() < 5e-4);
}

#[test]
fn intervals_of_scales_cover_what_they_say() {
    hold(&scales::wald(EFFORT));
    hold(&scales::order_effect(EFFORT));
}

#[test]
fn where_participants_differ_resampling_them_covers_and_wald_does_not() {
    hold(&participants::intervals(EFFORT));
}

#[test]
fn intervals_of_times_and_odds_ratios_cover_what_they_say() {
    hold(&effects::geometric_mean(EFFORT));
    hold(&effects::times_by_position(EFFORT));
    hold(&effects::odds_ratio(EFFORT));
    hold(&effects::cochran(EFFORT));
}

#[test]
fn families_keep_their_error_rate() {
    let verdicts = families::verdicts(EFFORT);
    hold(&verdicts);
    let (low, high) = verdicts[0].measured.bounds();
    let summed = value(&verdicts, "all cases summed");
    assert!((low..=high).contains(&summed), "{summed} {verdicts:#?}");
    hold(&families::verdicts_beside_true_ones(EFFORT));
    hold(&families::mcnemar_pairs(EFFORT));
    hold(&families::false_discoveries(EFFORT));
}

#[test]
fn optional_stopping_deceives_the_exact_test_and_not_the_anytime_valid_one() {
    let looks = evidence::looks(EFFORT);
    hold(&looks);
    for [counted, summed] in [[0, 1], [2, 3]] {
        let (low, high) = looks[counted].measured.bounds();
        let summed = looks[summed].measured.estimate();
        assert!((low..=high).contains(&summed), "{looks:#?}");
    }
    hold(&evidence::family(EFFORT));
    hold(&evidence::confidence_sequence(EFFORT));
}

/// A count of this size refutes an interval that is wrong.
#[test]
fn an_interval_of_90_percent_is_found_out() {
    let claim = effects::ninety_percent_interval(EFFORT);
    assert_eq!(claim.verdict(), Verdict::Refuted, "{claim:?}");
}
