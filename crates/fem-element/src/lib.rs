//! Axisymmetric four-node elements.
//!
//! Degrees of freedom are ordered (u_r, u_y) of corner 0, of corner 1, …; the
//! strain is (ε_rr, ε_yy, ε_θθ, γ_ry). All integrals are over the body of
//! revolution, 2π r dA.
//!
//! * [`QuadGeometry`]: the geometry of an element;
//! * [`mean_gradient`]: the element of all models, one mean stress with hourglass
//!   stiffness, as bulk and deviatoric matrices;
//! * [`b_bar`]: a fully integrated element with mean dilatation, the reference for
//!   tests;
//! * [`largest_eigenvalue`]: the largest eigenvalue of an element's stiffness against its masses.

mod eigenvalue;
mod geometry;
mod mean_gradient;
mod stiffness;

pub use eigenvalue::largest_eigenvalue;
pub use geometry::{QuadGeometry, nodal_volumes};
pub use mean_gradient::{mean_gradient, mean_gradient_stiffness};
pub use stiffness::{ElementMatrix, ElementStiffness, b_bar};
