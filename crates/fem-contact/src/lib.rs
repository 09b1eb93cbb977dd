//! Frictionless penalty contact between two bodies of revolution.
//!
//! The bodies lie on either side of the plane y = 0 and press along y, the
//! common normal of the flattened contact: for small strain and a contact
//! radius a, the interface of two unlike spheres tilts by less than a/(4R), so
//! the pressure's radial part is second order in a/R.
//!
//! ```math
//! g(r) = g_0(r) + u_y^{upper}(r) - u_y^{lower}(r), \qquad
//! p = k \langle -g \rangle, \qquad k = f E^* / h
//! ```
//!
//! g₀ is the distance of the true arcs, not of the chords. The pressure is
//! integrated over both boundaries at once: the interface is cut at every node
//! of either body and each piece carries two Gauss points, so that neither body
//! is master or slave, forces balance to rounding, and a piece that is half in
//! contact carries about half the load. Points at the nodes instead
//! ([`ContactInterface::node_to_surface`]) are noisier and gain more energy.
//!
//! Where strains are not small, and where slip between unlike bodies matters, [`MovedInterface`] has the
//! same springs between the surfaces where they are now.
//!
//! Sign convention: gap > 0 is open; the force is positive and acts on the
//! lower body along −y, on the upper along +y.

mod error;
mod evaluate;
mod interface;
mod moved;
mod nodal;
mod node_to_surface;
mod pressure;
mod pressure_recovery;
mod profile;
mod slip;
mod surface;

pub use error::ContactError;
pub use evaluate::{ContactForces, SurfaceFold};
pub use interface::{ContactInterface, ContactPoint};
pub use moved::MovedInterface;
pub use nodal::NodalContact;
pub use pressure_recovery::{ContactEnforcement, Reading, centre_pressure, contact_radius};
pub use profile::{Profile, ProfilePoint, facing};
pub use slip::{Displacement, SlippingGap, SlippingInterface};
pub use surface::{Surface, SurfaceProjection};
