//! `summary.json`: names, order and units of its keys.

use fem_case::{CaseFile, Effect};
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

/// The name of the file.
pub const SUMMARY_FILE: &str = "summary.json";
/// The value of `program`, by which a result folder is known.
pub const PROGRAM: &str = "fem-run";

/// What a run found. SI; `None` is written as `null`: it has no meaning, or no value.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    pub collision: Quantities,
    /// Closed contacts, openings in between not counted.
    pub contact_episodes: u64,
    /// The same quantities from Hertz with instantaneous moduli.
    pub hertz: Quantities,
    pub energy: Energy,
    /// Worst drift over Σ m|v| at the start.
    pub momentum_residual_relative: Option<f64>,
    pub bodies: Vec<BodySummary>,
    pub time_step_s: Option<f64>,
    pub steps: Option<u64>,
    pub element_updates: Option<u64>,
    pub cost: CostSummary,
    #[serde(serialize_with = "effects")]
    pub effects: Vec<Effect>,
    pub warnings: Vec<String>,
    pub complete: bool,
    pub stopped_because: Option<String>,
    pub program: &'static str,
    pub version: &'static str,
    /// Names of the files that the program wrote into the folder.
    pub files: Vec<String>,
    /// The resolved case.
    pub case: CaseFile,
}

/// What a collision is known by.
#[derive(Clone, Debug, Serialize)]
pub struct Quantities {
    pub restitution: Option<f64>,
    pub contact_time_s: Option<f64>,
    pub peak_force_n: Option<f64>,
    pub max_approach_m: Option<f64>,
    pub max_contact_radius_m: Option<f64>,
    pub peak_pressure_pa: Option<f64>,
}

/// The ledger at the end of the run.
#[derive(Clone, Debug, Serialize)]
pub struct Energy {
    pub initial_j: Option<f64>,
    pub kinetic_j: Option<f64>,
    pub strain_j: Option<f64>,
    pub contact_j: Option<f64>,
    pub viscous_dissipation_j: Option<f64>,
    /// Work that a moving wall has done.
    pub wall_work_j: Option<f64>,
    pub residual_j: Option<f64>,
    /// Worst imbalance over the run / initial kinetic energy in the centre-of-mass frame.
    pub residual_relative: Option<f64>,
}

/// One body; a wall has no mass and no vibration, a reduced model no elements.
#[derive(Clone, Debug, Serialize)]
pub struct BodySummary {
    pub name: String,
    pub elements: Option<usize>,
    pub nodes: Option<usize>,
    pub mass_kg: Option<f64>,
    pub added_mass_kg: Option<f64>,
    /// Along +y.
    pub velocity_before_m_s: Option<f64>,
    pub velocity_after_m_s: Option<f64>,
    pub vibration_energy_j: Option<f64>,
}

/// What the run took.
#[derive(Clone, Debug, Serialize)]
pub struct CostSummary {
    /// The process up to now.
    pub wall_s: f64,
    /// Until the collision could begin: case, meshes, factors.
    pub setup_s: f64,
    /// The collision alone.
    pub solve_s: f64,
    pub ns_per_element_update: Option<f64>,
    pub threads: usize,
    pub peak_memory_bytes: Option<u64>,
    /// Of condensed bodies.
    pub factor_bytes: Option<u64>,
}

fn effects<S: Serializer>(effects: &[Effect], serializer: S) -> Result<S::Ok, S::Error> {
    struct Line<'a>(&'a Effect);
    impl Serialize for Line<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let mut line = serializer.serialize_struct("Effect", 3)?;
            line.serialize_field("name", self.0.name)?;
            line.serialize_field("active", &self.0.active)?;
            line.serialize_field("reason", &self.0.reason)?;
            line.end()
        }
    }
    serializer.collect_seq(effects.iter().map(Line))
}
