//! `summary.json`: names, order and units of its keys.

use fem_case::CaseFile;
use fem_collision::{QuantityOfInterest, Status};
use serde::{Deserialize, Serialize, Serializer};

use super::dent::DentSummary;
use super::energy::Energy;
use super::measured::MeasuredSummary;
use crate::effects::{EffectDecision, NeglectError};
use crate::error::{ElasticNull, StressError};
use crate::models::ModelCandidate;
use crate::models::stepper::RefinementLevel;

/// The file name of the summary.
pub const SUMMARY_FILE: &str = "summary.json";

/// The summary of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Quantities of the collision.
    #[serde(flatten)]
    pub collision: Quantities,
    /// Quantities of an oblique impact, which are `null` of a head-on one.
    #[serde(flatten)]
    pub tangential: Tangential,
    /// What each of these numbers is.
    pub status: PerQuantity<Status>,
    /// Largest contact force of a single step; `None` for closed forms.
    pub peak_force_raw_n: Option<f64>,
    /// `"true"` (of the deformed bodies) at finite strain, else `"nominal"` (of the undeformed area).
    pub radius_and_pressure: &'static str,
    /// Loss of a relaxing run by mesh and settings, with relaxation off.
    pub elastic_null: Option<ElasticNull>,
    /// Error of the recovered stress near the contact at the largest approach, relative to that of a reference run.
    pub stress_error: Option<StressError>,
    /// Measured restitutions of the library between bodies of this material; `None` if it has none.
    pub measured_restitution: Option<Vec<MeasuredSummary>>,
    /// Number of contact episodes, separated by openings.
    pub contact_episodes: u64,
    /// Hertz' values of these quantities with instantaneous moduli.
    pub hertz: Quantities,
    /// Energies at the end of the run.
    pub energy: Energy,
    /// Largest drift of the momentum over Σ m|v| at the start.
    pub momentum_residual_relative: Option<f64>,
    /// Contacts under gravity; all keys above and the bodies belong to the first one.
    pub bounces: Option<Vec<BounceSummary>>,
    /// Adhesion of the bodies; `None` if the case gives neither surface energies nor a work of adhesion.
    pub adhesion: Option<AdhesionSummary>,
    /// Impact on a plate; `None` without one.
    pub plate: Option<PlateSummary>,
    /// Coverage of the contact's frequencies by the data of a relaxation; `None` without data.
    pub relaxation_coverage: Option<RelaxationCoverage>,
    /// Dents of the bodies that flowed plastically; `None` if none did.
    pub dent: Option<Vec<DentSummary>>,
    /// Static equilibrium of a ball at rest, fully relaxed.
    pub rest: Option<RestSummary>,
    /// The lower and the upper body.
    pub bodies: Vec<BodySummary>,
    /// Step of a model with a fixed step.
    pub time_step_s: Option<f64>,
    /// Number of steps of such a model.
    pub steps: Option<u64>,
    /// Number of elements times steps.
    pub element_updates: Option<u64>,
    /// Cost of the run.
    pub cost: CostSummary,
    /// The effects: whether they were on, why, and the error of neglecting them.
    pub effects: Vec<EffectSummary>,
    /// Uncertainty of the quantities.
    pub uncertainty: Uncertainty,
    /// Meshes that were too coarse for the tolerance of the case, in order; `None` if the first one was sufficient.
    pub coarser_meshes: Option<Vec<RefinementLevel>>,
    /// The candidate models if the case leaves the choice open, from the cheapest to the most expensive.
    pub models_considered: Option<Vec<ModelCandidate>>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// Whether the run ended by itself.
    pub complete: bool,
    /// Why the run did not end by itself.
    pub stopped_because: Option<String>,
    /// Name of the program ([`super::PROGRAM`]).
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// Identity of the build's numerics ([`NUMERICS`](crate::NUMERICS)).
    pub numerics: &'static str,
    /// Identity of the case ([`Simulation::input_digest`](crate::Simulation::input_digest)).
    pub made_from: String,
    /// The case file as seen from the result folder, with the overrides; `None` if the case comes from no file. A new
    /// result from the same file replaces this one.
    pub source: Option<String>,
    /// Names of the files in the result folder.
    pub files: Vec<String>,
    /// The resolved case.
    pub case: CaseFile,
}

impl Summary {
    /// Returns the measured restitutions of the library at the speed of the run, with their names.
    pub fn measured_restitutions(&self) -> Vec<(&str, f64)> {
        let all = self.measured_restitution.iter().flatten();
        all.filter_map(|it| Some((it.name, it.restitution?))).collect()
    }
}

/// An effect: whether the run had it, why, and the error of neglecting it.
#[derive(Clone, Debug, Serialize)]
pub struct EffectSummary {
    /// Decision on the effect, with the reason.
    #[serde(flatten)]
    pub decision: EffectDecision,
    /// Error of neglecting the effect, if closed forms estimate it.
    pub error_if_left_out: Option<NeglectError>,
}

