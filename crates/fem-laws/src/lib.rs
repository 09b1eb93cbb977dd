//! Closed forms and reduced laws for the collision of two spheres.
//!
//! A [`Pair`] reduces two [`Partner`]s to the radius, mass and modulus of their relative motion;
//! each law takes a pair and an approach speed. One law a file. Everything is SI; forces and
//! pressures of a closed contact are positive, stresses are positive in tension.
//!
//! ```
//! use fem_laws::{HertzImpact, Pair, Partner};
//! use fem_material::{ElasticModuli, Material};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
//! let glass = Material::new(2390.0, moduli, None)?;
//! let pair =
//!     Pair::new(Partner::solid_sphere(22.2e-3, &glass), Partner::solid_sphere(15.9e-3, &glass))?;
//! let impact = HertzImpact::new(&pair, 0.5)?;
//! assert_eq!((impact.contact_time() * 1e9).round(), 63_235.0);
//! # Ok(())
//! # }
//! ```

mod error;
mod hertz;
mod hertz_history;
mod hertz_pressure;
mod pair;

pub use error::LawError;
pub use hertz::{HertzImpact, contact_time_coefficient};
pub use hertz_history::HertzInstant;
pub use hertz_pressure::{AxisStress, HertzPressure};
pub use pair::{Pair, Partner, sphere_mass};
