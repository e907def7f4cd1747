//! Time to read and analyse a trial table of 100,000 rows (aim: under 1 s) and a million (the same).
#![allow(clippy::expect_used)]

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::PathBuf;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use greyfield::analysis::input::{self, Options};
use greyfield::analysis::{Settings, analyse, tails};
use greyfield::report::{self, Format};
use greyfield::seed;

const CONDITIONS: u32 = 7;

/// A trial table of seven conditions with coin-toss answers.
fn table(rows: u32) -> String {
    let mut rng = seed::generator(1, "analysis-bench", 0);
    let mut text =
        "participant,condition,first_technique,second_technique,chosen,rt_ms\n".to_owned();
    for row in 0..rows {
        let (participant, condition) = (row / CONDITIONS, row % CONDITIONS);
        let (first, second) = if (participant / CONDITIONS).is_multiple_of(2) {
            ("none", "blizzard24")
        } else {
            ("blizzard24", "none")
        };
        let chosen = ["first", "second"][seed::below(&mut rng, 2) as usize];
        let time_ms = 300 + seed::below(&mut rng, 4000);
        let _ = writeln!(
            text,
            "P{participant:06},condition-{condition},{first},{second},{chosen},{time_ms}"
        );
    }
    text
}

fn bench(criterion: &mut Criterion) {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let mut group = criterion.benchmark_group("analyse");
    group.sample_size(10);
    for rows in [100_000_u32, 1_000_000] {
        let path: PathBuf = dir.path().join(format!("{rows}.csv"));
        std::fs::write(&path, table(rows)).expect("a writable temporary folder");
        let inputs = [path];
        group.throughput(Throughput::Elements(u64::from(rows)));
        group.bench_function(format!("{rows} rows"), |bencher| {
            bencher.iter(|| {
                let data = input::read(&inputs, Options::default()).expect("a sound table");
                let analysis = analyse(data, Settings::default());
                black_box(report::render(&analysis, Format::Text).expect("a report"))
            });
        });
    }
    group.finish();

    let mut group = criterion.benchmark_group("tails");
    for n in [36_u32, 10_000, 10_000_000] {
        let k = n / 2 - n / 20;
        group.bench_function(format!("two-sided p, n = {n}"), |bencher| {
            bencher.iter(|| tails::two_sided_even(black_box(k), n));
        });
        group.bench_function(format!("Clopper–Pearson, n = {n}"), |bencher| {
            bencher.iter(|| tails::clopper_pearson(black_box(k), n, tails::Alpha::FIVE_PERCENT));
        });
    }
    // Usual arguments, large ones, and some of the slowest that a search over random ones found.
    group.bench_function("binomial tail, n = 10000000 at its mean", |bencher| {
        let x = tails::Binomial::new(10_000_000, 0.65).expect("a probability");
        bencher.iter(|| x.upper_tail(black_box(6_500_000)));
    });
    for (a, b) in [(1.1, 2.2), (261.7, 8.45), (1e7, 1e7)] {
        let x = a / (a + b) * 0.999;
        group.bench_function(format!("beta tail, {a} and {b}"), |bencher| {
            bencher.iter(|| tails::beta_lower(black_box(x), a, b));
        });
    }
    for (a, b) in [(0.008_8, 3.1e6), (12.0, 26.0), (1e7, 1e7)] {
        group.bench_function(format!("beta quantile, {a} and {b}"), |bencher| {
            bencher.iter(|| tails::beta_quantile(black_box(0.975), a, b));
        });
    }
    for df in [6.0, 1e7] {
        group.bench_function(format!("t tail, {df} degrees"), |bencher| {
            bencher.iter(|| tails::student_t_upper(black_box(2.5), df));
        });
        group.bench_function(format!("t critical value, {df} degrees"), |bencher| {
            bencher.iter(|| tails::student_t_critical(tails::Alpha::FIVE_PERCENT, black_box(df)));
        });
        group.bench_function(format!("F tail, {df} and 210 degrees"), |bencher| {
            bencher.iter(|| tails::f_upper(black_box(2.1), df, 210.0));
        });
        group.bench_function(format!("chi-square tail, {df} degrees"), |bencher| {
            bencher.iter(|| tails::chi_square_upper(black_box(1.001 * df), df as u32));
        });
    }
    group.bench_function("normal quantile, 1e-32", |bencher| {
        bencher.iter(|| tails::normal_quantile(black_box(1e-32)));
    });
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
