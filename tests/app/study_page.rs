//! The study's page over real results: the table, decisions, exports.

use crate::recorded;
use std::time::{Duration, Instant};

use crate::support::Tiny;
use eframe::egui::accesskit::Role;
use eframe::egui::{self, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use greyfield::app::study_page::StudyPage;
use greyfield::app::theme;
use greyfield::record::Study;

struct Looking {
    harness: Harness<'static, StudyPage>,
    study: Tiny,
}

impl Looking {
    fn at(study: Tiny) -> Self {
        let page = StudyPage::new(&study.path("results"), false);
        let harness = Harness::builder()
            .with_size(Vec2::new(1240.0, 900.0))
            .with_theme(egui::Theme::Light)
            .with_context_setup(theme::install)
            .build_ui_state(|ui, page: &mut StudyPage| page.ui(ui), page);
        let mut looking = Self { harness, study };
        looking.settle();
        looking
    }

    fn settle(&mut self) {
        let deadline = Instant::now() + Duration::from_secs(20);
        loop {
            self.harness.step();
            if self.harness.state().shown().is_some() {
                self.harness.step();
                return;
            }
            assert!(Instant::now() < deadline, "the folder is never read");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn click(&mut self, text: &str) {
        self.harness.get_by_label(text).click();
        for _ in 0..3 {
            self.harness.step();
        }
        self.settle();
    }
}

#[test]
fn a_participant_is_rejected_with_a_reason_and_reinstated() {
    let study = Tiny::new(3, [32, 18]);
    recorded::rows(&study, "first");
    let results = study.path("results");
    let mut looking = Looking::at(study);
    looking.harness.get_by_label("1 finished");
    looking.harness.get_by_label_contains("Audit: 0 errors");
    looking.click("firstp0001");
    looking.click("Reject");
    let rejected = || {
        let study = Study::open_existing(&results).expect("the study");
        study.rejected_ids().expect("the record")
    };
    assert!(rejected().is_empty(), "not without a reason");
    let field = looking
        .harness
        .get_by_role_and_label(Role::TextInput, "firstp0001: reason");
    field.focus();
    looking.harness.step();
    looking
        .harness
        .get_by_role_and_label(Role::TextInput, "firstp0001: reason")
        .type_text("fell asleep");
    looking.harness.step();
    looking.click("Reject");
    assert_eq!(rejected().into_iter().collect::<Vec<_>>(), ["firstp0001"]);
    looking.harness.get_by_label("finished, rejected");
    looking.click("Reinstate");
    assert!(rejected().is_empty());
}

#[test]
fn an_export_stands_beside_the_results_and_is_never_written_over() {
    let study = Tiny::new(3, [32, 18]);
    recorded::rows(&study, "first");
    let mut looking = Looking::at(study);
    looking.click("Export");
    let out = looking.study.path("results-psych-ds");
    assert!(out.join("dataset_description.json").is_file());
    looking.harness.get_by_label_contains("3 rows exported");
    looking.click("Export");
    assert!(
        looking
            .harness
            .query_by_label_contains("3 rows exported")
            .is_none()
    );
}
