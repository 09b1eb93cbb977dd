//! The defaults of all keys of a case that do not depend on the scene. Validation, the plan and messages read them
//! here; the table in `docs/cases.md` states them. Element sizes, mass scaling and other defaults that follow from the
//! scene are the plan's (`fem-simulation/src/plan`). Laws have the defaults of their keys in their table
//! (`fem-laws/src/laws/mod.rs`).

use fem_laws::{EndRule, LawImpact, Ting};

use crate::scene::Accuracy;
use crate::scene::model::{CondensedOptions, ModelChoice};
use crate::schema::{ContactMethod, PlateSupport};

/// Distance of the surfaces at time 0 (`start.gap`), m.
pub const GAP: f64 = 0.0;
/// Speed toward the other body (`body.N.approach_speed`), m/s.
pub const APPROACH_SPEED: f64 = 0.0;
/// Support of the face of a plate away from the contact (`body.N.plate.support`).
pub const PLATE_SUPPORT: PlateSupport = PlateSupport::Free;
/// Number of contacts under gravity (`stop.bounces`).
pub const BOUNCES: usize = 1;
/// Contact method at small strain (`contact.method`): a massless boundary gains no energy at any penalty stiffness and does
/// not ring (docs/contact.md).
pub const CONTACT_METHOD: ContactMethod = ContactMethod::Massless;
/// Factor on the penalty stiffness (`contact.penalty_factor`).
pub const PENALTY_FACTOR: f64 = 1.0;
/// Factor on the critical time step (`time.step_factor`).
pub const STEP_FACTOR: f64 = 0.9;
/// Tolerance of restitution, contact time and peak force (`accuracy.tolerance`), a third of that of the peak pressure.
pub const TOLERANCE: f64 = 0.01;
/// Whether a run writes its page (`output.report`).
pub const REPORT: bool = true;
/// Largest number of elements (`limits.elements`).
pub const MAX_ELEMENTS: u64 = 2_000_000;
/// Largest number of elements times steps (`limits.element_updates`).
pub const MAX_ELEMENT_UPDATES: u64 = 1_000_000_000_000;
/// Largest memory of a run (`limits.memory`), bytes.
pub const MAX_MEMORY: u64 = 8_000_000_000;
/// The model of a case without `[model]`.
pub const MODEL: ModelChoice = ModelChoice::Fem;
/// Whether spheres of finite size are more compliant than half-spaces (`finite_size`).
pub const FINITE_SIZE: bool = false;
/// Settings of `model.condensed`.
pub const CONDENSED: CondensedOptions =
    CondensedOptions { vibration_modes: 0, steps: 250, penalty_springs: false };
/// Accuracy of `model.ting`.
pub const TING_TOLERANCE: f64 = Ting::DEFAULT_TOLERANCE;
/// Accuracy of `model.law`.
pub const LAW_TOLERANCE: f64 = LawImpact::DEFAULT_TOLERANCE;
/// End of the contact of `model.law`.
pub const LAW_END: EndRule = EndRule::ZeroForce;

/// Typical surface energy of dry solids held by van der Waals forces, J/m². It only tells whether adhesion may matter in a
/// case that gives none, and is written into no case.
pub const TYPICAL_SURFACE_ENERGY: f64 = 0.05;

/// Returns the default tolerances.
pub fn accuracy() -> Accuracy {
    Accuracy::within(TOLERANCE)
}
