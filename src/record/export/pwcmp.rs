//! One table of comparisons as pwcmp and its kin read it
//! (<https://github.com/mantiuk/pwcmp>): `observer, session, scene, condition_A,
//! condition_B, is_A_selected`.
//!
//! Their "condition" is our technique: condition_A is the technique that comes first in
//! the base order of our condition, whichever image was shown first. Their "scene" is
//! whatever may be scaled together: images of one scene under one light.

use std::collections::{BTreeMap, HashMap};

use super::{Draft, Format, Material};
use crate::protocol::Phase;
use crate::record::spreadsheet::neutral;
use crate::record::{RecordError, TrialRow};

/// The format.
pub const PWCMP: Format = Format {
    name: "pwcmp",
    summary: "one table of comparisons for scaling: observer, session, scene, condition_A, condition_B, is_A_selected",
    write,
};

/// The table's columns.
const COLUMNS: [&str; 6] = [
    "observer",
    "session",
    "scene",
    "condition_A",
    "condition_B",
    "is_A_selected",
];

fn write(material: &Material, draft: &mut Draft) -> Result<(), RecordError> {
    let labels = scenes(material);
    let base: HashMap<&str, &str> = material
        .identity
        .conditions
        .iter()
        .filter_map(|condition| {
            Some((
                condition.id.as_str(),
                condition.techniques.first()?.as_str(),
            ))
        })
        .collect();
    let mut table = Table::new();
    let (mut not_main, mut no_choice) = (0, 0);
    for row in material.rows() {
        if row.phase != Phase::Main {
            not_main += 1;
            continue;
        }
        let Some(first_chosen) = first_was_chosen(row) else {
            no_choice += 1;
            continue;
        };
        let (first, second) = (row.technique_first.as_str(), row.technique_second.as_str());
        let reversed = base.get(row.condition.as_str()) == Some(&second);
        let (a, b) = if reversed {
            (second, first)
        } else {
            (first, second)
        };
        let scene = labels.get(row.condition.as_str());
        table.line([
            row.participant_id.as_str(),
            &row.session.to_string(),
            scene.map_or(row.scene.as_str(), String::as_str),
            a,
            b,
            if first_chosen != reversed { "1" } else { "0" },
        ]);
    }
    draft.rows -= not_main + no_choice;
    for (count, what) in [
        (
            not_main,
            "practice and catch trials are left out: they compare nothing",
        ),
        (
            no_choice,
            "rows without a choice between two images are left out: pwcmp has no place for them",
        ),
    ] {
        if count > 0 {
            draft.note(format!("{count} {what}."));
        }
    }
    draft.file("comparisons.csv", &table.0)
}

/// Whether the image shown first was chosen; `None` for rows that are no choice between
/// two images. By the technique chosen, which only a choice has.
fn first_was_chosen(row: &TrialRow) -> Option<bool> {
    let chosen = row.chosen_technique.as_ref()?;
    if chosen == &row.technique_first {
        Some(true)
    } else if chosen == &row.technique_second {
        Some(false)
    } else {
        None
    }
}

/// What to call the scene of each condition. Conditions that share an image (the same
/// hash) belong together. Where one scene falls into several such groups, which is so
/// when it was lit in several ways, each is named after its first condition.
fn scenes(material: &Material) -> HashMap<&str, String> {
    let conditions = &material.identity.conditions;
    let index: HashMap<&str, usize> = conditions
        .iter()
        .enumerate()
        .map(|(n, condition)| (condition.id.as_str(), n))
        .collect();
    // The group of each condition: the lowest condition it is joined with.
    let mut group: Vec<usize> = (0..conditions.len()).collect();
    let mut by_image: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for row in material.rows() {
        let Some(&condition) = index.get(row.condition.as_str()) else {
            continue;
        };
        for hash in [&row.first_image_sha256, &row.second_image_sha256] {
            if hash.is_empty() {
                continue;
            }
            let known = *by_image.entry((&row.scene, hash)).or_insert(condition);
            let (from, to) = (
                group[condition].max(group[known]),
                group[condition].min(group[known]),
            );
            for one in &mut group {
                if *one == from {
                    *one = to;
                }
            }
        }
    }
    let groups_of = |scene: &str| {
        let its = (0..conditions.len()).filter(|&n| conditions[n].scene == scene);
        let groups: std::collections::BTreeSet<usize> = its.map(|n| group[n]).collect();
        groups.len()
    };
    let label = |(n, condition): (usize, &'_ crate::protocol::Condition)| {
        if groups_of(&condition.scene) > 1 {
            format!("{}/{}", condition.scene, conditions[group[n]].id)
        } else {
            condition.scene.clone()
        }
    };
    conditions
        .iter()
        .enumerate()
        .map(|(n, condition)| (condition.id.as_str(), label((n, condition))))
        .collect()
}

/// A CSV table in memory.
struct Table(Vec<u8>);

impl Table {
    fn new() -> Self {
        Self(format!("{}\n", COLUMNS.join(",")).into_bytes())
    }

    fn line(&mut self, cells: [&str; 6]) {
        let cells = cells.map(|cell| {
            let cell = neutral(cell);
            if cell.contains([',', '"', '\n', '\r']) {
                format!("\"{}\"", cell.replace('"', "\"\""))
            } else {
                cell.into_owned()
            }
        });
        self.0.extend(cells.join(",").into_bytes());
        self.0.push(b'\n');
    }
}
