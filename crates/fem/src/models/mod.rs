//! The methods, one file or folder each.

mod condensed;
mod explicit;
mod hertz;
mod law;
mod law_numbers;
mod reduced;
mod region;
mod ting;

pub use condensed::{CONDENSED, Condensed, CondensedMethod, PairCache};
pub use explicit::{EXPLICIT, Explicit, ExplicitMethod};
pub use hertz::{HERTZ, HertzMethod};
pub use law::{LAW, LawMethod};
pub use reduced::Reduced;
pub use ting::{TING, TingMethod, ting_impact};
