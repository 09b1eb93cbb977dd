//! In which order members run: the dearest first, so that none of them is left alone at the end.

use std::cmp::Reverse;

use super::members::Members;
use fem_simulation::Simulation;

/// All members, the dearest first; those that are refused cost nothing.
pub fn dearest_first(members: &(impl Members + ?Sized)) -> Vec<usize> {
    let price = |index| members.build(index, |case| Simulation::price(&case)).unwrap_or(0);
    let mut order: Vec<usize> = (0..members.n_members()).collect();
    order.sort_by_cached_key(|index| Reverse(price(*index)));
    order
}
