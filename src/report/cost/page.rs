//! The report as one page: no script, no font, no picture from elsewhere.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::series::{self, front_of, is_none};
use super::{
    CostReport, estimator, flip_plane, knee, methods, plane, preferences, scaling, tables, words,
};
use crate::cost::row::Row;
use crate::report::VERSION;
use crate::report::figure::numbers::{fixed, ms};
use crate::report::figure::words::distinct;
use crate::report::markup::{Column, figure, paragraph, table};
use crate::report::svg::escape;

/// What analysis pages look like, so that these look the same.
const STYLE: &str = concat!(include_str!("../html/page.css"), include_str!("page.css"));

const TITLE: &str = "What does accuracy cost?";

/// The whole page, `cost.html`.
#[must_use]
pub fn page(report: &CostReport) -> String {
    let mut page = String::new();
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Greyfield: {TITLE}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n"
    );
    result(&mut page, report);
    votes(&mut page, report);
    for scene in report.scenes() {
        of_scene(&mut page, report, scene);
    }
    estimators(&mut page, report);
    growth(&mut page, report);
    everything(&mut page, report);
    methods::methods(&mut page, report);
    runs(&mut page, report);
    page.push_str("</main>\n</body>\n</html>\n");
    page
}

fn result(page: &mut String, report: &CostReport) {
    let _ = write!(
        page,
        "<header>\n<p class=\"kicker\">Greyfield cost</p>\n<h1>{TITLE}</h1>\n</header>\n<section class=\"result\">\n"
    );
    let about = &report.record.about;
    let configurations: usize = (report.scenes().iter())
        .map(|scene| series::once(report.rows, scene).len())
        .sum();
    let techniques = distinct(report.rows.iter().map(|row| row.technique.as_str()));
    paragraph(
        page,
        &format!(
            "{configurations} configurations of {} ambient-occlusion techniques in {}, {}×{} pixels, on {}: how long each takes, and how far its occlusion and its images are from those with ray-traced occlusion.",
            techniques.iter().filter(|name| !is_none(name)).count(),
            counted(report.scenes().len(), "scene"),
            about.size_px.0,
            about.size_px.1,
            words::adapter(about),
        ),
    );
    for scene in report.scenes() {
        if let Some(sentence) = finding(report, scene) {
            paragraph(page, &sentence);
        }
    }
    let rows: Vec<&Row> = report.rows.iter().collect();
    for warning in words::warnings(report, &rows) {
        let _ = writeln!(page, "<p class=\"reason\">{}</p>", escape(&warning));
    }
    page.push_str("</section>\n");
}

fn counted(count: usize, name: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {name}{plural}")
}

/// What a scene's front says in a sentence or two.
fn finding(report: &CostReport, scene: &str) -> Option<String> {
    let rows = series::once(report.rows, scene);
    let front = front_of(&rows, |row| row.rmse);
    let best = front.last()?;
    let name = |row: &Row| {
        let (name, error) = (&row.configuration, fixed(row.rmse, 3));
        format!("{name} with an RMSE of {error} in {} ms", ms(row.total_ms))
    };
    let mut sentence = format!("{scene}: ");
    let points: Vec<(f64, f64)> = front.iter().map(|row| (row.total_ms, row.rmse)).collect();
    match knee(&points).map(|index| front[index]) {
        Some(bend) => {
            let _ = write!(
                sentence,
                "the front bends at {}, and ends at {}",
                name(bend),
                name(best)
            );
        }
        None => {
            let _ = write!(sentence, "the least error is {}'s", name(best));
        }
    }
    if let Some(none) = rows.iter().find(|row| is_none(&row.technique)) {
        let _ = write!(
            sentence,
            "; no occlusion at all has {}",
            fixed(none.rmse, 3)
        );
    }
    let _ = write!(
        sentence,
        ". The best answer that the depth buffer alone allows has {}.",
        fixed(best.information_loss_rmse, 3)
    );
    Some(sentence)
}

