//! How a statistic declares itself. Each stands in a file of its own and in one line of
//! [`registry`](super::registry); tables, files and the methods text read the registry.

use super::dataset::{ConditionData, Dataset};
use super::settings::Settings;
use super::table::{Cell, Column, Status, Table, Undefined};
use super::tails::Probability;

/// What a statistic is and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct About {
    /// Short name in files (`chi_square`).
    pub id: &'static str,
    /// Name in the text.
    pub name: &'static str,
    /// The formula, in words and symbols of the field.
    pub formula: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// Where it is exact, and where it is not to be trusted.
    pub validity: &'static str,
}

/// A statistic of one condition alone.
pub struct ConditionStatistic {
    /// What it is.
    pub about: About,
    /// The columns it fills.
    pub columns: &'static [Column],
    /// One cell a column.
    pub cells: fn(&ConditionData, &Settings) -> Vec<Cell>,
    /// Present where it is a test of the condition's null hypothesis, one for the family.
    pub test: Option<ConditionTest>,
}

/// Columns of the table of conditions that need the single answers, and are filled for all
/// conditions in one pass over them.
pub struct AnswerStatistic {
    /// What it is.
    pub about: About,
    /// The columns it fills.
    pub columns: &'static [Column],
    /// For every condition one cell a column.
    pub cells: fn(&Dataset, &Settings) -> Vec<Vec<Cell>>,
}

/// A test that the family correction applies to.
#[derive(Clone, Copy)]
pub struct ConditionTest {
    /// Key of its p column, to which the name of the correction is added (`p_exact_holm`).
    pub p_key: &'static str,
    /// What stands in headings (`exact`).
    pub short: &'static str,
    /// The uncorrected p.
    pub p: fn(&ConditionData) -> Result<Probability, Undefined>,
}

/// A correction for testing several hypotheses at once.
pub struct Correction {
    /// What it is.
    pub about: About,
    /// What stands in headings (`Holm`).
    pub short: &'static str,
    /// Adjusted p-values, in the order given.
    pub adjust: fn(&[Probability]) -> Vec<Probability>,
}

/// A statistic of the study as a whole.
pub struct StudyStatistic {
    /// What it is.
    pub about: About,
    /// Its section of the report; `None` where the data cannot tell.
    pub section: fn(&Context<'_>) -> Option<Section>,
}

/// What a statistic of the whole study works on.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// What went in.
    pub data: &'a Dataset,
    /// What was chosen.
    pub settings: &'a Settings,
    /// Is told how far long work is.
    pub watch: &'a dyn Watch,
}

impl<'a> Context<'a> {
    /// With nobody watching.
    #[must_use]
    pub fn of(data: &'a Dataset, settings: &'a Settings) -> Self {
        Self {
            data,
            settings,
            watch: &(),
        }
    }
}

/// Is told how far long work is, from any thread: a progress bar, or nobody.
pub trait Watch: Sync {
    /// Work of so many steps begins.
    fn begin(&self, _what: &'static str, _steps: u64) {}
    /// One step is done.
    fn step(&self) {}
}

/// Nobody watches.
impl Watch for () {}

/// One part of the report.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Short name in files.
    pub id: &'static str,
    /// Heading.
    pub title: &'static str,
    /// How its main estimate stands; the findings say why.
    pub status: Status,
    /// Findings, one sentence or more each.
    pub findings: Vec<String>,
    /// Tables, each with a short name and a caption.
    pub tables: Vec<SectionTable>,
}

/// A table of a section.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionTable {
    /// Short name in files.
    pub id: &'static str,
    /// Caption.
    pub caption: &'static str,
    /// One row a participant: too long for the terminal, folded away in the page.
    pub long: bool,
    /// The table.
    pub table: Table,
}
