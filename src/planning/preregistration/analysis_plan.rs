//! What will be made of the answers.

use super::{Asked, Study, item, line, listed};

impl Study<'_> {
    pub(super) fn analyses(&self, out: &mut String) {
        line(out, "## Analysis plan");
        line(out, "### Statistical models");
        for text in self.main_analysis() {
            line(out, &text);
        }
        line(out, "### Inference criteria");
        let alpha = self.facts.analysis.alpha;
        line(
            out,
            &format!(
                "alpha = {} for the family as a whole; all tests are two-sided; intervals have a confidence of {} %. A difference that is significant before the correction only is reported as not significant.",
                alpha.get(),
                alpha.confidence_percent()
            ),
        );
        line(out, "### Data exclusion");
        self.exclusions(out);
        line(out, "### Missing data");
        line(
            out,
            match self.protocol.cannot_tell {
                true => {
                    "A trial answered with \"cannot tell\" is no vote for either technique: it is left out of the tests, and the number of such answers is reported by condition. Trials without an answer are left out and counted."
                }
                false => "A trial without an answer is left out and counted; nothing is imputed.",
            },
        );
        line(out, "### Exploratory and secondary analyses");
        for text in self.secondary() {
            item(out, text);
        }
        line(
            out,
            "\nThese are not of the family that is corrected; their p-values are reported as exploratory.",
        );
    }

    fn main_analysis(&self) -> Vec<String> {
        let family = match self.facts.analysis.family.is_empty() {
            true => format!("all {} conditions", self.family),
            false => {
                let ids: Vec<&str> = self
                    .facts
                    .analysis
                    .family
                    .iter()
                    .map(String::as_str)
                    .collect();
                format!("the {} conditions {}", self.family, listed(&ids))
            }
        };
        let alpha = self.facts.analysis.alpha.get();
        match self.asked {
            Asked::Choice => vec![
                format!("Main analysis. For each condition, the votes for its two techniques are tested against an even split by the exact binomial test, two-sided. The p-values are corrected by Holm's (1979) procedure over the family of {family}, at alpha = {alpha}. A condition supports the hypothesis it asks if the corrected p is at most alpha and, where the hypothesis names a side, more votes are on that side."),
                "Reported for every condition, significant or not: both counts, the share of technique b with its Clopper–Pearson and Wilson intervals, Cohen's g, the exact p before and after the correction.".to_owned(),
            ],
            Asked::Ratings => vec![format!(
                "Main analysis. For each scene and each scale, the versions are compared by Friedman's test on the participants' ratings, with Kendall's W as its effect size; the p-values are corrected by Holm's (1979) procedure over all scenes and scales ({} tests), at alpha = {alpha}. Where it is significant, pairs of versions are compared, Holm-corrected. Means, medians and their intervals are reported for every version, significant or not.",
                self.family
            )],
            Asked::Ranking => vec![format!(
                "Main analysis. For each scene, the participants' rank orders of its versions are compared by Friedman's test, with Kendall's W as its effect size; the p-values are corrected by Holm's (1979) procedure over all {} scenes, at alpha = {alpha}. Where it is significant, pairs of versions are compared, Holm-corrected. Mean ranks are reported for every version, significant or not.",
                self.family
            )],
        }
    }

    fn exclusions(&self, out: &mut String) {
        let plan = &self.facts.analysis;
        let mut rules = Vec::new();
        if let Some(ms) = plan.minimum_response_ms {
            rules.push(format!("Answers faster than {ms} ms are left out."));
        }
        if let Some(ms) = plan.maximum_response_ms {
            rules.push(format!("Answers slower than {ms} ms are left out."));
        }
        if let (true, Some(catch)) = (plan.exclude_failed_catch, &self.protocol.catch) {
            rules.push(format!(
                "Participants with fewer than {} of the {} attention checks right are left out.",
                catch.minimum_correct.get(),
                catch.trials.len()
            ));
        }
        if let Some(trials) = plan.minimum_main_trials {
            rules.push(format!(
                "Participants with fewer than {trials} answered main trials are left out."
            ));
        }
        rules.push("Practice trials and attention checks are not of the main analysis.".to_owned());
        rules.push("A participant whom the experimenter rejects (a technical failure, instructions not followed) is left out; who, when and why is on record before the data are analysed, and reported.".to_owned());
        for rule in &rules {
            item(out, rule);
        }
        line(
            out,
            "\nNo other data are left out. How many each rule touches is reported.",
        );
    }

    fn secondary(&self) -> &'static [&'static str] {
        match self.asked {
            Asked::Choice => &[
                "Position bias: how often the image shown first is chosen, over all trials, by participant and by condition, by the exact binomial test; and how even the orders were.",
                "Order: whether the choice depends on which technique was shown first (Cochran–Mantel–Haenszel over the conditions).",
                "The same participants in two conditions of one pair of techniques: McNemar's exact test.",
                "The techniques on one scale: Bradley–Terry and Thurstone case V (in just-objectionable differences), where the pairs connect them, with standard errors and goodness of fit.",
                "The chi-square test of each condition beside the exact one, for comparison with earlier studies.",
                "Response times on a logarithmic scale, by condition and position.",
            ],
            Asked::Ratings => &[
                "Agreement between participants, and outlying ones.",
                "Response times on a logarithmic scale, by condition and position.",
            ],
            Asked::Ranking => &[
                "The versions on one scale: Bradley–Terry on the pairs that the rank orders imply, which are not independent within a participant, so that its standard errors are a lower bound.",
                "Agreement between participants (Kendall's W), and outlying ones.",
                "Response times on a logarithmic scale, by condition and position.",
            ],
        }
    }
}
