//! Was each condition shown equally often in both orders, and could it have been?

use super::{Check, Verdict};
use crate::analysis::conclusion::{listed, plural};
use crate::analysis::dataset::Dataset;
use crate::analysis::table::Undefined;

const CHECK: &str = "orders within pairs";
const UNEVEN_COUNTS: Undefined = Undefined::not_available(
    "needs single answers, or the same number of votes in every condition",
);

/// From the orders shown where they are known, else from what the design of 2010 must give.
pub fn checks(data: &Dataset) -> Vec<Check> {
    let design = design(data);
    let shown: Vec<(&str, (u32, u32))> = (data.conditions.iter())
        .filter_map(|c| c.orders.map(|counts| (c.id.as_str(), counts.orders())))
        .collect();
    if shown.is_empty() {
        return vec![design.map_or_else(
            || Check::undefined(CHECK, UNEVEN_COUNTS),
            |(n, k, orders)| {
                let verdict = if orders.0 == orders.1 {
                    Verdict::Ok
                } else {
                    Verdict::Note
                };
                Check::new(CHECK, verdict, explained(n, k, orders))
            },
        )];
    }
    // One apart cannot be helped where the number is odd.
    let uneven: Vec<String> = (shown.iter())
        .filter(|(_, (ab, ba))| ab.abs_diff(*ba) > 1)
        .map(|(id, (ab, ba))| format!("{id} {ab} : {ba}"))
        .collect();
    if uneven.is_empty() {
        let all = plural(shown.len(), "condition");
        return vec![Check::new(
            CHECK,
            Verdict::Ok,
            format!("even in all of {all}"),
        )];
    }
    let names: Vec<&str> = uneven.iter().map(String::as_str).collect();
    let mut finding = format!(
        "answered more often in one order in {} of {}: {}",
        uneven.len(),
        plural(shown.len(), "condition"),
        listed(&names),
    );
    if let Some((n, k, orders)) = design
        && orders.0 != orders.1
    {
        finding += &format!("; {}", explained(n, k, orders));
    }
    vec![Check::new(CHECK, Verdict::Note, finding)]
}

fn explained(n: u32, k: u32, (more, fewer): (u32, u32)) -> String {
    let block = 2 * k;
    if more == fewer {
        return format!(
            "{n} participants are whole blocks of {block}, twice the {k} conditions: a Latin design that reverses the pairs by halves of a block shows every condition {more} times in each order"
        );
    }
    format!(
        "{n} participants are no multiple of {block}, twice the {k} conditions: a Latin design that reverses the pairs by halves of a block shows every condition {more} times in one order and {fewer} times in the other"
    )
}

/// Participants, conditions, and how often each order is shown, where every participant answered
/// every condition: then the votes of a condition are as many as the participants.
fn design(data: &Dataset) -> Option<(u32, u32, (u32, u32))> {
    let n = data.conditions.first()?.votes.total();
    let k = u32::try_from(data.conditions.len()).ok()?;
    let same = data.conditions.iter().all(|c| c.votes.total() == n);
    (same && n > 0 && k < 1 << 30).then(|| (n, k, latin_orders(n, k)))
}

/// How often `n` participants see a condition in the base order and turned round, in a Latin design
/// over `k` conditions that is run once as it is and once with all pairs reversed, and so on.
pub(super) fn latin_orders(n: u32, k: u32) -> (u32, u32) {
    let (blocks, rest) = (n / (2 * k), n % (2 * k));
    let as_is = blocks * k + rest.min(k);
    (as_is, n - as_is)
}
