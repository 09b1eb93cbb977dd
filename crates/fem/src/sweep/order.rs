//! Which members are left to do, and in which order: the dearest first, so that none of them is
//! left alone at the end.

use std::cmp::Reverse;
use std::collections::HashSet;

use fem_case::CaseError;

use super::identity::Member;
use super::members::Members;
use crate::simulation::Simulation;

/// Those of `own` that `is_done` does not know, each identity once, the dearest first. Each of them
/// could run.
///
/// # Errors
/// The first member that is refused before its model is made.
pub fn left_to_do<'m>(
    members: &(impl Members + ?Sized),
    own: impl IntoIterator<Item = &'m Member>,
    is_done: impl Fn(&Member) -> bool,
) -> Result<Vec<&'m Member>, CaseError> {
    let mut known = HashSet::new();
    let mut left: Vec<(u64, &Member)> = Vec::new();
    for member in own {
        if known.insert(&member.identity) && !is_done(member) {
            left.push((price(members, member.index)?, member));
        }
    }
    left.sort_by_key(|(price, member)| (Reverse(*price), member.index));
    Ok(left.into_iter().map(|(_, member)| member).collect())
}

/// All members, the dearest first; those that are refused cost nothing.
pub fn dearest_first(members: &(impl Members + ?Sized)) -> Vec<usize> {
    let mut order: Vec<usize> = (0..members.n_members()).collect();
    order.sort_by_cached_key(|index| Reverse(price(members, *index).unwrap_or(0)));
    order
}

fn price(members: &(impl Members + ?Sized), index: usize) -> Result<u64, CaseError> {
    members.build(index, |case| Simulation::price(&case))
}
