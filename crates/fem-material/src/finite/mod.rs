//! Finite strain: stored energy and stress at a point of a hyperelastic body of revolution.
//!
//! Quantities are per volume of the undeformed body, as functions of the displacement gradient H, F = 1 + H:
//!
//! ```math
//! W = W(F), \qquad P = \frac{\partial W}{\partial F}, \qquad \tau = P F^T, \qquad \sigma = \tau/J
//! ```
//!
//! with P the first Piola-Kirchhoff stress, τ Kirchhoff's, σ Cauchy's; tension is positive.

mod branches;
mod elastic_plastic;
mod ellipticity;
mod exponential;
mod hencky;
mod hyperelastic;
mod kinematics;
mod logarithm;
mod neo_hooke;
mod neo_hooke_ln;
mod number;
mod principal;
mod saint_venant_kirchhoff;
mod tensor;
mod viscoelastic;
mod viscous;

pub use branches::Branches;
pub use elastic_plastic::{ElasticPlastic, PlasticState, PlasticStress};
pub use ellipticity::least_acoustic_stiffness;
pub use hyperelastic::{Hyperelastic, HyperelasticLaw, Inverted};
pub use neo_hooke::NeoHooke;
pub use number::{
    Number, POWER_OFFSET, UNITS, UNITS_AND_OFFSET, inverse_cube_root, inverse_cube_root_estimate,
    power_of_two,
};
pub use tensor::{AxisymmetricTensor, SymmetricTensor};
pub use viscoelastic::Viscoelastic;
pub use viscous::{InverseMetric, Shape, ViscousStep, ViscousStrain};
