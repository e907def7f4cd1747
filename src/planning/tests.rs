//! Against R: `tests/data/power.R` enumerates every outcome.

use super::family::Holm;
use super::orders::Orders;
use super::sample_size::{Criterion, Question};
use super::*;
use crate::analysis::Alpha;

const TABLE: &str = include_str!("../../tests/data/power.csv");

struct Row<'a> {
    quantity: &'a str,
    test: Test,
    n: u32,
    p: f64,
    alpha: Alpha,
    extra: f64,
    value: f64,
}

fn rows() -> Vec<Row<'static>> {
    let row = |line: &'static str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells[i].parse::<f64>().unwrap();
        Row {
            quantity: cells[0],
            test: match cells[1] {
                "exact_binomial" => Test::Exact,
                "chi_square" => Test::ChiSquare,
                other => panic!("{other}"),
            },
            n: cells[2].parse().unwrap(),
            p: number(3),
            alpha: Alpha::try_from(number(4)).unwrap(),
            extra: number(5),
            value: number(6),
        }
    };
    TABLE.lines().skip(1).map(row).collect()
}

impl Row<'_> {
    fn question(&self, conditions: u32, criterion: Criterion) -> Question {
        Question {
            test: self.test,
            p: self.p,
            alpha: self.alpha,
            conditions,
            criterion,
        }
    }

    fn holm(&self) -> Holm {
        let question = self.question(3, Criterion::HolmEach);
        let level = |step| self.test.power(self.n, self.p, question.level(step));
        Holm::new(&(1..=3).map(|step| level(step).value()).collect::<Vec<_>>())
    }

    fn orders(&self, participant_sd: f64) -> f64 {
        let orders = Orders {
            p: self.p,
            bias: self.extra,
            participant_sd,
            a_then_b: 21,
            b_then_a: 15,
        };
        orders.power(self.test, self.alpha).value()
    }

    fn ours(&self) -> f64 {
        let size = || {
            let question = self.question(1, Criterion::Uncorrected);
            question.sample_size(self.extra).unwrap()
        };
        match self.quantity {
            "power" => self.test.power(self.n, self.p, self.alpha).value(),
            "n_first" => f64::from(size().smallest),
            "n_from" => f64::from(size().stable),
            "holm_each" => self.holm().each(),
            "holm_any" => self.holm().any(),
            "holm_all" => self.holm().all(),
            "orders_21_15" => self.orders(0.0),
            "orders_21_15_sd_0.8" => self.orders(0.8),
            other => panic!("{other}"),
        }
    }
}

#[test]
fn every_number_is_the_one_of_r() {
    let rows = rows();
    assert!(rows.len() > 400);
    for row in rows {
        let (ours, theirs) = (row.ours(), row.value);
        // R's dbinom is good to about 1e-13.
        assert!(
            (ours - theirs).abs() <= 1e-12 + 1e-11 * theirs,
            "{} {:?} n {} p {} alpha {} extra {}: {ours} {theirs}",
            row.quantity,
            row.test,
            row.n,
            row.p,
            row.alpha.get(),
            row.extra
        );
    }
}
