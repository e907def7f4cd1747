//! A paragraph on the methods, to paste into a paper.

use super::VERSION;
use crate::analysis::Analysis;
use crate::analysis::conditions::main_family;

/// The paragraph; its sources stand in the table of statistics.
pub fn paragraph(analysis: &Analysis) -> String {
    let computed = format!("Computed with Greyfield {VERSION}.");
    if analysis.data.conditions.is_empty() {
        return computed;
    }
    let alpha = analysis.settings.alpha.get();
    let confidence = analysis.settings.alpha.confidence_percent();
    let tested = main_family(&analysis.data, &analysis.settings).size();
    let mut text = format!(
        "In each condition the number of participants who chose either image was compared with an even split by an exact two-sided binomial test and by a chi-square test with one degree of freedom and no continuity correction. Shares are given with {confidence} % score intervals (Wilson, 1927) and exact intervals (Clopper & Pearson, 1934), effect sizes as Cohen's g and w (Cohen, 1988). "
    );
    text += &match tested {
        0 | 1 => format!("The significance level was {alpha}. "),
        n => format!(
            "The {n} conditions were treated as one family: the family-wise error was held at {alpha} by Holm's (1979) step-down correction; p-values corrected for the false discovery rate (Benjamini & Hochberg, 1995) are given beside them. "
        ),
    };
    if analysis.data.has_answers() {
        text += "Position bias was examined by an exact binomial test of how often the image shown first was chosen. ";
    }
    if analysis
        .sections
        .iter()
        .any(|section| section.id == "mcnemar")
    {
        text += "Conditions that showed the same two techniques were compared within participants by McNemar's (1947) exact test, corrected by Holm. ";
    }
    text + &computed
}
