//! `dataset_description.json`: what the data is and what every column means, for
//! people and for tools that know Psych-DS.

use serde_json::{Value, json};

use super::StudyIdentity;
use super::columns::{COLUMNS, Column};

/// `.psychdsignore`: files of the folder that Psych-DS knows nothing of.
pub const PSYCHDS_IGNORE: &str =
    "study.json\nslots/\nparticipants/\ndisplays/\nmaterials/\n.*.draft\n";

/// The description of a study's data, JSON-LD in the vocabulary of schema.org as
/// Psych-DS asks for.
#[must_use]
pub fn dataset_description(identity: &StudyIdentity) -> Value {
    json!({
        "@context": "https://schema.org/",
        "@type": "Dataset",
        "name": identity.study_id,
        "description": format!(
            "Choices of participants between two images of one scene that differ in ambient occlusion. \
             One file a session, one row a trial. Written by Greyfield {}. Protocol SHA-256 {}.",
            env!("CARGO_PKG_VERSION"),
            identity.protocol_hash
        ),
        "variableMeasured": COLUMNS.iter().map(variable).collect::<Vec<_>>(),
    })
}

fn variable(column: &Column) -> Value {
    let mut variable = json!({
        "@type": "PropertyValue",
        "name": column.name,
        "description": column.description,
    });
    if !column.unit.is_empty() {
        variable["unitText"] = json!(column.unit);
    }
    if !column.values.is_empty() {
        variable["valueReference"] = json!(column.values);
    }
    variable
}