/// The quantities of interest of a collision, SI.
#[derive(Clone, Debug, Serialize)]
pub struct Quantities {
    /// Relative velocity after the collision over that before.
    pub restitution: Option<f64>,
    /// Time from the first to the last contact.
    pub contact_time_s: Option<f64>,
    /// Largest contact force.
    pub peak_force_n: Option<f64>,
    /// Largest approach of the mass centres.
    pub max_approach_m: Option<f64>,
    /// Largest radius at which the pressure falls to zero.
    pub max_contact_radius_m: Option<f64>,
    /// Largest pressure on the axis.
    pub peak_pressure_pa: Option<f64>,
}

impl Quantities {
    /// Returns the quantities with the values of `number`.
    pub fn by(number: impl FnMut(QuantityOfInterest) -> Option<f64>) -> Self {
        let [
            restitution,
            contact_time_s,
            peak_force_n,
            max_approach_m,
            max_contact_radius_m,
            peak_pressure_pa,
        ] = QuantityOfInterest::ALL.map(number);
        Self {
            restitution,
            contact_time_s,
            peak_force_n,
            max_approach_m,
            max_contact_radius_m,
            peak_pressure_pa,
        }
    }

    /// Returns one quantity.
    pub fn number(&self, quantity: QuantityOfInterest) -> Option<f64> {
        let Self { restitution, contact_time_s, peak_force_n, max_approach_m, .. } = *self;
        let (radius, pressure) = (self.max_contact_radius_m, self.peak_pressure_pa);
        let all = [restitution, contact_time_s, peak_force_n, max_approach_m, radius, pressure];
        all[quantity as usize]
    }
}

/// Tangential quantities of an oblique impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tangential {
    /// Tangential velocity of the contact patch after the collision over that before; `None` if the patch stands before.
    pub tangential_restitution: Option<f64>,
    /// Angle of the rebounding patch against the normal; negative if it goes back.
    pub contact_patch_rebound_deg: Option<f64>,
    /// Tangential over normal impulse; positive against the velocity of the patch before.
    pub impulse_ratio: Option<f64>,
    /// ψ₁ = (k_t/k_n) v_t/(μ v_n) of the patch before the collision, with instantaneous moduli; `None` without friction.
    pub psi_before: Option<f64>,
    /// ψ₂, the same of the patch after it, with the speed of approach.
    pub psi_after: Option<f64>,
}

/// Error bars of the tangential quantities, written beside those of the others in an oblique impact.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TangentialParts {
    /// Error bar of `tangential_restitution`.
    pub tangential_restitution: Parts,
    /// Error bar of `contact_patch_rebound_deg`.
    pub contact_patch_rebound_deg: Parts,
    /// Error bar of `impulse_ratio`.
    pub impulse_ratio: Parts,
}

/// Uncertainty of all quantities.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Uncertainty {
    /// Error bars of the quantities along the axis.
    #[serde(flatten)]
    pub axial: PerQuantity<Parts>,
    /// Error bars of those across it, in an oblique impact.
    #[serde(flatten)]
    pub tangential: Option<TangentialParts>,
}

impl Uncertainty {
    /// Returns the error bar of a quantity along the axis.
    pub fn of(&self, quantity: QuantityOfInterest) -> Parts {
        self.axial.of(quantity)
    }
}

/// One value for each quantity, written under its key.
#[derive(Clone, Copy, Debug)]
pub struct PerQuantity<T>([T; 6]);

impl<T: Copy> PerQuantity<T> {
    /// Returns the values that `value` gives.
    pub fn by(value: impl FnMut(QuantityOfInterest) -> T) -> Self {
        Self(QuantityOfInterest::ALL.map(value))
    }

    /// Returns the value of one quantity.
    pub fn of(&self, quantity: QuantityOfInterest) -> T {
        self.0[quantity as usize]
    }
}

impl<T: Copy + Serialize> Serialize for PerQuantity<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(
            QuantityOfInterest::ALL.map(|quantity| (quantity.key(), self.of(quantity))),
        )
    }
}

/// The parts of an error bar.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Parts {
    /// Discretisation error: the exact solution of the model's continuum problem is expected within it.
    pub discretisation: Option<f64>,
    /// Model-form error: the change by neglected effects, of this scene with these inputs; `None` if a neglected effect
    /// matters and its size is not known.
    pub model: Option<f64>,
    /// Uncertainty by uncertain inputs; `None` if the case has none.
    pub input: Option<f64>,
    /// The side on which the true value lies, if the number is a bound of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<Side>,
}

impl Parts {
    /// Returns the sum of both errors, if both are known, and of the uncertainty by inputs, if there is one.
    pub fn sum(&self) -> Option<f64> {
        Some(self.discretisation? + self.model? + self.input.unwrap_or(0.0))
    }
}

/// The side of a bound on which the true value lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// The true value is at most the bound.
    #[serde(rename = "at most")]
    AtMost,
    /// The true value is at least the bound.
    #[serde(rename = "at least")]
    AtLeast,
}

