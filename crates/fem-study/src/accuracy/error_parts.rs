//! Where the error of explicit elements with eight of them across the contact comes from.

use fem_collision::QuantityOfInterest;

/// The source of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorSource {
    /// Elements are of finite size: as condensed bodies have it on the same mesh.
    Mesh,
    /// The penalty springs between the surfaces are compliant: from a run with four times their stiffness,
    /// extrapolated.
    ContactSprings,
    /// Mass is added for a longer step: against a run without.
    AddedMass,
    /// Steps are of finite length: of second order, from half the step.
    TimeStep,
    /// Condensed bodies have no waves and no large strains: what explicit elements add to them.
    LeftOutByCondensed,
    /// Strains are taken as small: against a run at finite strain, with springs between nodes that have
    /// mass in both.
    SmallStrain,
}

impl ErrorSource {
    /// Its name for readers.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::ContactSprings => "contact springs",
            Self::AddedMass => "added mass",
            Self::TimeStep => "time step",
            Self::LeftOutByCondensed => "left out by condensed",
            Self::SmallStrain => "small strain",
        }
    }
}

/// An error and its source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorPart {
    /// The source of the error.
    pub source: ErrorSource,
    /// Its contribution to each quantity, in the order of [`QuantityOfInterest::ALL`]: the restitution's
    /// absolute, all others relative.
    pub errors: [Option<f64>; 6],
}

impl ErrorPart {
    /// The difference of two sets of values over the limits, times a factor.
    pub(super) fn between(
        source: ErrorSource,
        values: [Option<f64>; 6],
        others: [Option<f64>; 6],
        limits: [Option<f64>; 6],
        factor: f64,
    ) -> Self {
        let errors = QuantityOfInterest::ALL.map(|quantity| {
            let k = quantity as usize;
            Some(factor * (values[k]? - others[k]?) / quantity.scale(limits[k]?))
        });
        Self { source, errors }
    }
}
