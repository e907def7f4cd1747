//! More than two techniques on one scale: Thurstone's case V in JOD, and Bradley & Terry.
//!
//! [`comparison`] pools the votes, [`graph`] says which scales exist, [`fit`] finds them
//! ([`link`] is the model of a choice, `firth` the penalty), [`scale`] reads values and standard errors off. Beside them:
//! [`pairwise`] differences, [`goodness`] of fit, the [`order_effect`], [`scenes`], and the
//! [`bootstrap`]. [`tables`] and [`findings`] report.

pub mod bootstrap;
pub mod comparison;
mod firth;
pub mod fit;
pub mod goodness;
pub mod graph;
pub mod link;
pub mod order_effect;
pub mod pairwise;
pub mod scale;
pub mod scenes;

mod findings;
mod tables;
#[cfg(test)]
mod tests;

use bootstrap::Bootstrap;
use comparison::Comparisons;
use link::Link;
use order_effect::OrderEffect;
use pairwise::Difference;
use scale::{Component, Method, Scale};
use scenes::{OneScale, Scene};

use super::statistic::{About, Context, Section, StudyStatistic};
use super::table::{Status, Undefined};

/// The models, in the order of the tables.
const LINKS: [Link; 2] = [Link::Thurstone, Link::BradleyTerry];
/// With more techniques the fits would take seconds.
const MOST_TECHNIQUES: usize = 200;
/// With more differences than this their table would drown the report.
const MOST_DIFFERENCES: usize = 1000;

/// The declaration.
pub const STATISTIC: StudyStatistic = StudyStatistic {
    about: About {
        id: "scaling",
        name: "Thurstone case V (JOD) and Bradley–Terry scales",
        formula: "P(i preferred to j) = F(λᵢ − λⱼ), F normal (Thurstone; 1 JOD = 75 % preferred) or logistic (Bradley–Terry); maximum likelihood, the first technique is 0; order effect: logit P(first) = λ(first) − λ(second) + δ",
        source: "L. L. Thurstone (1927), Psychological Review 34(4), 273–286; R. A. Bradley, M. E. Terry (1952), Biometrika 39(3/4), 324–345; existence: L. R. Ford (1957), American Mathematical Monthly 64(8), 28–33; JOD: M. Perez-Ortiz, R. K. Mantiuk (2017), arXiv:1712.03686; order effect: R. R. Davidson, R. J. Beaver (1977), Biometrics 33(4), 693–702; penalty: D. Firth (1993), Biometrika 80(1), 27–38, and I. Kosmidis, D. Firth (2021), Biometrika 108(1), 71–82; expanded percentiles: T. C. Hesterberg (2015), The American Statistician 69(4), 371–386",
        validity: "connected comparisons; finite only where the win graph is strongly connected, else Firth's penalised estimate, marked so; standard errors are asymptotic and take votes as independent; intervals over resampled participants do not",
    },
    section,
};

/// Everything that is computed, before it is put into tables.
struct Scaling {
    table: Comparisons,
    components: Vec<Component>,
    /// Component of every technique.
    labels: Vec<usize>,
    /// By link as in [`LINKS`], then by component.
    scales: [Vec<Result<Scale, Undefined>>; 2],
    bootstrap: Option<Bootstrap>,
    differences: Vec<Difference>,
    order_effect: Option<Result<OrderEffect, Undefined>>,
    scenes: Vec<Scene>,
    one_scale: [Result<OneScale, Undefined>; 2],
}

impl Scaling {
    fn of(context: &Context<'_>, table: Comparisons) -> Self {
        let data = context.data;
        let (components, labels) = scale::components(&table);
        let scales = LINKS.map(|link| {
            components
                .iter()
                .map(|component| component.fit(link))
                .collect::<Vec<_>>()
        });
        let differences = if pairwise::count(&components) > MOST_DIFFERENCES {
            Vec::new()
        } else {
            pairwise::differences(&table, &components, &scales[0], context.settings.alpha)
        };
        let order_effect = order_effect::ordered(data, &table)
            .map(|answers| order_effect::fit(&answers, &components, table.techniques.len()));
        let scenes = scenes::scenes(data);
        Self {
            bootstrap: bootstrap::run(context, &table, &components),
            one_scale: LINKS.map(|link| scenes::one_scale(data, &scenes, link)),
            differences,
            order_effect,
            scenes,
            scales,
            components,
            labels,
            table,
        }
    }

    fn status(&self) -> Status {
        if self.table.pairs.is_empty() {
            Status::Degenerate
        } else if self.labels.iter().any(|label| *label > 0) {
            Status::Disconnected
        } else if self.scales.iter().flatten().all(|scale| {
            scale
                .as_ref()
                .is_ok_and(|scale| scale.method == Method::MaximumLikelihood)
        }) {
            Status::Ok
        } else {
            Status::NoFiniteEstimate
        }
    }
}

fn section(context: &Context<'_>) -> Option<Section> {
    let table = Comparisons::of(&context.data.conditions);
    let techniques = table.techniques.len();
    if techniques < 2 {
        return None;
    }
    let mut section = Section {
        id: "scaling",
        title: "Scale of the techniques",
        status: Status::NotAvailable,
        findings: Vec::new(),
        tables: Vec::new(),
    };
    if techniques > MOST_TECHNIQUES {
        section.findings.push(format!(
            "{techniques} techniques were compared; scales are computed for at most {MOST_TECHNIQUES}."
        ));
        return Some(section);
    }
    let scaling = Scaling::of(context, table);
    section.status = scaling.status();
    section.findings = findings::all(&scaling, context);
    section.tables = tables::all(&scaling, context);
    Some(section)
}
