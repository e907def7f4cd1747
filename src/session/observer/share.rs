//! Chooses one technique of each pair with a given probability, whatever the images look like: an
//! effect of exactly known size, for planning a study before its images exist.

use rand_chacha::ChaCha20Rng;

use super::model::normal;
use super::options::{number, split};
use super::random::{by_chance, seconds_between};
use super::{Behaviour, Kind, Needs, Observer, Question};
use crate::protocol::Position;
use crate::protocol::procedure::{Ask, Step};
use crate::seed;
use crate::session::Answer;

/// `share:SEED[,KEY=VALUE…]`.
pub const SHARE: Kind = Kind {
    name: "share",
    argument: "SEED[,KEY=VALUE…]",
    summary: "chooses the second technique of each pair's base order with a given probability, whatever the images look like; keys: p, bias, participants",
    make: |argument, needs| {
        let share = Share::parse(argument)?;
        asks_for_choices(needs)?;
        Ok(Box::new(share))
    },
};

const KEYS: &str = "p, bias, participants";

/// logit P(b) = logit(p) + own ± bias: + where b is shown first, − where a is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Seed of its answers.
    pub seed: u64,
    /// Share of technique b for a participant whose own preference is 0, without a bias; above 0 and
    /// below 1.
    pub p: f64,
    /// Preference for the image shown first (or on the left), on the logit scale.
    pub bias: f64,
    /// Standard deviation of each participant's own preference for b, on the logit scale: the same
    /// in all their trials.
    pub participants: f64,
}

fn asks_for_choices(needs: &Needs<'_>) -> Result<(), String> {
    let procedure = needs.protocol.procedure;
    match (procedure.steps)(needs.protocol).last() {
        Some(Step::Ask(Ask::Choice | Ask::CloserToReference)) => Ok(()),
        _ => Err(format!(
            "a protocol that asks for a choice between two images, not \"{}\"",
            procedure.name
        )),
    }
}

impl Share {
    /// The message says what is needed, as the end of a sentence.
    fn parse(argument: &str) -> Result<Self, String> {
        let (seed, given) = split(argument, "p=0.65", KEYS)?;
        let mut share = Self {
            seed,
            p: 0.65,
            bias: 0.0,
            participants: 0.0,
        };
        for (key, value) in given {
            match key {
                "p" => share.p = number(key, value, |p| p > 0.0 && p < 1.0, "above 0, below 1")?,
                "bias" => share.bias = number(key, value, |_| true, "of any sign")?,
                "participants" => {
                    share.participants = number(key, value, |x| x >= 0.0, "from 0")?;
                }
                _ => return Err(format!("options that exist: {KEYS}; not {key:?}")),
            }
        }
        Ok(share)
    }

    /// What this participant adds to the preference for b.
    fn own(&self, slot: u32) -> f64 {
        if self.participants == 0.0 {
            return 0.0;
        }
        let mut rng = seed::generator(self.seed, "observer-share-participant", slot.into());
        self.participants * normal(&mut rng)
    }

    /// P(b) in a trial.
    fn chance_of_b(&self, slot: u32, b_is_first: bool) -> f64 {
        let towards_b = if b_is_first { self.bias } else { -self.bias };
        let logit = libm::log(self.p) - libm::log1p(-self.p);
        1.0 / (1.0 + libm::exp(-(logit + self.own(slot) + towards_b)))
    }

    /// An attentive participant passes an attention check; everything else goes by chance.
    fn choice(&self, rng: &mut ChaCha20Rng, question: &Question<'_>) -> Answer {
        let mut shown = question.plan.shown(question.trial);
        if let Some(correct) = &question.trial.correct {
            let is_first = shown.next().is_some_and(|first| first == correct);
            return Answer::Choice(if is_first {
                Position::First
            } else {
                Position::Second
            });
        }
        // The base order's second image is b.
        let b_is_first = question.trial.places.first() == Some(&1);
        let chooses_b = seed::unit_f64(rng) < self.chance_of_b(question.plan.slot, b_is_first);
        Answer::Choice(if chooses_b == b_is_first {
            Position::First
        } else {
            Position::Second
        })
    }
}

