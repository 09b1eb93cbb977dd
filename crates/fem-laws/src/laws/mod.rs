//! Contact laws F(ξ, ξ̇) by name: each a function that returns its [`ContactLaw`].

mod bordbar_hyppanen;
mod falcon;
mod hertz;
mod hunt_crossley;
mod kuwabara_kono;
mod linear;
mod mishra_murty;
mod morgado_oppenheim;
mod power;
mod schwager_poeschel;
mod tsuji;

pub use bordbar_hyppanen::bordbar_hyppanen;
pub use falcon::falcon;
pub use hertz::hertz;
pub use hunt_crossley::hunt_crossley;
pub use kuwabara_kono::{corrected_dissipation_time, kuwabara_kono};
pub use linear::{linear, linear_from_restitution};
pub use mishra_murty::mishra_murty;
pub use morgado_oppenheim::morgado_oppenheim;
pub use power::{ContactLaw, EndRule, power};
pub use schwager_poeschel::{dissipation_time, schwager_poeschel};
pub use tsuji::{tsuji, tsuji_coefficient, zhang_whiten_coefficient};
