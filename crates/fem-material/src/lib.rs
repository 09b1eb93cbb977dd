//! Isotropic linear viscoelastic materials: elastic moduli, Prony relaxation, stress from strain.
//!
//! The shear modulus relaxes as `G(t) = G_0 g(t)`; the bulk modulus relaxes with it or stays
//! elastic ([`ActsOn`]). A metal flows by a [`FlowRule`]. Everything is SI, tension is positive.
//!
//! ```
//! use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
//!
//! # fn main() -> Result<(), fem_material::MaterialError> {
//! let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
//! let term = PronyTerm { weight: 1.0, relaxation_time: 1.0 / 2708.0 };
//! let relaxation = PronySeries::new(vec![term], ActsOn::All)?;
//! let glass = Material::new(2390.0, moduli, Some(relaxation))?;
//! assert_eq!(glass.shear_wave_speed().round(), 3255.0);
//! assert_eq!(glass.equilibrium_shear_modulus(), 0.0);
//! # Ok(())
//! # }
//! ```

mod elastic;
pub mod engineering;
mod error;
pub mod finite;
mod flow;
mod hooke;
mod material;
mod prony;
mod prony_merging;
mod relaxation_step;
mod shift;

pub use elastic::{ElasticModuli, ModuliInput};
pub use error::MaterialError;
pub use flow::{FlowPoint, FlowRule, FlowStress, Hardening, MAX_FLOW_ROWS, RateFactor};
pub use material::Material;
pub use prony::{ActsOn, PronySeries, PronyTerm, maxwell_element, relaxation_at};
pub use relaxation_step::RelaxationStep;
pub use shift::{GAS_CONSTANT, ShiftLaw, ZERO_CELSIUS};
