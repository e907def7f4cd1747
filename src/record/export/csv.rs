//! One flat file of all rows, in the columns of the data files, and what each column means.

use super::{Draft, Format, Material};
use crate::record::columns::COLUMNS;
use crate::record::{RecordError, TrialRow, line};

/// The format.
pub const CSV: Format = Format {
    name: "csv",
    summary: "one flat file of all rows, and the meaning of its columns",
    write,
};

fn write(material: &Material, draft: &mut Draft) -> Result<(), RecordError> {
    draft.file("rows.csv", &rows_file(material.rows())?)?;
    draft.file("columns.csv", &columns_file())
}

/// A file in the layout of a data file: the same header, the same lines.
pub(super) fn rows_file<'a>(
    rows: impl Iterator<Item = &'a TrialRow>,
) -> Result<Vec<u8>, RecordError> {
    let mut bytes = line::header().into_bytes();
    for row in rows {
        let line = line::encode(row).map_err(|message| RecordError::Row {
            row_id: row.row_id.clone(),
            message,
        })?;
        bytes.extend(line);
    }
    Ok(bytes)
}

fn columns_file() -> Vec<u8> {
    let mut text = String::from("name,unit,values,description\n");
    for column in COLUMNS {
        text += &format!(
            "{},{},{},\"{}\"\n",
            column.name,
            column.unit,
            column.values.join(" "),
            column.description.replace('"', "\"\"")
        );
    }
    text.into_bytes()
}
