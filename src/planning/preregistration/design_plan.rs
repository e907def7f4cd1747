//! How the study is made: design, orders, trials, and what is shown and asked.

use super::{Asked, Study, heading_row, item, line, listed, quoted, row};
use crate::protocol::config::GreyArea;
use crate::protocol::design::InnerOrder;
use crate::protocol::procedure::{Ask, Step, TrialStart, Until};
use crate::protocol::{Phase, Words};

impl Study<'_> {
    pub(super) fn design(&self, out: &mut String) {
        line(out, "## Design plan");
        line(out, "### Study type");
        line(
            out,
            "Experiment: the technique of each image is manipulated, everything else about it is kept.",
        );
        line(out, "### Blinding");
        line(
            out,
            "Participants are not told which techniques there are, what they do, or which image is whose. Orders come from the software by the participant's number, so the experimenter does not choose them.",
        );
        line(out, "### Study design");
        let each = match self.asked {
            Asked::Choice => "two images each",
            Asked::Ratings => "one image each",
            Asked::Ranking => "all versions of a scene each",
        };
        line(
            out,
            &format!(
                "Within-subject: every participant gets every condition once ({} conditions, {each}). Procedure `{}`: {}. After {}.",
                self.main.len(),
                self.protocol.procedure.name,
                self.protocol.procedure.summary,
                self.protocol.procedure.source,
            ),
        );
        self.trial(out);
        self.other_trials(out);
        line(out, "### Randomization");
        self.orders(out);
    }

    /// A trial step by step.
    fn trial(&self, out: &mut String) {
        line(out, "A trial:");
        let keys = self.protocol.keys;
        item(
            out,
            match self.protocol.trial_start() {
                TrialStart::Menu => {
                    "begins when the participant presses its button on a page with one button a trial, of which only the next one is enabled;"
                }
                TrialStart::Button => "begins when the participant presses a button;",
                TrialStart::Itself => "begins by itself, right after the answer to the one before;",
            },
        );
        for step in (self.protocol.procedure.steps)(self.protocol) {
            let text = match step {
                Step::Image { until, place } => {
                    let which = match (self.asked, place) {
                        (Asked::Choice, 0) => "the first image",
                        (Asked::Choice, _) => "the second image",
                        _ => "the image",
                    };
                    match until {
                        Until::Continue => format!(
                            "{which}, as long as the participant likes, ended with the key {};",
                            keys.go_on
                        ),
                        Until::Elapsed { duration_ns } => format!(
                            "{which}, for {} ms from its first frame on the display;",
                            duration_ns / 1_000_000
                        ),
                    }
                }
                Step::Grey { duration_ns } => format!(
                    "grey, sRGB level {}, on {}, for at least {} ms; it cannot be skipped;",
                    self.protocol.grey.level_srgb.get(),
                    match self.protocol.grey.area {
                        GreyArea::Image => "the area of the images",
                        GreyArea::Screen => "the whole screen",
                    },
                    duration_ns / 1_000_000,
                ),
                Step::Ask(ask) => asks(ask).to_owned(),
            };
            item(out, &text);
        }
        line(
            out,
            "\nThere is no going back, and no feedback. Images are shown at one image pixel per screen pixel, without any filtering.",
        );
    }

    /// Practice, attention checks, rests.
    fn other_trials(&self, out: &mut String) {
        let count = |phase| {
            self.plan
                .trials
                .iter()
                .filter(|it| it.phase == phase)
                .count()
        };
        let mut said = Vec::new();
        if let Some(practice) = &self.protocol.practice {
            let ids: Vec<&str> = practice.conditions.iter().map(String::as_str).collect();
            said.push(format!(
                "Before them {} for practice ({}), which {} not analysed.",
                trials(count(Phase::Practice)),
                listed(&ids),
                if ids.len() == 1 { "is" } else { "are" }
            ));
        }
        if let Some(catch) = &self.protocol.catch {
            let checks: Vec<String> = (catch.trials.iter())
                .map(|it| format!("{} (correct: {})", it.condition, it.correct))
                .collect();
            let checks: Vec<&str> = checks.iter().map(String::as_str).collect();
            said.push(format!(
                "Spread over them {} that check attention: {}. An attentive participant has at least {} right.",
                trials(count(Phase::Catch)),
                listed(&checks),
                catch.minimum_correct.get()
            ));
        }
        if let Some(breaks) = self.protocol.breaks {
            said.push(format!(
                "A rest is offered after every {} main trials.",
                breaks.every.get()
            ));
        }
        if !said.is_empty() {
            line(out, &said.join(" "));
        }
    }

    fn orders(&self, out: &mut String) {
        let protocol = self.protocol;
        let mut text = format!(
            "Design `{}`: {}. ",
            protocol.design.name, protocol.design.summary
        );
        if self.asked == Asked::Choice {
            text += match protocol.inner_order {
                InnerOrder::Block => {
                    "Which image of a pair comes first: all pairs of a participant in the base order, or all reversed, by halves of a block. "
                }
                InnerOrder::Within => {
                    "Which image of a pair comes first: half of each participant's pairs are reversed, the other half for the participant with the mirrored session. "
                }
            };
        }
        text += &match self.block() {
            Some(block) => format!(
                "A full block is {block} participants; over it, everything the design balances is even. "
            ),
            None => "The design has no blocks: orders are even on average only. ".to_owned(),
        };
        text += &format!(
            "The orders are a function of the protocol, the seed {} and the participant's number, drawn by the generator `{}`, and can be printed beforehand with `greyfield order`. Participants take the numbers as they come; the number of one who leaves is taken by the next.",
            protocol.seed,
            crate::seed::GENERATOR
        );
        line(out, &text);
    }

    pub(super) fn variables(&self, out: &mut String) {
        line(out, "## Variables");
        line(out, "### Manipulated variables");
        self.stimuli(out);
        line(out, "### Measured variables");
        line(out, "Asked, word for word:");
        let words = self.protocol.words(self.protocol.language);
        line(out, &quoted(&words.question));
        let answers = self.answers(&words);
        line(out, &answers);
        let others: Vec<&str> = (self.protocol.languages().skip(1))
            .map(|it| it.name())
            .collect();
        if !others.is_empty() {
            line(
                out,
                &format!(
                    "The session can be held in {} as well; the data say in which language it was.",
                    listed(&others)
                ),
            );
        }
        line(
            out,
            "The time from the question's first frame to the answer is recorded, and the onset of every image with how it was obtained.",
        );
        self.told(out);
        line(out, "The instructions, word for word:");
        line(out, &quoted(&words.instructions));
        if let Some(consent) = &words.consent {
            line(out, "What participants agree to before that:");
            line(out, &quoted(consent));
        }
    }

    fn stimuli(&self, out: &mut String) {
        let size = self.facts.set.size_px;
        let size = size.map_or(String::new(), |(width, height)| {
            format!(", {width}×{height} pixels each")
        });
        line(
            out,
            &format!(
                "The technique that made the image. Stimulus set `{}` (\"{}\"){size}; the images of a condition are of one scene, camera and light. \"a\" is the first of the base order.",
                self.facts.set.id, self.facts.set.title
            ),
        );
        match self.asked {
            Asked::Choice => {
                let reference = self.protocol.reference.as_ref();
                heading_row(
                    out,
                    &["condition", "scene", "technique a", "technique b", "asks"],
                );
                for it in &self.main {
                    let technique = |i: usize| it.techniques.get(i).cloned().unwrap_or_default();
                    row(
                        out,
                        &[
                            it.id.clone(),
                            it.scene.clone(),
                            technique(0),
                            technique(1),
                            or_dash(&it.hypothesis),
                        ],
                    );
                }
                out.push('\n');
                if let Some(reference) = reference {
                    line(
                        out,
                        &format!(
                            "Both are compared with the image that the technique \"{}\" made of the same scene and light, which stands between them.",
                            &*reference.technique
                        ),
                    );
                }
            }
            Asked::Ratings | Asked::Ranking => {
                heading_row(out, &["condition", "scene", "techniques"]);
                for it in &self.main {
                    row(
                        out,
                        &[it.id.clone(), it.scene.clone(), it.techniques.join(", ")],
                    );
                }
                out.push('\n');
            }
        }
    }

    fn answers(&self, words: &Words) -> String {
        let keys = self.protocol.keys;
        let beside = (self.protocol.procedure.steps)(self.protocol).last()
            == Some(&Step::Ask(Ask::CloserToReference));
        match self.asked {
            Asked::Choice => {
                let (one, other) = match beside {
                    true => (&words.answer_left, &words.answer_right),
                    false => (&words.answer_first, &words.answer_second),
                };
                let neither = match self.protocol.cannot_tell {
                    true => format!(", or \"{}\" (key {})", words.cannot_tell, keys.cannot_tell),
                    false => "; there is no third answer".to_owned(),
                };
                format!("Answers: \"{one}\" (key {}) or \"{other}\" (key {}){neither}.", keys.answer_first, keys.answer_second)
            }
            Asked::Ratings => {
                let scale = |scale: &crate::protocol::options::Scale| {
                    let points = scale.points.get();
                    match words.scales.get(&*scale.id) {
                        Some(said) => format!("*{}* from 1, \"{}\", to {points}, \"{}\"", &*said.question, &*said.low, &*said.high),
                        None => format!("*{}* from 1 to {points}", &*scale.id),
                    }
                };
                let scales: Vec<String> = self.protocol.scales.iter().map(scale).collect();
                let scales: Vec<&str> = scales.iter().map(String::as_str).collect();
                format!("Scales: {}.", listed(&scales))
            }
            Asked::Ranking => "Answer: the order of all the images on the screen, the best one first, without ties.".to_owned(),
        }
    }

    /// Questions about the participant.
    fn told(&self, out: &mut String) {
        if self.protocol.metadata.is_empty() {
            line(out, "Nothing is asked about the participants themselves.");
            return;
        }
        let words = self.protocol.words(self.protocol.language);
        line(
            out,
            "About themselves participants may tell, each of it optional and used to describe the sample only:",
        );
        for field in &self.protocol.metadata {
            let said = words.metadata.get(&*field.id);
            let label = said.map_or(&*field.id, |it| &*it.label);
            let shown: Vec<&str> = match said {
                Some(it) if !it.choices.is_empty() => {
                    it.choices.iter().map(|text| &**text).collect()
                }
                _ => field.choices.iter().map(|text| &**text).collect(),
            };
            let choices = match shown.is_empty() {
                true => "in their own words".to_owned(),
                false => shown.join(" / "),
            };
            item(out, &format!("*{label}* ({choices})"));
        }
        out.push('\n');
    }
}

fn asks(ask: Ask) -> &'static str {
    match ask {
        Ask::Choice => {
            "the question, on a page without images, for as long as the participant likes."
        }
        Ask::CloserToReference => {
            "both images, one on either side of the reference, with the question, for as long as the participant likes."
        }
        Ask::Ratings => {
            "the scales, on a page without images, for as long as the participant likes."
        }
        Ask::Ranking => {
            "all versions of the scene at once, to be put in order, for as long as the participant likes."
        }
    }
}

fn trials(count: usize) -> String {
    match count {
        1 => "comes 1 trial".to_owned(),
        _ => format!("come {count} trials"),
    }
}

fn or_dash(text: &str) -> String {
    match text.is_empty() {
        true => "–".to_owned(),
        false => text.to_owned(),
    }
}
