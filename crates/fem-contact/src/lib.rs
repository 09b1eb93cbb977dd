//! Frictionless penalty contact between two bodies of revolution.
//!
//! The bodies lie on either side of the plane y = 0 and press along y, the common normal of the flattened
//! contact. For small strain and a contact radius a, the interface of two unlike spheres tilts by less than
//! a/(4R), so the radial part of the pressure is of second order in a/R.
//!
//! ```math
//! g(r) = g_0(r) + u_y^{upper}(r) - u_y^{lower}(r), \qquad
//! p = k \langle -g \rangle, \qquad k = K / h
//! ```
//!
//! K is the `stiffness` that the caller gives, in Pa, a multiple of the contact modulus E*. g₀ is the distance of the true arcs, not of the chords. The pressure is integrated over both boundaries at
//! once ([`ContactInterface`]): the interface is cut at every node of either body, and each interval has two Gauss
//! points. So neither body is master or slave, forces balance to rounding, and an interval that is half in contact
//! carries about half the load. Springs at the nodes instead ([`ContactInterface::node_to_surface`]) are noisier
//! and gain more energy.
//!
//! [`SlippingInterface`] adds slip between unlike bodies, to first order. [`DeformedInterface`] integrates over the
//! deformed surfaces, for strains that are not small. [`NodalContact`] has points without overlap at the nodes.
//!
//! Sign convention: gap > 0 is open; the force is positive and acts on the lower body along −y, on the upper
//! along +y.

mod deformed;
mod error;
mod interface;
mod nodal;
mod node_to_surface;
mod pressure;
mod pressure_recovery;
mod profile;
mod slip;
mod surface;
#[cfg(test)]
mod test_support;
mod undeformed_forces;

pub use deformed::DeformedInterface;
pub use error::ContactError;
pub use interface::{ContactInterface, ContactPoint};
pub use nodal::NodalContact;
pub use pressure_recovery::{
    ContactEnforcement, RecoverySurfaces, centre_pressure, contact_radius,
};
pub use profile::{Profile, ProfilePoint, facing};
pub use slip::{Displacement, SlippingGap, SlippingInterface};
pub use surface::{Surface, SurfaceProjection};
pub use undeformed_forces::{ContactForces, SurfaceFold};
