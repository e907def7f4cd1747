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
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
