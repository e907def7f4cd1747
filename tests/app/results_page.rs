//! The results leaf of the study's page: nothing before the note is read, then the report, live.

use std::time::{Duration, Instant};

use crate::recorded;
use crate::support::Tiny;
use eframe::egui::{self, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use greyfield::app::study_page::StudyPage;
use greyfield::app::theme;

fn page(study: &Tiny, follows: bool) -> Harness<'static, StudyPage> {
    let page = StudyPage::new(&study.path("results"), follows);
    Harness::builder()
        .with_size(Vec2::new(1240.0, 900.0))
        .with_theme(egui::Theme::Light)
        .with_context_setup(theme::install)
        .build_ui_state(|ui, page: &mut StudyPage| page.ui(ui), page)
}

/// Passes of the interface until something is so.
fn until(
    harness: &mut Harness<'static, StudyPage>,
    what: &str,
    is_so: impl Fn(&Harness<'static, StudyPage>) -> bool,
) {
    let deadline = Instant::now() + Duration::from_secs(30);
    while !is_so(harness) {
        assert!(Instant::now() < deadline, "never: {what}");
        harness.step();
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn opened(study: &Tiny, follows: bool) -> Harness<'static, StudyPage> {
    let mut harness = page(study, follows);
    harness.step();
    harness.get_by_label("Results").click();
    harness.step();
    harness.step();
    assert!(
        harness.query_by_label("Show the results").is_some(),
        "the note comes first"
    );
    assert!(!harness.state().report().is_shown());
    harness.get_by_label("Show the results").click();
    harness.step();
    until(&mut harness, "the report is there", |harness| {
        harness.state().report().is_shown()
    });
    harness.step();
    harness
}

#[test]
fn the_report_is_behind_a_note_and_is_saved_beside_the_results() {
    let study = Tiny::new(3, [32, 18]);
    recorded::rows(&study, "first");
    let mut harness = opened(&study, false);
    harness.get_by_label_contains("1 participant of");
    harness.get_by_label("Anytime-valid test");
    harness.get_by_label("Save the report").click();
    harness.step();
    harness.step();
    let folder = study.path("results-report");
    for file in [
        "report.html",
        "report.json",
        "tables/conditions.csv",
        "figures/votes.png",
    ] {
        assert!(folder.join(file).is_file(), "{file}");
    }
}

#[test]
fn new_answers_show_while_the_page_stands() {
    let study = Tiny::new(3, [32, 18]);
    recorded::rows(&study, "first");
    let mut harness = opened(&study, true);
    harness.get_by_label_contains("1 participant of");
    recorded::rows(&study, "random:7");
    until(&mut harness, "the second participant", |harness| {
        harness
            .query_by_label_contains("2 participants of")
            .is_some()
    });
}

#[test]
fn a_folder_without_answers_says_so() {
    let study = Tiny::new(3, [32, 18]);
    recorded::rows(&study, "first");
    let data = study.path("results/data");
    for file in std::fs::read_dir(&data).expect("the data folder") {
        std::fs::remove_file(file.expect("an entry").path()).expect("removed");
    }
    let harness = opened(&study, false);
    harness.get_by_label_contains("has no data files");
}
