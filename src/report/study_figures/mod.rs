//! The figures of a study, one file each. A page shows them where their section stands; as files
//! they are drawings of their own, SVG and PNG.

mod forest;
mod lookup;
mod orders;
mod positions;
mod ranks;
mod ratings;
mod response_times;
mod scale;
mod sequential;
mod shares;
#[cfg(test)]
mod tests;
mod votes;

use super::figure::sheet::Sheet;
use crate::analysis::Analysis;

/// One figure.
pub struct StudyFigure {
    /// Name of its file.
    pub id: &'static str,
    /// Id of the section it stands in; [`CHOICES`] and [`TESTS`] are the page's own.
    pub section: &'static str,
    /// The drawing; `None` where the data has nothing to show.
    pub draw: fn(&Analysis) -> Option<Drawing>,
}

/// The part of the page that holds the votes.
pub const CHOICES: &str = "choices";
/// The part of the page that holds the tests against an even split.
pub const TESTS: &str = "tests";

/// Every figure, in the order of the page.
pub const FIGURES: &[StudyFigure] = &[
    votes::FIGURE,
    forest::FIGURE,
    positions::FIGURE,
    orders::FIGURE,
    sequential::FIGURE,
    response_times::FIGURE,
    scale::FIGURE,
    ratings::FIGURE,
    ranks::FIGURE,
];

/// A figure with more rows says less than its table.
const MOST_ROWS: usize = 60;

const STYLE: &str = include_str!("study.css");
/// What the styles of these figures keep to.
const CLASS: &str = "study";

/// A drawing with what is to be read under it.
pub struct Drawing {
    sheet: Sheet,
    /// Where the drawing ends and a caption may begin.
    bottom: f64,
    /// What it shows and how to read it.
    pub caption: String,
}

impl Drawing {
    /// Without its caption, which the page sets as text.
    #[must_use]
    pub fn in_page(self) -> String {
        self.sheet.finish(CLASS, &[], self.bottom, &style())
    }

    /// With its caption, as a file.
    #[must_use]
    pub fn alone(self) -> String {
        let caption = [self.caption];
        self.sheet
            .finish(CLASS, &caption, self.bottom + 14.0, &style())
    }
}

fn style() -> String {
    STYLE.replace(".CLASS", &format!(".{CLASS}"))
}

/// The figures of one section, in order.
pub fn of_section<'a>(
    analysis: &'a Analysis,
    section: &'a str,
) -> impl Iterator<Item = Drawing> + 'a {
    FIGURES
        .iter()
        .filter(move |figure| figure.section == section)
        .filter_map(|figure| (figure.draw)(analysis))
}
