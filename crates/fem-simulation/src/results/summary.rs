//! `summary.json`: names, order and units of its keys.

use fem_case::CaseFile;
use fem_collision::QuantityOfInterest;
use serde::{Serialize, Serializer};

use super::energy::Energy;
use crate::effects::{EffectDecision, NeglectError};
use crate::error::{ElasticNull, RefinementLevel};
use crate::models::ModelCandidate;

/// The name of the file.
pub const SUMMARY_FILE: &str = "summary.json";
/// The value of `program`, by which a result folder is known.
pub const PROGRAM: &str = "fem-run";

/// The summary of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Identity of the collision.
    #[serde(flatten)]
    pub collision: Quantities,
    /// Largest contact force of a single step, in models that step.
    pub peak_force_raw_n: Option<f64>,
    /// `"true"`, of the deformed bodies, at finite strain; else `"nominal"`, of undeformed area.
    pub radius_and_pressure: &'static str,
    /// Loss of a relaxing run's mesh and settings with relaxation off.
    pub elastic_null: Option<ElasticNull>,
    /// Closed contacts, openings in between not counted.
    pub contact_episodes: u64,
    /// Hertz' values of these quantities, with instantaneous moduli.
    pub hertz: Quantities,
    /// The ledger at the end of the run.
    pub energy: Energy,
    /// Worst drift over Σ m|v| at the start.
    pub momentum_residual_relative: Option<f64>,
    /// With gravity each contact, of which all keys above and the bodies are the first one's.
    pub bounces: Option<Vec<BounceSummary>>,
    /// Static equilibrium of a ball at rest, once all has relaxed.
    pub rest: Option<RestSummary>,
    /// Lower and upper body.
    pub bodies: Vec<BodySummary>,
    /// Step of a model with a fixed step.
    pub time_step_s: Option<f64>,
    /// Steps done by such a model.
    pub steps: Option<u64>,
    /// Elements times steps.
    pub element_updates: Option<u64>,
    /// Cost of the run.
    pub cost: CostSummary,
    /// Which effects were on, why, and what they are worth.
    pub effects: Vec<EffectSummary>,
    /// Uncertainty of the quantities.
    pub uncertainty: UncertaintySummary,
    /// Meshes that were too coarse for the tolerance of the case, the first one first; none where the first
    /// one does.
    pub coarser_meshes: Option<Vec<RefinementLevel>>,
    /// The candidate models if the case leaves the choice open, from the cheapest to the most expensive.
    pub models_considered: Option<Vec<ModelCandidate>>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// Whether the run ended by itself.
    pub complete: bool,
    /// Why the run did not end by itself.
    pub stopped_because: Option<String>,
    /// By which a result folder is known.
    pub program: &'static str,
    /// Version of the program.
    pub version: &'static str,
    /// The numerics of the build; see [`NUMERICS`](crate::NUMERICS).
    pub numerics: &'static str,
    /// Digest of what was asked for; see [`Simulation::made_from`](crate::Simulation::made_from).
    pub made_from: String,
    /// Names of the files that the program wrote into the folder.
    pub files: Vec<String>,
    /// The resolved case.
    pub case: CaseFile,
}

/// An effect: whether the run had it, why, and by how much the numbers change without it.
#[derive(Clone, Debug, Serialize)]
pub struct EffectSummary {
    /// Whether it is on, and why.
    #[serde(flatten)]
    pub verdict: EffectDecision,
    /// Estimate by closed forms, if there is one.
    pub error_if_left_out: Option<NeglectError>,
}

/// Identity of a collision.
#[derive(Clone, Debug, Serialize)]
pub struct Quantities {
    /// Relative velocity after over before.
    pub restitution: Option<f64>,
    /// First to last contact.
    pub contact_time_s: Option<f64>,
    /// Largest contact force.
    pub peak_force_n: Option<f64>,
    /// Largest approach of the mass centres.
    pub max_approach_m: Option<f64>,
    /// Where the pressure falls to zero, at its largest.
    pub max_contact_radius_m: Option<f64>,
    /// Largest pressure on the axis.
    pub peak_pressure_pa: Option<f64>,
}

impl Quantities {
    /// Each as `number` has it.
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

    /// One of them.
    pub fn number(&self, headline: QuantityOfInterest) -> Option<f64> {
        match headline {
            QuantityOfInterest::Restitution => self.restitution,
            QuantityOfInterest::ContactTime => self.contact_time_s,
            QuantityOfInterest::PeakForce => self.peak_force_n,
            QuantityOfInterest::MaxApproach => self.max_approach_m,
            QuantityOfInterest::MaxContactRadius => self.max_contact_radius_m,
            QuantityOfInterest::PeakPressure => self.peak_pressure_pa,
        }
    }
}

