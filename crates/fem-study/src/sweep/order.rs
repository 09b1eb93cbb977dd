//! The order in which members run: the most expensive first, so that no long run is left at the end.

use std::cmp::Reverse;

use super::members::Members;
use fem_simulation::Simulation;

/// Returns all members, the most expensive first; rejected ones cost nothing.
pub fn dearest_first(members: &(impl Members + ?Sized)) -> Vec<usize> {
    let price = |index| members.build(index, |case| Simulation::price(&case)).unwrap_or(0);
    let mut order: Vec<usize> = (0..members.n_members()).collect();
    order.sort_by_cached_key(|index| Reverse(price(*index)));
    order
}
