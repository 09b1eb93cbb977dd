//! How far results are from their limit.

mod power_law;

pub use power_law::PowerLaw;
