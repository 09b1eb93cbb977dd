//! What the members of a sweep warn of: each kind once, with how many have it and the first of them.

use fem::{WarningKind, WarningKinds};
use fem_case::Sweep;

use crate::standard_output::one_line;

/// Kinds that are told.
const MOST_TOLD: usize = 20;

/// A line a kind, those of the most members first; of those that are left out that there are. What was `told` before is
/// not told again.
pub fn lines<'t>(
    warnings: &WarningKinds,
    sweep: &Sweep,
    told: impl Iterator<Item = &'t String> + Clone,
) -> Vec<String> {
    let is_new = |kind: &&WarningKind| !told.clone().any(|text| kind.is_of(text));
    let mut kinds: Vec<&WarningKind> = warnings.all().iter().filter(is_new).collect();
    kinds.sort_by_key(|kind| std::cmp::Reverse(kind.count));
    let line = |kind: &&WarningKind| {
        let (text, first) = (&kind.first, sweep.describe(kind.place));
        one_line(&match kind.count {
            1 => format!("{text} (1 member: {first})"),
            n => format!("{text} ({n} members, numbers are of the first: {first})"),
        })
    };
    let mut lines: Vec<String> = kinds.iter().take(MOST_TOLD).map(line).collect();
    let n_untold = kinds.len().saturating_sub(MOST_TOLD) + warnings.n_others();
    if n_untold > 0 {
        lines.push(format!("… and {n_untold} more, in the column `warnings` of sweep.csv"));
    }
    lines
}
