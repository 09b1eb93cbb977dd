//! Effects of the materials: relaxation, finite strain and first yield.

pub(super) mod finite_strain;
mod plastic_yield;
mod viscoelasticity;

pub use finite_strain::FiniteStrain;
pub use plastic_yield::PlasticYield;
pub use viscoelasticity::Viscoelasticity;
