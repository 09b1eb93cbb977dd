//! Laws of mechanics and properties of the method that hold for any scene.

pub mod balances;
pub mod contact_patch;
pub mod critical_step;
pub mod invariance;
pub mod uniform_stress;