/// How far each quantity may be off, written by its key; sizes in its own unit.
#[derive(Clone, Copy, Debug)]
pub struct UncertaintySummary([Parts; 6]);

impl UncertaintySummary {
    /// Returns quantities with the values given by the function.
    pub fn by(parts: impl FnMut(QuantityOfInterest) -> Parts) -> Self {
        Self(QuantityOfInterest::ALL.map(parts))
    }

    /// Returns one quantity.
    pub fn parts(&self, headline: QuantityOfInterest) -> Parts {
        self.0[headline as usize]
    }
}

impl Serialize for UncertaintySummary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(
            QuantityOfInterest::ALL.map(|headline| (headline.key(), self.parts(headline))),
        )
    }
}

/// The two parts of how far a quantity may be off.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Parts {
    /// The truth of the continuum problem is expected within it.
    pub discretisation: Option<f64>,
    /// Nature is expected within it and the first part together.
    pub model: Option<f64>,
    /// What is known of the second part where the whole is not: it is at least this.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model_at_least: Option<f64>,
}

impl Parts {
    /// Both together, where both are known.
    pub fn sum(&self) -> Option<f64> {
        Some(self.discretisation? + self.model?)
    }

    /// What is known of both together; nothing where that is nothing.
    pub fn known(&self) -> Option<f64> {
        let parts = [self.discretisation, self.model.or(self.model_at_least)];
        parts.into_iter().flatten().reduce(|one, more| one + more)
    }
}

/// One contact of a ball that bounces.
#[derive(Clone, Debug, Serialize)]
pub struct BounceSummary {
    /// Relative speed at first touch.
    pub speed_before_m_s: Option<f64>,
    /// Relative velocity after over before.
    pub restitution: Option<f64>,
    /// First to last contact.
    pub contact_time_s: Option<f64>,
    /// Largest contact force.
    pub peak_force_n: Option<f64>,
    /// First touch since the start of the case.
    pub time_s: Option<f64>,
}

/// The contact of a ball at rest, with equilibrium moduli.
#[derive(Clone, Debug, Serialize)]
pub struct RestSummary {
    /// When the ball was seen not to leave any more, since the start of the case.
    pub time_s: Option<f64>,
    /// Weight of the body, in newtons.
    pub static_force_n: Option<f64>,
    /// Where the pressure falls to zero.
    pub contact_radius_m: Option<f64>,
    /// Approach of the mass centres.
    pub approach_m: Option<f64>,
    /// Pressure on the axis.
    pub centre_pressure_pa: Option<f64>,
}

/// One body; a wall has no mass and no vibration, a reduced model no elements.
#[derive(Clone, Debug, Serialize)]
pub struct BodySummary {
    /// Name in the case.
    pub name: String,
    /// Elements of its mesh.
    pub elements: Option<usize>,
    /// Nodes of its mesh.
    pub nodes: Option<usize>,
    /// Mass, in kilograms.
    pub mass_kg: Option<f64>,
    /// Mass added to light nodes by scaling, from others of the body.
    pub added_mass_kg: Option<f64>,
    /// Velocity along +y before.
    pub velocity_before_m_s: Option<f64>,
    /// Velocity along +y after.
    pub velocity_after_m_s: Option<f64>,
    /// Energy left in its vibrations.
    pub vibration_energy_j: Option<f64>,
}

/// Cost of the run.
#[derive(Clone, Debug, Serialize)]
pub struct CostSummary {
    /// The process up to now.
    pub wall_s: f64,
    /// Time until the first collision could begin: case, meshes, factors, reference runs.
    pub setup_s: f64,
    /// Collisions whose mesh or region of contact did not do, with what told that; 0 where the first did.
    pub trials_s: f64,
    /// The collision alone.
    pub solve_s: f64,
    /// Time of an element and step, of the collision alone.
    pub ns_per_element_update: Option<f64>,
    /// Element updates of the collision, of coarser meshes before it, and of the reference runs of all.
    pub all_element_updates: Option<u64>,
    /// Threads that the run used.
    pub threads: usize,
    /// Largest memory of the process.
    pub peak_memory_bytes: Option<u64>,
    /// Memory of the factors of condensed bodies.
    pub factor_bytes: Option<u64>,
}
