//! Effects of the numerical method, and those that a model either has or lacks without a decision.

mod bulk_viscosity;
pub(crate) mod mass_scaling;
mod mirror_symmetry;

use fem_case::Scene;
use fem_case::engineering::show;
use fem_collision::{CandidateRegion, Collision};

use super::decision::neglect_error::NeglectError;
use super::decision::support::Support;
use super::decision::{ContactSearch, DashpotEffect, Effect, HourglassControl, PenaltySprings};
use crate::estimate::Estimate;

impl Effect for DashpotEffect {}

impl Effect for HourglassControl {}

impl Effect for PenaltySprings {}

impl ContactSearch {
    /// Returns the support of a model that searches this region.
    pub(crate) fn within(candidate_region: &CandidateRegion) -> Support {
        let CandidateRegion { radius, n_points, at_nodes } = candidate_region;
        let points = if *at_nodes { "points" } else { "integration points" };
        let radius = show(*radius, "m");
        Support::decided(
            true,
            format!(
                "contact is searched at {n_points} {points} within {radius} of the axis; steps begin at first touch"
            ),
        )
    }
}

impl Effect for ContactSearch {
    fn neglect_error(&self, _: &Scene, _: &Estimate) -> Option<NeglectError> {
        Some(NeglectError::NOTHING)
    }

    /// The region may have grown during the run.
    fn support_in_result(&self, _: &Scene, collision: &Collision) -> Option<Support> {
        collision.candidate_region.as_ref().map(Self::within)
    }
}