impl Observer for Share {
    fn behave(&self, question: &Question<'_>) -> Behaviour {
        let mut rng = seed::generator(self.seed, "observer-share", question.index());
        let answer = match question.ask {
            Ask::Choice | Ask::CloserToReference => self.choice(&mut rng, question),
            Ask::Ratings | Ask::Ranking => by_chance(&mut rng, question),
        };
        Behaviour {
            answer,
            looks_ns: [(); 2].map(|()| seconds_between(&mut rng, 2.0, 8.0)),
            decision_ns: seconds_between(&mut rng, 0.5, 2.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::{Condition, Protocol, SessionPlan};
    use std::path::Path;

    const THESIS: &str = include_str!("../../../protocols/thesis-2010.toml");

    fn protocol() -> Protocol {
        Protocol::parse(Path::new("p.toml"), THESIS).unwrap()
    }

    fn conditions() -> Vec<Condition> {
        let condition = |index| Condition {
            id: format!("c{index}"),
            scene: "atrium".into(),
            techniques: vec!["a".into(), "b".into()],
            reference: None,
            hypothesis: String::new(),
        };
        (0..7).map(condition).collect()
    }

    /// Shares of b over many sessions where b stood first, and where it stood second.
    fn shares(share: Share, slots: u32) -> [f64; 2] {
        let (protocol, conditions) = (protocol(), conditions());
        let mut counts = [[0_u32; 2]; 2];
        for slot in 0..slots {
            let plan = SessionPlan::new(&protocol, &conditions, slot).unwrap();
            for trial in &plan.trials {
                let behaviour = share.behave(&Question::new(&protocol, &plan, trial));
                let Answer::Choice(position) = behaviour.answer else {
                    panic!("no choice");
                };
                let b_place = usize::from(!trial.reversed);
                counts[b_place][usize::from(position.place() == b_place)] += 1;
            }
        }
        counts.map(|[a, b]| f64::from(b) / f64::from(a + b))
    }

    fn assert_near(found: f64, expected: f64, n: f64) {
        let error = (expected * (1.0 - expected) / n).sqrt();
        assert!((found - expected).abs() < 4.0 * error, "{found} {expected}");
    }

    /// Within four standard errors of logit⁻¹(logit(0.65) ± 0.5), each order 7000 trials.
    #[test]
    fn the_share_is_as_asked_and_the_bias_moves_it_by_order() {
        let share = Share::parse("1,p=0.65,bias=0.5").unwrap();
        let [b_first, b_second] = shares(share, 2000);
        assert_near(b_first, 0.753_810, 7000.0);
        assert_near(b_second, 0.529_725, 7000.0);
        let plain = Share::parse("1,p=0.65").unwrap();
        for found in shares(plain, 2000) {
            assert_near(found, 0.65, 7000.0);
        }
    }

    #[test]
    fn participants_differ_by_as_much_as_they_are_to() {
        let share = Share::parse("1,participants=0.8").unwrap();
        let own: Vec<f64> = (0..10_000).map(|slot| share.own(slot)).collect();
        let spread = (own.iter().map(|x| x * x).sum::<f64>() / 1e4).sqrt();
        assert!(
            (spread - 0.8).abs() < 4.0 * 0.8 / 2e4_f64.sqrt(),
            "{spread}"
        );
    }

    #[test]
    fn an_attention_check_is_passed() {
        let (protocol, conditions) = (protocol(), conditions());
        let plan = SessionPlan::new(&protocol, &conditions, 3).unwrap();
        let share = Share::parse("1,p=0.000001").unwrap();
        for trial in &plan.trials {
            let mut check = trial.clone();
            check.correct = Some("b".into());
            let behaviour = share.behave(&Question::new(&protocol, &plan, &check));
            let expected = if trial.reversed {
                Position::First
            } else {
                Position::Second
            };
            assert_eq!(behaviour.answer, Answer::Choice(expected));
        }
    }

    #[test]
    fn bad_options_say_what_is_needed() {
        for (argument, part) in [
            ("", "p=0.65"),
            ("1,p=1", "above 0, below 1 for p"),
            ("1,p=nan", "for p"),
            ("1,bias=inf", "for bias"),
            ("1,participants=-1", "from 0 for participants"),
            ("1,sigma=1", "p, bias, participants"),
            ("1,p=0.6,p=0.7", "once"),
        ] {
            let message = Share::parse(argument).unwrap_err();
            assert!(message.contains(part), "{argument:?}: {message:?}");
        }
    }
}
