//! A folder by the rules of BIDS (<https://bids-specification.readthedocs.io>,
//! behavioural experiments with no neural recordings): one table a participant under
//! `sub-…/beh/`, with its meaning beside it.

use serde_json::{Map, Value, json as value};

use super::material::Session;
use super::{Draft, Format, Material, alphanumeric, json};
use crate::record::columns::{COLUMNS, Column};
use crate::record::line::CHECKSUM_COLUMN;
use crate::record::spreadsheet::neutral;
use crate::record::{ParticipantId, RecordError, TrialRow, line};

/// The format.
pub const BIDS: Format = Format {
    name: "bids",
    summary: "a BIDS dataset: sub-…/beh/ tables with their sidecars, participants.tsv",
    write,
};

/// The version whose rules these are.
const BIDS_VERSION: &str = "1.10.0";

/// How a missing value is written.
const MISSING: &str = "n/a";

fn write(material: &Material, draft: &mut Draft) -> Result<(), RecordError> {
    let task = alphanumeric(&material.identity.study_id);
    draft.file("dataset_description.json", &json(&description(material)))?;
    draft.file("README", readme(material).as_bytes())?;
    draft.file("participants.tsv", &participants(material)?)?;
    draft.file("participants.json", &json(&participants_meaning(material)))?;
    let sidecar = json(&sidecar(material, &task));
    for session in &material.sessions {
        let label = subject(session)?;
        let stem = format!("sub-{label}/beh/sub-{label}_task-{task}_beh");
        draft.file(format!("{stem}.tsv"), &table(&session.rows)?)?;
        draft.file(format!("{stem}.json"), &sidecar)?;
    }
    Ok(())
}

/// The label of a participant: letters and digits, one of its own for each id.
fn subject(session: &Session) -> Result<String, RecordError> {
    Ok(ParticipantId::new(&session.participant)?.file_value())
}

fn description(material: &Material) -> Value {
    value!({
        "Name": material.identity.study_id,
        "BIDSVersion": BIDS_VERSION,
        "DatasetType": "raw",
        "GeneratedBy": [{ "Name": "Greyfield", "Version": env!("CARGO_PKG_VERSION") }],
    })
}

fn readme(material: &Material) -> String {
    let mut text = format!(
        "{}: {} participants, {} trials. Choices of participants between two images of one scene that differ in ambient occlusion; \
         protocol SHA-256 {}. Exported by Greyfield {}.\n\n\
         Text that a spreadsheet would run as a formula, and text that reads n/a, has an apostrophe in front.\n",
        material.identity.study_id,
        material.sessions.len(),
        material.rows().count(),
        material.identity.protocol_hash,
        env!("CARGO_PKG_VERSION"),
    );
    for note in &material.notes {
        text += &format!("\n{note}\n");
    }
    text
}

/// One row a participant.
fn participants(material: &Material) -> Result<Vec<u8>, RecordError> {
    let mut text = String::from(
        "participant_id\tgreyfield_id\tslot\ttrials\tpilot\treleased\trejected\trejection_reason",
    );
    let questions = material.questions();
    for id in &questions {
        text += &format!("\tabout_{id}");
    }
    text.push('\n');
    for session in &material.sessions {
        let standing = session.standing.as_ref();
        let rejected = standing.and_then(|known| known.rejected.as_ref());
        let cells = [
            format!("sub-{}", subject(session)?),
            cell(&session.participant),
            session.rows[0].slot.to_string(),
            session.rows.len().to_string(),
            session.rows[0].pilot.to_string(),
            standing
                .is_some_and(|known| known.released.is_some())
                .to_string(),
            rejected.is_some().to_string(),
            rejected.map_or(MISSING.to_owned(), |known| cell(&one_line(&known.reason))),
        ];
        text += &cells.join("\t");
        let told = session.about.iter().flat_map(|about| &about.answers);
        for id in &questions {
            let answer = told.clone().find(|answer| answer.id == *id);
            text.push('\t');
            text += &answer.map_or(MISSING.to_owned(), |it| cell(&one_line(&it.answer)));
        }
        text.push('\n');
    }
    Ok(text.into_bytes())
}

fn participants_meaning(material: &Material) -> Value {
    let mut meaning = value!({
        "greyfield_id": { "Description": "The participant's pseudonymous id as it stands in Greyfield." },
        "slot": { "Description": "Participant number in the counterbalancing design, from 0." },
        "trials": { "Description": "Trials in this dataset." },
        "pilot": { "Description": "Whether the session was recorded to try the study out.", "Levels": levels(&["true", "false"]) },
        "released": { "Description": "Whether the slot was given to another participant.", "Levels": levels(&["true", "false"]) },
        "rejected": { "Description": "Whether the experimenter has rejected the data.", "Levels": levels(&["true", "false"]) },
        "rejection_reason": { "Description": "The experimenter's words." },
    });
    for id in material.questions() {
        let words = "What the participant chose to tell; the question stands in the protocol.";
        meaning[format!("about_{id}")] = value!({ "Description": words });
    }
    meaning
}

/// What the columns mean.
fn sidecar(material: &Material, task: &str) -> Value {
    let mut all = Map::new();
    all.insert("TaskName".to_owned(), value!(task));
    let words = "Which image looks more realistic? Two images of one scene, one after the other.";
    all.insert("TaskDescription".to_owned(), value!(words));
    all.insert(
        "Instructions".to_owned(),
        value!(format!(
            "See the protocol with SHA-256 {}.",
            material.identity.protocol_hash
        )),
    );
    for column in columns() {
        let mut meaning = value!({ "Description": column.description });
        if !column.unit.is_empty() {
            meaning["Units"] = value!(column.unit);
        }
        if !column.values.is_empty() {
            meaning["Levels"] = levels(column.values);
        }
        all.insert(column.name.to_owned(), meaning);
    }
    Value::Object(all)
}

fn levels(values: &[&str]) -> Value {
    let level = |name: &&str| ((*name).to_owned(), value!(*name));
    Value::Object(values.iter().map(level).collect())
}

/// The checksum is of a line of another file.
fn columns() -> impl Iterator<Item = &'static Column> {
    COLUMNS
        .iter()
        .filter(|column| column.name != CHECKSUM_COLUMN)
}

/// The rows, tab-separated.
pub(super) fn table(rows: &[TrialRow]) -> Result<Vec<u8>, RecordError> {
    let names: Vec<&str> = columns().map(|column| column.name).collect();
    let mut text = names.join("\t");
    text.push('\n');
    for row in rows {
        let cells = line::cells(row).map_err(|message| RecordError::Row {
            row_id: row.row_id.clone(),
            message,
        })?;
        // These are neutral against spreadsheets already.
        let cells: Vec<String> = cells.iter().map(|cell| shown(cell)).collect();
        text += &cells.join("\t");
        text.push('\n');
    }
    Ok(text.into_bytes())
}

/// A free text as a cell.
fn cell(text: &str) -> String {
    shown(&neutral(text))
}

/// A neutral text as a cell of a BIDS table: `n/a` for nothing, quoted where a tab or a
/// quotation mark is in it.
fn shown(cell: &str) -> String {
    match cell {
        "" => MISSING.to_owned(),
        MISSING => format!("'{MISSING}"),
        text if text.contains(['\t', '"']) => format!("\"{}\"", text.replace('"', "\"\"")),
        text => text.to_owned(),
    }
}

fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}
