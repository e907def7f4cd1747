//! Where every number comes from: input files with their hashes, seeds, versions.

use std::fmt::Write as _;

use super::elements::paragraph;
use crate::analysis::Analysis;
use crate::report::VERSION;
use crate::report::svg::escape;
use crate::seed;

/// With more files than this the list is folded away.
const MOST_FILES: usize = 8;

/// The section.
pub fn section(page: &mut String, analysis: &Analysis) {
    page.push_str("<section>\n<h2>Provenance</h2>\n");
    inputs(page, analysis);
    if let Some(study) = &analysis.data.study {
        let recorded = match study.versions.is_empty() {
            true => String::new(),
            false => format!(", recorded by Greyfield {}", study.versions.join(", ")),
        };
        let _ = writeln!(
            page,
            "<p>Protocol of {}, SHA-256 <code>{}</code>{}.</p>",
            escape(&study.id),
            study.protocol_sha256,
            escape(&recorded),
        );
    }
    let settings = &analysis.settings;
    let bootstrap = match settings.bootstrap {
        0 => String::new(),
        n => format!(
            ", {n} bootstrap resamples of the participants with seed {} ({})",
            settings.seed,
            seed::GENERATOR,
        ),
    };
    paragraph(
        page,
        &format!(
            "Greyfield {VERSION}, alpha = {}{bootstrap}. The same input gives this page again, byte for byte.",
            settings.alpha.get()
        ),
    );
    page.push_str("</section>\n");
}

fn inputs(page: &mut String, analysis: &Analysis) {
    let sources = &analysis.data.sources;
    let many = sources.len() > MOST_FILES;
    if many {
        let _ = writeln!(
            page,
            "<details>\n<summary>{} input files, {} rows used</summary>",
            sources.len(),
            sources.iter().map(|source| source.rows_used).sum::<u64>()
        );
    }
    page.push_str("<div class=\"scroll\"><table>\n<thead><tr><th>input</th><th>read as</th><th class=\"n\">rows used</th><th class=\"n\">left out</th><th>SHA-256</th></tr></thead>\n<tbody>\n");
    for source in sources {
        let _ = writeln!(
            page,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td><code>{}</code></td></tr>",
            escape(&source.path),
            source.kind,
            source.rows_used,
            source.rows_left_out,
            source.sha256
        );
    }
    page.push_str("</tbody>\n</table></div>\n");
    if many {
        page.push_str("</details>\n");
    }
}
