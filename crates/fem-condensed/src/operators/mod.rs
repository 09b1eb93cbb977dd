//! Operators of one body at the contact points: compliance, relaxation, vibration, radiation, bending of a plate and slip.

pub(crate) mod body_operator;
pub(crate) mod plate;
pub(crate) mod points;
pub(crate) mod radiation;
pub(crate) mod shear;
pub(crate) mod slip;
pub(crate) mod vibration;
pub(crate) mod viscoelastic_modes;
