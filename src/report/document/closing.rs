//! Methods to paste into a paper, and where every number comes from.

use super::{Block, Part, TableBlock, Term};
use crate::analysis::Analysis;
use crate::analysis::registry;
use crate::analysis::table::{Cell, Column, Group, Style, Table};
use crate::report::{VERSION, methods};
use crate::seed;

/// With more input files than this their list is folded away.
const MOST_FILES: usize = 8;

/// What was computed, in sentences, and every formula.
pub fn methods(analysis: &Analysis) -> Part {
    let mut part = Part::new("Methods");
    part.note("To paste into a paper:");
    part.blocks
        .push(Block::Quote(methods::paragraphs(analysis)));
    let terms = registry::abouts().into_iter().map(|about| Term {
        name: about.name,
        formula: about.formula,
        validity: about.validity,
        source: about.source,
    });
    part.blocks.push(Block::Terms(terms.collect()));
    part
}

/// Input files with their hashes, seeds, versions.
pub fn provenance(analysis: &Analysis) -> Part {
    let mut part = Part::new("Provenance");
    let sources = &analysis.data.sources;
    let rows: u64 = sources.iter().map(|source| source.rows_used).sum();
    let files = crate::analysis::conclusion::plural(sources.len(), "input file");
    part.table(
        TableBlock::new(format!("{files}, {rows} rows used"), inputs(analysis))
            .folded(sources.len() > MOST_FILES),
    );
    if let Some(study) = &analysis.data.study {
        let recorded = match study.versions.is_empty() {
            true => String::new(),
            false => format!(", recorded by Greyfield {}", study.versions.join(", ")),
        };
        part.paragraph(format!(
            "Protocol of {}, SHA-256 {}{recorded}; counterbalanced with seed {} ({}).",
            study.id,
            study.protocol_sha256,
            study.seed,
            seed::GENERATOR,
        ));
    }
    let settings = &analysis.settings;
    let bootstrap = match settings.bootstrap {
        0 => String::new(),
        resamples => format!(
            ", {resamples} bootstrap resamples of the participants with seed {} ({})",
            settings.seed,
            seed::GENERATOR,
        ),
    };
    part.paragraph(format!(
        "Greyfield {VERSION}, alpha = {}{bootstrap}. The same input gives this report again, byte for byte.",
        settings.alpha.get()
    ));
    part
}

fn inputs(analysis: &Analysis) -> Table {
    let count = |rows: u64| Cell::Count(u32::try_from(rows).unwrap_or(u32::MAX));
    let sources = analysis.data.sources.iter();
    Table {
        columns: vec![
            Column::new("input", "input", Style::Text, Group::Key),
            Column::new("read_as", "read as", Style::Text, Group::Key),
            Column::new("rows_used", "rows used", Style::Count, Group::Key),
            Column::new("left_out", "left out", Style::Count, Group::Key),
            Column::new("sha256", "SHA-256", Style::Code, Group::Key),
        ],
        rows: sources
            .map(|source| {
                vec![
                    Cell::Text(source.path.clone()),
                    Cell::Text(source.kind.to_owned()),
                    count(source.rows_used),
                    count(source.rows_left_out),
                    Cell::Text(source.sha256.clone()),
                ]
            })
            .collect(),
    }
}
