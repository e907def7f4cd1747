//! A folder by the rules of Psych-DS (<https://psych-ds.github.io>): the data files
//! without the lines a crash has left, their description, and the materials.

use super::{Draft, Format, Material, csv, json};
use crate::record::{DATA_FOLDER, RecordError, description};

/// The format.
pub const PSYCH_DS: Format = Format {
    name: "psych-ds",
    summary: "one CSV file a session and dataset_description.json, as Psych-DS asks for",
    write,
};

fn write(material: &Material, draft: &mut Draft) -> Result<(), RecordError> {
    let description = description::dataset_description(&material.identity);
    draft.file("dataset_description.json", &json(&description))?;
    draft.file("README.md", readme(material).as_bytes())?;
    for session in &material.sessions {
        let name = format!("{DATA_FOLDER}/{}", session.file);
        draft.file(name, &csv::rows_file(session.rows.iter())?)?;
    }
    if let Some(protocol) = &material.protocol {
        draft.file("materials/protocol.toml", protocol)?;
    }
    Ok(())
}

fn readme(material: &Material) -> String {
    let mut text = format!(
        "# {}\n\n{} sessions, {} rows, exported by Greyfield {}. One file a session under data/, one row a trial; dataset_description.json says what the columns mean, materials/protocol.toml what the participants went through.\n",
        material.identity.study_id,
        material.sessions.len(),
        material.rows().count(),
        env!("CARGO_PKG_VERSION"),
    );
    for note in &material.notes {
        text += &format!("\n- {note}\n");
    }
    text
}
