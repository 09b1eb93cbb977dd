//! Compares estimated errors with the tolerances of the case.

use fem_collision::{Collision, QuantityOfInterest};

use super::calibration::SCATTER;
use super::estimator::{ErrorEstimate, early_pressure_radius};
use crate::effects::percent;
use crate::models::method::ElementSetup;
use crate::plan::penalty_compliance::softness;
use crate::simulation::Simulation;

/// Errors up to this multiple of what soft penalty springs change are theirs and not the mesh's: estimates have a safety
/// factor, and force and pressure change by more than the contact time.
const OF_SPRINGS: f64 = 4.0;
/// Scatter over the tolerance below which it is neglected where a finer mesh is chosen.
const SCATTER_OF_TOLERANCE: f64 = 0.25;
/// A larger error is printed as "more than half".
const LARGEST_PRINTED: f64 = 0.5;

/// A quantity whose estimated error exceeds its tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ToleranceMiss {
    pub headline: QuantityOfInterest,
    /// The restitution's absolute, others relative.
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
        match self.scatter < SCATTER_OF_TOLERANCE * self.tolerance {
            true => self.excess(),
            false => (self.error - self.scatter) / (self.tolerance - self.scatter),
        }
    }

    /// "peak force may be off by 1.7 % where 1 % is asked".
    pub fn in_words(&self) -> String {
        let (name, error, tolerance) =
            (self.headline.name(), self.error_in_words(), self.number(self.tolerance));
        match error == tolerance {
            true => {
                format!("{name} may be off by a little more than the {tolerance} that is asked")
            }
            false => format!("{name} may be off by {error} where {tolerance} is asked"),
        }
    }

    /// "peak force by 1.7 %", after another miss; with its tolerance where that is another number.
    pub fn after(&self, first: &Self) -> String {
        let (name, error, tolerance) =
            (self.headline.name(), self.error_in_words(), self.number(self.tolerance));
        let asked = match tolerance == first.number(first.tolerance) {
            true => String::new(),
            false => format!(" where {tolerance} is asked"),
        };
        let of_any_mesh = match self.is_of_mesh() {
            true => String::new(),
            false => format!(" ({} of it on any mesh)", self.number(self.scatter)),
        };
        format!("{name} by {error}{asked}{of_any_mesh}")
    }

    fn error_in_words(&self) -> String {
        match self.error < LARGEST_PRINTED {
            true => self.number(self.error),
            false => "more than half".to_string(),
        }
    }

    /// Prints an error of the quantity.
    pub fn number(&self, error: f64) -> String {
        match self.headline {
            QuantityOfInterest::Restitution => format!("{error:.1e}"),
            _ => percent(error),
        }
    }

    /// Returns whether soft penalty springs are at fault, and not the mesh.
    pub fn is_of_springs(&self, elements: &ElementSetup) -> bool {
        let is_theirs = |softness: f64| self.error <= OF_SPRINGS * softness;
        let is_possible = elements.has_springs && self.headline != QuantityOfInterest::Restitution;
        is_possible && softness(&elements.plan).is_some_and(is_theirs)
    }
}

/// Returns the quantities whose estimated errors exceed the tolerance, as [`misses`].
pub(super) fn missed(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Vec<ToleranceMiss> {
    let is_early = early_pressure_radius(simulation, collision).is_some();
    misses(simulation, |headline| {
        if is_early && headline == QuantityOfInterest::PeakPressure {
            return None;
        }
        Some(errors.discretisation(headline)? / headline.scale(headline.of(collision)?))
    })
}

/// Returns the quantities whose error exceeds the tolerance: those that a mesh helps first, the largest excess first.
pub(super) fn misses(
    simulation: &Simulation,
    error: impl Fn(QuantityOfInterest) -> Option<f64>,
) -> Vec<ToleranceMiss> {
    let accuracy = simulation.case().scene().accuracy();
    let of = |(headline, tolerance): (QuantityOfInterest, f64)| {
        let scatter = SCATTER[headline as usize];
        Some(ToleranceMiss { headline, error: error(headline)?, tolerance, scatter })
    };
    let all = [
        (QuantityOfInterest::Restitution, accuracy.restitution),
        (QuantityOfInterest::ContactTime, accuracy.contact_time),
        (QuantityOfInterest::PeakForce, accuracy.peak_force),
        (QuantityOfInterest::PeakPressure, accuracy.peak_pressure),
    ];
    let mut missed: Vec<ToleranceMiss> =
        all.into_iter().filter_map(of).filter(|miss| miss.excess() > 1.0).collect();
    let by_excess = |a: &ToleranceMiss, b: &ToleranceMiss| b.excess().total_cmp(&a.excess());
    missed.sort_by(|a, b| b.is_of_mesh().cmp(&a.is_of_mesh()).then(by_excess(a, b)));
    missed
}