impl Side {
    /// Returns the side of a quantity's bound where an effect is missing that takes energy and makes the contact softer. The
    /// contact time has none: plastic flow first shortens and then lengthens it.
    pub(super) fn without_dissipation(quantity: QuantityOfInterest) -> Option<Self> {
        match quantity {
            QuantityOfInterest::Restitution
            | QuantityOfInterest::PeakForce
            | QuantityOfInterest::PeakPressure => Some(Self::AtMost),
            QuantityOfInterest::MaxApproach | QuantityOfInterest::MaxContactRadius => {
                Some(Self::AtLeast)
            }
            QuantityOfInterest::ContactTime => None,
        }
    }

    /// Returns the sign before a bound.
    pub fn sign(self) -> &'static str {
        match self {
            Self::AtMost => "≤",
            Self::AtLeast => "≥",
        }
    }
}

/// One contact of a bouncing ball.
#[derive(Clone, Debug, Serialize)]
pub struct BounceSummary {
    /// Relative speed at first touch.
    pub speed_before_m_s: Option<f64>,
    /// Relative velocity after the collision over that before.
    pub restitution: Option<f64>,
    /// Parts of its error bar.
    pub restitution_uncertainty: Parts,
    /// Measured restitution of the library at this speed, if it has one.
    pub measured_restitution: Option<f64>,
    /// Time from the first to the last contact.
    pub contact_time_s: Option<f64>,
    /// Largest contact force.
    pub peak_force_n: Option<f64>,
    /// Time of first touch since the start of the case.
    pub time_s: Option<f64>,
}

/// The contact of a ball at rest, with equilibrium moduli.
#[derive(Clone, Debug, Serialize)]
pub struct RestSummary {
    /// Time since the start of the case at which the ball is found at rest.
    pub time_s: Option<f64>,
    /// Weight of the body, in newtons.
    pub static_force_n: Option<f64>,
    /// Radius at which the pressure falls to zero.
    pub contact_radius_m: Option<f64>,
    /// Approach of the mass centres.
    pub approach_m: Option<f64>,
    /// Pressure on the axis.
    pub centre_pressure_pa: Option<f64>,
}

/// Adhesion of the bodies.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct AdhesionSummary {
    /// Approach speed below which the bodies stay together.
    pub sticking_speed_m_s: Option<f64>,
    /// Work of adhesion of the pair.
    pub work_of_adhesion_j_m2: Option<f64>,
    /// Tabor's number: the deformation by the attraction over its range.
    pub tabor: Option<f64>,
    /// Whether the bodies stay together in the first contact.
    pub sticks: bool,
}

/// Impact on a plate.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct PlateSummary {
    /// Zener's number λ, which decides the loss on a thin plate.
    pub lambda: Option<f64>,
    /// How the plate answers: `thin`, `between` or `thick`.
    pub regime: &'static str,
    /// Plate thicknesses that waves of the speed √(E/ρ) travel during the contact.
    pub wave_travel_over_thickness: Option<f64>,
    /// Contact times until a surface wave is back from the edge; `None` for an unbounded plate.
    pub edge_return_over_contact_time: Option<f64>,
}

/// Coverage of the frequencies of the contact by those at which the moduli of a body are measured; of two bodies with
/// data that of the lesser.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RelaxationCoverage {
    /// Decades of frequency that are measured and matter to the contact.
    pub decades_inside: f64,
    /// Decades of frequency that matter to the contact.
    pub decades_needed: f64,
    /// The frequency or the temperature to measure; `None` if the data cover the contact.
    pub warning: Option<String>,
}

/// One body. A wall has no mass and no vibration, a reduced model has no elements.
#[derive(Clone, Debug, Serialize)]
pub struct BodySummary {
    /// Name in the case.
    pub name: String,
    /// Number of elements.
    pub elements: Option<usize>,
    /// Number of nodes.
    pub nodes: Option<usize>,
    /// Mass, in kilograms.
    pub mass_kg: Option<f64>,
    /// Mass that mass scaling moves to light nodes.
    pub added_mass_kg: Option<f64>,
    /// Velocity along +y before the collision.
    pub velocity_before_m_s: Option<f64>,
    /// Velocity along +y after the collision.
    pub velocity_after_m_s: Option<f64>,
    /// Velocity along x after an oblique impact.
    pub velocity_tangential_after_m_s: Option<f64>,
    /// Angular velocity after it, right-handed about x × y.
    pub spin_after_rad_s: Option<f64>,
    /// Energy of the remaining vibrations.
    pub vibration_energy_j: Option<f64>,
}

/// Cost of the run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CostSummary {
    /// Time of the process until now.
    pub wall_s: f64,
    /// Time until the first collision began: case, meshes, factors, reference runs.
    pub setup_s: f64,
    /// Time of collisions whose mesh or candidate region was not sufficient, with their error estimates.
    pub trials_s: f64,
    /// Time of the last collision alone.
    pub solve_s: f64,
    /// Time per element update of the last collision.
    pub ns_per_element_update: Option<f64>,
    /// Element updates of the collision, of coarser meshes before it, and of all reference runs.
    pub all_element_updates: Option<u64>,
    /// Threads that the run used.
    pub threads: usize,
    /// Largest memory of the process.
    pub peak_memory_bytes: Option<u64>,
    /// Memory of the factors of condensed bodies.
    pub factor_bytes: Option<u64>,
}
