//! Effects of the bodies as a whole and of their surfaces: size, inertia, waves, gravity, tangential slip.

mod finite_size;
mod gravity;
pub(super) mod partner_waves;
mod rigid_partner;
mod surface_slip;
mod vibration;

pub use finite_size::FiniteSizeEffect;
pub use gravity::Gravity;
pub use partner_waves::PartnerWaves;
pub use rigid_partner::RigidPartner;
pub use surface_slip::SurfaceSlip;
pub use vibration::Vibration;
