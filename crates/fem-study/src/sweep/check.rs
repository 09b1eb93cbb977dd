//! Checks every member before the first one runs: its identity, whether it can run, and the order of the members that
//! are left.
//!
//! Members are made, checked and dropped, some at a time on all threads; a sweep keeps three numbers per
//! member.

use std::cmp::Reverse;
use std::collections::HashSet;

use fem_case::schema::MeshTable;
use fem_case::{Case, CaseError, CaseFile};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::members::{Member, Members};
use fem_simulation::{Simulation, WarningKinds};

/// Number of members that are made at the same time.
const AT_ONCE: usize = 64;

/// The members of a sweep as far as they are known before the first one runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checked {
    /// The members that were checked, in order.
    pub members: Vec<Member>,
    /// Indices of the members to run, each identity once, the most expensive first, so that no long run is
    /// left at the end.
    pub left: Vec<usize>,
    /// Estimated cost of each of those by its element updates alone, s on one core of 3 GHz; an order of
    /// magnitude.
    pub seconds: Vec<f64>,
    /// Doubts about members before they run: implausible values, such as a ball of 1 km, and a tolerance
    /// that no mesh meets.
    pub warnings: WarningKinds,
    /// Suggestions that make the sweep cheaper.
    pub advice: Option<&'static str>,
}

/// A member that was checked.
struct CheckedMember {
    member: Member,
    case: CaseFile,
    /// Cost estimate of a member that is still to run.
    element_updates: Option<u64>,
    warnings: Vec<String>,
}

/// Checks all members. Those that are `is_own` and not `is_done` are left to run; `see` is called for each member in
/// order.
///
/// # Errors
/// A member is no valid case, or its model rejects it; the error of the first such member.
pub fn check(
    members: &(impl Members + ?Sized),
    is_own: impl Fn(usize) -> bool + Sync,
    is_done: impl Fn(&Member) -> bool + Sync,
    see: impl FnMut(&Member, &CaseFile),
) -> Result<Checked, CaseError> {
    let all: Vec<usize> = (0..members.n_members()).collect();
    check_some(members, &all, is_own, is_done, see)
}

/// Checks only the members of these indices, in this order; see [`check`].
///
/// # Errors
/// As [`check`].
pub fn check_some(
    members: &(impl Members + ?Sized),
    places: &[usize],
    is_own: impl Fn(usize) -> bool + Sync,
    is_done: impl Fn(&Member) -> bool + Sync,
    mut see: impl FnMut(&Member, &CaseFile),
) -> Result<Checked, CaseError> {
    let look = |index: usize, case: &Case| {
        case.check_units(false)?;
        let (member, resolved) = Member::resolved(index, case)?;
        let is_left = is_own(index) && !is_done(&member);
        let expected = is_left.then(|| Simulation::expected_of(case)).transpose()?;
        let element_updates = expected.as_ref().map(|expected| expected.element_updates);
        let mut warnings = case.scene().implausible_numbers();
        warnings.extend(expected.and_then(|expected| expected.out_of_reach));
        Ok(CheckedMember { member, case: resolved, element_updates, warnings })
    };
    let mut checked = Checked { members: Vec::with_capacity(places.len()), ..Checked::default() };
    let (mut known, mut prices, mut meshes) = (HashSet::new(), Vec::new(), Meshes::default());
    for some in places.chunks(AT_ONCE) {
        let made = some.par_iter().map(|&index| members.build(index, |case| look(index, &case)));
        let made: Vec<Result<CheckedMember, CaseError>> = made.collect();
        for seen in made {
            let seen = seen.map_err(|first| {
                members.with_other_faults(first, |case| look(usize::MAX, &case).map(drop))
            });
            let CheckedMember { member, case, element_updates, warnings } = seen?;
            for warning in warnings {
                checked.warnings.add(member.index, &warning);
            }
            see(&member, &case);
            checked.members.push(member);
            if let Some(element_updates) = element_updates
                && known.insert(member.digest)
            {
                prices.push((
                    Reverse(element_updates),
                    member.index,
                    seconds(&case, element_updates),
                ));
                meshes.see(member.index, &case);
            }
        }
    }
    prices.sort_unstable_by_key(|(element_updates, index, _)| (*element_updates, *index));
    (checked.left, checked.seconds) =
        prices.into_iter().map(|(_, index, seconds)| (index, seconds)).unzip();
    checked.advice = meshes.advice(members)?;
    Ok(checked)
}

/// Whether condensed members have different meshes: a mesh that the case leaves open depends on the expected contact,
/// and so on the speed.
#[derive(Default)]
struct Meshes {
    first: Option<Option<MeshTable>>,
    /// The first member with another mesh.
    other: Option<usize>,
}

impl Meshes {
    fn see(&mut self, index: usize, case: &CaseFile) {
        let is_condensed = case.model.as_ref().is_some_and(|model| model.condensed.is_some());
        if !is_condensed || self.other.is_some() {
            return;
        }
        if *self.first.get_or_insert_with(|| case.mesh.clone()) != case.mesh {
            self.other = Some(index);
        }
    }

    fn advice(&self, members: &(impl Members + ?Sized)) -> Result<Option<&'static str>, CaseError> {
        let Some(other) = self.other else { return Ok(None) };
        let case = members.case(other)?;
        let mesh = case.scene().mesh();
        let is_open = mesh.contact_element_size.is_none() || mesh.refined_radius.is_none();
        Ok(is_open.then_some(
            "members have meshes of their own; give mesh.contact_element_size and \
             mesh.refined_radius, and those of equal bodies share one factor",
        ))
    }
}

/// Seconds per element update on one core of 3 GHz, with one or two Prony terms.
const SECONDS_AN_UPDATE: f64 = 8e-9;
/// Seconds per member with condensed bodies, which share their factors with others.
const SECONDS_OF_CONDENSED: f64 = 0.1;
/// Seconds per member without a mesh.
const SECONDS_WITHOUT_MESH: f64 = 2e-3;

/// Returns the estimated seconds of a member on one core of 3 GHz, for a resolved case and its number of
/// element updates.
fn seconds(case: &CaseFile, updates: u64) -> f64 {
    let is_condensed = case.model.as_ref().is_some_and(|model| model.condensed.is_some());
    let least = if is_condensed { SECONDS_OF_CONDENSED } else { SECONDS_WITHOUT_MESH };
    least + SECONDS_AN_UPDATE * updates as f64
}