fn of_scene(page: &mut String, report: &CostReport, scene: &str) {
    let _ = writeln!(page, "<section>\n<h2>Scene: {}</h2>", escape(scene));
    figure(page, &plane(report, scene));
    tables::front(page, report, scene);
    figure(page, &flip_plane(report, scene));
    pictures(page, report, scene);
    page.push_str("</section>\n");
}

fn pictures(page: &mut String, report: &CostReport, scene: &str) {
    let mut subject = None;
    for picture in report
        .pictures
        .iter()
        .filter(|picture| picture.scene == scene)
    {
        if subject != Some(&picture.subject) {
            page.push_str(if subject.is_some() { "</div>\n" } else { "" });
            page.push_str("<div class=\"pictures\">\n");
            subject = Some(&picture.subject);
        }
        let caption = escape(&picture.caption);
        let _ = writeln!(
            page,
            "<figure><img alt=\"{caption}\" src=\"data:{};base64,{}\"><figcaption>{caption}</figcaption></figure>",
            escape(picture.mime),
            STANDARD.encode(&picture.bytes)
        );
    }
    page.push_str(if subject.is_some() { "</div>\n" } else { "" });
}

fn estimators(page: &mut String, report: &CostReport) {
    if report.rows.is_empty() {
        return;
    }
    page.push_str("<section>\n<h2>What a better estimator could gain</h2>\n");
    paragraph(
        page,
        "A screen-space technique errs because the depth buffer does not hold all that it would have to know, and because it estimates badly from what the buffer holds. Filled marks: distance from the truth. Open marks: distance from the best answer that the buffer allows. The dashed line: how far that answer is from the truth; a technique left of it is right for other reasons than knowing the depths well.",
    );
    figure(page, &estimator(report));
    page.push_str("</section>\n");
}

fn votes(page: &mut String, report: &CostReport) {
    if report.preferences.is_empty() {
        return;
    }
    page.push_str("<section>\n<h2>What people chose</h2>\n");
    figure(page, &preferences(report));
    paragraph(
        page,
        "Votes for the second image (b) beside what it costs more than the first (a). JOD: just objectionable differences, 1 where three of four people choose b (Thurstone's case V). Points: percentage points of the votes above a half.",
    );
    tables::votes(page, report);
    page.push_str("</section>\n");
}

fn growth(page: &mut String, report: &CostReport) {
    if report.scaling.is_empty() {
        return;
    }
    page.push_str("<section>\n<h2>How time grows</h2>\n");
    for scene in report.scaling_scenes() {
        figure(page, &scaling(report, scene));
    }
    tables::exponents(page, report);
    page.push_str("</section>\n");
}

fn everything(page: &mut String, report: &CostReport) {
    let _ = writeln!(
        page,
        "<section>\n<h2>Everything measured</h2>\n<details>\n<summary>{} rows; the same with full precision are in cost.csv</summary>",
        report.rows.len()
    );
    tables::rows(page, report);
    page.push_str("</details>\n</section>\n");
}

fn runs(page: &mut String, report: &CostReport) {
    page.push_str("<section>\n<h2>Runs</h2>\n");
    let cells: Vec<_> = (report.record.runs.iter().enumerate())
        .map(|(index, run)| {
            vec![
                (index + 1).to_string(),
                run.date.clone(),
                run.command.clone(),
            ]
        })
        .collect();
    table(
        page,
        "",
        "What was run, and when; compare times of one run",
        &[
            Column::Words("run"),
            Column::Words("date"),
            Column::Words("command"),
        ],
        &cells,
    );
    let about = &report.record.about;
    paragraph(
        page,
        &format!(
            "Measured by Greyfield {} with seed {}, written by Greyfield {VERSION}. The same sweep gives this page again, byte for byte.",
            about.app_version, about.seed
        ),
    );
    page.push_str("</section>\n");
}
