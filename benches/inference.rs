//! The claims of `tests/inference.rs` with twenty times the studies and more kinds of studies: one row a claim.
//! Exits with 1 where a claim is refuted.

#[path = "../tests/inference/mod.rs"]
mod simulated;

use std::process::ExitCode;

use simulated::claim::{Claim, Measured, Verdict};
use simulated::{Effort, effects, evidence, families, participants, scales, shares};

const EFFORT: Effort = Effort {
    times: 20,
    wide: true,
};

const TOPICS: [fn(Effort) -> Vec<Claim>; 16] = [
    shares::intervals,
    shares::sizes,
    scales::wald,
    scales::order_effect,
    participants::intervals,
    effects::geometric_mean,
    effects::times_by_position,
    effects::odds_ratio,
    effects::cochran,
    families::verdicts,
    families::verdicts_beside_true_ones,
    families::mcnemar_pairs,
    families::false_discoveries,
    evidence::looks,
    evidence::family,
    evidence::confidence_sequence,
];

fn main() -> ExitCode {
    // `cargo test --benches` starts this, too, without `--bench`.
    if !std::env::args().any(|argument| argument == "--bench") {
        println!("inference: run it by cargo bench --bench inference");
        return ExitCode::SUCCESS;
    }
    println!("| claim | claimed, % | measured, % | possible, % | seed | studies | verdict |");
    println!("|---|---|---|---|---|---|---|");
    let mut refuted = 0;
    for topic in TOPICS {
        for claim in topic(EFFORT) {
            println!("{}", row(&claim));
            refuted += u32::from(claim.verdict() == Verdict::Refuted);
        }
    }
    let wrong = effects::ninety_percent_interval(EFFORT);
    println!("{} (as it must)", row(&wrong));
    if wrong.verdict() != Verdict::Refuted {
        println!("\nAn interval of 90 % was not found out.");
        return ExitCode::FAILURE;
    }
    if refuted > 0 {
        println!("\n{refuted} claims are refuted.");
        return ExitCode::FAILURE;
    }
    println!("\nNo claim is refuted but that of the last row, which is wrong on purpose.");
    ExitCode::SUCCESS
}

fn row(claim: &Claim) -> String {
    let percent = |x: f64| format!("{:.2}", 100.0 * x);
    let range = |low: f64, high: f64| format!("{} to {}", percent(low), percent(high));
    let claimed = match &claim.range {
        None => "–".to_owned(),
        Some(it) => range(*it.start(), *it.end()),
    };
    let (possible, seed, studies) = match claim.measured {
        Measured::Exact(_) => ("exact".to_owned(), "–".to_owned(), "all cases".to_owned()),
        Measured::Counted { seed, studies, .. } => {
            let (low, high) = claim.measured.bounds();
            (range(low, high), seed.to_string(), studies.to_string())
        }
    };
    let verdict = match claim.verdict() {
        Verdict::Holds => "holds",
        Verdict::NotRefuted => "not refuted",
        Verdict::Refuted => "REFUTED",
        Verdict::Told => "–",
    };
    format!(
        "| {} | {claimed} | {} | {possible} | {seed} | {studies} | {verdict} |",
        claim.what,
        percent(claim.measured.estimate()),
    )
}
