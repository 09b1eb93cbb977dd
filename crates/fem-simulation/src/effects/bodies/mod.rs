//! Effects of the bodies as a whole and of their surfaces: size, inertia, waves, gravity, tangential slip, adhesion.

mod adhesion;
mod finite_size;
mod friction;
mod gravity;
mod partner_waves;
mod plate_bending;
mod rigid_partner;
mod surface_slip;
mod vibration;
