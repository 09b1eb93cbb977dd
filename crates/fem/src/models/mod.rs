//! The methods, one file or folder each, and which of them a scene chooses.

mod condensed;
mod explicit;
mod hertz;
mod law;
mod law_numbers;
mod mirrored;
mod reduced;
mod ting;

use fem_case::{ModelChoice, Scene};

use crate::method::Method;
use crate::refusal::Refusal;

pub use condensed::{Condensed, CondensedMethod};
pub use explicit::{Explicit, ExplicitMethod};
pub use hertz::HertzMethod;
pub use law::LawMethod;
pub use reduced::Reduced;
pub use ting::{TingMethod, ting_impact};

/// All methods, from the cheapest to the dearest.
pub const METHODS: [&dyn Method; 5] =
    [&HertzMethod, &LawMethod, &TingMethod, &CondensedMethod, &ExplicitMethod];

/// The method that a scene chooses.
pub fn method_of(scene: &Scene) -> &'static dyn Method {
    match scene.model() {
        ModelChoice::Hertz { .. } => &HertzMethod,
        ModelChoice::Law { .. } => &LawMethod,
        ModelChoice::Ting { .. } => &TingMethod,
        ModelChoice::Condensed(_) => &CondensedMethod,
        ModelChoice::Fem => &ExplicitMethod,
    }
}

impl Reduced {
    /// Builds the reduced model that a scene chooses.
    ///
    /// # Errors
    /// A scene whose closed-form estimates are not finite, or that asks for finite elements; a
    /// contact too large for the finite-size correction; a law that cannot be made of this pair.
    pub fn new(scene: &Scene) -> Result<Self, Refusal> {
        match scene.model() {
            ModelChoice::Hertz { .. } => hertz::build(scene),
            ModelChoice::Law { .. } => law::build(scene),
            ModelChoice::Ting { .. } => ting::build(scene),
            ModelChoice::Condensed(_) | ModelChoice::Fem => {
                Err(Refusal::new("model", "finite elements are no reduced model"))
            }
        }
    }
}
