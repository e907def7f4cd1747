//! What the study asked, and who answered.

use super::{Part, TableBlock};
use crate::analysis::Analysis;
use crate::analysis::conclusion::plural;
use crate::analysis::dataset::StudyFacts;
use crate::analysis::table::{Cell, Column, Group, Style, Table};

/// What the report is of.
pub fn title(analysis: &Analysis) -> String {
    match &analysis.data.study {
        Some(study) => format!("Greyfield: {}", study.id),
        None => "Greyfield: analysis of choices".to_owned(),
    }
}

/// What kind of thing it is.
pub fn kicker(analysis: &Analysis) -> String {
    match &analysis.data.study {
        Some(study) => format!("Greyfield analysis of {}", study.id),
        None => "Greyfield analysis".to_owned(),
    }
}

/// The question that participants were asked.
pub fn heading(analysis: &Analysis) -> String {
    let study = analysis.data.study.as_ref();
    let question = study.map(|study| study.question.as_str());
    let question = question.filter(|question| !question.is_empty());
    let data = &analysis.data;
    let unnamed = if !data.ratings.answers.is_empty() {
        "How were the images rated?"
    } else if !data.rankings.answers.is_empty() {
        "In which order were the images put?"
    } else {
        "Which image looked more realistic?"
    };
    question.unwrap_or(unnamed).to_owned()
}

/// Procedure, design and hypotheses, as far as they are known.
pub fn asked(analysis: &Analysis) -> Option<Part> {
    let hypotheses = hypotheses(analysis);
    let study = analysis.data.study.as_ref();
    if study.is_none() && hypotheses.is_empty() {
        return None;
    }
    let mut part = Part::new("What was asked");
    if let Some(study) = study {
        part.paragraph(procedure(study));
    }
    let in_words = hypotheses.iter().any(|row| !row[1].is_empty());
    let table = match in_words {
        true => words(&["hypothesis", "in words", "conditions"], hypotheses),
        false => {
            let rows = hypotheses.into_iter();
            let rows = rows.map(|[name, _, conditions]| [name, conditions]);
            words(&["hypothesis", "conditions"], rows)
        }
    };
    let caption = "Hypotheses and the conditions that ask them";
    part.table(TableBlock::new(caption, table).wrapping());
    Some(part)
}

fn procedure(study: &StudyFacts) -> String {
    format!(
        "Participants were asked: “{}” Procedure {}, counterbalancing {}, seed {}; {} participants were planned.",
        study.question, study.procedure, study.design, study.seed, study.planned_participants,
    )
}

/// Each hypothesis, its words where the protocol has them, and its conditions.
fn hypotheses(analysis: &Analysis) -> Vec<[String; 3]> {
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
            [name, words, conditions]
        })
        .collect()
}

/// Participants, what they told of themselves, and what was left out by rule.
pub fn who(analysis: &Analysis) -> Part {
    let data = &analysis.data;
    let mut part = Part::new("Who took part");
    part.paragraph(headcount(analysis));
    let told = data.study.iter().flat_map(|study| &study.participants_told);
    let told = told.map(|(question, answers)| {
        let answers: Vec<String> = (answers.iter())
            .map(|(answer, count)| format!("{answer}: {count}"))
            .collect();
        [question.clone(), answers.join(", ")]
    });
    part.table(
        TableBlock::new(
            "What participants chose to tell of themselves",
            words(&["question", "answers"], told),
        )
        .wrapping(),
    );
    let exclusions = data.exclusions.iter().map(|one| {
        let participants = match one.participants.len() {
            0 => "none".to_owned(),
            1..=12 => one.participants.join(", "),
            many => format!("{many} participants"),
        };
        [one.rule.clone(), participants, one.trials.to_string()]
    });
    part.table(
        TableBlock::new(
            "Left out by rules that were laid down before",
            words(&["rule", "participants", "trials left out"], exclusions),
        )
        .wrapping(),
    );
    part
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
    let answers = data.answers.len() - missing as usize
        + data.ratings.answers.len()
        + data.rankings.answers.len();
    format!(
        "{}{planned}, {}; {missing} trials without an answer.",
        plural(data.participants.len(), "participant"),
        plural(answers, "answer"),
    )
}

/// A table of words.
fn words<const N: usize>(
    titles: &[&'static str; N],
    rows: impl IntoIterator<Item = [String; N]>,
) -> Table {
    let column = |title: &&'static str| Column::new(title, title, Style::Text, Group::Key);
    Table {
        columns: titles.iter().map(column).collect(),
        rows: rows
            .into_iter()
            .map(|row| row.map(Cell::Text).into())
            .collect(),
    }
}
