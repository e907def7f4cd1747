//! Paragraphs on the methods, to paste into a paper.

use super::VERSION;
use crate::analysis::Analysis;
use crate::analysis::conditions::main_family;

/// What is said of a section where the report has it.
const OF_SECTIONS: &[(&str, &str)] = &[
    (
        "position_bias",
        "Position bias was examined by an exact binomial test of how often the image shown first was chosen.",
    ),
    (
        "order_effect",
        "Whether the choice depended on the order of the two images was tested over all conditions by the Cochran–Mantel–Haenszel test (Mantel & Haenszel, 1959), with the common odds ratio and its interval (Robins, Breslow & Greenland, 1986).",
    ),
    (
        "mcnemar",
        "Conditions that showed the same two techniques were compared within participants by McNemar's (1947) exact test, corrected by Holm.",
    ),
    (
        "cochran_q",
        "Three or more conditions of the same two techniques were compared within participants by Cochran's (1950) Q, exactly where its distribution could be enumerated.",
    ),
    (
        "bayes_factor",
        "Evidence for a preference was weighed against an even split by the Bayes factor under a uniform prior of the share (Beta(1, 1)); how far it depends on the prior is shown for symmetric Beta priors from 0.5 to 10.",
    ),
    (
        "sequential",
        "An anytime-valid test (the mixture martingale of the same prior; Robbins, 1970; Howard et al., 2021) gives p-values and confidence sequences that hold at every number of participants.",
    ),
    (
        "response_times",
        "Response times were analysed by their logarithms: geometric means with t intervals, a one-sample t test of each participant's difference between choosing the first and the second image, and Friedman's test between conditions.",
    ),
    (
        "scaling",
        "The techniques were placed on one scale by Thurstone's (1927) case V, in units of just-objectionable differences (1 JOD: 75 % prefer one to the other), and by the model of Bradley & Terry (1952), both fitted by maximum likelihood after its existence was checked (Ford, 1957); where a maximum did not exist, Firth's (1993) penalised likelihood was used and is marked.",
    ),
    (
        "consistency",
        "Each observer's answers were compared with those of the others, and where all pairs of a scene were judged, consistency was measured by circular triads and the coefficient of agreement (Kendall & Babington Smith, 1940); nobody was left out for it.",
    ),
    (
        "rankings",
        "Rank orders were compared by Friedman's (1937) test, over several conditions with each participant's mean ranks, by its exact permutation distribution where that could be enumerated and Iman & Davenport's (1980) F elsewhere, with Kendall's W; pairs of techniques by exact sign tests, corrected by Holm.",
    ),
    (
        "ratings",
        "Ratings were compared by Friedman's (1937) test within participants, pairs of techniques by Wilcoxon's (1945) signed-rank test, corrected by Holm, and all techniques by a proportional-odds model (McCullagh, 1980) with standard errors clustered by participant (Liang & Zeger, 1986).",
    ),
];

/// The paragraphs; their sources stand in the table of statistics.
pub fn paragraphs(analysis: &Analysis) -> Vec<String> {
    let mut paragraphs = Vec::new();
    if !analysis.data.conditions.is_empty() {
        paragraphs.push(of_choices(analysis));
    }
    let ids = || analysis.sections.iter().map(|section| section.id);
    let said: Vec<&str> = OF_SECTIONS
        .iter()
        .filter(|(id, _)| ids().any(|known| known == *id))
        .map(|(_, sentence)| *sentence)
        .collect();
    if !said.is_empty() {
        paragraphs.push(said.join(" "));
    }
    paragraphs.extend(left_out(analysis));
    let bootstrap = match analysis.settings.bootstrap {
        0 => String::new(),
        resamples => format!(
            "Bootstrap intervals are expanded percentile intervals (Hesterberg, 2015) from {resamples} resamples of the participants (seed {}). ",
            analysis.settings.seed
        ),
    };
    paragraphs.push(format!("{bootstrap}Computed with Greyfield {VERSION}."));
    paragraphs
}

fn of_choices(analysis: &Analysis) -> String {
    let alpha = analysis.settings.alpha.get();
    let confidence = analysis.settings.alpha.confidence_percent();
    let tested = main_family(&analysis.data, &analysis.settings).size();
    let mut text = format!(
        "In each condition the number of participants who chose either image was compared with an even split by an exact two-sided binomial test and by a chi-square test with one degree of freedom and no continuity correction. Shares are given with {confidence} % score intervals (Wilson, 1927) and exact intervals (Clopper & Pearson, 1934), effect sizes as Cohen's g and w (Cohen, 1988). "
    );
    text += &match (tested, analysis.settings.family.is_empty()) {
        (0 | 1, _) => format!("The significance level was {alpha}."),
        (n, true) => format!(
            "The {n} conditions were treated as one family: the family-wise error was held at {alpha} by Holm's (1979) step-down correction; p-values corrected for the false discovery rate (Benjamini & Hochberg, 1995) are given beside them."
        ),
        (n, false) => format!(
            "The family was declared beforehand and has {n} conditions, over which the family-wise error was held at {alpha} by Holm's (1979) step-down correction; p-values corrected for the false discovery rate (Benjamini & Hochberg, 1995) are given beside them. The other conditions are exploratory and uncorrected."
        ),
    };
    text
}

/// What was left out by rules laid down before, and whom that touched.
fn left_out(analysis: &Analysis) -> Option<String> {
    let exclusions = &analysis.data.exclusions;
    if exclusions.is_empty() {
        return None;
    }
    let rules: Vec<String> = exclusions
        .iter()
        .map(|one| {
            format!(
                "{} ({} participants, {} trials)",
                one.rule,
                one.participants.len(),
                one.trials
            )
        })
        .collect();
    Some(format!(
        "By rules laid down before the data were analysed, these were left out: {}.",
        rules.join("; ")
    ))
}
