//! The estimated errors of a collision, the parts of its error bars, and the reason why its mesh is not refined.

use fem_case::CaseError;
use fem_collision::QuantityOfInterest;

use super::elastic_null::ElasticNull;
use super::stress_error::StressError;
use crate::effects::EffectDecisions;
use crate::quantity_errors::QuantityErrors;

/// The estimated errors of a collision.
#[derive(Debug, Default)]
pub struct ErrorEstimate {
    pub(crate) bars: QuantityErrors,
    pub(super) parts: [Option<BarParts>; 6],
    /// Discretisation errors of the restitutions of the contacts of a bouncing ball, of no more than the first ten.
    pub(crate) of_bounces: Vec<Option<f64>>,
    /// Loss of a relaxing run without relaxation.
    pub elastic_null: Option<ElasticNull>,
    /// Error of the recovered stress near the contact; `None` without a reference run or a snapshot.
    pub stress_error: Option<StressError>,
    /// Element updates of all reference runs so far, those of coarser meshes included.
    pub element_updates: u64,
    /// The effects of the collision, on which error bars and warnings depend.
    pub(crate) decisions: EffectDecisions,
    /// The reason why the mesh stays, if the tolerance is missed.
    pub(super) not_refined: Option<NotRefined>,
}

/// The parts of an error bar before the noise of the run: the restitution's absolute, others relative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarParts {
    /// Name of the row of calibrated constants.
    pub constants: &'static str,
    /// Distance from the Richardson limit of the reference runs.
    pub reference_error: f64,
    /// Safety factor on this distance.
    pub safety_factor: f64,
    /// Elements across the contact.
    pub across: f64,
    /// Floor by the place of the contact's edge.
    pub edge: f64,
    /// Floor by the scatter that remains on any mesh.
    pub scatter: f64,
    /// Floor by moved mass.
    pub moved_mass: f64,
}

impl BarParts {
    /// Returns safety factor × reference error + edge + scatter + moved mass.
    pub fn sum(&self) -> f64 {
        // The last two first: the order of the sum decides its last bit.
        self.safety_factor * self.reference_error + self.edge + (self.scatter + self.moved_mass)
    }
}

impl ErrorEstimate {
    /// Returns the discretisation error of a quantity, SI; `None` if it is not estimated.
    pub fn discretisation(&self, quantity: QuantityOfInterest) -> Option<f64> {
        self.bars.size(quantity)
    }

    /// Returns the parts of the error bar of a model with elements, without the noise of the run.
    pub fn parts(&self, quantity: QuantityOfInterest) -> Option<BarParts> {
        self.parts[quantity as usize]
    }
}

/// The reason why a mesh stays although the tolerance is missed.
#[derive(Debug)]
pub(super) enum NotRefined {
    /// The case gives the element size.
    Given,
    FromFile,
    Gravity,
    /// Another setting of the case is the cause.
    Setting(FaultySetting),
    /// The scatter of any mesh exceeds the tolerance.
    Scatter(f64),
    TooExpensive {
        updates: Option<u64>,
    },
    Rejected(CaseError),
    /// The collision failed on a finer mesh.
    Stopped(String),
}

/// A setting of the case whose error a finer mesh does not reduce.
#[derive(Clone, Copy, Debug)]
pub(super) enum FaultySetting {
    MovedMass,
    SoftSprings,
    ChatteringSprings,
    /// The key that gives the mesh away from the contact.
    FarMesh(&'static str),
}

impl FaultySetting {
    pub fn described(self) -> &'static str {
        match self {
            Self::MovedMass => "mass scaling",
            Self::SoftSprings => "soft penalty springs",
            Self::ChatteringSprings => "contact chatter",
            Self::FarMesh(_) => "the mesh away from the contact",
        }
    }

    /// Returns the key to leave out.
    pub fn key(self) -> &'static str {
        match self {
            Self::MovedMass => "time.mass_scaling",
            Self::SoftSprings | Self::ChatteringSprings => "contact.penalty_factor",
            Self::FarMesh(key) => key,
        }
    }
}
