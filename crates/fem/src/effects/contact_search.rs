//! Contact is looked for near the axis only, and free flight is not stepped: a decision of the plan.

use fem_collision::Searched;

use super::answer::Answer;
use super::effect::Effect;

/// Where contact is looked for.
#[derive(Clone, Copy, Debug)]
pub struct ContactSearch;

impl ContactSearch {
    /// Its name in results.
    pub const NAME: &'static str = "contact search";

    /// What a model has of it that looks for contact here.
    pub(crate) fn within(searched: &Searched) -> Answer {
        Answer::is(true, Self::reason(searched))
    }

    /// Where contact is looked for, in words.
    pub(crate) fn reason(searched: &Searched) -> String {
        let Searched { radius, n_points, at_nodes } = searched;
        let points = if *at_nodes { "points" } else { "integration points" };
        format!("{n_points} {points} within {radius:.4e} m of the axis; free flight is not stepped")
    }
}

impl Effect for ContactSearch {
    fn name(&self) -> &'static str {
        Self::NAME
    }
}
