//! Collisions of linear viscoelastic bodies, condensed to their contact: finite-element accuracy in
//! milliseconds.
//!
//! Two linear bodies touch at a few tens of nodes, and waves carry a few millionths of the energy.
//! So the stiffness of each body is factored once and condensed to the compliance of its contact nodes
//! (`condensation`), and only the relative motion of the mass centres is integrated (`motion`):
//!
//! ```math
//! m^*\ddot\delta = -\mathbf 1^T\mathbf p, \qquad
//! \mathbf p \ge 0 \;\perp\; \mathbf g_0 - \delta + \sum_i \mathbf u_i \ge 0, \qquad
//! \mathbf u_i = C_i \mathbf p
//! ```
//!
//! Elements, masses and penalty springs are those of the explicit model. Contact acts along the common normal of the
//! flattened interface, at matching nodes; the finer of two unlike meshes is projected on the nodes of the coarser.
//! Initial gaps are taken between the exact circles, not between the element edges. The contact problem of a step is
//! solved exactly, without iteration (`disc_contact`).
//!
//! A relaxing body is a set of scalar viscoelastic modes (`viscoelastic_modes`). With constant Poisson's ratio there is
//! one per contact node. With a relaxing shear modulus and an elastic bulk modulus a Galerkin basis has two per node
//! (`shear`). Modes of free vibration add the inertia that the quasi-static body lacks (`vibration`). For a body so
//! large that its waves do not return within the contact, such as a half-space, a separate element models the radiated
//! energy (`radiation`), and another the bending waves of a plate (`plate`).
//!
//! A rigid sphere has no compliance; its curvature enters the gap, its mass the reduced mass. A wall has neither.
//!
//! Sign convention: approach, forces and inward displacements are positive in compression. SI units.
//! Limits: small strain (a/R of a few per cent), linear materials, frictionless contact; without modes of
//! vibration, speeds far below the wave speeds.
//!
//! ```
//! use fem_collision::BodyInput;
//! use fem_condensed::{CondensedPair, PairSettings};
//! use fem_material::{ElasticModuli, Material};
//! use fem_mesh::{HalfDisc, Side};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
//! let glass = Material::new(2390.0, moduli, None)?;
//! let disc = HalfDisc {
//!     radius: 7.95e-3,
//!     contact_element_size: 40e-6,
//!     refined_radius: 0.3e-3,
//!     growth: None,
//!     edge: None,
//! };
//! let mesh = disc.build()?.on_side(Side::Above);
//! let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material: glass }];
//! let pair = CondensedPair::new(bodies, PairSettings::new(0.4e-3))?;
//! // One factor, any number of speeds and relaxations.
//! for speed in [0.1, 0.2, 0.4] {
//!     let run = pair.impact(speed, [None, None], CondensedPair::N_STEPS)?;
//!     assert!(run.restitution.is_some_and(|e| (e - 1.0).abs() < 1e-4));
//! }
//! # Ok(())
//! # }
//! ```

mod collision;
mod condensation;
mod contact;
mod error;
mod fields;
mod motion;
mod operators;
mod pair;
mod run;
mod settings;

pub use contact::elastic_impact::ElasticImpact;
pub use error::CondensedError;
pub use operators::slip::Slip;
pub use pair::CondensedPair;
pub use settings::{ContactModel, Damping, PairSettings};
