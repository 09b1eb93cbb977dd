//! Finite strain: what a point of a hyperelastic body of revolution stores and exerts.
//!
//! All is per volume of the undeformed body, of the displacement gradient H, F = 1 + H:
//!
//! ```math
//! W = W(F), \qquad P = \frac{\partial W}{\partial F}, \qquad \tau = P F^T, \qquad \sigma = \tau/J
//! ```
//!
//! with P the first Piola-Kirchhoff stress, τ Kirchhoff's, σ Cauchy's; tension is positive.

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

pub use hyperelastic::{Hyperelastic, HyperelasticLaw, Inverted};
pub use neo_hooke::NeoHooke;
pub use number::{Number, inverse_cube_root, inverse_cube_root_estimate};
pub use tensor::{AxisymmetricTensor, SymmetricTensor};
