//! Contact is searched near the axis only, and free flight is not stepped: decisions of the plan.

use fem_case::Scene;
use fem_case::engineering::show;
use fem_collision::{CandidateRegion, Collision};

use crate::effects::effect::Effect;
use crate::effects::effect::neglect_error::NeglectError;
use crate::effects::effect::support::Support;
use crate::estimate::Estimate;

/// The candidate region of the contact search.
#[derive(Clone, Copy, Debug)]
pub struct ContactSearch;

impl ContactSearch {
    /// The effect's name in results.
    pub const NAME: &'static str = "contact search";

    /// Returns the answer of a model that searches this region.
    pub(crate) fn within(candidate_region: &CandidateRegion) -> Support {
        let CandidateRegion { radius, n_points, at_nodes } = candidate_region;
        let points = if *at_nodes { "points" } else { "integration points" };
        let flight = "free flight is not stepped";
        Support::is(
            true,
            format!("{n_points} {points} within {} of the axis; {flight}", show(*radius, "m")),
        )
    }
}

impl Effect for ContactSearch {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn neglect_error(&self, _: &Scene, _: &Estimate) -> Option<NeglectError> {
        Some(NeglectError::NOTHING)
    }

    /// The region may have grown during the run.
    fn found(&self, _: &Scene, collision: &Collision) -> Option<Support> {
        collision.candidate_region.as_ref().map(Self::within)
    }
}
