//! What the study asked, and who answered.

use std::fmt::Write as _;

use super::elements::paragraph;
use crate::analysis::Analysis;
use crate::analysis::dataset::StudyFacts;
use crate::report::markup::{self, Column};
use crate::report::svg::escape;

/// Title of the page.
pub fn title(analysis: &Analysis) -> String {
    match &analysis.data.study {
        Some(study) => format!("Greyfield: {}", study.id),
        None => "Greyfield: analysis of choices".to_owned(),
    }
}

/// The question as the heading.
pub fn head(page: &mut String, analysis: &Analysis) {
    let study = analysis.data.study.as_ref();
    let kicker = study.map_or("Greyfield analysis".to_owned(), |study| {
        format!("Greyfield analysis of {}", study.id)
    });
    let question = study
        .map(|study| study.question.as_str())
        .filter(|question| !question.is_empty())
        .unwrap_or("Which image looked more realistic?");
    let _ = writeln!(
        page,
        "<header>\n<p class=\"kicker\">{}</p>\n<h1>{}</h1>\n</header>",
        escape(&kicker),
        escape(question)
    );
}

/// Procedure, design and hypotheses, as far as they are known.
pub fn asked(page: &mut String, analysis: &Analysis) {
    let hypotheses = hypotheses(analysis);
    let study = analysis.data.study.as_ref();
    if study.is_none() && hypotheses.is_empty() {
        return;
    }
    page.push_str("<section>\n<h2>What was asked</h2>\n");
    if let Some(study) = study {
        paragraph(page, &procedure(study));
    }
    if !hypotheses.is_empty() {
        let caption = "Hypotheses and the conditions that ask them";
        let columns = ["hypothesis", "in words", "conditions"].map(Column::Words);
        let in_words = hypotheses.iter().any(|row| !row[1].is_empty());
        match in_words {
            true => markup::table(page, "wraps", caption, &columns, &hypotheses),
            false => {
                let columns = [columns[0], columns[2]];
                let rows = hypotheses.into_iter().map(|row| vec![row[0].clone(), row[2].clone()]);
                markup::table(page, "wraps", caption, &columns, &rows.collect::<Vec<_>>());
            }
        }
    }
    page.push_str("</section>\n");
}

fn procedure(study: &StudyFacts) -> String {
    format!(
        "Participants were asked: “{}” Procedure {}, counterbalancing {}, seed {}; {} participants were planned.",
        study.question,
        study.procedure,
        study.design,
        study.seed,
        study.planned_participants,
    )
}

/// Each hypothesis, its words where the protocol has them, and its conditions.
fn hypotheses(analysis: &Analysis) -> Vec<Vec<String>> {
    let declared = analysis.data.study.iter().flat_map(|s| &s.hypotheses);
    let mut rows: Vec<(String, String)> = declared.cloned().collect();
    for condition in &analysis.data.conditions {
        for name in condition.hypothesis.iter().filter(|name| !name.is_empty()) {
            if !rows.iter().any(|(known, _)| known == name) {
                rows.push((name.clone(), String::new()));
            }
        }
    }
    rows.sort();
    let asked_by = |name: &str| {
        let of: Vec<&str> = (analysis.data.conditions.iter())
            .filter(|condition| condition.hypothesis.as_deref() == Some(name))
            .map(|condition| condition.id.as_str())
            .collect();
        of.join(", ")
    };
    rows.into_iter()
        .map(|(name, words)| {
            let conditions = asked_by(&name);
            vec![name, words, conditions]
        })
        .collect()
}

/// Participants, what they told of themselves, and what was left out by rule.
pub fn who(page: &mut String, analysis: &Analysis) {
    let data = &analysis.data;
    page.push_str("<section>\n<h2>Who took part</h2>\n");
    paragraph(page, &headcount(analysis));
    let told = data.study.iter().flat_map(|study| &study.participants_told);
    let told: Vec<Vec<String>> = told
        .map(|(question, answers)| {
            let answers: Vec<String> = (answers.iter())
                .map(|(answer, count)| format!("{answer}: {count}"))
                .collect();
            vec![question.clone(), answers.join(", ")]
        })
        .collect();
    if !told.is_empty() {
        let columns = [Column::Words("question"), Column::Words("answers")];
        let caption = "What participants chose to tell of themselves";
        markup::table(page, "wraps", caption, &columns, &told);
    }
    if !data.exclusions.is_empty() {
        let columns = [
            Column::Words("rule"),
            Column::Words("participants"),
            Column::Numbers("trials left out"),
        ];
        let rows: Vec<Vec<String>> = (data.exclusions.iter())
            .map(|one| {
                let participants = match one.participants.len() {
                    0 => "none".to_owned(),
                    1..=12 => one.participants.join(", "),
                    many => format!("{many} participants"),
                };
                vec![one.rule.clone(), participants, one.trials.to_string()]
            })
            .collect();
        let caption = "Left out by rules that were laid down before";
        markup::table(page, "wraps", caption, &columns, &rows);
    }
    page.push_str("</section>\n");
}

fn headcount(analysis: &Analysis) -> String {
    let data = &analysis.data;
    if data.participants.is_empty() {
        return "The input is a table of counts: it does not say who answered, in which order, or how many people there were in all.".to_owned();
    }
    let missing: u32 = (data.conditions.iter())
        .filter_map(|condition| condition.orders)
        .map(|orders| orders.missing)
        .sum();
    let planned = match &data.study {
        Some(study) if study.planned_participants > 0 => {
            format!(" of {} planned", study.planned_participants)
        }
        _ => String::new(),
    };
    let answers =
        data.answers.len() + data.ratings.answers.len() + data.rankings.answers.len();
    format!(
        "{}{planned}, {answers} answers, {missing} trials without one.",
        crate::analysis::conclusion::plural(data.participants.len(), "participant"),
    )
}
