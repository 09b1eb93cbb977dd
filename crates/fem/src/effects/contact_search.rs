//! Contact is looked for near the axis only, and free flight is not stepped: a decision of the plan.

use super::effect::Effect;

/// Where contact is looked for.
#[derive(Clone, Copy, Debug)]
pub struct ContactSearch;

impl Effect for ContactSearch {
    fn name(&self) -> &'static str {
        "contact search"
    }
}
