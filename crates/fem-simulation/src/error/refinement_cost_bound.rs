//! Upper bound of the cost of the finer meshes that may follow a collision.

use super::refinement::{MAX_ELEMENTS, MAX_LEVELS, MAX_UPDATES, may_be_refined};
use crate::models::method::Cost;
use crate::simulation::Simulation;

/// Largest work of a mesh that is advised over that of a mesh to which the program refines by itself.
const ADVISED_OVER_AUTOMATIC: f64 = 10.0;

/// Upper bound of the finer meshes that may follow a collision, in number and cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefinementBound {
    /// The largest number of finer meshes.
    pub meshes: usize,
    /// Element updates of all finer meshes over those of the collision; for condensed bodies their elements.
    pub over_first: f64,
}

impl Simulation {
    /// Returns an upper bound of the finer meshes that may follow the run, each as large as the largest to which the program refines
    /// by itself; `None` if the mesh stays.
    pub fn refinement_bound(&self) -> Option<RefinementBound> {
        let most = most_over_present(self).filter(|most| *most > 1.0)?;
        let meshes = MAX_LEVELS.checked_sub(self.levels().len()).filter(|left| *left > 0)?;
        let over_first = meshes as f64 * most;
        may_be_refined(self).then_some(RefinementBound { meshes, over_first })
    }
}

/// Returns the largest work of a finer mesh over that of the present one: element updates, or elements of condensed bodies.
fn most_over_present(simulation: &Simulation) -> Option<f64> {
    let (present, most) = match simulation.setup().cost {
        Cost::Steps { element_updates, .. } => {
            let limit = simulation.case().scene().limits().element_updates;
            (element_updates, limit.unwrap_or(MAX_UPDATES))
        }
        Cost::Factors { elements, .. } => (elements, MAX_ELEMENTS),
        Cost::ClosedForm { .. } => return None,
    };
    Some(most as f64 / present as f64)
}

/// Returns the ratio by which elements may become smaller on a mesh that is advised: element updates grow with its third
/// power, elements with its second.
pub(super) fn affordable_ratio(simulation: &Simulation) -> f64 {
    let most = ADVISED_OVER_AUTOMATIC * most_over_present(simulation).unwrap_or(0.0);
    match simulation.setup().cost {
        Cost::Factors { .. } => most.sqrt(),
        _ => most.cbrt(),
    }
}
