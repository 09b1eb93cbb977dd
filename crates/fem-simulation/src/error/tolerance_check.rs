//! Compares estimated errors with the tolerances of the case.

use fem_collision::{Collision, QuantityOfInterest};

use super::estimate::ErrorEstimate;
use super::noise_floor::early_pressure_radius;
use crate::effects::percent;
use crate::models::method::ElementSetup;
use crate::plan::penalty_compliance::softness;
use crate::quantity_errors::tolerance_of;
use crate::simulation::Simulation;

/// Errors up to this multiple of the lengthening by soft penalty springs are due to the springs and not to the mesh:
/// estimates have a safety factor, and force and pressure change by more than the contact time.
const OF_SPRINGS: f64 = 4.0;
/// Scatter over the tolerance below which it is neglected in the choice of a finer mesh.
const SCATTER_OF_TOLERANCE: f64 = 0.25;
/// Errors above this are printed as "more than half".
const MAX_PRINTED: f64 = 0.5;

/// A quantity whose estimated error exceeds its tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ToleranceMiss {
    pub quantity: QuantityOfInterest,
    /// Estimated error: the restitution's absolute, others relative.
    pub error: f64,
    pub tolerance: f64,
    /// Part of the error that no mesh reduces.
    pub scatter: f64,
}

impl ToleranceMiss {
    pub fn excess(&self) -> f64 {
        self.error / self.tolerance
    }

    /// Returns whether a mesh could be fine enough.
    pub fn is_of_mesh(&self) -> bool {
        self.scatter < self.tolerance
    }

    /// Returns the factor by which the part of the mesh must fall.
    pub fn excess_of_mesh(&self) -> f64 {
        let scatter = self.scatter;
        match scatter < SCATTER_OF_TOLERANCE * self.tolerance {
            true => self.excess(),
            false => (self.error - scatter) / (self.tolerance - scatter),
        }
    }

    /// Describes the miss: "peak force has an estimated error of 1.7 %, above the tolerance of 1 %".
    pub fn described(&self) -> String {
        let (name, error) = (self.quantity.name(), self.printed_error());
        let tolerance = self.printed(self.tolerance);
        match error == tolerance {
            true => {
                format!("{name} has an estimated error a little above the tolerance of {tolerance}")
            }
            false => {
                format!(
                    "{name} has an estimated error of {error}, above the tolerance of {tolerance}"
                )
            }
        }
    }

    /// Describes a further miss: "peak pressure by 4 % (tolerance 3 %)", without a tolerance that is the first one's.
    pub fn described_after(&self, first: &Self) -> String {
        let (name, error) = (self.quantity.name(), self.printed_error());
        let tolerance = self.printed(self.tolerance);
        let tolerance = match tolerance == first.printed(first.tolerance) {
            true => String::new(),
            false => format!(" (tolerance {tolerance})"),
        };
        let of_any_mesh = match self.is_of_mesh() {
            true => String::new(),
            false => format!(" (of which {} remains on any mesh)", self.printed(self.scatter)),
        };
        format!("{name} by {error}{tolerance}{of_any_mesh}")
    }

    fn printed_error(&self) -> String {
        match self.error < MAX_PRINTED {
            true => self.printed(self.error),
            false => "more than half".to_string(),
        }
    }

    /// Prints an error of the quantity.
    pub fn printed(&self, error: f64) -> String {
        match self.quantity {
            QuantityOfInterest::Restitution => format!("{error:.1e}"),
            _ => percent(error),
        }
    }

    /// Returns whether soft penalty springs are the cause, and not the mesh.
    pub fn is_of_springs(&self, elements: &ElementSetup) -> bool {
        let is_theirs = |softness: f64| self.error <= OF_SPRINGS * softness;
        let is_possible = elements.has_springs && self.quantity != QuantityOfInterest::Restitution;
        is_possible && softness(&elements.plan).is_some_and(is_theirs)
    }
}

/// Returns the quantities of a collision whose estimated errors exceed the tolerance, in the order of [`misses`].
pub(super) fn missed(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Vec<ToleranceMiss> {
    let is_early = early_pressure_radius(simulation, collision).is_some();
    // The pressure of bodies that flow is flat, and its value on the axis converges slowly: no mesh is refined for it.
    let flows = collision.unloaded.is_some();
    misses(simulation, |quantity| {
        if (is_early || flows) && quantity == QuantityOfInterest::PeakPressure {
            return None;
        }
        let error = errors.discretisation(quantity)? / quantity.scale(quantity.of(collision)?);
        Some((error, errors.parts(quantity).map_or(0.0, |parts| parts.scatter)))
    })
}

/// Returns the quantities whose error exceeds the tolerance: first those that a finer mesh improves, the largest excess
/// first. `error` returns an error and its scatter.
pub(super) fn misses(
    simulation: &Simulation,
    error: impl Fn(QuantityOfInterest) -> Option<(f64, f64)>,
) -> Vec<ToleranceMiss> {
    let accuracy = simulation.case().scene().accuracy();
    let of = |quantity| {
        let tolerance = tolerance_of(&accuracy, quantity)?;
        let (error, scatter) = error(quantity)?;
        Some(ToleranceMiss { quantity, error, tolerance, scatter })
    };
    let all = QuantityOfInterest::ALL;
    let mut missed: Vec<ToleranceMiss> =
        all.into_iter().filter_map(of).filter(|miss| miss.excess() > 1.0).collect();
    let by_excess = |a: &ToleranceMiss, b: &ToleranceMiss| b.excess().total_cmp(&a.excess());
    missed.sort_by(|a, b| b.is_of_mesh().cmp(&a.is_of_mesh()).then(by_excess(a, b)));
    missed
}
