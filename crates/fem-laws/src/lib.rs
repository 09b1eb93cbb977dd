//! Closed forms and reduced laws for the collision of two spheres.
//!
//! A [`Pair`] reduces two [`Partner`]s to the radius, mass and modulus of their relative motion;
//! each model takes a pair and an approach speed:
//!
//! - [`HertzImpact`]: elastic, closed forms;
//! - [`Ting`]: viscoelastic, with the [`PairRelaxation`] of the two materials and, if wanted, the
//!   [`FiniteSize`] of the spheres, the [`SurfaceSlip`] of unlike ones and the waves that a half-space
//!   or a thin plate takes away;
//! - [`LawImpact`]: any law F(ξ, ξ̇) of [`laws`], integrated in time.
//!
//! Each gives an [`Impact`], summary and history; [`ImpactPath`] is its state at any time. The error of a
//! neglected effect is an [`ImpactDifference`] of two impacts, or a [`RelativeError`] in closed form: for
//! relaxation that is not integrated in time ([`FastSlowLimits`]) and for a [`rigid_partner`]. [`Adhesion`]
//! gives the [`ImpactQuantities`] of impacts that no law here computes in time, and [`FirstYield`] those of bodies that dent. One law a
//! file; [`LawFamily`] lists them by name, with their parameters. Everything is SI; forces and pressures of
//! a closed contact are positive, stresses are positive in tension.
//!
//! ```
//! use fem_laws::{HertzImpact, LawImpact, Pair, PairRelaxation, Partner, Ting};
//! use fem_material::{ElasticModuli, Material};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
//! let glass = Material::new(2390.0, moduli, None)?;
//! let pair =
//!     Pair::new(Partner::solid_sphere(22.2e-3, &glass), Partner::solid_sphere(15.9e-3, &glass))?;
//! let impact = HertzImpact::new(&pair, 0.5)?;
//! assert_eq!((impact.contact_time() * 1e9).round(), 63_235.0);
//!
//! let law = fem_laws::laws::kuwabara_kono(&pair, 1e-6)?;
//! let restitution = LawImpact::new(&pair, law).impact(0.5)?.restitution;
//! assert!(0.8 < restitution && restitution < 0.95);
//!
//! let relaxation = PairRelaxation::new(Some(&glass), Some(&glass))?;
//! let elastic = Ting::new(&pair, relaxation).impact(0.5)?;
//! assert!((elastic.restitution - 1.0).abs() < 1e-8);
//! # Ok(())
//! # }
//! ```

mod adhesion;
mod contact_motion;
mod contact_springs;
mod dent_impact;
mod difference;
mod error;
mod family;
mod fast_slow_limits;
mod finite_size;
mod hertz;
mod impact;
mod law_impact;
pub mod laws;
mod numerics;
mod pair;
mod pair_relaxation;
mod plastic_yield;
mod plate;
mod radiation;
mod surface_slip;
mod tangential;
mod ting;

pub use adhesion::{Adhesion, RANGE_OF_ATTRACTION};
pub use contact_springs::{ContactSprings, SpringProfile, SpringState, verlet_impact};
pub use difference::{ImpactDifference, RelativeError, rigid_partner};
pub use error::LawError;
pub use family::{
    KeyKind, KeyNeed, KeyRange, KeySet, LawContext, LawFamily, LawInput, LawInputError,
    LawParameter, LawValues, ParameterRole,
};
pub use fast_slow_limits::FastSlowLimits;
pub use finite_size::FiniteSize;
pub use hertz::{
    AxisStress, HertzImpact, HertzInstant, HertzPressure, StaticHertz, contact_time_coefficient,
};
pub use impact::{Impact, ImpactInstant, ImpactPath, ImpactQuantities, MIN_RESTITUTION};
pub use law_impact::LawImpact;
pub use laws::EndRule;
pub use numerics::bisection;
pub use pair::{Pair, Partner, compliance_shares, restitution_of_mass_centres, sphere_mass};
pub use pair_relaxation::PairRelaxation;
pub use plastic_yield::{FirstYield, YieldingBody, largest_von_mises};
pub use plate::{
    FreePlate, LOSS_PER_LAMBDA, SINKING_LAMBDA, plate_lambda, plate_mobility,
    plate_slow_contact_error, plate_thickness_error, plate_thickness_factor, plate_wave_travel,
};
pub use radiation::{
    radiated_share, radiation_coefficient, radiation_damping, rayleigh_wave_speed,
};
pub use surface_slip::{SlipSurface, SurfaceSlip};
pub use tangential::{NormalSprings, TangentialContact, TangentialImpact, TangentialInstant};
pub use ting::Ting;
