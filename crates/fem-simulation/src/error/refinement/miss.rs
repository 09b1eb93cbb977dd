//! Quantities that may be off by more than their case allows.

use fem_collision::{Collision, QuantityOfInterest};

use crate::effects::percent;
use crate::error::early_pressure::EarlyPressure;
use crate::error::scatter_of_any_mesh;
use crate::models::method::ElementSetup;
use crate::plan::penalty_compliance::softness;
use crate::simulation::Simulation;

/// An error of more than so many times what soft springs change is one of the mesh: what is told has a margin, and
/// force and pressure change by more than the contact time.
const OF_SPRINGS: f64 = 4.0;
/// Scatter over the tolerance below which it is left out where a finer mesh is chosen.
const SCATTER_OF_TOLERANCE: f64 = 0.25;
/// An error of more is no number any more: it is not resolved at all.
const LARGEST_TOLD: f64 = 0.5;

/// A quantity that may be off by more than the case allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Miss {
    pub(super) headline: QuantityOfInterest,
    /// The restitution's as it is, others as shares.
    pub(super) error: f64,
    pub(super) tolerance: f64,
    /// What of the error is told of every mesh.
    pub(super) scatter: f64,
}

impl Miss {
    pub(super) fn excess(&self) -> f64 {
        self.error / self.tolerance
    }

    /// Whether a mesh could be fine enough.
    pub(super) fn is_of_mesh(&self) -> bool {
        self.scatter < self.tolerance
    }

    /// By how many times what the mesh does is to become less. Where little is scatter that is the excess.
    pub(super) fn excess_of_mesh(&self) -> f64 {
        match self.scatter < SCATTER_OF_TOLERANCE * self.tolerance {
            true => self.excess(),
            false => (self.error - self.scatter) / (self.tolerance - self.scatter),
        }
    }

    /// "peak force may be off by 1.7 % where 1 % is asked".
    pub(super) fn in_words(&self) -> String {
        let (name, error, tolerance) =
            (self.headline.name(), self.error_in_words(), self.number(self.tolerance));
        match error == tolerance {
            true => {
                format!("{name} may be off by a little more than the {tolerance} that is asked")
            }
            false => format!("{name} may be off by {error} where {tolerance} is asked"),
        }
    }

    /// "peak force by 1.7 %", beside another one; with what is asked where that is another number.
    pub(super) fn beside(&self, first: &Self) -> String {
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
        match self.error <= LARGEST_TOLD {
            true => self.number(self.error),
            false => "more than half".to_string(),
        }
    }

    /// An error of its quantity.
    pub(super) fn number(&self, error: f64) -> String {
        match self.headline {
            QuantityOfInterest::Restitution => format!("{error:.1e}"),
            _ => percent(error),
        }
    }

    /// Whether springs of these that are softer than the usual ones are at fault, and not the mesh.
    pub(super) fn is_of_springs(&self, elements: &ElementSetup) -> bool {
        let is_theirs = |softness: f64| self.error <= OF_SPRINGS * softness;
        let is_possible = elements.has_springs && self.headline != QuantityOfInterest::Restitution;
        is_possible && softness(&elements.plan).is_some_and(is_theirs)
    }
}

impl Simulation {
    /// The quantity of a collision that may be off by most of what the case allows, if by more than that.
    pub(crate) fn missed(&self, collision: &Collision) -> Option<Miss> {
        self.all_missed(collision).into_iter().next()
    }

    /// The quantities of a collision that may be off by more than the case allows, in the order of
    /// [`Simulation::misses`].
    pub(super) fn all_missed(&self, collision: &Collision) -> Vec<Miss> {
        let doubt = self.discretisation(collision);
        // Of a pressure that comes much too early there is a warning of its own.
        let early = EarlyPressure::of(self, collision);
        let is_early = early.as_ref().is_some_and(EarlyPressure::is_beyond_reach);
        self.misses(|headline| {
            if headline == QuantityOfInterest::PeakPressure && is_early {
                return None;
            }
            Some(doubt.size(headline)? / headline.scale(headline.of(collision)?))
        })
    }

    /// The quantities that are off by more than the case allows, that which is off by most of it first; those that a
    /// mesh helps before the others.
    fn misses(&self, error: impl Fn(QuantityOfInterest) -> Option<f64>) -> Vec<Miss> {
        let accuracy = self.case().scene().accuracy();
        let scatter = scatter_of_any_mesh(self);
        let of = |(headline, tolerance): (QuantityOfInterest, f64)| {
            let scatter = scatter[headline as usize];
            Some(Miss { headline, error: error(headline)?, tolerance, scatter })
        };
        let all = [
            (QuantityOfInterest::Restitution, accuracy.restitution),
            (QuantityOfInterest::ContactTime, accuracy.contact_time),
            (QuantityOfInterest::PeakForce, accuracy.peak_force),
            (QuantityOfInterest::PeakPressure, accuracy.peak_pressure),
        ];
        let mut missed: Vec<Miss> =
            all.into_iter().filter_map(of).filter(|miss| miss.excess() > 1.0).collect();
        let by_excess = |a: &Miss, b: &Miss| b.excess().total_cmp(&a.excess());
        missed.sort_by(|a, b| b.is_of_mesh().cmp(&a.is_of_mesh()).then(by_excess(a, b)));
        missed
    }

    /// The first of them.
    pub(crate) fn worst_miss(
        &self,
        error: impl Fn(QuantityOfInterest) -> Option<f64>,
    ) -> Option<Miss> {
        self.misses(error).into_iter().next()
    }
}
