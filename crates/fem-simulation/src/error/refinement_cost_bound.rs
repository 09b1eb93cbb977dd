//! Upper bound of the cost of the finer meshes that may follow a collision.

use std::iter::successors;

use super::refinement::{MAX_ELEMENTS, MAX_LEVELS, MAX_UPDATES, may_be_refined};
use crate::models::method::Cost;
use crate::simulation::Simulation;

/// Smallest and largest growth of the element updates from one mesh to the next. The growth is of third order, but rows of
/// elements are whole, and a small refinement may add no row in places.
const GROWTH_OF_UPDATES: [f64; 2] = [1.35, 9.0];
/// Smallest and largest growth of the number of elements, which is of second order.
const GROWTH_OF_ELEMENTS: [f64; 2] = [1.2, 4.5];
/// Largest work of a mesh that is advised over that of a mesh to which the program refines by itself.
const ADVISED_OVER_AUTOMATIC: f64 = 10.0;
/// Power of the number of elements with which the time of condensed bodies grows: 0.85 to 1.2 was measured for four pairs
/// with 700 to 150,000 elements.
const TIME_POWER_OF_ELEMENTS: f64 = 1.2;

/// Upper bound of the finer meshes that may follow a collision, in number and cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefinementBound {
    /// The largest number of finer meshes.
    pub meshes: usize,
    /// Element updates of all finer meshes over those of the collision; for condensed bodies their time.
    pub over_first: f64,
}

impl Simulation {
    /// Returns an upper bound of the finer meshes that may follow the run; `None` if the mesh stays.
    pub fn refinement_bound(&self) -> Option<RefinementBound> {
        let most = most_over_present(self)?;
        let (growth, power) = match self.setup().cost {
            Cost::Factors { .. } => (GROWTH_OF_ELEMENTS, TIME_POWER_OF_ELEMENTS),
            _ => (GROWTH_OF_UPDATES, 1.0),
        };
        let left = MAX_LEVELS.saturating_sub(self.levels().len());
        let of_levels = |n| of_levels(n, most, growth, power);
        let meshes = (1..=left).rev().find(|n| of_levels(*n) > 0.0)?;
        let over_first = (1..=meshes).map(of_levels).fold(0.0, f64::max);
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

/// Returns the cost of `n` finer meshes over that of the first mesh. The last one takes at most `most`, and the cost grows
/// from mesh to mesh by a factor within `growth`. The result is 0 if `n` meshes exceed `most`.
fn of_levels(n: usize, most: f64, growth: [f64; 2], power: f64) -> f64 {
    if most < growth[0].powi(n as i32) {
        return 0.0;
    }
    let from_above = successors(Some(most), |above| Some(above / growth[0]));
    let all = from_above.take(n).enumerate().map(|(k, above)| {
        let from_below = growth[1].powi((n - k) as i32);
        above.min(from_below).powf(power)
    });
    all.sum()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use fem_case::Case;

    use super::super::refinement::REFINEMENT_RATIOS;
    use super::*;

    /// Each mesh takes eight times the one before, until the last ones approach the limit.
    #[test]
    fn refinement_cost_bound_counts_the_largest_meshes() {
        assert_eq!(of_levels(0, 100.0, [2.0, 8.0], 1.0), 0.0);
        assert_eq!(of_levels(1, 1.9, [2.0, 8.0], 1.0), 0.0);
        assert_eq!(of_levels(1, 5.0, [2.0, 8.0], 1.0), 5.0);
        assert_eq!(of_levels(1, 100.0, [2.0, 8.0], 1.0), 8.0);
        assert_eq!(of_levels(3, 100.0, [2.0, 8.0], 1.0), 8.0 + 50.0 + 100.0);
        assert_eq!(of_levels(2, 16.0, [2.0, 8.0], 2.0), 64.0 + 256.0);
    }

    /// The cost of a pair, of a ball on a wall, of unlike and of soft bodies grows within the assumed factors.
    #[test]
    fn cost_grows_within_the_bounds() {
        const BALL: &str = "material.a = { density = 2500, youngs_modulus = 'E', poissons_ratio = 0.3 }
            material.b = { density = 7800, youngs_modulus = '210 GPa', poissons_ratio = 0.28 }
            body = [{ name = 'lower', OTHER },
                    { name = 'upper', sphere.diameter = '1 cm', material = 'a', approach_speed = 1 }]\n";
        for (modulus, other) in [
            ("60 GPa", "sphere.diameter = '1 cm', material = 'a'"),
            ("60 GPa", "wall = {}"),
            ("2 GPa", "sphere.diameter = '4 cm', material = 'b'"),
            ("3 MPa", "wall = {}"),
        ] {
            for (model, [least, most]) in [
                ("model.fem = {}", GROWTH_OF_UPDATES),
                ("model.condensed = {}", GROWTH_OF_ELEMENTS),
            ] {
                let text = BALL.replace("'E'", &format!("'{modulus}'")).replace("OTHER", other);
                let case = Case::parse("ball.toml", &(text + model), Path::new("."), &[]).unwrap();
                let takes = |refinement: f64| {
                    let finer = Simulation::new(case.clone()).unwrap().refined(refinement, vec![]);
                    match finer.unwrap().setup().cost {
                        Cost::Steps { element_updates, .. } => element_updates as f64,
                        Cost::Factors { elements, .. } => elements as f64,
                        Cost::ClosedForm { .. } => unreachable!(),
                    }
                };
                for first in [1.0, 1.25, 1.6] {
                    for by in REFINEMENT_RATIOS {
                        let grew = takes(first * by) / takes(first);
                        let within = least..most;
                        assert!(
                            within.contains(&grew),
                            "{modulus} {other} {model}: {first} {by} {grew}"
                        );
                    }
                }
            }
        }
    }
}
